#include "recorder.h"
#include "run_summary.h"

#include <algorithm>

namespace Morsel
{
  namespace
  {
    /// With the forces of all ranks.
    Contact::Surface
    on_all_ranks(Contact::Surface surface, const MPI_Comm communicator)
    {
      std::vector<double> force;
      for (const auto &f : surface.force)
        force.insert(force.end(), {f[0], f[1]});
      dealii::Utilities::MPI::sum(force, communicator, force);
      for (unsigned int k = 0; k < surface.force.size(); ++k)
        surface.force[k] =
            dealii::Tensor<1, 2>({force[2 * k], force[2 * k + 1]});
      return surface;
    }


    double
    width_of_particles(const Scene::Scene &scene)
    {
      double width = 0.;
      for (const auto &body : scene.particle_bodies)
        width = std::max(width, body.spacing);
      return width;
    }


    double
    perimeter_of(const Measure::Fragments &fragments)
    {
      double sum = 0.;
      for (unsigned int f = 0; f < fragments.count; ++f)
        sum += fragments.pieces[f].perimeter;
      return sum;
    }
  } // namespace


  void
  Recorder::follow_surfaces()
  {
    if (stroke.time_of_peak() != bite.time() && !surfaces_at_peak.empty())
      return;
    const auto &plates = bite.get_plates();
    surfaces_at_peak.resize(plates.size());
    for (unsigned int p = 0; p < plates.size(); ++p)
      surfaces_at_peak[p] = plates[p].surface;
  }


  void
  Recorder::write_surfaces()
  {
    using Field = Output::Field;

    std::vector<dealii::Point<2>> points;
    std::vector<double>           vector, pressure, shear, number;
    const auto                   &plates = bite.get_plates();
    for (unsigned int p = 0; p < plates.size(); ++p)
      {
        const auto surface = on_all_ranks(plates[p].surface, communicator);
        if (!first_rank)
          continue;
        const auto t = Contact::traction_of(
            surface, width_of_particles(scene), scene.depth);
        for (const auto &[first, second] : surface.facets)
          for (const unsigned int k : {first, second})
            {
              points.push_back(surface.nodes[k]);
              vector.insert(vector.end(), {t.vector[k][0], t.vector[k][1]});
              pressure.push_back(t.pressure(k));
              shear.push_back(t.shear(k));
              number.push_back(p);
            }
      }
    surface_frames->write(bite.time(),
                          dealii::make_array_view(points),
                          {{"traction", Field::Kind::vector, vector},
                           {"pressure", Field::Kind::scalar, pressure},
                           {"shear", Field::Kind::scalar, shear},
                           {"plate", Field::Kind::scalar, number}});
  }


  void
  Recorder::summarise_surfaces()
  {
    std::vector<Contact::Traction> tractions;
    const unsigned int             axis = bite.closing_axis();
    for (auto &surface : surfaces_at_peak)
      {
        surface = on_all_ranks(std::move(surface), communicator);
        tractions.push_back(Contact::traction_of(
            surface, width_of_particles(scene), scene.depth));
        const auto load = Contact::load_on(surface, tractions.back());
        if (load.peak_pressure == 0.)
          continue;
        const std::string name = underscored(surface.name);
        const std::string when = " at the peak of the mean force";
        summary.add("peak_pressure_" + name,
                    load.peak_pressure,
                    "Pa",
                    "largest normal pressure on its surface, over the width "
                    "of a particle," +
                        when);
        summary.add("contact_length_" + name,
                    load.contact_length,
                    "m",
                    "of its surface, where the pressure exceeds 1 % of its "
                    "peak," +
                        when);
        summary.add("resultant_x_" + name,
                    load.centre[0],
                    "m",
                    "mean place of contact, weighted with the forces," + when);
        summary.add("resultant_y_" + name, load.centre[1], "m", "as its x");
        if (load.force[axis] != 0.)
          summary.add("tangential_over_normal_" + name,
                      std::abs(load.force[1 - axis] / load.force[axis]),
                      "1",
                      "force across over force along the closing direction" +
                          when);
      }
    if (first_rank)
      write_surface_table(tractions);
  }


  void
  Recorder::write_surface_table(
      const std::vector<Contact::Traction> &tractions) const
  {
    std::vector<std::vector<double>> rows;
    for (unsigned int p = 0; p < tractions.size(); ++p)
      for (unsigned int k = 0; k < tractions[p].arc.size(); ++k)
        rows.push_back({static_cast<double>(p),
                        tractions[p].arc[k],
                        surfaces_at_peak[p].nodes[k][0],
                        surfaces_at_peak[p].nodes[k][1],
                        tractions[p].pressure(k),
                        tractions[p].shear(k)});
    Output::write_table(options.output_directory + "/surface_forces.csv",
                        {"plate [1]",
                         "arc_length [m]",
                         "x [m]",
                         "y [m]",
                         "normal_pressure [Pa]",
                         "tangential_traction [Pa]"},
                        rows);
  }


  void
  Recorder::summarise_new_surface()
  {
    const double work = energy.last().external_work;
    if (!bite.food().can_fail() || !(work > 0.))
      return;
    const double area =
        0.5 * scene.depth * (perimeter_of(fragments) - perimeter_of(intact));
    summary.add("new_surface",
                area,
                "m^2",
                "of cracks, half of what the counted fragments have gained in "
                "surface");
    summary.add("new_surface_per_work",
                area / work,
                "m^2/J",
                "the same over the work of the plates: their efficiency");
  }
} // namespace Morsel
