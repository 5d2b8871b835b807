#include "recorder.h"
#include "run_summary.h"

#include <algorithm>

namespace Morsel
{
  void
  Recorder::write_elastic_plates()
  {
    using Field = Output::Field;

    std::vector<dealii::Point<2>> points;
    std::vector<double>           displacement, stress, mises, number;
    const auto                   &plates = bite.get_plates();
    for (unsigned int p = 0; p < plates.size(); ++p)
      {
        const auto *const deformation = plates[p].get_deformation();
        // Every rank has the same ones.
        if (!deformation || !first_rank)
          continue;
        const auto fields =
            deformation->get_body().corner_fields(deformation->displacement());
        for (unsigned int i = 0; i < fields.points.size(); ++i)
          points.push_back(plates[p].frame().place(
              fields.points[i] +
              dealii::Tensor<1, 2>({fields.displacement[2 * i],
                                    fields.displacement[2 * i + 1]})));
        const auto append = [](std::vector<double>       &to,
                               const std::vector<double> &values) {
          to.insert(to.end(), values.begin(), values.end());
        };
        append(displacement, fields.displacement);
        append(stress, fields.stress);
        append(mises, fields.von_mises);
        number.resize(points.size(), p);
      }
    elastic_frames->write(bite.time(),
                          dealii::make_array_view(points),
                          {{"displacement", Field::Kind::vector, displacement},
                           {"stress", Field::Kind::tensor, stress},
                           {"von_mises", Field::Kind::scalar, mises},
                           {"plate", Field::Kind::scalar, number}});
  }


  void
  Recorder::follow_deflections()
  {
    const auto &plates = bite.get_plates();
    deflections.resize(plates.size(), 0.);
    for (unsigned int p = 0; p < plates.size(); ++p)
      if (const auto *const d = plates[p].get_deformation())
        deflections[p] = std::max(deflections[p],
                                  (d->get_body().trace() * d->displacement())
                                      .lpNorm<Eigen::Infinity>());
  }


  void
  Recorder::summarise_plates()
  {
    const auto &plates = bite.get_plates();
    for (unsigned int p = 0; p < plates.size(); ++p)
      {
        const std::string name = underscored(plates[p].body.name);
        summary.add("peak_tangential_force_" + name,
                    stroke.peak_tangential_force(p),
                    "N",
                    "largest tangential force on the " + plates[p].body.name);
        if (!plates[p].body.deformation.elastic)
          continue;
        summary.add_text("response_" + name, bite.response(p));
        if (plates[p].get_deformation())
          summary.add("largest_deflection_" + name,
                      deflections[p],
                      "m",
                      "largest displacement of its surface's nodes relative "
                      "to the sides that are held");
        if (const auto *const d = plates[p].get_deformation();
            d && d->settles())
          summary.add("contact_evaluations_per_step_" + name,
                      static_cast<double>(d->n_evaluations()) /
                          (bite.step() + 1.),
                      "1",
                      "what its equilibrium with the food takes");
      }
    const auto &e = energy.last();
    if (e.plate_strain == 0. && e.plate_kinetic == 0.)
      return;
    summary.add("plate_strain_energy",
                e.plate_strain,
                "J",
                "recoverable in elastic plates, at the end");
    summary.add("plate_kinetic_energy",
                e.plate_kinetic,
                "J",
                "of elastic plates with inertia, at the end");
  }
} // namespace Morsel
