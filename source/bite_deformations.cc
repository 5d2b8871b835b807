#include "bite.h"
#include "elastic_plates.h"

#include <morsel/core/suggestions.h>
#include <morsel/jaw/dynamic_deformation.h>
#include <morsel/jaw/quasi_static_deformation.h>

#include <algorithm>

namespace Morsel
{
  namespace
  {
    /// The step and what stiff plates carry at it follow from each other; the
    /// second round is within 1 % of the limit of many.
    constexpr unsigned int rounds_of_step = 3;
  } // namespace


  void
  Bite::set_up_deformations(
      std::vector<std::unique_ptr<FE::ElasticBody>> &&elastic)
  {
    for (unsigned int p = 0; p < plates.size(); ++p)
      if (elastic[p])
        {
          const auto choice = choose_response(
              scene,
              plates[p].body,
              *elastic[p],
              dealii::Utilities::MPI::n_mpi_processes(communicator));
          responses[p] = choice.response;
          log << "Body '" << plates[p].body.name << "', "
              << elastic[p]->n_cells() << " cells: " << choice.response
              << ", since " << choice.reason << ".\n";
        }
    limit_step_by_plates(elastic);

    for (unsigned int p = 0; p < plates.size(); ++p)
      {
        if (responses[p] == "quasi-static")
          plates[p].set_deformation(
              std::make_unique<Jaw::QuasiStaticDeformation>(
                  std::move(elastic[p])));
        else if (responses[p] == "dynamic")
          plates[p].set_deformation(std::make_unique<Jaw::DynamicDeformation>(
              std::move(elastic[p]),
              plates[p].body.deformation.initial_velocity,
              plates[p].body.deformation.beta,
              clock.time_step(),
              communicator));
        deforms = deforms || plates[p].get_deformation() != nullptr;
      }
    set_slipping_masses();
  }


  void
  Bite::limit_step_by_plates(
      const std::vector<std::unique_ptr<FE::ElasticBody>> &elastic)
  {
    // What a plate's own stiffness carries of the contact's springs depends on
    // the step, and the step on what is left: from the food's own one down.
    const auto any_carries = [this] {
      for (unsigned int p = 0; p < plates.size(); ++p)
        if (responses[p] == "dynamic" && plates[p].body.deformation.beta > 0.25)
          return true;
      return false;
    };
    const unsigned int rounds = any_carries() ? rounds_of_step : 1;
    for (unsigned int round = 0; round < rounds; ++round)
      {
        for (const auto &pair : pairs)
          if (responses[pair.plate] == "dynamic")
            plate_frequencies[pair.plate] =
                std::max(plate_frequencies[pair.plate],
                         Jaw::contact_frequency(
                             *elastic[pair.plate],
                             pair.contact->stiffness() /
                                 solids[pair.solid]->contact_side().spacing,
                             plates[pair.plate].surface.tributary,
                             carried_share(pair.plate)));
        limit_step_by_meetings(elastic);
        choose_time_step();
      }
    if (clock.time_step() > automatic_step &&
        *std::max_element(plate_frequencies.begin(), plate_frequencies.end()) >
            0.)
      log.warning("'Time/Time step' exceeds the stable step of contact with "
                  "elastic plates, " +
                  number_text(automatic_step) + " s.");
  }


  double
  Bite::carried_share(const unsigned int plate) const
  {
    const double dt = clock.time_step();
    return (plates[plate].body.deformation.beta - 0.25) * dt * dt;
  }


  void
  Bite::set_slipping_masses()
  {
    // Friction that stops a particle against a surface at rest would turn a
    // light surface around.
    for (const auto &pair : pairs)
      if (responses[pair.plate] == "dynamic")
        {
          const auto   side      = solids[pair.solid]->contact_side();
          const double stiffness = pair.contact->stiffness();
          const double frequency = Jaw::contact_frequency(
              plates[pair.plate].get_deformation()->get_body(),
              stiffness / side.spacing,
              plates[pair.plate].surface.tributary,
              plates[pair.plate].body.deformation.beta * clock.time_step() *
                  clock.time_step());
          pair.contact->set_slipping_mass(
              1. / (1. / side.mass + frequency / stiffness));
        }
  }


  const std::vector<ParticleForce> &
  Bite::press(Pair &pair)
  {
    const auto &particles = solids[pair.solid]->get_particles();
    return pair.contact->compute(particles.reference,
                                 particles.motion,
                                 particles.n_owned,
                                 clock.time_step(),
                                 plates[pair.plate].surface,
                                 particles.travelled);
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
    // Since the last equilibrium.
    const double past =
        clock.step() == 0 ? clock.time_step() : 2. * clock.lag();
    while (!plates[plate].settle(touches, past))
      for (auto &pair : pairs)
        if (pair.plate == plate)
          pair.contact->compute_again(
              solids[pair.solid]->get_particles().motion,
              clock.time_step(),
              plates[plate].surface);
  }
} // namespace Morsel
