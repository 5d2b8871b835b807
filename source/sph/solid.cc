#include <morsel/core/errors.h>
#include <morsel/core/parallel.h>
#include <morsel/sph/body_cracks.h>
#include <morsel/sph/solid.h>
#include <morsel/sph/stable_step.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Morsel::SPH
{
  Solid::Solid(const Scene::ParticleBody &body,
               const Scene::Scene        &scene,
               const MPI_Comm             communicator)
      : depth(scene.depth)
      , cfl(body.solid.cfl)
      , kernel(kernel_named(body.solid.kernel),
               body.solid.smoothing_ratio * body.spacing)
      , material(body.material.youngs_modulus,
                 body.material.poissons_ratio,
                 body.material.density)
      , linear_law(body.material.law == "linear")
      , softening(body.damage.softening == "deviator"
                      ? Materials::Softening::deviator
                      : Materials::Softening::tensile_principal)
      , hourglass_stiffness(body.solid.hourglass * material.youngs_modulus)
      , normalisation(normalisation_named(body.solid.normalisation))
      , host(communicator,
             body.shape.lower_corner,
             body.shape.upper_corner,
             kernel.support(),
             body.spacing)
      , viscosity(body.solid.viscosity == "on" ||
                  (body.solid.viscosity == "auto" && body.damage.enabled))
  {
    if (body.damage.enabled &&
        dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw InputError("Body '" + body.name +
                       "' can fail (Damage/Enabled = true), which runs on one "
                       "rank only: start the program without mpirun, or with "
                       "'mpirun -np 1'.");
    fill(body, scene.seed);
    choose_loops(body);
    if (body.damage.enabled)
      make_breakable(body, scene);
  }


  void
  Solid::fill(const Scene::ParticleBody &body, const unsigned int seed)
  {
    if (body.scatter > 0.)
      {
        const auto                          points = body.positions(seed);
        std::vector<ParticleHost<2>::Index> ids(points.size());
        std::iota(ids.begin(), ids.end(), ParticleHost<2>::Index(0));
        host.insert(points, ids);
      }
    else
      host.insert_lattice(body.shape.lower_corner,
                          body.shape.upper_corner,
                          body.particles_across);
    const double dp     = body.spacing;
    particles.spacing   = dp;
    particles.volume    = dp * dp * depth;
    particles.mass      = material.density * particles.volume;
    particles.n_owned   = host.n_owned();
    particles.n_local   = host.n_local();
    particles.reference = host.reference_positions();
    particles.id.assign(host.ids().begin(), host.ids().end());

    const unsigned int n = particles.n_local;
    particles.set_velocity(body.initial_velocity_function());
    particles.acceleration.assign(n, {0., 0.});
    particles.gradient.assign(n, {0., 0., 0., 0.});
    particles.pair_stress.assign(n, {0., 0., 0., 0.});
    particles.hourglass.assign(n, hourglass_stiffness);
    if (viscosity)
      particles.viscous_heat.assign(n, 0.);

    bonds.build(particles, kernel, cracks_of(body, seed));
    normalise(body);
  }


  void
  Solid::normalise(const Scene::ParticleBody &body)
  {
    const bool own_fit = normalisation != Normalisation::gradient_matrix &&
                         hourglass_stiffness > 0.;
    const double area = particles.spacing * particles.spacing;
    particles.shape.resize(particles.n_local);
    if (own_fit)
      particles.fit.resize(particles.n_local);
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const Symmetric2 m = bonds.moment(i);
        if (smaller_eigenvalue(m) < 1e-3)
          throw InputError(
              "Body '" + body.name +
              "': its particles do not span the plane (a single row or column "
              "has no strain across it); use at least two rows and columns.");
        particles.shape[i] = inverse(m);
        if (own_fit)
          particles.fit[i] = particles.shape[i];
        if (normalisation == Normalisation::gradient_matrix)
          continue;
        double sum = kernel.value(0.);
        for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
             ++k)
          sum += kernel.value(std::sqrt(bonds.length_square(k)));
        particles.shape[i] =
            gradient_correction(normalisation, {m, area * sum});
      }
  }


  void
  Solid::choose_loops(const Scene::ParticleBody &body)
  {
    constants         = {};
    constants.mu      = material.mu;
    constants.bulk    = material.bulk;
    constants.density = material.density;
    constants.mass    = particles.mass;
    constants.uniform_hourglass =
        body.solid.hourglass * material.youngs_modulus;
    constants.viscosity_alpha_c =
        body.solid.viscosity_alpha * material.wave_speed;
    constants.viscosity_beta   = body.solid.viscosity_beta;
    constants.smoothing_length = kernel.h;

    // Nothing is decided inside the loops.
    const PairKernels &kernels  = pair_kernels();
    const unsigned int softened = !body.damage.enabled ? 0
                                  : softening == Materials::Softening::deviator
                                      ? 1
                                      : 2;
    strain_loop = particles.fit.empty() ? kernels.strain[linear_law][softened]
                                        : kernels.strain_own_fit[linear_law];
    force_loop  = kernels.force[viscosity][body.damage.enabled];
  }


  void
  Solid::make_breakable(const Scene::ParticleBody &body,
                        const Scene::Scene        &scene)
  {
    const Materials::DamageLaw law(body.damage,
                                   material,
                                   body.material.compressive_strength,
                                   particles.volume);
    fracture = std::make_unique<DamageEvolution>(
        particles,
        bonds,
        kernel,
        material,
        linear_law,
        law,
        constants,
        body.damage,
        scene.measures.friend_distance * particles.spacing,
        scene.seed);
    granular = std::make_unique<Granular>(
        particles,
        bonds,
        kernel,
        material,
        GranularConstants{body.damage.granular_friction,
                          body.solid.viscosity_alpha,
                          body.solid.viscosity_beta,
                          scene.contact.stiffness * material.p_wave_modulus *
                              depth},
        fracture->exposed_particles(),
        fracture->contact_diameters());
  }


  double
  Solid::stable_time_step(const double contact_stiffness) const
  {
    // Where hourglass control is stiffer than stress, its own highest
    // frequency rules: 3.4 alpha E/(rho h^2) is the largest square of it
    // (measured over kernels and smoothing ratios). A spring of stiffness k on
    // one particle adds k/m to the square.
    const double w2 =
        std::max(square_of_highest_frequency(material.wave_speed, kernel.h),
                 3.4 * hourglass_stiffness /
                     (material.density * kernel.h * kernel.h)) +
        contact_stiffness / particles.mass;
    const double g = viscosity
                         ? viscous_damping_rate(constants.viscosity_alpha_c,
                                                particles.spacing)
                         : 0.;
    return cfl * largest_stable_step(w2, g);
  }


  void
  Solid::compute_accelerations(const double time_step)
  {
    constexpr unsigned int grain  = 64;
    const BondedArrays     arrays = bonded_arrays(particles, bonds);
    parallel_for(
        particles.n_groups(),
        [&](unsigned int begin, unsigned int end) {
          strain_loop(arrays, constants, begin, end);
        },
        grain);
    host.exchange(particles.pair_stress);
    parallel_for(
        particles.n_groups(),
        [&](unsigned int begin, unsigned int end) {
          force_loop(arrays, constants, time_step, begin, end);
        },
        grain);
  }


  void
  Solid::add_grain_forces(const double time_step)
  {
    if (granular && granular->active())
      granular->add_forces(time_step);
  }


  void
  Solid::apply_forces(const std::vector<ParticleForce> &forces)
  {
    for (const auto &f : forces)
      {
        particles.acceleration[f.particle].x += f.force[0] / particles.mass;
        particles.acceleration[f.particle].y += f.force[1] / particles.mass;
      }
  }


  void
  Solid::grow_damage(const double time_step)
  {
    if (fracture)
      granular->take_over(fracture->update(time_step));
  }


  void
  Solid::advance(const double dt)
  {
    // The first kick carries the velocities from time 0 to half a step.
    const double kick = started ? dt : 0.5 * dt;
    started           = true;
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      for (unsigned int i = begin; i < end; ++i)
        {
          const Vector2 a = particles.acceleration[i];
          Vector2      &v = particles.half_velocity[i];
          Motion       &m = particles.motion[i];
          v.x += kick * a.x;
          v.y += kick * a.y;
          m.u_x += dt * v.x;
          m.u_y += dt * v.y;
          m.v_x = v.x + 0.5 * dt * a.x;
          m.v_y = v.y + 0.5 * dt * a.y;
        }
    });
    host.exchange(particles.motion);
  }


  void
  Solid::advance_grains(const double dt)
  {
    if (granular && granular->active())
      granular->advance(dt);
  }


  void
  Solid::set_near_face(const std::vector<unsigned int> &near)
  {
    if (!fracture)
      return;
    for (const unsigned int i : near)
      particles.near_face[i] = 1;
  }


  ParticleSide
  Solid::contact_side() const
  {
    return {particles.spacing,
            depth,
            particles.mass,
            material.youngs_modulus,
            material.p_wave_modulus,
            kernel.h};
  }
} // namespace Morsel::SPH
