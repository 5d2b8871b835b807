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
               const double               depth,
               const unsigned int         seed,
               const double               friend_distance,
               const double               contact_stiffness_factor)
      : depth(depth)
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
      , constants{material,
                  softening,
                  body.solid.viscosity_alpha,
                  body.solid.viscosity_beta,
                  kernel.h}
      , viscosity(body.solid.viscosity == "on" ||
                  (body.solid.viscosity == "auto" && body.damage.enabled))
  {
    const auto        &lower = body.shape.lower_corner;
    const auto         size  = body.shape.upper_corner - lower;
    const double       dp    = body.spacing;
    const unsigned int rows  = std::lround(size[1] / dp);

    particles.spacing = dp;
    particles.volume  = dp * dp * depth;
    particles.mass    = material.density * particles.volume;
    for (unsigned int r = 0; r < rows; ++r)
      for (unsigned int c = 0; c < body.particles_across; ++c)
        {
          particles.reference.emplace_back(lower[0] + (c + 0.5) * dp,
                                           lower[1] + (r + 0.5) * dp);
          particles.id.push_back(particles.id.size());
        }
    const unsigned int n = particles.n_owned = particles.n_local =
        particles.reference.size();

    const auto &v = body.initial_velocity;
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
    for (unsigned int i = 0; i < n; ++i)
      particles.shape[i] = inverse(bonds.moment(i));

    strain_loop = choose_strain_loop(linear_law, body.damage.enabled);
    force_loop  = choose_force_loop(viscosity);
    if (body.damage.enabled)
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
                                              friend_distance * dp,
                                              seed);
        granular = std::make_unique<Granular>(
            particles,
            bonds,
            kernel,
            material,
            GranularConstants{body.damage.granular_friction,
                              body.solid.viscosity_alpha,
                              body.solid.viscosity_beta,
                              contact_stiffness_factor *
                                  material.p_wave_modulus * depth},
            fracture->exposed_particles(),
            fracture->contact_diameters());
      }
  }


  double
  Solid::stable_time_step(const double contact_stiffness) const
  {
    // Lattice: stable up to about 1.0 h/c, measured; a spring of stiffness k
    // on one particle adds k/m to the square of the highest frequency.
    const double elastic = kernel.h / material.wave_speed;
    const double highest = 4. / (elastic * elastic);
    return cfl * 2. / std::sqrt(highest + contact_stiffness / particles.mass);
  }


  void
  Solid::compute_accelerations(const double time_step)
  {
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      strain_loop(particles, bonds, constants, begin, end);
    });
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      force_loop(particles, bonds, constants, time_step, begin, end);
    });
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
