#ifndef morsel_fracture_interaction_integral_h
#define morsel_fracture_interaction_integral_h

#include <morsel/fracture/crack.h>
#include <morsel/fracture/elastic_plane.h>

#include <string>
#include <vector>

namespace Morsel::Fracture
{
  /// The ring that an interaction integral is taken over: its weight falls
  /// from 1 at the inner to 0 at the outer radius [m].
  struct Ring
  {
    double inner_radius = 0.;
    double outer_radius = 0.;
  };


  struct StressIntensity
  {
    double mode_I  = 0.; ///< K_I [Pa sqrt(m)]
    double mode_II = 0.; ///< K_II [Pa sqrt(m)]
  };


  /// The interaction integral at one tip over one ring, for any field that
  /// can be sampled at points (Shih and Asaro 1988, domain form):
  /// I = integral of (sigma_ij u^aux_i,1 + sigma^aux_ij u_i,1
  ///     - sigma_ik eps^aux_ik delta_1j) q_,j dA, K = E'/2 I,
  /// with the two unit Williams fields as auxiliary fields. q is a smooth
  /// function of the distance to the tip, so that the integral suits finite
  /// elements and particles alike.
  class InteractionIntegral
  {
  public:
    InteractionIntegral(const CrackTip     &tip,
                        const ElasticPlane &material,
                        const Ring         &ring);

    /// Whether a point at this place contributes: between the two radii.
    bool
    reaches(const dealii::Point<2> &p) const
    {
      const double r = p.distance(tip.position);
      return r > ring.inner_radius && r < ring.outer_radius;
    }

    /// Adds one quadrature point or particle.
    /// @param p        where [m]
    /// @param gradient H_ij = du_i/dx_j there, global components [1]
    /// @param stress   the stress there, global components [Pa]
    /// @param weight   quadrature weight or particle area [m^2]
    void
    add(const dealii::Point<2>              &p,
        const dealii::Tensor<2, 2>          &gradient,
        const dealii::SymmetricTensor<2, 2> &stress,
        const double                         weight);

    /// K_I and K_II from what was added.
    StressIntensity
    stress_intensity() const;

    /// J from what was added [J/m^2], for the check J = (K_I^2 + K_II^2)/E'.
    double
    energy_release_rate() const
    {
      return energy_release;
    }

    const Ring &
    get_ring() const
    {
      return ring;
    }

    /// Adds what another part of the domain (a rank) gathered.
    void
    add_partial_sums(const double mode_I,
                     const double mode_II,
                     const double energy)
    {
      integral_I += mode_I;
      integral_II += mode_II;
      energy_release += energy;
    }

    /// The three running sums (mode I, mode II, J) for a sum over ranks.
    std::vector<double>
    partial_sums() const
    {
      return {integral_I, integral_II, energy_release};
    }

  private:
    CrackTip     tip;
    ElasticPlane material;
    Ring         ring;
    double       integral_I     = 0.;
    double       integral_II    = 0.;
    double       energy_release = 0.;
  };


  /// K over several rings: the mean, and the spread (largest minus smallest)
  /// as its own error estimate.
  struct RingStatistics
  {
    StressIntensity mean;
    StressIntensity spread;
  };

  /// @pre at least one ring
  RingStatistics
  ring_statistics(const std::vector<StressIntensity> &rings);


  /// Why a ring about a tip cannot be used, as half a sentence; empty if it
  /// can. A ring must not reach another crack, a kink of its own crack or
  /// the crack's other end, nor the boundary of the body.
  /// @param distance_to_boundary from the tip to the body's boundary [m]
  std::string
  ring_obstacle(const CrackTip           &tip,
                const std::vector<Crack> &cracks,
                const double              distance_to_boundary,
                const Ring               &ring);


  /// The largest outer radius that ring_obstacle() accepts at a tip [m].
  double
  largest_ring_radius(const CrackTip           &tip,
                      const std::vector<Crack> &cracks,
                      const double              distance_to_boundary);
} // namespace Morsel::Fracture

#endif
