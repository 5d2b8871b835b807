#include <morsel/core/parallel.h>
#include <morsel/sph/granular.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Morsel::SPH
{
  namespace
  {
    /// The list reaches this share of the support further than needed.
    constexpr double skin = 0.15;

    /// Contact diameter of a grain over that of live material: grains
    /// may be packed closer than the lattice before they repel.
    constexpr double grain_diameter = 0.8;

    /// Above this |sum a X| dp [1] a particle of the intact lattice lies on
    /// its surface (outermost row about 0.4, second row below 0.1).
    constexpr double surface_limit = 0.2;
  } // namespace


  Granular::Granular(Particles                   &particles,
                     const Bonds                 &bonds,
                     const Kernel                &kernel,
                     const Materials::Elasticity &material,
                     const GranularConstants     &constants,
                     const std::vector<char>     &exposed,
                     const std::vector<double>   &contact_diameters)
      : particles(particles)
      , bonds(bonds)
      , kernel(kernel)
      , material(material)
      , constants(constants)
      , exposed(exposed)
      , contact_diameter(contact_diameters)
      , on_surface(particles.n_local, 0)
      , ratio(particles.n_local, 1.)
      , deviator(particles.n_local, {0., 0., 0.})
      , grain_heat(particles.n_local, 0.)
      , pair_friction_heat(particles.n_local, 0.)
      , pair_viscous_heat(particles.n_local, 0.)
      , penalty_energy(particles.n_local, 0.)
  {
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      on_surface[i] =
          bonds.surface_measure(i) * particles.spacing > surface_limit;
  }


  void
  Granular::take_over(const std::vector<unsigned int> &failed)
  {
    for (const unsigned int i : failed)
      {
        const auto  &H = particles.gradient[i];
        const double J = (1. + H.xx) * (1. + H.yy) - H.xy * H.yx;
        ratio[i]       = 1. / J;
        deviator[i]    = {0., 0., 0.};
      }
    any_failed = any_failed || !failed.empty();
    stale      = stale || !failed.empty();
  }


  void
  Granular::update_list()
  {
    const double reach = skin * kernel.support();
    if (!stale)
      {
        for (unsigned int m = 0; m < members.size(); ++m)
          if ((particles.position(members[m]) - built_at[m]).norm_square() >
              0.25 * reach * reach)
            {
              stale = true;
              break;
            }
        if (!stale)
          return;
      }

    members.clear();
    built_at.clear();
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      if (particles.failed[i] || exposed[i] || on_surface[i])
        {
          members.push_back(i);
          built_at.push_back(particles.position(i));
        }

    // Live pairs touch at one spacing, pairs with a grain within the support.
    const double grain_reach = kernel.support() + reach;
    const double live_reach  = particles.spacing + reach;
    CellGrid     grid;
    grid.build(built_at, grain_reach);
    list.start.assign(1, 0);
    list.index.clear();
    for (unsigned int m = 0; m < members.size(); ++m)
      {
        const unsigned int i = members[m];
        grid.for_each_near(built_at[m], [&](const unsigned int n) {
          const unsigned int j = members[n];
          if (j == i)
            return;
          const bool   grain = particles.failed[i] || particles.failed[j];
          const double r     = grain ? grain_reach : live_reach;
          if ((built_at[n] - built_at[m]).norm_square() >= r * r)
            return;
          if (!grain)
            {
              const long k = bonds.find(i, j);
              if (k >= 0 && bonds.weight[k] > 0.)
                return;
            }
          list.index.push_back(j);
        });
        std::sort(list.index.begin() + list.start.back(), list.index.end());
        list.start.push_back(list.index.size());
      }
    stale = false;
  }


  void
  Granular::advance(const double time_step)
  {
    update_list();
    parallel_for(members.size(), [&](unsigned int begin, unsigned int end) {
      advance_range(begin, end, time_step);
    });
  }


  void
  Granular::advance_range(const unsigned int begin,
                          const unsigned int end,
                          const double       dt)
  {
    for (unsigned int m = begin; m < end; ++m)
      {
        const unsigned int i = members[m];
        if (!particles.failed[i])
          continue;
        // L_i = sum_j c_ij V_j v_ij (x) grad W at the middle of the step.
        const auto         x_i = particles.position(i);
        const Vector2      v_i = particles.half_velocity[i];
        Materials::Tensor2 L{0., 0., 0., 0.};
        const double       area = particles.spacing * particles.spacing;
        for (unsigned int k = list.start[m]; k < list.start[m + 1]; ++k)
          {
            const unsigned int j   = list.index[k];
            const auto         x_j = particles.position(j);
            const double       v_x = particles.half_velocity[j].x - v_i.x;
            const double       v_y = particles.half_velocity[j].y - v_i.y;
            const double       r_x = x_j[0] - x_i[0] - 0.5 * dt * v_x;
            const double       r_y = x_j[1] - x_i[1] - 0.5 * dt * v_y;
            const double       r2  = r_x * r_x + r_y * r_y;
            if (r2 >= kernel.support() * kernel.support())
              continue;
            const double w = (particles.failed[j] ? 1. / ratio[j] : 2.) * area *
                             kernel.gradient_weight(std::sqrt(r2));
            L.xx += w * v_x * r_x;
            L.xy += w * v_x * r_y;
            L.yx += w * v_y * r_x;
            L.yy += w * v_y * r_y;
          }

        const double before = grain_energy(i);
        const double volume = particles.volume / ratio[i];
        const double tr     = (L.xx + L.yy) * dt;
        const double d_xx   = L.xx * dt - tr / 3.;
        const double d_yy   = L.yy * dt - tr / 3.;
        const double d_xy   = 0.5 * (L.xy + L.yx) * dt;
        const double spin   = 0.5 * (L.xy - L.yx) * dt;
        const double p_old  = -stress(i).zz - deviator[i].xx - deviator[i].yy;

        ratio[i] *= std::exp(-tr);
        const double p_new =
            std::max(0., -Materials::mean_stress(material.bulk, 1. / ratio[i]));

        const Symmetric2 s = deviator[i];
        Symmetric2       t = {s.xx + 2. * material.mu * d_xx + 2. * spin * s.xy,
                              s.yy + 2. * material.mu * d_yy - 2. * spin * s.xy,
                              s.xy + 2. * material.mu * d_xy + spin * (s.yy - s.xx)};
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
        grain_heat[i] += work - (grain_energy(i) - before);
      }
  }


  void
  Granular::add_forces(const double time_step)
  {
    update_list();
    parallel_for(members.size(), [&](unsigned int begin, unsigned int end) {
      force_range(begin, end, time_step);
    });
  }


  void
  Granular::force_range(const unsigned int begin,
                        const unsigned int end,
                        const double       dt)
  {
    const double h = kernel.h, c = material.wave_speed;
    const double support2 = kernel.support() * kernel.support();
    const double area     = particles.spacing * particles.spacing;
    for (unsigned int m = begin; m < end; ++m)
      {
        const unsigned int i        = members[m];
        const auto         x_i      = particles.position(i);
        const Motion       a        = particles.motion[i];
        const bool         i_failed = particles.failed[i];
        const auto         sigma_i =
            i_failed ? stress(i) : Materials::PlaneStrainStress{};
        const double d_i =
            (i_failed ? grain_diameter : 1.) * contact_diameter[i];
        double f_x = 0., f_y = 0.;
        double rubbed = 0., damped = 0., pressed = 0.;
        for (unsigned int k = list.start[m]; k < list.start[m + 1]; ++k)
          {
            const unsigned int j   = list.index[k];
            const auto         x_j = particles.position(j);
            const double       r_x = x_j[0] - x_i[0], r_y = x_j[1] - x_i[1];
            const double       r2 = r_x * r_x + r_y * r_y;
            if (r2 >= support2)
              continue;
            const bool   j_failed = particles.failed[j];
            const double r        = std::sqrt(r2);
            const Motion b        = particles.motion[j];
            const double v_x = b.v_x - a.v_x, v_y = b.v_y - a.v_y;
            const double vr = v_x * r_x + v_y * r_y;

            // Viscosity (T3-44, sign corrected) of whatever approaches.
            if (vr < 0. && (i_failed || j_failed || r < particles.spacing))
              {
                const double w  = area * kernel.gradient_weight(r);
                const double mu = h * vr / (r2 + 0.01 * h * h);
                const double q  = particles.mass * w * mu *
                                 (constants.viscosity_beta * mu -
                                  constants.viscosity_alpha * c);
                f_x -= q * r_x;
                f_y -= q * r_y;
                damped -= q * vr;
              }

            if (i_failed || j_failed)
              {
                // V_i V_j (sigma_i + sigma_j) grad W between grains;
                // V_i V_j 2 sigma grad W where one of the two is live.
                const double volume_i =
                    i_failed ? particles.volume / ratio[i] : particles.volume;
                const double area_j = j_failed ? area / ratio[j] : area;
                const double w = volume_i * area_j * kernel.gradient_weight(r);
                auto         sigma  = sigma_i;
                double       factor = 2.;
                if (j_failed)
                  {
                    const auto sigma_j = stress(j);
                    sigma.xx += sigma_j.xx;
                    sigma.yy += sigma_j.yy;
                    sigma.xy += sigma_j.xy;
                    factor = i_failed ? 1. : 2.;
                  }
                f_x += factor * w * (sigma.xx * r_x + sigma.xy * r_y);
                f_y += factor * w * (sigma.xy * r_x + sigma.yy * r_y);
              }

            const double d_j =
                (j_failed ? grain_diameter : 1.) * contact_diameter[j];
            const double gap = r - std::min(d_i, d_j);
            if (gap < 0.)
              {
                const double f = constants.contact_stiffness * gap / r; // < 0
                f_x += f * r_x;
                f_y += f * r_y;
                pressed += 0.5 * constants.contact_stiffness * gap * gap;
                if (!i_failed && !j_failed)
                  {
                    // Coulomb friction, at most what stops the pair within
                    // this step.
                    const double t_x = v_x - vr * r_x / r2;
                    const double t_y = v_y - vr * r_y / r2;
                    const double slip =
                        std::sqrt(t_x * t_x + t_y * t_y) + 1e-300;
                    const double g =
                        std::min(-constants.friction *
                                     constants.contact_stiffness * gap,
                                 0.1 * particles.mass * slip / dt) /
                        slip;
                    f_x += g * t_x;
                    f_y += g * t_y;
                    rubbed += g * slip * slip;
                  }
              }
          }
        particles.acceleration[i].x += f_x / particles.mass;
        particles.acceleration[i].y += f_y / particles.mass;
        pair_friction_heat[i] += 0.5 * rubbed * dt;
        pair_viscous_heat[i] += 0.5 * damped * dt;
        penalty_energy[i] = 0.5 * pressed;
      }
  }


  Materials::PlaneStrainStress
  Granular::stress(const unsigned int i) const
  {
    const double mean =
        std::min(0., Materials::mean_stress(material.bulk, 1. / ratio[i]));
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
    return particles.volume *
           ((ratio[i] > 1.
                 ? Materials::volumetric_energy(material.bulk, 1. / ratio[i])
                 : 0.) +
            ss / (4. * material.mu * ratio[i]));
  }


  double
  Granular::stored_energy() const
  {
    if (!any_failed)
      return 0.;
    double sum =
        std::accumulate(penalty_energy.begin(), penalty_energy.end(), 0.);
    for (const unsigned int i : members)
      if (particles.failed[i])
        sum += grain_energy(i);
    return sum;
  }


  double
  Granular::friction_heat() const
  {
    return std::accumulate(grain_heat.begin(), grain_heat.end(), 0.) +
           std::accumulate(
               pair_friction_heat.begin(), pair_friction_heat.end(), 0.);
  }


  double
  Granular::viscous_heat() const
  {
    return std::accumulate(
        pair_viscous_heat.begin(), pair_viscous_heat.end(), 0.);
  }
} // namespace Morsel::SPH
