#ifndef morsel_sph_updated_lagrangian_h
#define morsel_sph_updated_lagrangian_h

#include <morsel/scene/scene.h>
#include <morsel/sph/cloud.h>
#include <morsel/sph/deformable_body.h>
#include <morsel/sph/leapfrog.h>
#include <morsel/sph/updated_loops.h>
#include <morsel/sph/visibility.h>

#include <string>
#include <vector>

namespace Morsel::SPH
{
  /// A body of particles in the updated Lagrangian rate form: density by the
  /// continuity equation (T3-22), stress by Hooke's law for the Jaumann rate
  /// (T3-24), momentum by T3-36, each corrected as the scene asks. On one rank.
  ///
  /// Leapfrog: positions, density and stress at whole steps, velocities at
  /// half steps. The velocity gradient belongs to the half step and is
  /// evaluated at the places halfway, where a rigid rotation by a finite
  /// angle is exactly skew (Hughes and Winget 1980); so stress rotates with
  /// the body by exactly the angle of the step.
  ///
  /// Neighbours come from a list with a skin, made anew when a particle has
  /// moved by half of it. Particles keep the order in which they were given:
  /// in a solid neighbours stay near, and with a lattice's rows near in memory.
  class UpdatedLagrangian final : public DeformableBody
  {
  public:
    /// Fills the body's shape.
    UpdatedLagrangian(const Scene::ParticleBody &body,
                      const Scene::Scene        &scene);

    double
    stable_time_step(double contact_stiffness) const override;

    /// @throws NumericalError if a particle has left for infinity.
    void
    compute_accelerations(double time_step) override;

    void
    advance(double time_step) override;

    /// Strain energy is the integral of the stress's power, since the rate
    /// form has no potential.
    SolidEnergies
    energies() const override;

    Vector2
    momentum() const override;

    Materials::PlaneStrainStress
    stress(const unsigned int i) const override
    {
      return sigma[i];
    }

    double
    density_ratio(const unsigned int i) const override
    {
      return density[i] / material.density;
    }

    /// A step that takes more than twice a particle's volume turns the sign of
    /// its density.
    long
    first_inverted() const override;

    Materials::Tensor2
    velocity_gradient(unsigned int i) const override;

    std::vector<Vector2>
    surface_vectors() const override;

    double
    neighbours_per_particle() const override;

    Particles &
    state() override
    {
      return particles;
    }

    const Particles &
    get_particles() const override
    {
      return particles;
    }

    const Materials::Elasticity &
    get_material() const override
    {
      return material;
    }

    void
    exchange_state(StateArchive &state) override;

    /// How often the neighbours were searched for.
    unsigned int
    search_count() const
    {
      return searches;
    }

    /// Gives every particle the stress that @p stress_at says of its place.
    template <typename Function>
    void
    set_stress(const Function &stress_at)
    {
      for (unsigned int i = 0; i < particles.n_owned; ++i)
        sigma[i] = stress_at(particles.reference[i]);
    }

  private:
    UpdatedLagrangian(const Scene::ParticleBody &body,
                      const Scene::Scene        &scene,
                      const Cloud               &cloud);

    void
    search_neighbours();

    /// Places at the time @p back before the present one, with the
    /// velocities of the half step (halfway) or the present ones.
    void
    place_particles(double back, bool halfway);

    void
    update_stress(double time_step);

    UpdatedArrays
    arrays();

    const std::string           name;
    const double                depth, cfl, epsilon; ///< of artificial stress
    const Materials::Elasticity material;
    const Kernel                kernel;
    const double                skin;       ///< [m]
    const Visibility            visibility; ///< in the reference places
    UpdatedConstants            constants;

    Particles particles;
    Leapfrog  leapfrog;

    std::vector<double>                       density, area;
    std::vector<double>                       mass_per_depth; ///< [kg/m]
    std::vector<Materials::PlaneStrainStress> sigma;
    std::vector<double>                       stress_work;     ///< [J]
    std::vector<double>                       artificial_heat; ///< [J]
    std::vector<Motion>                       place;
    std::vector<Symmetric2>                   artificial;

    NeighbourList                 neighbours;
    std::vector<dealii::Point<2>> searched_at;
    unsigned int                  searches = 0;
    std::vector<double>           weight, closeness;
    std::vector<Vector2>          offset;
  };
} // namespace Morsel::SPH

#endif
