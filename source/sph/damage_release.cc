#include <morsel/sph/damage_evolution.h>

#include <algorithm>

namespace Morsel::SPH
{
  void
  DamageEvolution::add_work(std::vector<unsigned int> &of_particles) const
  {
    // Measured, doc/performance.md.
    constexpr unsigned int work_of_growth = 60;
    for (unsigned int g = 0; g < particles.n_groups(); ++g)
      {
        const unsigned int more = may_grow(g) ? work_of_growth : 0;
        for (unsigned int i = g * group_size;
             i < std::min(particles.n_owned, (g + 1) * group_size);
             ++i)
          of_particles[i] = particles.failed[i] ? 0 : of_particles[i] + more;
      }
  }


  namespace
  {
    /// Below this smallest eigenvalue of the moment matrix, as a share of that
    /// inside of a body, the remaining bonds do not span the plane any more.
    constexpr double smallest_moment = 0.05;
  } // namespace


  void
  DamageEvolution::break_up()
  {
    // Cutting bonds can leave others with too few of them: those fail too.
    while (take_batch())
      {
        for (const unsigned int i : batch)
          fail(i);
        if (ranks)
          agree_on_cuts();
        settle_touched();
      }
    gradient_of_doomed.clear();
    for (const unsigned int i : newly_failed)
      retire_group(i / group_size);
  }


  bool
  DamageEvolution::take_batch()
  {
    newly_failed.insert(
        newly_failed.end(), failed_now.begin(), failed_now.end());
    bool any = !failed_now.empty();
    if (ranks)
      any = take_batch_of_all_ranks();
    else
      {
        batch.swap(failed_now);
        for (const unsigned int i : batch)
          failed_area += particles.area[i];
      }
    failed_now.clear();
    failed_anywhere = failed_anywhere || any;
    return any;
  }


  void
  DamageEvolution::retire_group(const unsigned int g)
  {
    const auto first = particles.failed.begin() + g * group_size;
    const auto last =
        first + std::min(group_size, particles.n_owned - g * group_size);
    if (std::all_of(first, last, [](const char f) { return f != 0; }))
      bonds.retire(g);
  }


  void
  DamageEvolution::release_damage(const unsigned int i, const double new_damage)
  {
    if (new_damage > particles.damage[i])
      release_damage(i, ends_of(i), new_damage);
  }


  void
  DamageEvolution::release_damage(const unsigned int i,
                                  const Ends        &ends,
                                  const double       new_damage)
  {
    const double old = particles.damage[i];
    if (new_damage <= old)
      return;
    const double D = new_damage >= failure_damage ? 1. : new_damage;
    particles.damage_heat[i] +=
        mean_energy(i, ends, old) - mean_energy(i, ends, D);
    set_damage(i, D);
  }


  void
  DamageEvolution::set_damage(const unsigned int i, const double new_damage)
  {
    particles.damage[i] = new_damage;
    particles.hourglass[i] =
        hourglass_stiffness * (1. - new_damage) * particles.modulus_factor(i);
  }


  DamageEvolution::Ends
  DamageEvolution::ends_of(const unsigned int i) const
  {
    const auto strain = strain_over_step(particles, bonds, i, time_step);
    const auto doomed = gradient_of_doomed.find(i);
    Ends       ends   = ends_at(strain[0].gradient,
                        doomed == gradient_of_doomed.end() ? strain[1].gradient
                                                                   : doomed->second);
    for (unsigned int e = 0; e < 2; ++e)
      ends.residual[e] = strain[e].residual;
    return ends;
  }


  DamageEvolution::Ends
  DamageEvolution::ends_at(const Materials::Tensor2 &now,
                           const Materials::Tensor2 &then) const
  {
    return {{now, then},
            {response_to(now, material, linear_law),
             response_to(then, material, linear_law)},
            {0., 0.}};
  }


  double
  DamageEvolution::mean_energy(const unsigned int i,
                               const Ends        &ends,
                               const double       damage) const
  {
    double sum = 0.;
    for (unsigned int e = 0; e < 2; ++e)
      sum += particles.volume(i) *
                 Materials::stored_energy(
                     law.softening, material, ends.response[e], damage) +
             hourglass_stiffness * (1. - damage) * ends.residual[e];
    return 0.5 * particles.modulus_factor(i) * sum;
  }


