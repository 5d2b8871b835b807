#include <morsel/core/parallel.h>
#include <morsel/sph/fracture.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  namespace
  {
    /// Damage this close to one is failure: nothing measurable is left.
    constexpr double failure_damage = 0.999;

    /// Below this smallest eigenvalue of the moment matrix (one inside a
    /// lattice) the remaining bonds do not span the plane any more.
    constexpr double smallest_moment = 0.05;

    /// A particle pressed to this share of its area is crushed.
    constexpr double crushed_jacobian = 0.1;
  } // namespace


  Fracture::Fracture(Particles                         &particles,
                     Bonds                             &bonds,
                     const Kernel                      &kernel,
                     const Materials::Elasticity       &material,
                     const bool                         linear_law,
                     const Materials::DamageLaw        &law,
                     const Materials::DamageParameters &parameters,
                     const double                       friend_distance,
                     const unsigned int                 seed)
      : particles(particles)
      , bonds(bonds)
      , kernel(kernel)
      , material(material)
      , linear_law(linear_law)
      , law(law)
      , average_stress(parameters.average_stress)
      , friend_distance_square(friend_distance * friend_distance)
      , hourglass_stiffness(
            particles.hourglass.empty() ? 0. : particles.hourglass[0])
      , is_touched(particles.n_local, 0)
      , exposed(particles.n_local, 0)
      , contact_diameter(particles.n_local, particles.spacing)
  {
    const unsigned int n = particles.n_local;
    particles.damage.assign(n, 0.);
    particles.failed.assign(n, 0);
    particles.effective.assign(n, {0., 0., 0., 0.});
    particles.driver.assign(n, 0.);
    particles.near_face.assign(n, 0);
    particles.damage_heat.assign(n, 0.);
    particles.threshold.resize(n);
    for (unsigned int i = 0; i < n; ++i)
      particles.threshold[i] =
          law.threshold_scale *
          (parameters.flaws == "uniform"
               ? 1.
               : Materials::weibull_threshold(
                     law.weibull_modulus, seed, particles.id[i]));
    weakest = *std::min_element(particles.threshold.begin(),
                                particles.threshold.end());
    bonds.find_mirrors();
  }


  const std::vector<unsigned int> &
  Fracture::update(const double time_step)
  {
    newly_failed.clear();

    // With the tensile cut-off everywhere this bounds every average from
    // above: the driver is convex.
    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      for (unsigned int i = begin; i < end; ++i)
        particles.driver[i] =
            particles.failed[i]
                ? 0.
                : Materials::driver_value(
                      law, material, particles.effective[i], true);
    });
    const double strongest =
        *std::max_element(particles.driver.begin(), particles.driver.end());
    if (strongest <= weakest)
      return newly_failed;

    parallel_for(particles.n_owned, [&](unsigned int begin, unsigned int end) {
      grow(begin, end, time_step);
    });

    failed_now.clear();
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      if (!particles.failed[i] && particles.damage[i] >= failure_damage)
        failed_now.push_back(i);

    // Cutting bonds can leave others with too few of them: those fail too.
    while (!failed_now.empty())
      {
        const std::vector<unsigned int> batch = failed_now;
        failed_now.clear();
        for (const unsigned int i : batch)
          fail(i);
        newly_failed.insert(newly_failed.end(), batch.begin(), batch.end());
        settle_touched();
      }
    return newly_failed;
  }


  void
  Fracture::grow(const unsigned int begin,
                 const unsigned int end,
                 const double       time_step)
  {
    for (unsigned int i = begin; i < end; ++i)
      {
        if (particles.failed[i])
          continue;
        const double r = particles.threshold[i];
        // The average cannot exceed the largest driver among the averaged.
        double bound = particles.driver[i];
        if (average_stress)
          for (unsigned int k = bonds.list.start[i];
               k < bonds.list.start[i + 1];
               ++k)
            bound = std::max(bound, particles.driver[bonds.list.index[k]]);
        const double J =
            (1. + particles.gradient[i].xx) * (1. + particles.gradient[i].yy) -
            particles.gradient[i].xy * particles.gradient[i].yx;
        if (!linear_law && !(J > crushed_jacobian))
          {
            release_damage(i, 1.);
            continue;
          }
        if (bound <= r)
          continue;

        const double s = averaged_driver(i);
        if (law.growth == Materials::Growth::grady_kipp)
          release_damage(i,
                         Materials::grady_kipp_damage(
                             law, particles.damage[i], s, r, time_step));
        else
          release_damage(i,
                         std::max(particles.damage[i],
                                  Materials::linear_softening_damage(
                                      s, r, law.softening_range)));
      }
  }


  double
  Fracture::averaged_driver(const unsigned int i) const
  {
    const bool cut_off = !particles.near_face[i];
    if (!average_stress)
      return Materials::driver_value(
          law, material, particles.effective[i], cut_off);

    // Shepard average (T3-35) of the undamaged stress over the particle and
    // its live neighbours; volumes are equal.
    double                       sum = kernel.value(0.);
    Materials::PlaneStrainStress s   = particles.effective[i];
    s = {sum * s.xx, sum * s.yy, sum * s.xy, sum * s.zz};
    for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1]; ++k)
      if (bonds.weight[k] > 0.)
        {
          const double w = kernel.value(std::sqrt(bonds.length_square(k)));
          const auto  &t = particles.effective[bonds.list.index[k]];
          s.xx += w * t.xx;
          s.yy += w * t.yy;
          s.xy += w * t.xy;
          s.zz += w * t.zz;
          sum += w;
        }
    s = {s.xx / sum, s.yy / sum, s.xy / sum, s.zz / sum};
    return Materials::driver_value(law, material, s, cut_off);
  }


  void
  Fracture::release_damage(const unsigned int i, const double new_damage)
  {
    const double old = particles.damage[i];
    if (new_damage <= old)
      return;
    const double D        = new_damage >= failure_damage ? 1. : new_damage;
    const auto   response = response_at(particles, material, linear_law, i);
    particles.damage_heat[i] +=
        particles.volume *
            (Materials::stored_energy(law.softening, material, response, old) -
             Materials::stored_energy(law.softening, material, response, D)) +
        hourglass_stiffness * (D - old) * fit_residual(particles, bonds, i);
    particles.damage[i]    = D;
    particles.hourglass[i] = hourglass_stiffness * (1. - D);
  }


  double
  Fracture::energy_of(const unsigned int i) const
  {
    return particles.volume *
               Materials::stored_energy(
                   law.softening,
                   material,
                   response_at(particles, material, linear_law, i),
                   particles.damage[i]) +
           particles.hourglass[i] * fit_residual(particles, bonds, i);
  }


  void
  Fracture::fail(const unsigned int i)
  {
    particles.failed[i] = 1;
    ++failed_count;
    for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1]; ++k)
      {
        const unsigned int j = bonds.list.index[k];
        if (bonds.weight[k] > 0.)
          {
            const double r =
                (particles.position(j) - particles.position(i)).norm();
            contact_diameter[i] = std::min(contact_diameter[i], r);
            cut(k, i);
          }
      }

    // Longer bonds that passed by here may have lost their chain; cutting
    // one can leave still longer ones without theirs: until none is left.
    for (bool again = true; again;)
      {
        again = false;
        for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
             ++k)
          again = cut_unsupported(bonds.list.index[k]) || again;
      }
  }


  bool
  Fracture::cut_unsupported(const unsigned int i)
  {
    if (particles.failed[i])
      return false;
    bool any = false;
    for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1]; ++k)
      if (bonds.weight[k] > 0. &&
          bonds.length_square(k) > friend_distance_square && !supported(i, k))
        {
          cut(k, i);
          any = true;
        }
    return any;
  }


  bool
  Fracture::supported(const unsigned int i, const unsigned int k) const
  {
    const unsigned int j     = bonds.list.index[k];
    const double       limit = (1. - 1e-9) * bonds.length_square(k);
    for (unsigned int l = bonds.list.start[i]; l < bonds.list.start[i + 1]; ++l)
      if (bonds.weight[l] > 0. && bonds.length_square(l) < limit)
        {
          const long m = bonds.find(bonds.list.index[l], j);
          if (m >= 0 && bonds.weight[m] > 0. && bonds.length_square(m) < limit)
            return true;
        }
    return false;
  }


  void
  Fracture::cut(const unsigned int k, const unsigned int i)
  {
    const unsigned int j = bonds.list.index[k];
    touch(i);
    touch(j);
    bonds.weight[k]               = 0.;
    bonds.weight[bonds.mirror[k]] = 0.;
    exposed[i] = exposed[j] = 1;
  }


  void
  Fracture::touch(const unsigned int i)
  {
    if (is_touched[i])
      return;
    is_touched[i] = 1;
    touched.push_back(i);
    energy_before.push_back(energy_of(i));
  }


  void
  Fracture::settle_touched()
  {
    for (unsigned int t = 0; t < touched.size(); ++t)
      {
        const unsigned int i = touched[t];
        is_touched[i]        = 0;
        if (particles.failed[i])
          {
            // What pressure it carries goes on in the granular response.
            particles.pair_stress[i] = {0., 0., 0., 0.};
            particles.hourglass[i]   = 0.;
            heat_of_bonds += energy_before[t] - energy_of(i);
            continue;
          }
        const Symmetric2 m = bonds.moment(i);
        if (smaller_eigenvalue(m) < smallest_moment)
          {
            // Its energy is released when it fails, right after this.
            heat_of_bonds += energy_before[t] - energy_of(i);
            release_damage(i, 1.);
            failed_now.push_back(i);
            continue;
          }
        particles.shape[i]    = inverse(m);
        particles.gradient[i] = displacement_gradient(particles, bonds, i);
        heat_of_bonds += energy_before[t] - energy_of(i);
      }
    touched.clear();
    energy_before.clear();
  }
} // namespace Morsel::SPH
