#include "experiment.h"

#include <morsel/core/errors.h>
#include <morsel/sph/solid.h>
#include <morsel/sph/updated_lagrangian.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Morsel
{
  Experiment::Experiment(const Scene::Scene &scene, RunLog &log)
      : scene(scene)
      , log(log)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      throw InputError("A scene without plates runs on one rank: start the "
                       "program without mpirun.");
    dt = std::numeric_limits<double>::max();
    for (const auto &body : scene.particle_bodies)
      {
        if (body.solid.is_updated())
          solids.push_back(
              std::make_unique<SPH::UpdatedLagrangian>(body, scene));
        else
          solids.push_back(
              std::make_unique<SPH::Solid>(body, scene, MPI_COMM_SELF));
        conditions.emplace_back(scene, body, *solids.back());
        dt = std::min(dt, solids.back()->stable_time_step(0.));
      }
    if (scene.time.time_step > 0.)
      dt = scene.time.time_step;
  }


  void
  Experiment::evaluate()
  {
    {
      const auto timer = log.section("strain and forces");
      for (auto &solid : solids)
        {
          solid->compute_accelerations(dt);
          solid->add_grain_forces(dt);
        }
    }
    const auto timer = log.section("supports and loads");
    for (unsigned int k = 0; k < solids.size(); ++k)
      conditions[k].apply(*solids[k], now, dt);
  }


  void
  Experiment::advance()
  {
    const auto timer = log.section("strain and forces");
    for (auto &solid : solids)
      {
        solid->grow_damage(dt);
        solid->advance(dt);
        solid->advance_grains(dt);
      }
    now = ++steps * dt;
  }


  Measure::Energies
  Experiment::energies() const
  {
    Measure::Energies e;
    for (const auto &solid : solids)
      {
        const auto s = solid->energies(dt);
        e.strain += s.strain;
        e.hourglass += s.hourglass;
        e.kinetic += s.kinetic;
        e.granular += s.granular;
        e.dissipated_viscosity += s.viscous_heat;
        e.dissipated_damage += s.damage_heat;
        e.dissipated_bonds += s.bond_heat;
        e.dissipated_granular_friction += s.friction_heat;
        e.dissipated_artificial_stress += s.artificial;
      }
    for (const auto &of_body : conditions)
      for (const auto &condition : of_body.list())
        if (condition->is_damping())
          e.dissipated_damping -= condition->work();
        else
          e.external_work += condition->work();
    return e;
  }


  dealii::Tensor<1, 2>
  Experiment::momentum() const
  {
    return SPH::total_momentum(solids);
  }


  std::vector<dealii::Tensor<1, 2>>
  Experiment::impulses() const
  {
    std::vector<dealii::Tensor<1, 2>> list;
    for (const auto &of_body : conditions)
      for (const auto &condition : of_body.list())
        {
          const Vector2 p = condition->impulse();
          list.emplace_back();
          list.back()[0] = p.x;
          list.back()[1] = p.y;
        }
    return list;
  }


  Vector2
  Experiment::force(const unsigned int number) const
  {
    for (const auto &of_body : conditions)
      for (unsigned int k = 0; k < of_body.list().size(); ++k)
        if (of_body.numbers()[k] == number)
          return of_body.list()[k]->force();
    return {0., 0.};
  }


  void
  Experiment::check_finite() const
  {
    for (unsigned int s = 0; s < solids.size(); ++s)
      {
        const SPH::Particles &p = solids[s]->get_particles();
        for (unsigned int i = 0; i < p.n_owned; ++i)
          {
            const Motion &m = p.motion[i];
            if (std::isfinite(m.u_x + m.u_y + m.v_x + m.v_y))
              continue;
            std::ostringstream text;
            text << "The motion of body '" << scene.particle_bodies[s].name
                 << "' is not finite any more: particle " << p.id[i] << " at ("
                 << p.reference[i] << ") m, at time " << now << " s, step "
                 << steps
                 << ". Lower 'CFL factor' or the load, or take 'Formulation' = "
                    "'total Lagrangian' with hourglass control.";
            throw NumericalError(text.str());
          }
      }
  }


  unsigned int
  Experiment::index_of(const std::string &body) const
  {
    for (unsigned int k = 0; k < solids.size(); ++k)
      if (scene.particle_bodies[k].name == body)
        return k;
    AssertThrow(false, dealii::ExcInternalError());
    return 0;
  }


  unsigned long long
  Experiment::particle_count() const
  {
    unsigned long long count = 0;
    for (const auto &solid : solids)
      count += solid->get_particles().n_owned;
    return count;
  }
} // namespace Morsel