  void
  DamageEvolution::fail(const unsigned int i)
  {
    particles.failed[i] = 1;
    for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1]; ++k)
      {
        const unsigned int j = bonds.list.index[k];
        if (bonds.live[k])
          {
            const double r =
                (particles.position(j) - particles.position(i)).norm();
            contact_diameter[i] = std::min(contact_diameter[i], r);
            cut(k, i);
          }
      }

    // Longer bonds that passed by here may have lost their chain, and each one
    // that is cut was perhaps a link of longer ones at both its ends.
    suspects.assign(bonds.list.index.begin() + bonds.list.start[i],
                    bonds.list.index.begin() + bonds.list.start[i + 1]);
    clear_suspects();
  }


  void
  DamageEvolution::clear_suspects()
  {
    while (!suspects.empty())
      {
        const unsigned int j = suspects.back();
        suspects.pop_back();
        cut_unsupported(j);
      }
  }


  void
  DamageEvolution::cut_unsupported(const unsigned int i)
  {
    if (particles.failed[i] || i >= particles.n_owned)
      return;
    bool any = false;
    for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1]; ++k)
      if (bonds.live[k] && !is_direct[k] &&
          bonds.length_square(particles, i, k) > friend_distance_square &&
          !supported(i, k))
        {
          cut(k, i);
          suspects.push_back(bonds.list.index[k]);
          any = true;
          if (ranks && i < ranks->n_boundary())
            cut_pairs.push_back(
                {{particles.id[i], particles.id[bonds.list.index[k]]}});
        }
    if (any)
      suspects.push_back(i);
  }


  bool
  DamageEvolution::supported(const unsigned int i, const unsigned int k) const
  {
    const unsigned int j = bonds.list.index[k];
    const double limit   = (1. - 1e-9) * bonds.length_square(particles, i, k);
    for (unsigned int l = bonds.list.start[i]; l < bonds.list.start[i + 1]; ++l)
      if (bonds.live[l] && bonds.length_square(particles, i, l) < limit)
        {
          const long m = bonds.find(bonds.list.index[l], j);
          if (m >= 0 && bonds.live[m] &&
              bonds.length_square(particles, bonds.list.index[l], m) < limit)
            return true;
        }
    return false;
  }


  void
  DamageEvolution::cut(const unsigned int k, const unsigned int i)
  {
    const unsigned int j = bonds.list.index[k];
    touch(i);
    touch(j);
    bonds.cut(k);
    exposed[i] = exposed[j] = 1;
  }


  void
  DamageEvolution::touch(const unsigned int i)
  {
    if (is_touched[i] || i >= particles.n_owned)
      return;
    is_touched[i]   = 1;
    const Ends ends = ends_of(i);
    touched.push_back(
        {i, mean_energy(i, ends, particles.damage[i]), ends.gradient[1]});
  }


  void
  DamageEvolution::settle_touched()
  {
    for (const auto &[i, energy_before, gradient_before] : touched)
      {
        is_touched[i] = 0;
        parted.push_back(i);
        if (particles.failed[i])
          {
            particles.driver[i] = 0.;
            // What pressure it carries goes on in the granular response.
            particles.pair_stress[i] = {0., 0., 0., 0.};
            if (bonds.is_conforming())
              particles.fit_stress[i] = {0., 0., 0., 0.};
            particles.hourglass[i] = 0.;
            // As a grain it goes on from where its bonds had it go.
            heat_of_bonds +=
                energy_before -
                mean_energy(
                    i, ends_at(particles.gradient[i], gradient_before), 1.);
            continue;
          }
        const Symmetric2 m = bonds.moment(particles, i);
        if (smaller_eigenvalue(m) < smallest_moment * bonds.full_moment)
          {
            // Its energy is released when it fails, right after this.
            gradient_of_doomed[i] = gradient_before;
            heat_of_bonds += energy_before - mean_energy(i);
            release_damage(i, 1.);
            failed_now.push_back(i);
            continue;
          }
        if (bonds.is_conforming())
          renew_conforming(particles, bonds, i);
        else
          particles.shape[i] = inverse(m);
        particles.gradient[i] = displacement_gradient(particles, bonds, i);
        heat_of_bonds += energy_before - mean_energy(i);
      }
    touched.clear();
  }
} // namespace Morsel::SPH
