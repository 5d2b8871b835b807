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

    /// Adds one place of the two traction-free faces behind the tip, whose
    /// strain energy densities differ; it counts for J_2 alone.
    /// @param distance to the tip [m]
    /// @param energy_jump strain energy density of the left face, as seen in
    ///   the tip's direction, minus that of the right one [J/m^3]
    /// @param weight   quadrature weight along the faces [m]
    void
    add_faces(const double distance,
              const double energy_jump,
              const double weight)
    {
      energy_release_across -= ring_weight(distance) * energy_jump * weight;
    }

    /// K_I and K_II from what was added.
    StressIntensity
    stress_intensity() const;

    /// J from what was added [J/m^2], for the check J = (K_I^2 + K_II^2)/E'.
    double
    energy_release_rate() const
    {
      return energy_release;
    }

    /// J_2, the component of the J vector across the crack, from what was
    /// added, the faces included [J/m^2]: -2 K_I K_II/E' for the singular
    /// field (Hellen and Blackburn 1975).
    double
    energy_release_rate_across() const
    {
      return energy_release_across;
    }

    const Ring &
    get_ring() const
    {
      return ring;
    }

    /// Adds what another part of the domain (a rank) gathered.
    /// @param sums as of partial_sums()
    void
    add_partial_sums(const std::vector<double> &sums)
    {
      integral_I += sums[0];
      integral_II += sums[1];
      energy_release += sums[2];
      energy_release_across += sums[3];
    }

    /// The running sums (mode I, mode II, J_1, J_2) for a sum over ranks.
    std::vector<double>
    partial_sums() const
    {
      return {integral_I, integral_II, energy_release, energy_release_across};
    }

  private:
    /// q of the ring: 1 at the tip, 0 beyond the outer radius.
    double
    ring_weight(const double distance) const;

    CrackTip     tip;
    ElasticPlane material;
    Ring         ring;
    double       integral_I            = 0.;
    double       integral_II           = 0.;
    double       energy_release        = 0.;
    double       energy_release_across = 0.;
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


  /// Refuses an outer radius that the user wishes and that does not fit;
  /// 0 stands for the largest one that fits.
  /// @param entry the parameter that wishes it
  /// @throws InputError naming the obstacle and the largest radius
  void
  check_ring_radius(const CrackTip           &tip,
                    const std::vector<Crack> &cracks,
                    const double              distance_to_boundary,
                    const double              radius,
                    const std::string &entry = "Stress intensity/Ring radius");


  /// The largest outer radius that ring_obstacle() accepts at a tip [m].
  double
  largest_ring_radius(const CrackTip           &tip,
                      const std::vector<Crack> &cracks,
                      const double              distance_to_boundary);
} // namespace Morsel::Fracture

#endif
