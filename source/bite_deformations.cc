#include "bite.h"
#include "elastic_plates.h"

#include <morsel/jaw/dynamic_deformation.h>
#include <morsel/jaw/quasi_static_deformation.h>

#include <algorithm>

namespace Morsel
{
  void
  Bite::set_up_deformations(
      std::vector<std::unique_ptr<FE::ElasticBody>> &&elastic)
  {
    std::vector<Jaw::DynamicDeformation *> dynamic(plates.size(), nullptr);
    for (unsigned int p = 0; p < plates.size(); ++p)
      {
        if (!elastic[p])
          continue;
        const auto choice = choose_response(
            scene,
            plates[p].body,
            *elastic[p],
            dealii::Utilities::MPI::n_mpi_processes(communicator));
        responses[p] = choice.response;
        log << "Body '" << plates[p].body.name << "', " << elastic[p]->n_cells()
            << " cells: " << choice.response << ", since " << choice.reason
            << ".\n";
        if (choice.response == "quasi-static")
          plates[p].set_deformation(
              std::make_unique<Jaw::QuasiStaticDeformation>(
                  std::move(elastic[p])));
        else if (choice.response == "dynamic")
          {
            auto deformation = std::make_unique<Jaw::DynamicDeformation>(
                std::move(elastic[p]),
                plates[p].body.deformation.initial_velocity,
                dt,
                communicator);
            dynamic[p] = deformation.get();
            plates[p].set_deformation(std::move(deformation));
          }
        deforms = deforms || plates[p].get_deformation() != nullptr;
      }

    // The shorter the step, the less a body's stiffness resists its surface's
    // motion on the springs of contact.
    for (double last = 0.; deforms && dt != last;)
      {
        last = dt;
        for (const auto &pair : pairs)
          if (auto *const d = dynamic[pair.plate])
            {
              d->set_time_step(dt);
              plate_frequencies[pair.plate] =
                  std::max(plate_frequencies[pair.plate],
                           d->contact_frequency(
                               pair.contact->stiffness() /
                                   solids[pair.solid]->contact_side().spacing,
                               plates[pair.plate].surface.tributary));
            }
        const double stable = stable_time_step();
        if (scene.time.time_step == 0. && stable < 0.99 * dt)
          dt = stable;
        else if (scene.time.time_step > stable)
          log.warning("'Time/Time step' exceeds the stable step " +
                      std::to_string(1e9 * stable) +
                      " ns of the elastic bodies' contact.");
      }
  }


  const std::vector<ParticleForce> &
  Bite::press(Pair &pair)
  {
    const auto &particles = solids[pair.solid]->get_particles();
    return pair.contact->compute(particles.reference,
                                 particles.motion,
                                 particles.n_owned,
                                 dt,
                                 plates[pair.plate].surface);
  }


  void
  Bite::settle(const unsigned int plate)
  {
    std::vector<const Contact::Touches *> touches;
    for (auto &pair : pairs)
      if (pair.plate == plate)
        {
          press(pair);
          touches.push_back(&pair.contact->touches());
        }
    while (!plates[plate].settle(touches, dt))
      for (auto &pair : pairs)
        if (pair.plate == plate)
          pair.contact->compute_again(
              solids[pair.solid]->get_particles().motion,
              dt,
              plates[plate].surface);
  }
} // namespace Morsel
