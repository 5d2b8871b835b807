#ifndef morsel_sph_velocity_constraints_h
#define morsel_sph_velocity_constraints_h

#include <morsel/sph/particles.h>

#include <Eigen/SparseCore>

#include <string>
#include <vector>

namespace Morsel::SPH
{
  template <int dim>
  class ParticleHost;


  /// The velocity of a place as a sum over particles; of one that is shared,
  /// over those of this rank.
  struct Trace
  {
    std::vector<unsigned int> particle;
    std::vector<double>       weight; ///< [1], sum 1
  };


  /// The velocity of a trace is prescribed.
  struct Prescribed
  {
    Trace   trace;
    Vector2 target{0., 0.}, reaction{0., 0.}; ///< [m/s], [N]
    /// On one of the ranks that know it: so that sums have it once.
    bool counts = true;
  };


  /// The traces that share particles, directly or through others.
  std::vector<std::vector<unsigned int>>
  coupled_groups(const std::vector<Prescribed *> &constraints);


  /// All prescribed velocities of a body, which hold together.
  ///
  /// With the weights of the traces as rows of W, the reactions r of one
  /// component solve W M^-1 W^T r = (target - W v) / kick. Only traces that
  /// share particles are coupled, where held sides meet at a corner. There they
  /// nearly depend on each other, since the rows of one side and those of the
  /// other both tell the velocity of the corner itself: scaled to a unit
  /// diagonal, one eigenvalue is 3e-3 to 3e-6, or 0 without corrected
  /// gradients, and the next one 0.7. So each group of coupled traces is
  /// inverted by its eigenvalues, without those that are zero; sweeps from
  /// trace to trace would take as many as one over the smallest.
  ///
  /// Targets contradict each other if there is no motion that has them. With y
  /// the traces' shares in a mode, y^T W v = y^T target takes particles as fast
  /// as |y^T target| over the sum of |W^T y|.
  class VelocityConstraints
  {
  public:
    /// @param constraints of x and of y, which stay where they are
    /// @param mass of the particles [kg]
    VelocityConstraints(std::vector<Prescribed *>  in_x,
                        std::vector<Prescribed *>  in_y,
                        const std::vector<double> &mass);

    /// Corrects accelerations so that all velocities reach their targets, and
    /// adds what that takes to the reactions.
    /// @param kick by which the velocities are going to advance [s]
    /// @param body to be named
    /// @param ranks that hold the particles of the traces together, which are
    ///   the same ones on each; collective then. Else null
    /// @throws NumericalError where targets contradict each other
    void
    enforce(Particles             &particles,
            double                 kick,
            const std::string     &body,
            const ParticleHost<2> *ranks = nullptr) const;

  private:
    /// Traces that nearly depend on each other.
    struct Mode
    {
      std::vector<Prescribed *> constraints;
      Eigen::VectorXd           share; ///< of each [1], absolute sum 2
      /// |share^T target| over the largest target that motions may take [1].
      double allowance;
    };

    struct Component
    {
      double Vector2::           *direction;
      std::vector<Prescribed *>   constraints;
      Eigen::SparseMatrix<double> inverse; ///< of W M^-1 W^T [kg]
      std::vector<Mode>           modes;
    };

    static Component
    make_component(double Vector2::          *direction,
                   std::vector<Prescribed *>  constraints,
                   const std::vector<double> &mass);

    static void
    check_targets(const Component &component, const std::string &body);

    static void
    meet_targets(const Component       &component,
                 Particles             &particles,
                 double                 kick,
                 const ParticleHost<2> *ranks);

    std::vector<Component> components;
  };
} // namespace Morsel::SPH

#endif
