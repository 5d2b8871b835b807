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

    /// Newmark's beta with which a body's stiffness drops out of the stable
    /// step, and with which it carries the springs of contact.
    constexpr double average_acceleration = 0.25, carrying_beta = 0.5;

    /// Plates that shorten the step by less keep the average acceleration.
    constexpr double worthwhile = 0.8;
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
              betas[p],
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
    const double of_food        = automatic_step;
    const auto   without_plates = plate_frequencies;
    bool         may_carry      = false;
    for (unsigned int p = 0; p < plates.size(); ++p)
      {
        const double given = plates[p].body.deformation.beta;
        betas.push_back(given > 0. ? given : average_acceleration);
        may_carry = may_carry || (responses[p] == "dynamic" && given == 0. &&
                                  elastic[p]->is_held());
      }
    limit_step_by_dynamic_plates(elastic);
    if (may_carry && automatic_step < worthwhile * of_food)
      {
        for (unsigned int p = 0; p < plates.size(); ++p)
          if (responses[p] == "dynamic" && elastic[p]->is_held() &&
              plates[p].body.deformation.beta == 0.)
            betas[p] = carrying_beta;
        const double shorter = automatic_step;
        plate_frequencies    = without_plates;
        choose_time_step();
        limit_step_by_dynamic_plates(elastic);
        log << "The stiffness of plates carries the contact (Newmark's beta "
            << carrying_beta << "): step " << automatic_step << " s instead of "
            << shorter << " s.\n";
      }
    if (clock.time_step() > automatic_step &&
        *std::max_element(plate_frequencies.begin(), plate_frequencies.end()) >
            0.)
      log.warning("'Time/Time step' exceeds the stable step of contact with "
                  "elastic plates, " +
                  number_text(automatic_step) + " s.");
  }


  void
  Bite::limit_step_by_dynamic_plates(
      const std::vector<std::unique_ptr<FE::ElasticBody>> &elastic)
  {
    // What a plate's own stiffness carries of the contact's springs depends on
    // the step, and the step on what is left: from the food's own one down.
    const bool any_carries =
        std::any_of(betas.begin(), betas.end(), [](const double beta) {
          return beta > average_acceleration;
        });
    const unsigned int rounds = any_carries ? rounds_of_step : 1;
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
  }


  double
  Bite::carried_share(const unsigned int plate) const
  {
    const double dt = clock.time_step();
    return (betas[plate] - average_acceleration) * dt * dt;
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
              betas[pair.plate] * clock.time_step() * clock.time_step());
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
