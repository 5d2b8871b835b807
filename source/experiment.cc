#include "experiment.h"

#include "guarded.h"

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
    automatic_step = std::numeric_limits<double>::max();
    for (const auto &body : scene.particle_bodies)
      {
        if (body.solid.is_updated())
          solids.push_back(
              std::make_unique<SPH::UpdatedLagrangian>(body, scene));
        else
          solids.push_back(
              std::make_unique<SPH::Solid>(body, scene, MPI_COMM_SELF));
        conditions.emplace_back(scene, body, *solids.back());
        automatic_step =
            std::min(automatic_step, solids.back()->stable_time_step(0.));
      }
    clock.set_time_step(scene.time.time_step > 0. ? scene.time.time_step
                                                  : automatic_step);
  }


  double
  Experiment::safe_time_step() const
  {
    return automatic_step / largest_cfl_above_one(scene);
  }


  double
  Experiment::measured_stable_step()
  {
    double smallest = std::numeric_limits<double>::max();
    for (unsigned int k = 0; k < solids.size(); ++k)
      {
        auto *const solid = dynamic_cast<SPH::Solid *>(solids[k].get());
        smallest          = std::min(smallest,
                            solid ? solid->measured_stable_time_step(0., 0.)
                                           : solids[k]->stable_time_step(0.) /
                                        scene.particle_bodies[k].solid.cfl);
      }
    return smallest;
  }


  void
  Experiment::evaluate()
  {
    const double dt = clock.time_step();
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
      conditions[k].apply(*solids[k], clock.time(), dt);
  }


  void
  Experiment::advance()
  {
    const auto   timer = log.section("strain and forces");
    const double dt    = clock.time_step();
    for (auto &solid : solids)
      {
        solid->grow_damage(dt);
        solid->advance(dt);
        solid->advance_grains(dt);
      }
    clock.advance();
  }


  Measure::Energies
  Experiment::energies() const
  {
    Measure::Energies e;
    for (const auto &solid : solids)
      {
        const auto s = solid->energies();
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


  double
  Experiment::masses_times_speeds() const
  {
    double sum = 0.;
    for (const auto &solid : solids)
      sum += SPH::half_step_masses_times_speeds(solid->get_particles());
    return sum;
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


  GuardedSystem
  Experiment::guarded() const
  {
    return guarded_bodies(scene, solids, MPI_COMM_SELF);
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
