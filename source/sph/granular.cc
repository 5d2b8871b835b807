#include <morsel/core/parallel.h>
#include <morsel/sph/granular.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace Morsel::SPH
{
  namespace
  {
    GrainConstants
    constants_of_loops(const Particles             &particles,
                       const Kernel                &kernel,
                       const Materials::Elasticity &material,
                       const GranularConstants     &constants)
    {
      return {kernel.h,
              kernel.normalisation,
              kernel.support() * kernel.support(),
              particles.depth,
              particles.spacing * particles.spacing,
              constants.viscosity_alpha * material.wave_speed,
              constants.viscosity_beta,
              constants.contact_stiffness};
    }
  } // namespace


  Granular::Granular(Particles                   &particles,
                     const Bonds                 &bonds,
                     const Kernel                &kernel,
                     const Materials::Elasticity &material,
                     const GranularConstants     &constants,
                     const std::vector<char>     &exposed,
                     const std::vector<double>   &contact_diameters,
                     const ParticleHost<2> *const ranks)
      : particles(particles)
      , bonds(bonds)
      , kernel(kernel)
      , material(material)
      , constants(constants)
      , exposed(exposed)
      , contact_diameter(contact_diameters)
      , kernels(pair_kernels())
      , loop_constants(
            constants_of_loops(particles, kernel, material, constants))
      , force_loop(kernels.grain_force[kernel.kind == KernelKind::wendland_c2])
      , rate_loop(kernels.grain_rate[kernel.kind == KernelKind::wendland_c2])
      , on_surface(particles.n_local, 0)
      , ratio(particles.n_local, 1.)
      , deviator(particles.n_local, {0., 0., 0.})
      , energy(particles.n_local, 0.)
      , grain_heat(particles.n_local, 0.)
      , pair_friction_heat(particles.n_local, 0.)
      , penalty_energy(particles.n_local, 0.)
      , ranks(ranks)
      , local(ranks ? LocalNumbers(particles.id) : LocalNumbers())
      , exchange(ranks ? std::make_unique<MemberExchange>(ranks->communicator())
                       : nullptr)
  {
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      on_surface[i] = bonds.on_surface(i, particles, kernel);
  }


  void
  Granular::take_over(const std::vector<unsigned int> &failed,
                      const std::vector<unsigned int> &parted)
  {
    for (const unsigned int i : failed)
      {
        const auto  &H = particles.gradient[i];
        const double J = (1. + H.xx) * (1. + H.yy) - H.xy * H.yx;
        ratio[i]       = 1. / J;
        deviator[i]    = {0., 0., 0.};
        energy[i]      = grain_energy(i);
      }
    stale      = stale || !any_failed;
    any_failed = true;
    changed.insert(changed.end(), parted.begin(), parted.end());
  }


  void
  Granular::advance(const double time_step)
  {
    bool old = stale;
    if (!old)
      {
        old = !amend_list(time_step) || gather_rates(time_step);
        if (ranks)
          old = ranks->maximum(old) > 0.;
      }
    if (old)
      {
        rebuild_list(time_step);
        gather_rates(time_step);
      }
    if (exchange)
      exchange_rates_of_members();
    parallel_for(
        blocks.size(),
        [&](unsigned int begin, unsigned int end) {
          Materials::Tensor2 rates[block_size];
          for (unsigned int b = begin; b < end; ++b)
            {
              const Block &block = blocks[b];
              rate_loop(rows_of(block), loop_constants, rates);
              for (unsigned int r = 0; r < block.n_grains; ++r)
                {
                  const unsigned int m = block.row[r];
                  advance_grain(members[m], rates[m - block.first], time_step);
                }
            }
        },
        4);
  }


  GrainArrays
  Granular::rows_of(const Block &block) const
  {
    return {block.row.data(),
            block.slot_begin.data(),
            block.grain_pair.data(),
            block.n_rows,
            block.n_grains,
            block.first,
            motion.data(),
            member_stress.data(),
            size.data(),
            mass.data(),
            area.data()};
  }


  bool
  Granular::gather_rates(const double time_step)
  {
    // Positions at the middle of the step; a live neighbour counts twice.
    std::atomic<bool> moved_far(false);
    parallel_for(members.size(), [&](unsigned int begin, unsigned int end) {
      bool far = false;
      for (unsigned int m = begin; m < end; ++m)
        {
          const unsigned int i = members[m];
          const Vector2      v = particles.half_velocity[i];
          const auto         x = particles.position(i);
          far                  = far ||
                (x - built_at[m]).norm_square() > allowance[m] * allowance[m];
          motion[m] = {x[0] - 0.5 * time_step * v.x,
                       x[1] - 0.5 * time_step * v.y,
                       v.x,
                       v.y};
          area[m] = particles.area[i] * (member_failed[m] ? 1. / ratio[i] : 2.);
        }
      if (far)
        moved_far = true;
    });
    return moved_far;
  }


  void
  Granular::advance_grain(const unsigned int        i,
                          const Materials::Tensor2 &L,
                          const double              dt)
  {
    const double before = energy[i];
    const double factor = particles.modulus_factor(i);
    const double bulk = factor * material.bulk, mu = factor * material.mu;
    const double volume = particles.volume(i) / ratio[i];
    const double tr     = (L.xx + L.yy) * dt;
    const double d_xx   = L.xx * dt - tr / 3.;
    const double d_yy   = L.yy * dt - tr / 3.;
    const double d_xy   = 0.5 * (L.xy + L.yx) * dt;
    const double spin   = 0.5 * (L.xy - L.yx) * dt;
    const double p_old =
        std::max(0., -Materials::mean_stress(bulk, 1. / ratio[i]));

    ratio[i] *= std::exp(-tr);
    const double p_new =
        std::max(0., -Materials::mean_stress(bulk, 1. / ratio[i]));

    const Symmetric2 s    = deviator[i];
    Symmetric2       t    = {s.xx + 2. * mu * d_xx + 2. * spin * s.xy,
                             s.yy + 2. * mu * d_yy - 2. * spin * s.xy,
                             s.xy + 2. * mu * d_xy + spin * (s.yy - s.xx)};
    const double     t_zz = -t.xx - t.yy;
    const double     J2 =
        0.5 * (t.xx * t.xx + t.yy * t.yy + t_zz * t_zz) + t.xy * t.xy;
    const double cap = constants.friction * p_new;
    if (J2 > cap * cap)
      {
        const double scale = cap / std::sqrt(J2);
        t                  = {scale * t.xx, scale * t.yy, scale * t.xy};
      }
    deviator[i] = t;

    // Stress power less what was stored has become heat.
    const double d_zz = -tr / 3.;
    const double work =
        volume * (-0.5 * (p_old + p_new) * tr +
                  0.5 * ((s.xx + t.xx) * d_xx + (s.yy + t.yy) * d_yy -
                         (s.xx + s.yy + t.xx + t.yy) * d_zz) +
                  (s.xy + t.xy) * d_xy);
    energy[i] = grain_energy(i);
    grain_heat[i] += work - (energy[i] - before);
  }


  void
  Granular::add_forces(const double time_step)
  {
    if (stale) // from a checkpoint of another number of ranks
      rebuild_list(time_step);
    gather_state();
    parallel_for(
        blocks.size(),
        [&](unsigned int begin, unsigned int end) {
          for (unsigned int b = begin; b < end; ++b)
            push(blocks[b], time_step);
        },
        4);
  }


  void
  Granular::gather_state()
  {
    parallel_for(members.size(), [&](unsigned int begin, unsigned int end) {
      for (unsigned int m = begin; m < end; ++m)
        {
          const unsigned int i    = members[m];
          const double       full = particles.area[i];
          const auto         x    = particles.position(i);
          const Motion      &v    = particles.motion[i];
          motion[m]               = {x[0], x[1], v.v_x, v.v_y};
          member_stress[m]        = {0., 0., 0., -full};
          if (member_failed[m])
            {
              const auto sigma = stress(i);
              member_stress[m] = {
                  sigma.xx, sigma.yy, sigma.xy, full / ratio[i]};
            }
        }
    });
    if (exchange)
      exchange_state_of_members();
  }


  void
  Granular::push(const Block &block, const double dt)
  {
    GrainForce sums[block_size] = {};
    force_loop(rows_of(block), loop_constants, sums);
    for (unsigned int m = block.first; m < block.last; ++m)
      {
        const unsigned int i      = members[m];
        GrainForce        &f      = sums[m - block.first];
        double             rubbed = 0.;
        push_live(block, m, dt, f, rubbed);
        const double inverse_mass = 1. / particles.mass[i];
        particles.acceleration[i].x += inverse_mass * f.x;
        particles.acceleration[i].y += inverse_mass * f.y;
        particles.viscous[i].x += inverse_mass * f.viscous_x;
        particles.viscous[i].y += inverse_mass * f.viscous_y;
        pair_friction_heat[i] += 0.5 * rubbed * dt;
        penalty_energy[i] = 0.5 * f.pressed;
      }
  }


  void
  Granular::push_live(const Block       &block,
                      const unsigned int m,
                      const double       dt,
                      GrainForce        &f,
                      double            &rubbed) const
  {
    const GrainConstants &c   = loop_constants;
    const GrainMotion     a   = motion[m];
    const unsigned int    row = m - block.first;
    for (unsigned int k = block.live_start[row]; k < block.live_start[row + 1];
         ++k)
      {
        const unsigned int n   = block.live_pair[k];
        const GrainMotion  b   = motion[n];
        const double       r_x = b.x - a.x, r_y = b.y - a.y;
        const double       r2 = r_x * r_x + r_y * r_y;
        if (r2 >= c.contact_square)
          continue;
        const double r   = std::sqrt(r2);
        const double v_x = b.v_x - a.v_x, v_y = b.v_y - a.v_y;
        const double vr = v_x * r_x + v_y * r_y;
        if (vr < 0.)
          {
            const double mu = c.h * vr / (r2 + 0.01 * c.h * c.h);
            const double q  = mass[m] * size[n].area *
                             kernel.gradient_weight(r) * mu *
                             (c.viscosity_beta * mu - c.viscosity_alpha_c);
            f.x -= q * r_x;
            f.y -= q * r_y;
            f.viscous_x -= q * r_x;
            f.viscous_y -= q * r_y;
          }
        const double gap = r - std::min(size[m].diameter, size[n].diameter);
        if (gap >= 0.)
          continue;
        const double pressure = c.contact_stiffness * gap / r; // < 0
        f.x += pressure * r_x;
        f.y += pressure * r_y;
        f.pressed += 0.5 * c.contact_stiffness * gap * gap;

        // Coulomb friction, at most what stops the pair within this step.
        const double t_x  = v_x - vr * r_x / r2;
        const double t_y  = v_y - vr * r_y / r2;
        const double slip = std::sqrt(t_x * t_x + t_y * t_y) + 1e-300;
        const double g =
            std::min(-constants.friction * c.contact_stiffness * gap,
                     0.1 * std::min(mass[m], mass[n]) * slip / dt) /
            slip;
        f.x += g * t_x;
        f.y += g * t_y;
        rubbed += g * slip * slip;
      }
  }


  Materials::PlaneStrainStress
  Granular::stress(const unsigned int i) const
  {
    const double mean = std::min(
        0.,
        Materials::mean_stress(particles.modulus_factor(i) * material.bulk,
                               1. / ratio[i]));
    const Symmetric2 s = deviator[i];
    return {mean + s.xx, mean + s.yy, s.xy, mean - s.xx - s.yy};
  }


  double
  Granular::grain_energy(const unsigned int i) const
  {
    const Symmetric2 s    = deviator[i];
    const double     s_zz = -s.xx - s.yy;
    const double     ss =
        s.xx * s.xx + s.yy * s.yy + s_zz * s_zz + 2. * s.xy * s.xy;
    // The deviator is a stress: its energy goes with the compliance.
    const double f = particles.modulus_factor(i);
    return particles.volume(i) *
           ((ratio[i] > 1. ? Materials::volumetric_energy(f * material.bulk,
                                                          1. / ratio[i])
                           : 0.) +
            ss / (4. * f * material.mu * ratio[i]));
  }


  double
  Granular::stored_energy() const
  {
    if (!any_failed)
      return 0.;
    double sum = particles.sum_of_owned(penalty_energy);
    for (const unsigned int i : members)
      if (particles.failed[i])
        sum += energy[i];
    return sum;
  }


  double
  Granular::friction_heat() const
  {
    return particles.sum_of_owned(grain_heat) +
           particles.sum_of_owned(pair_friction_heat);
  }
} // namespace Morsel::SPH
