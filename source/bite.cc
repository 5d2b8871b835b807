#include "bite.h"
#include "drives.h"
#include "elastic_plates.h"
#include "guarded.h"

#include <morsel/core/errors.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Morsel
{
  namespace
  {
    /// Loaded faces are looked for again after this many steps.
    constexpr unsigned int steps_between_face_marks = 20;
  } // namespace


  Bite::Bite(const Scene::Scene &scene,
             const MPI_Comm      communicator,
             RunLog             &log,
             const Partition    &partition)
      : scene(scene)
      , communicator(communicator)
      , log(log)
  {
    for (unsigned int s = 0; s < scene.particle_bodies.size(); ++s)
      solids.push_back(
          std::make_unique<SPH::Solid>(scene.particle_bodies[s],
                                       scene,
                                       communicator,
                                       part_of_body(partition, s)));
    std::vector<std::unique_ptr<FE::ElasticBody>> elastic;
    make_plates(elastic);
    make_pairs();
    make_meetings();
    make_neighbours();
    limit_step_by_drives();
    if (!scene.conditions.empty())
      for (unsigned int s = 0; s < solids.size(); ++s)
        conditions.emplace_back(scene, scene.particle_bodies[s], *solids[s]);
    choose_time_step();
    set_up_deformations(std::move(elastic));
    find_closing_axis();
    find_ways_to_food();
  }


  void
  Bite::change_time_step(const double time_step)
  {
    clock.set_time_step(time_step);
    adapt_to_time_step();
  }


  void
  Bite::adapt_to_time_step()
  {
    for (auto &plate : plates)
      plate.change_time_step(clock.time_step());
    set_slipping_masses();
  }


  void
  Bite::make_plates(std::vector<std::unique_ptr<FE::ElasticBody>> &elastic)
  {
    const auto of_plates = make_drives(scene, communicator);
    for (const auto &drive : of_plates)
      if (std::find(drives.begin(), drives.end(), drive) == drives.end())
        drives.push_back(drive);
    for (unsigned int p = 0; p < scene.plate_bodies.size(); ++p)
      {
        const auto &body = scene.plate_bodies[p];
        elastic.emplace_back();
        if (body.deformation.elastic)
          {
            elastic.back() = make_elastic_body(scene, body);
            plates.emplace_back(body, of_plates[p], *elastic.back());
          }
        else
          plates.emplace_back(body,
                              of_plates[p],
                              body.node_spacing > 0.
                                  ? body.node_spacing
                                  : 0.5 *
                                        scene.particle_bodies.front().spacing);
      }
    plate_frequencies.assign(plates.size(), 0.);
    responses.assign(plates.size(), "rigid");
  }


  void
  Bite::find_closing_axis()
  {
    double largest = 0.;
    for (const auto &plate : plates)
      {
        const auto &box       = plate.body.shape;
        const auto  direction = plate.get_drive()->direction(
            box.lower_corner + 0.5 * (box.upper_corner - box.lower_corner));
        for (unsigned int d = 0; d < 2; ++d)
          if (std::abs(direction[d]) > largest)
            {
              largest = std::abs(direction[d]);
              axis    = d;
            }
      }
    // The food may fly into a body that is free.
    const auto &flight = scene.particle_bodies.front().initial_velocity;
    if (deforms && largest == 0.)
      axis = std::abs(flight[0]) > std::abs(flight[1]) ? 0 : 1;
  }


  void
  Bite::evaluate()
  {
    const double dt = clock.time_step();
    for (auto &plate : plates)
      plate.move_to(clock.time());

    {
      // Motion alone says how the food touches the plates: their forces are
      // summed while those within the food are worked out.
      const auto timer = log.section("contact with plates");
      touch();
      for (auto &plate : plates)
        plate.account(clock.kick(), dt);
      for (const auto &drive : drives)
        drive->account(clock.kick());
      begin_sum_of_plate_forces();
    }
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
    const auto timer = log.section("contact with plates");
    load_food();
    finish_sum_of_plate_forces();
    if (clock.step() % steps_between_face_marks == 0)
      mark_loaded_faces();
  }


  void
  Bite::mark_loaded_faces()
  {
    for (const auto &pair : pairs)
      {
        const auto &body = scene.particle_bodies[pair.solid];
        if (body.damage.enabled)
          solids[pair.solid]->set_near_face(pair.contact->particles_within(
              body.damage.face_exclusion * body.spacing,
              plates[pair.plate].surface));
      }
  }


  void
  Bite::advance()
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
    for (auto &plate : plates)
      plate.advance(dt);
    for (const auto &drive : drives)
      drive->advance(dt);
    clock.advance();
  }


  void
  Bite::find_ways_to_food()
  {
    // Plates below the food close upwards, plates above it downwards.
    const auto middle = [this](const Scene::Rectangle &box) {
      return 0.5 * (box.lower_corner[axis] + box.upper_corner[axis]);
    };
    for (const auto &plate : plates)
      {
        const Scene::Rectangle &food = scene.particle_bodies.front().shape;
        ways_to_food.push_back(middle(plate.body.shape.box_before(axis, food)) <
                                       middle(food)
                                   ? 1.
                                   : -1.);
      }
  }


  double
  Bite::closure() const
  {
    double sum = 0.;
    for (unsigned int p = 0; p < plates.size(); ++p)
      sum += ways_to_food[p] * plates[p].displacement()[axis];
    return sum;
  }


  void
  Bite::begin_sum_of_plate_forces()
  {
    plate_forces.clear();
    for (const auto &plate : plates)
      {
        plate_forces.push_back(std::abs(plate.force()[axis]));
        plate_forces.push_back(plate.force()[1 - axis]);
      }
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    const int error = MPI_Iallreduce(MPI_IN_PLACE,
                                     plate_forces.data(),
                                     plate_forces.size(),
                                     MPI_DOUBLE,
                                     MPI_SUM,
                                     communicator,
                                     &plate_forces_travel);
    AssertThrowMPI(error);
  }


  void
  Bite::finish_sum_of_plate_forces()
  {
    const int error = MPI_Wait(&plate_forces_travel, MPI_STATUS_IGNORE);
    AssertThrowMPI(error);
  }


  Measure::Energies
  Bite::energies() const
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
      }
    double     contact[5] = {0., 0., 0., 0., 0.};
    const auto add        = [&contact](const auto &of_two) {
      contact[0] += of_two.contact->stored_energy();
      contact[1] += of_two.contact->friction_heat();
    };
    std::for_each(pairs.begin(), pairs.end(), add);
    std::for_each(meetings.begin(), meetings.end(), add);
    std::for_each(neighbours.begin(), neighbours.end(), add);
    for (const auto &plate : plates)
      {
        contact[2] += plate.work();
        if (const auto *const deformation = plate.get_deformation())
          {
            contact[3] += deformation->strain_energy();
            contact[4] += deformation->kinetic_energy();
          }
      }
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(contact, 5),
                                communicator,
                                dealii::ArrayView<double>(contact, 5));
    e.contact             = contact[0];
    e.dissipated_friction = contact[1];
    e.plate_strain        = contact[3];
    e.plate_kinetic       = contact[4];
    const auto work       = SPH::work_of_conditions(conditions, communicator);
    e.external_work       = contact[2] + work.of_loads;
    e.dissipated_damping  = work.damped;
    return e;
  }


  dealii::Tensor<1, 2>
  Bite::momentum() const
  {
    auto sum = SPH::total_momentum(solids);
    for (const auto &plate : plates)
      if (const auto *const deformation = plate.get_deformation())
        sum +=
            dealii::Utilities::MPI::sum(deformation->momentum(), communicator);
    return sum;
  }


  double
  Bite::masses_times_speeds() const
  {
    double sum = 0.;
    for (const auto &solid : solids)
      sum += SPH::half_step_masses_times_speeds(solid->get_particles());
    for (const auto &plate : plates)
      if (const auto *const deformation = plate.get_deformation())
        sum += deformation->masses_times_speeds();
    return dealii::Utilities::MPI::sum(sum, communicator);
  }


  std::vector<dealii::Tensor<1, 2>>
  Bite::impulses() const
  {
    std::vector<dealii::Tensor<1, 2>> list;
    for (const auto &plate : plates)
      list.push_back(
          dealii::Utilities::MPI::sum(plate.impulse(), communicator));
    for (const auto &impulse :
         SPH::impulses_of_conditions(conditions, communicator))
      list.push_back(impulse);
    return list;
  }


  double
  Bite::deepest_penetration() const
  {
    double deepest = 0.;
    for (const auto &pair : pairs)
      deepest = std::max(deepest, pair.contact->deepest_penetration());
    return dealii::Utilities::MPI::max(deepest, communicator);
  }


  GuardedSystem
  Bite::guarded() const
  {
    GuardedSystem system = guarded_bodies(scene, solids, communicator);
    for (const auto &pair : pairs)
      system.contacts.push_back(
          {scene.particle_bodies[pair.solid].name,
           scene.plate_bodies[pair.plate].name,
           [&pair] { return pair.contact->deepest_penetration(); },
           solids[pair.solid]->get_particles().spacing});
    for (const auto &meeting : meetings)
      system.contacts.push_back(
          {scene.plate_bodies[meeting.first].name,
           scene.plate_bodies[meeting.second].name,
           [&meeting] { return meeting.contact->deepest_penetration(); },
           solids.front()->get_particles().spacing});
    for (const auto &two : neighbours)
      system.contacts.push_back(
          {scene.particle_bodies[two.first].name,
           scene.particle_bodies[two.second].name,
           [&two] { return two.contact->deepest_penetration(); },
           0.9 * two.contact->range()});
    for (const auto &plate : scene.plate_bodies)
      system.given_speed =
          std::max({system.given_speed,
                    plate.motion.typical_velocity().norm(),
                    plate.deformation.initial_velocity.norm()});
    return system;
  }


  std::vector<const SPH::Solid *>
  Bite::shared_bodies() const
  {
    std::vector<const SPH::Solid *> list;
    for (const auto &solid : solids)
      list.push_back(solid.get());
    return list;
  }


  unsigned long long
  Bite::particle_count() const
  {
    unsigned long long count = 0;
    for (const auto &solid : solids)
      count += solid->get_host().n_global();
    return count;
  }
} // namespace Morsel
