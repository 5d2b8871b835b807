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
  namespace
  {
    void
    require_one_rank(const Scene::ParticleBody &body,
                     const MPI_Comm             communicator)
    {
      if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
        throw InputError("Body '" + body.name + "' is '" +
                         body.solid.formulation +
                         "', which runs on one rank only: start the program "
                         "without mpirun, or with 'mpirun -np 1', or take "
                         "'Formulation' = 'total Lagrangian'.");
    }
  } // namespace


  Experiment::Experiment(const Scene::Scene &scene,
                         const MPI_Comm      communicator,
                         RunLog             &log,
                         const Partition    &partition)
      : scene(scene)
      , communicator(communicator)
      , log(log)
  {
    automatic_step = std::numeric_limits<double>::max();
    for (unsigned int b = 0; b < scene.particle_bodies.size(); ++b)
      {
        const auto &body = scene.particle_bodies[b];
        if (body.solid.is_updated())
          {
            require_one_rank(body, communicator);
            solids.push_back(
                std::make_unique<SPH::UpdatedLagrangian>(body, scene));
          }
        else
          solids.push_back(std::make_unique<SPH::Solid>(
              body, scene, communicator, part_of_body(partition, b)));
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
        solid->compute_accelerations(dt);
    }
    {
      const auto timer = log.section("failed food");
      for (auto &solid : solids)
        solid->add_grain_forces(dt);
    }
    const auto timer = log.section("supports and loads");
    for (unsigned int k = 0; k < solids.size(); ++k)
      conditions[k].apply(*solids[k], clock.time(), dt);
  }


  void
  Experiment::advance()
  {
    const double dt = clock.time_step();
    {
      const auto timer = log.section("damage and broken bonds");
      for (auto &solid : solids)
        solid->grow_damage(dt);
    }
    {
      const auto timer = log.section("strain and forces");
      for (auto &solid : solids)
        solid->advance(dt);
    }
    {
      const auto timer = log.section("failed food");
      for (auto &solid : solids)
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
    const auto work      = SPH::work_of_conditions(conditions, communicator);
    e.external_work      = work.of_loads;
    e.dissipated_damping = work.damped;
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
    return dealii::Utilities::MPI::sum(sum, communicator);
  }


  std::vector<dealii::Tensor<1, 2>>
  Experiment::impulses() const
  {
    return SPH::impulses_of_conditions(conditions, communicator);
  }


  Vector2
  Experiment::force(const unsigned int number) const
  {
    for (const auto &of_body : conditions)
      for (unsigned int k = 0; k < of_body.list().size(); ++k)
        if (of_body.numbers()[k] == number)
          {
            const auto f = dealii::Utilities::MPI::sum(
                SPH::as_tensor(of_body.list()[k]->force()), communicator);
            return {f[0], f[1]};
          }
    return {0., 0.};
  }


  GuardedSystem
  Experiment::guarded() const
  {
    return guarded_bodies(scene, solids, communicator);
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
    return dealii::Utilities::MPI::sum(count, communicator);
  }


  std::vector<const SPH::Solid *>
  Experiment::shared_bodies() const
  {
    std::vector<const SPH::Solid *> list;
    for (const auto &solid : solids)
      if (solid->ranks())
        list.push_back(dynamic_cast<const SPH::Solid *>(solid.get()));
    return list;
  }
} // namespace Morsel
