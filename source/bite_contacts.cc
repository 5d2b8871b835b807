#include "bite.h"

#include <morsel/jaw/dynamic_deformation.h>
#include <morsel/materials/elasticity.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Morsel
{
  namespace
  {
    /// lambda + 2 mu of an elastic plate [Pa]; a rigid one is beyond measure.
    double
    p_wave_modulus(const Scene::PlateBody &plate)
    {
      const auto &d = plate.deformation;
      return d.elastic ? Materials::Elasticity(
                             d.youngs_modulus, d.poissons_ratio, d.density)
                             .p_wave_modulus
                       : std::numeric_limits<double>::infinity();
    }


    template <typename Bodies>
    unsigned int
    index_of(const Bodies &bodies, const std::string &name)
    {
      for (unsigned int k = 0; k < bodies.size(); ++k)
        if (bodies[k].name == name)
          return k;
      AssertThrow(false, dealii::ExcInternalError());
      return 0;
    }
  } // namespace


  void
  Bite::make_pairs()
  {
    for (const auto &pair : scene.contact_pairs)
      {
        const unsigned int s = index_of(scene.particle_bodies, pair.food);
        const unsigned int p = index_of(scene.plate_bodies, pair.plate);
        // The softer one says how stiff their contact is.
        ParticleSide side   = solids[s]->contact_side();
        side.p_wave_modulus = std::min(side.p_wave_modulus,
                                       p_wave_modulus(scene.plate_bodies[p]));
        pairs.push_back({s,
                         p,
                         Contact::make_plate_contact(
                             scene.contact,
                             side,
                             solids[s]->get_edges(),
                             scene.plate_bodies[p].deformation.elastic)});
      }
  }


  void
  Bite::make_meetings()
  {
    for (const auto &pair : scene.plate_pairs)
      {
        const unsigned int first  = index_of(scene.plate_bodies, pair.first);
        const unsigned int second = index_of(scene.plate_bodies, pair.second);
        ParticleSide       side   = solids.front()->contact_side();
        // The softer one yields; where both are rigid as much as the food.
        const double softer = std::min(p_wave_modulus(plates[first].body),
                                       p_wave_modulus(plates[second].body));
        if (std::isfinite(softer))
          side.p_wave_modulus = softer;
        const auto   &surface = plates[first].surface;
        ParticleEdges edges;
        for (const double width : surface.tributary)
          {
            edges.of_particle.push_back({0., width});
            edges.enlarge(edges.of_particle.back());
          }
        Contact::ContactParameters law = scene.contact;
        law.law                        = "gap penalty";
        meetings.push_back(
            {first,
             second,
             Contact::make_plate_contact(
                 law, side, edges, plates[second].body.deformation.elastic),
             scene.contact.stiffness * side.p_wave_modulus * side.depth /
                 side.spacing,
             surface.nodes,
             {}});
      }
  }


  void
  Bite::make_neighbours()
  {
    for (const auto &pair : scene.food_pairs)
      {
        const unsigned int first = index_of(scene.particle_bodies, pair.first),
                           second =
                               index_of(scene.particle_bodies, pair.second);
        const double softer =
            std::min(solids[first]->get_material().p_wave_modulus,
                     solids[second]->get_material().p_wave_modulus);
        neighbours.push_back(
            {first,
             second,
             std::make_unique<SPH::BodyContact>(solids[first]->get_particles(),
                                                solids[second]->get_particles(),
                                                scene.contact.stiffness *
                                                    softer * scene.depth,
                                                scene.contact.friction,
                                                communicator)});
      }
  }


  void
  Bite::touch()
  {
    // Forces on plates are sums over ranks.
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      for (auto &meeting : meetings)
        meet(meeting);
    for (unsigned int p = 0; p < plates.size(); ++p)
      if (plates[p].settles())
        settle(p);
    for (auto &pair : pairs)
      if (!plates[pair.plate].settles())
        press(pair);
  }


  void
  Bite::load_food()
  {
    for (auto &pair : pairs)
      solids[pair.solid]->apply_forces(pair.contact->last_forces());
    for (auto &two : neighbours)
      {
        two.contact->compute(clock.time_step());
        solids[two.first]->apply_forces(two.contact->forces_on_first());
        solids[two.second]->apply_forces(two.contact->forces_on_second());
      }
    for (unsigned int s = 0; s < conditions.size(); ++s)
      conditions[s].apply(*solids[s], clock.time(), clock.time_step());
  }


  void
  Bite::meet(Meeting &meeting)
  {
    auto              &first = plates[meeting.first].surface;
    const unsigned int n     = first.nodes.size();
    meeting.motion.resize(n);
    for (unsigned int k = 0; k < n; ++k)
      {
        const auto u      = first.nodes[k] - meeting.places[k];
        meeting.motion[k] = {
            u[0], u[1], first.velocity[k][0], first.velocity[k][1]};
      }
    for (const auto &f :
         meeting.contact->compute(meeting.places,
                                  meeting.motion,
                                  n,
                                  clock.time_step(),
                                  plates[meeting.second].surface))
      first.force[f.particle] += f.force;
  }


  void
  Bite::limit_step_by_drives()
  {
    for (unsigned int p = 0; p < plates.size(); ++p)
      {
        const auto *const drive = dynamic_cast<const Jaw::InertialDrive *>(
            plates[p].get_drive().get());
        if (!drive)
          continue;
        const auto  &box  = plates[p].body.shape;
        const double mass = drive->mass_at(
            box.lower_corner + 0.5 * (box.upper_corner - box.lower_corner));
        double stiffness = 0.;
        for (const auto &pair : pairs)
          if (pair.plate == p)
            {
              const auto  &food = scene.particle_bodies[pair.solid].shape;
              const double side = std::max(food.extent(0), food.extent(1));
              stiffness += pair.contact->stiffness() * side /
                           solids[pair.solid]->contact_side().spacing;
            }
        for (const auto &meeting : meetings)
          if (meeting.first == p || meeting.second == p)
            stiffness +=
                meeting.foundation * std::max(box.extent(0), box.extent(1));
        plate_frequencies[p] = stiffness / mass;
      }
  }


  void
  Bite::limit_step_by_meetings(
      const std::vector<std::unique_ptr<FE::ElasticBody>> &elastic)
  {
    for (const auto &meeting : meetings)
      for (const unsigned int p : {meeting.first, meeting.second})
        if (responses[p] == "dynamic")
          plate_frequencies[p] =
              std::max(plate_frequencies[p],
                       Jaw::contact_frequency(*elastic[p],
                                              meeting.foundation,
                                              plates[p].surface.tributary,
                                              carried_share(p)));
  }


  std::vector<std::pair<std::string, const Jaw::InertialDrive *>>
  Bite::inertial_drives() const
  {
    std::vector<std::pair<std::string, const Jaw::InertialDrive *>> list;
    for (const auto &drive : drives)
      if (const auto *const inertial =
              dynamic_cast<const Jaw::InertialDrive *>(drive.get()))
        {
          const auto plate = std::find_if(
              plates.begin(), plates.end(), [&](const Jaw::Plate &one) {
                return one.get_drive() == drive;
              });
          list.emplace_back(plate->body.motion.kind == "jaw" ? "jaw"
                                                             : plate->body.name,
                            inertial);
        }
    return list;
  }


  double
  Bite::work_on_food(const Jaw::InertialDrive &drive) const
  {
    double sum = 0.;
    for (const auto &plate : plates)
      if (plate.get_drive().get() == &drive)
        sum += plate.work();
    return dealii::Utilities::MPI::sum(sum, communicator);
  }
} // namespace Morsel
