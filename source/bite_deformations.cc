#include "bite.h"
#include "elastic_plates.h"
#include "guarded.h"

#include <morsel/core/suggestions.h>
#include <morsel/jaw/dynamic_deformation.h>
#include <morsel/jaw/quasi_static_deformation.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
          const auto choice =
              choose_response(scene, plates[p].body, *elastic[p]);
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
                  std::move(elastic[p]), communicator));
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
    const auto without_plates = plate_frequencies;
    bool       may_carry      = false;
    for (unsigned int p = 0; p < plates.size(); ++p)
      may_carry = may_carry || chooses_beta(p, elastic);
    const auto limit_with = [&](const double chosen) {
      betas.clear();
      for (unsigned int p = 0; p < plates.size(); ++p)
        {
          const double given = plates[p].body.deformation.beta;
          betas.push_back(chooses_beta(p, elastic) ? chosen
                          : given > 0.             ? given
                                                   : average_acceleration);
        }
      plate_frequencies = without_plates;
      choose_time_step();
      limit_step_by_dynamic_plates(elastic);
      return automatic_step;
    };
    const double of_food = automatic_step;
    const double shorter = limit_with(average_acceleration);
    if (may_carry && shorter < worthwhile * of_food)
      {
        const double longer = limit_with(carrying_beta);
        if (shorter < worthwhile * longer)
          log << "The stiffness of plates carries the contact (Newmark's beta "
              << carrying_beta << "): step " << longer << " s instead of "
              << shorter << " s.\n";
        else
          limit_with(average_acceleration);
      }
    if (clock.time_step() > automatic_step &&
        *std::max_element(plate_frequencies.begin(), plate_frequencies.end()) >
            0.)
      log.warning("'Time/Time step' exceeds the stable step of contact with "
                  "elastic plates, " +
                  number_text(automatic_step) + " s.");
  }


  bool
  Bite::chooses_beta(
      const unsigned int                                   plate,
      const std::vector<std::unique_ptr<FE::ElasticBody>> &elastic) const
  {
    return responses[plate] == "dynamic" && elastic[plate]->is_held() &&
           plates[plate].body.deformation.beta == 0.;
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
  Bite::choose_time_step()
  {
    automatic_step = stable_time_step();
    clock.set_time_step(scene.time.time_step > 0. ? scene.time.time_step
                                                  : automatic_step);
  }


  double
  Bite::safe_time_step() const
  {
    return automatic_step / largest_cfl_above_one(scene);
  }


  double
  Bite::contact_stiffness(const unsigned int solid) const
  {
    double stiffness = 0.;
    for (const auto &pair : pairs)
      if (pair.solid == solid)
        stiffness = std::max(stiffness,
                             pair.contact->stiffness() +
                                 plate_frequencies[pair.plate] *
                                     solids[solid]->contact_side().mass);
    for (const auto &two : neighbours)
      if (two.first == solid || two.second == solid)
        stiffness += two.contact->stiffness();
    return stiffness;
  }


  double
  Bite::stopped_slip() const
  {
    const auto &law = scene.contact;
    return pairs.empty() || law.friction == 0. || law.sticks_elastically()
               ? 0.
               : Contact::stopped_slip;
  }


  double
  Bite::measured_stable_step()
  {
    double smallest = std::numeric_limits<double>::max();
    for (unsigned int s = 0; s < solids.size(); ++s)
      smallest = std::min(smallest,
                          solids[s]->measured_stable_time_step(
                              contact_stiffness(s), stopped_slip()));
    return smallest;
  }


  double
  Bite::stable_time_step() const
  {
    double smallest = std::numeric_limits<double>::max();
    for (unsigned int s = 0; s < solids.size(); ++s)
      smallest = std::min(
          smallest,
          solids[s]->stable_time_step(contact_stiffness(s), stopped_slip()));
    for (const auto &meeting : meetings)
      if (const double square = plate_frequencies[meeting.first] +
                                plate_frequencies[meeting.second];
          square > 0.)
        smallest = std::min(smallest,
                            scene.particle_bodies.front().solid.cfl * 2. /
                                std::sqrt(square));
    for (const auto &drive : inertial_drives())
      smallest = std::min(smallest, drive.second->stable_time_step());
    return smallest;
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


  void
  Bite::press(Pair &pair)
  {
    const auto &particles = solids[pair.solid]->get_particles();
    pair.contact->compute(particles.reference,
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
