#include "bite.h"

#include <algorithm>

namespace Morsel
{
  namespace
  {
    /// lambda + 2 mu of an elastic plate [Pa], 0 for a rigid one.
    double
    p_wave_modulus(const Scene::PlateBody &plate)
    {
      const auto &d = plate.deformation;
      if (!d.elastic)
        return 0.;
      const double nu = d.poissons_ratio;
      return d.youngs_modulus * (1. - nu) / ((1. + nu) * (1. - 2. * nu));
    }
  } // namespace


  void
  Bite::make_meetings()
  {
    if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      return; // forces on plates are sums over ranks
    const auto place = [this](const std::string &name) {
      unsigned int p = 0;
      while (scene.plate_bodies[p].name != name)
        ++p;
      return p;
    };
    for (const auto &pair : scene.plate_pairs)
      {
        const unsigned int first     = place(pair.first);
        const unsigned int second    = place(pair.second);
        const double       moduli[2] = {p_wave_modulus(plates[first].body),
                                        p_wave_modulus(plates[second].body)};
        ParticleSide       side      = solids.front()->contact_side();
        // The softer one yields; rigid ones take the food's stiffness.
        if (const double larger = std::max(moduli[0], moduli[1]); larger > 0.)
          side.p_wave_modulus = moduli[0] > 0. && moduli[1] > 0.
                                    ? std::min(moduli[0], moduli[1])
                                    : larger;
        const auto   &surface = plates[first].surface;
        ParticleEdges edges;
        edges.distance.assign(surface.nodes.size(), 0.);
        edges.width                    = surface.tributary;
        Contact::ContactParameters law = scene.contact;
        law.law                        = "gap penalty";
        meetings.push_back(
            {first,
             second,
             Contact::make_plate_contact(
                 law, side, edges, plates[second].body.deformation.elastic),
             surface.nodes,
             {}});
      }
  }


  void
  Bite::make_neighbours()
  {
    const auto place = [this](const std::string &name) {
      unsigned int s = 0;
      while (scene.particle_bodies[s].name != name)
        ++s;
      return s;
    };
    for (const auto &pair : scene.food_pairs)
      {
        const unsigned int first  = place(pair.first),
                           second = place(pair.second);
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
                                                scene.contact.friction)});
      }
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
                                  dt,
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
        plate_frequencies[p] = stiffness / mass;
      }
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
