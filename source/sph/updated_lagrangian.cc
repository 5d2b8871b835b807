#include <morsel/core/errors.h>
#include <morsel/core/number_list.h>
#include <morsel/core/parallel.h>
#include <morsel/sph/artificial_stress.h>
#include <morsel/sph/body_cloud.h>
#include <morsel/sph/body_cracks.h>
#include <morsel/sph/stable_step.h>
#include <morsel/sph/updated_lagrangian.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace Morsel::SPH
{
  namespace
  {
    /// Of the list of neighbours, in spacings.
    constexpr double skin_ratio = 0.3;


    /// Stress after a step of Hooke's law in the Jaumann rate, with the
    /// velocity gradient L of the half step: the old stress turned by the
    /// step's rotation (I - dt W/2)^-1 (I + dt W/2), plus dt C : D.
    Materials::PlaneStrainStress
    jaumann_step(const Materials::PlaneStrainStress &sigma,
                 const Tensor2                      &L,
                 const Materials::Elasticity        &material,
                 const double                        dt)
    {
      const double half = 0.25 * dt * (L.yx - L.xy); // tan of half the angle
      const double s    = 2. * half / (1. + half * half);
      const double c    = (1. - half * half) / (1. + half * half);
      const double tr   = dt * (L.xx + L.yy);
      const double mu2  = 2. * material.mu;
      const double mean = material.lambda * tr;
      const double turn = 2. * s * c * sigma.xy;
      return {
          c * c * sigma.xx - turn + s * s * sigma.yy + mean + mu2 * dt * L.xx,
          s * s * sigma.xx + turn + c * c * sigma.yy + mean + mu2 * dt * L.yy,
          s * c * (sigma.xx - sigma.yy) + (c * c - s * s) * sigma.xy +
              material.mu * dt * (L.xy + L.yx),
          sigma.zz + mean};
    }


    /// Cells, which cost some time, only where their volumes differ.
    Cloud
    particles_of(const Scene::ParticleBody &body, const unsigned int seed)
    {
      if (!body.is_even_lattice())
        return body_cloud(body, seed);
      Cloud cloud;
      cloud.points = body.positions(seed);
      return cloud;
    }
  } // namespace


  UpdatedLagrangian::UpdatedLagrangian(const Scene::ParticleBody &body,
                                       const Scene::Scene        &scene)
      : UpdatedLagrangian(body, scene, particles_of(body, scene.seed))
  {}


  UpdatedLagrangian::UpdatedLagrangian(const Scene::ParticleBody &body,
                                       const Scene::Scene        &scene,
                                       const Cloud               &cloud)
      : name(body.name)
      , depth(scene.depth)
      , cfl(body.solid.cfl)
      , epsilon(body.solid.artificial_stress)
      , material(body.material.youngs_modulus,
                 body.material.poissons_ratio,
                 scene.time.inertia_factor * body.material.density)
      , kernel(kernel_named(body.solid.kernel),
               body.solid.smoothing_ratio * body.spacing)
      , skin(skin_ratio * body.spacing)
      , visibility(visibility_in(body, cloud.points, kernel.support()))
  {
    const double dp     = body.spacing;
    particles.reference = cloud.points;
    particles.spacing   = dp;

    const unsigned int n = particles.reference.size();
    area.assign(n, dp * dp);
    if (!body.is_even_lattice())
      for (unsigned int i = 0; i < n; ++i)
        area[i] = cloud.cells[i].area;
    particles.set_areas(area, depth, material.density);
    for (const double a : area)
      mass_per_depth.push_back(material.density * a);
    particles.n_owned = particles.n_local = n;
    particles.id.resize(n);
    std::iota(particles.id.begin(), particles.id.end(), 0ull);
    particles.set_velocity(body.initial_velocity_function());
    particles.acceleration.assign(n, {0., 0.});
    particles.gradient.assign(n, {0., 0., 0., 0.});
    particles.pair_stress.assign(n, {0., 0., 0., 0.});
    particles.shape.assign(n, {1., 1., 0.});
    particles.viscous_heat.assign(n, 0.);
    density.assign(n, material.density);
    sigma.assign(n, {0., 0., 0., 0.});
    stress_work.assign(n, 0.);
    artificial_heat.assign(n, 0.);
    artificial.assign(n, {0., 0., 0.});
    place.resize(n);
    if (const auto s = number_list(body.initial_stress, 3); !s.empty())
      sigma.assign(
          n, {s[0], s[1], s[2], body.material.poissons_ratio * (s[0] + s[1])});

    constants.kernel        = kernel.kind;
    constants.normalisation = normalisation_named(body.normalisation());
    constants.h             = kernel.h;
    constants.viscosity_alpha_c =
        body.solid.viscosity_alpha * material.wave_speed;
    constants.viscosity_beta     = body.solid.viscosity_beta;
    constants.closeness_scale    = 1. / kernel.value(dp);
    constants.closeness_exponent = body.solid.artificial_stress_exponent;
    constants.viscosity          = body.solid.viscosity == "on";
    constants.artificial_stress  = epsilon > 0.;

    search_neighbours();
    place_particles(0., false);
    correct_geometry(arrays(), constants);
  }


  double
  UpdatedLagrangian::stable_time_step(const double contact_stiffness) const
  {
    const double w2 =
        square_of_highest_frequency(material.wave_speed, kernel.h) +
        contact_stiffness / particles.least_mass();
    const double g = constants.viscosity
                         ? viscous_damping_rate(constants.viscosity_alpha_c,
                                                particles.spacing)
                         : 0.;
    return cfl * largest_stable_step(w2, g);
  }


  void
  UpdatedLagrangian::search_neighbours()
  {
    searched_at.resize(particles.n_owned);
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        searched_at[i] = particles.position(i);
        // A search over a body that has flown apart would not end.
        if (!(searched_at[i].norm() < 1e6 * (particles.spacing * 1e3)))
          {
            std::ostringstream text;
            text << "Body '" << name << "' has flown apart: particle " << i
                 << " from (" << particles.reference[i]
                 << ") m is out of reach. The updated Lagrangian form is "
                    "unstable in tension: load less, add artificial stress, or "
                    "take 'Formulation' = 'total Lagrangian'.";
            throw NumericalError(text.str());
          }
      }
    neighbours = find_neighbours(
        searched_at, particles.n_owned, kernel.support() + skin);
    keep_visible(neighbours, particles.reference, visibility);
    ++searches;
    const std::size_t n = neighbours.index.size();
    weight.resize(n);
    offset.resize(n);
    if (constants.artificial_stress)
      closeness.resize(n);
  }


  void
  UpdatedLagrangian::place_particles(const double back, const bool halfway)
  {
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      for (unsigned int i = begin; i < end; ++i)
        {
          const Motion  &m = particles.motion[i];
          const Vector2 &v = particles.half_velocity[i];
          const auto    &X = particles.reference[i];
          if (halfway)
            place[i] = {
                X[0] + m.u_x - back * v.x, X[1] + m.u_y - back * v.y, v.x, v.y};
          else
            place[i] = {X[0] + m.u_x, X[1] + m.u_y, m.v_x, m.v_y};
        }
    });
  }


  UpdatedArrays
  UpdatedLagrangian::arrays()
  {
    return {&neighbours,
            place.data(),
            area.data(),
            particles.mass.data(),
            mass_per_depth.data(),
            density.data(),
            weight.data(),
            offset.data(),
            closeness.data(),
            particles.shape.data(),
            particles.pair_stress.data(),
            artificial.data(),
            particles.acceleration.data(),
            particles.viscous_heat.data(),
            artificial_heat.data()};
  }


  void
  UpdatedLagrangian::compute_accelerations(const double time_step)
  {
    double farthest = 0.;
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      farthest = std::max(
          farthest, (particles.position(i) - searched_at[i]).norm_square());
    if (farthest > 0.25 * skin * skin)
      search_neighbours();

    place_particles(0., false);
    const UpdatedArrays a = arrays();
    correct_geometry(a, constants);
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      for (unsigned int i = begin; i < end; ++i)
        {
          const Materials::PlaneStrainStress &s = sigma[i];
          const Symmetric2                   &B = particles.shape[i];
          const Tensor2 T = product(Tensor2{s.xx, s.xy, s.xy, s.yy}, B);
          particles.pair_stress[i] = {T.xx, T.xy, T.yx, T.yy};
          if (constants.artificial_stress)
            artificial[i] = artificial_stress(s, epsilon);
        }
    });
    sum_forces(a, constants, time_step);
  }


  void
  UpdatedLagrangian::advance(const double dt)
  {
    leapfrog.advance(particles, dt);
    update_stress(dt);
  }


  void
  UpdatedLagrangian::update_stress(const double dt)
  {
    place_particles(0.5 * dt, true);
    sum_velocity_gradients(arrays(), constants, particles.gradient.data());
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      for (unsigned int i = begin; i < end; ++i)
        {
          const Tensor2                     &L   = particles.gradient[i];
          const Materials::PlaneStrainStress old = sigma[i];
          Materials::PlaneStrainStress      &s   = sigma[i];
          s = jaumann_step(old, L, material, dt);

          const double before   = area[i];
          const double dilation = 0.5 * dt * (L.xx + L.yy);
          density[i] *= (1. - dilation) / (1. + dilation);
          area[i] = mass_per_depth[i] / density[i];
          stress_work[i] += 0.25 * depth * (before + area[i]) * dt *
                            ((old.xx + s.xx) * L.xx + (old.yy + s.yy) * L.yy +
                             (old.xy + s.xy) * (L.xy + L.yx));
        }
    });
  }


  SolidEnergies
  UpdatedLagrangian::energies() const
  {
    SolidEnergies e;
    e.kinetic      = kinetic_energy(leapfrog, particles);
    e.strain       = sum_of(stress_work);
    e.viscous_heat = sum_of(particles.viscous_heat);
    e.artificial   = sum_of(artificial_heat);
    return e;
  }


  Vector2
  UpdatedLagrangian::momentum() const
  {
    return half_step_momentum(particles);
  }


  long
  UpdatedLagrangian::first_inverted() const
  {
    const auto bad = std::find_if(density.begin(),
                                  density.end(),
                                  [](const double d) { return !(d > 0.); });
    return bad == density.end() ? -1 : bad - density.begin();
  }


  Tensor2
  UpdatedLagrangian::velocity_gradient(const unsigned int i) const
  {
    // With the weights of the last compute_accelerations().
    const Motion &own = particles.motion[i];
    Tensor2       L{0., 0., 0., 0.};
    for (unsigned int k = neighbours.start[i]; k < neighbours.start[i + 1]; ++k)
      {
        const unsigned int j   = neighbours.index[k];
        const double       w   = area[j] * weight[k];
        const double       v_x = w * (particles.motion[j].v_x - own.v_x);
        const double       v_y = w * (particles.motion[j].v_y - own.v_y);
        L.xx += v_x * offset[k].x;
        L.xy += v_x * offset[k].y;
        L.yx += v_y * offset[k].x;
        L.yy += v_y * offset[k].y;
      }
    return product(L, particles.shape[i]);
  }


  std::vector<Vector2>
  UpdatedLagrangian::surface_vectors() const
  {
    std::vector<Vector2> S(particles.n_owned, {0., 0.});
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      for (unsigned int k = neighbours.start[i]; k < neighbours.start[i + 1];
           ++k)
        {
          const unsigned int j = neighbours.index[k];
          const Symmetric2  &B = particles.shape[i];
          const Symmetric2  &C = particles.shape[j];
          const double       w = depth * area[i] * area[j] * weight[k];
          const double       X = offset[k].x, Y = offset[k].y;
          S[i].x -= w * ((B.xx + C.xx) * X + (B.xy + C.xy) * Y);
          S[i].y -= w * ((B.xy + C.xy) * X + (B.yy + C.yy) * Y);
        }
    return S;
  }


  double
  UpdatedLagrangian::neighbours_per_particle() const
  {
    const double within = std::count_if(
        weight.begin(), weight.end(), [](const double w) { return w > 0.; });
    return within / particles.n_owned;
  }
} // namespace Morsel::SPH
