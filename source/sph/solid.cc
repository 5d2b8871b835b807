#include <morsel/core/errors.h>
#include <morsel/core/parallel.h>
#include <morsel/sph/solid.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Morsel::SPH
{
  namespace
  {
    double
    sum(const std::vector<double> &x)
    {
      return std::accumulate(x.begin(), x.end(), 0.);
    }
  } // namespace


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
      , host(communicator,
             body.shape.lower_corner,
             body.shape.upper_corner,
             kernel.support(),
             body.spacing)
      , constants{material,
                  softening,
                  body.solid.viscosity_alpha,
                  body.solid.viscosity_beta,
                  kernel.h}
      , strain_loop(choose_strain_loop(linear_law, body.damage.enabled))
      , viscosity(body.solid.viscosity == "on" ||
                  (body.solid.viscosity == "auto" && body.damage.enabled))
  {
    force_loop = choose_force_loop(viscosity);
    if (body.damage.enabled &&
        dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw InputError("Body '" + body.name +
                       "' can fail (Damage/Enabled = true), which runs on one "
                       "rank only: start the program without mpirun, or with "
                       "'mpirun -np 1'.");
    fill(body);
    if (body.damage.enabled)
      make_breakable(body, scene);
  }


  void
  Solid::fill(const Scene::ParticleBody &body)
  {
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
    const auto        &v = body.initial_velocity;
    particles.motion.assign(n, {0., 0., v[0], v[1]});
    particles.half_velocity.assign(n, {v[0], v[1]});
    particles.acceleration.assign(n, {0., 0.});
    particles.gradient.assign(n, {0., 0., 0., 0.});
    particles.pair_stress.assign(n, {0., 0., 0., 0.});
    particles.hourglass.assign(n,
                               body.solid.hourglass * material.youngs_modulus);
    if (viscosity)
      particles.viscous_heat.assign(n, 0.);

    bonds.build(particles, kernel);
    particles.shape.resize(n);
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const Symmetric2 m = bonds.moment(i);
        if (smaller_eigenvalue(m) < 1e-3)
          throw InputError(
              "Body '" + body.name +
              "': its particles do not span the plane (a single row or column "
              "has no strain across it); use at least two rows and columns.");
        particles.shape[i] = inverse(m);
      }
  }


  void
  Solid::make_breakable(const Scene::ParticleBody &body,
                        const Scene::Scene        &scene)
  {
    const Materials::DamageLaw law(body.damage,
                                   material,
                                   body.material.compressive_strength,
                                   particles.volume);
    fracture = std::make_unique<Fracture>(particles,
                                          bonds,
                                          kernel,
                                          material,
                                          linear_law,
                                          law,
                                          body.damage,
                                          scene.measures.friend_distance *
                                              particles.spacing,
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
    // Undamped, the lattice is stable up to 1.0 h/c (measured), that is to a
    // highest frequency of 2 c/h; a spring of stiffness k on one particle
    // adds k/m to its square. Linear viscosity damps the shortest wave at
    // 1.54 alpha c/dp (sum over the lattice's pairs); evaluated at a
    // predicted velocity it asks for w^2 dt^2/4 + g dt/2 < 1.
    const double c = material.wave_speed;
    const double w2 =
        4. * c * c / (kernel.h * kernel.h) + contact_stiffness / particles.mass;
    const double g =
        viscosity ? 1.54 * constants.viscosity_alpha * c / particles.spacing
                  : 0.;
    return cfl * (std::sqrt(0.25 * g * g + w2) - 0.5 * g) * 2. / w2;
  }


  void
  Solid::compute_accelerations(const double time_step)
  {
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      strain_loop(particles, bonds, constants, begin, end);
    });
    host.exchange(particles.pair_stress);
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      force_loop(particles, bonds, constants, time_step, begin, end);
    });
  }


  void
  Solid::add_grain_forces(const double time_step)
  {
    if (granular && granular->active())
      granular->add_forces(time_step);
  }


  void
  Solid::apply_forces(const std::vector<Contact::ParticleForce> &forces)
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


  SolidEnergies
  Solid::energies(const double time_step) const
  {
    SolidEnergies e;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const double half = started ? 0.5 * time_step : 0.;
        const double v_x =
            particles.half_velocity[i].x + half * particles.acceleration[i].x;
        const double v_y =
            particles.half_velocity[i].y + half * particles.acceleration[i].y;
        e.kinetic += 0.5 * particles.mass * (v_x * v_x + v_y * v_y);
        if (fracture && particles.failed[i])
          continue;
        e.strain += particles.volume *
                    Materials::stored_energy(
                        softening,
                        material,
                        response_at(particles, material, linear_law, i),
                        fracture ? particles.damage[i] : 0.);
        e.hourglass +=
            particles.hourglass[i] * fit_residual(particles, bonds, i);
      }
    e.viscous_heat = sum(particles.viscous_heat);
    if (fracture)
      {
        e.damage_heat   = sum(particles.damage_heat);
        e.bond_heat     = fracture->bond_heat();
        e.granular      = granular->stored_energy();
        e.friction_heat = granular->friction_heat();
        e.viscous_heat += granular->viscous_heat();
      }
    double *const all = &e.strain;
    host.sum(dealii::ArrayView<double>(all, sizeof(e) / sizeof(double)));
    return e;
  }


  Vector2
  Solid::momentum() const
  {
    Vector2 p{0., 0.};
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        p.x += particles.mass * particles.half_velocity[i].x;
        p.y += particles.mass * particles.half_velocity[i].y;
      }
    host.sum(dealii::ArrayView<double>(&p.x, 2));
    return p;
  }


  Materials::PlaneStrainStress
  Solid::stress(const unsigned int i) const
  {
    if (fracture && particles.failed[i])
      return granular->stress(i);
    return Materials::soften(softening,
                             response_at(particles, material, linear_law, i),
                             fracture ? particles.damage[i] : 0.);
  }


  double
  Solid::density_ratio(const unsigned int i) const
  {
    if (fracture && particles.failed[i])
      return granular->density_ratio(i);
    return 1. / response_at(particles, material, linear_law, i).jacobian;
  }


  unsigned int
  Solid::inverted_count() const
  {
    unsigned int count = 0;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      count += !(density_ratio(i) > 0.) || !std::isfinite(density_ratio(i));
    return count;
  }


  long
  Solid::first_not_finite() const
  {
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const Motion &m = particles.motion[i];
        if (!std::isfinite(m.u_x + m.u_y + m.v_x + m.v_y))
          return i;
      }
    return -1;
  }


  Contact::ParticleSide
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
