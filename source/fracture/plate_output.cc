#include <morsel/core/vtu.h>
#include <morsel/fracture/plate_output.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

namespace Morsel::Fracture
{
  using namespace dealii;

  namespace
  {
    /// The crack from one of its tips on, up to @p length along it [m].
    struct CrackWalk
    {
      CrackWalk(const Crack &crack, const CrackTip &tip)
          : vertices(crack.get_vertices())
      {
        if (tip.end == 1)
          std::reverse(vertices.begin(), vertices.end());
      }

      /// The place at a distance along the crack, and the unit vector back
      /// towards the tip there.
      std::pair<Point<2>, Tensor<1, 2>>
      at(double distance) const
      {
        unsigned int s = 0;
        while (s + 2 < vertices.size() &&
               distance > vertices[s].distance(vertices[s + 1]))
          {
            distance -= vertices[s].distance(vertices[s + 1]);
            ++s;
          }
        const Tensor<1, 2> step = vertices[s + 1] - vertices[s];
        return {vertices[s] + distance / step.norm() * step,
                -1. / step.norm() * step};
      }

      std::vector<Point<2>> vertices;
    };


    /// Coordinates to a point and back of a polar frame at a tip.
    Point<2>
    polar(const CrackTip &tip, const double r, const double angle)
    {
      const Tensor<1, 2> &d = tip.direction;
      const double        c = std::cos(angle), s = std::sin(angle);
      return tip.position +
             r * Tensor<1, 2>({c * d[0] - s * d[1], c * d[1] + s * d[0]});
    }


    /// sigma_tt, sigma_rt, sigma_rr at an angle from the tip's direction.
    std::array<double, 3>
    polar_stress(const CrackTip              &tip,
                 const SymmetricTensor<2, 2> &stress,
                 const double                 angle)
    {
      const Tensor<1, 2> radial = polar(tip, 1., angle) - tip.position;
      const Tensor<1, 2> across({-radial[1], radial[0]});
      return {{across * (stress * across),
               radial * (stress * across),
               radial * (stress * radial)}};
    }


    ElasticPlane
    material_of(const PlateScene &plate)
    {
      return ElasticPlane(
          plate.youngs_modulus, plate.poissons_ratio, plate.plane_stress);
    }


    std::ostringstream
    begin_table(const std::string &header)
    {
      std::ostringstream out;
      out.precision(12);
      out << header << '\n';
      return out;
    }


    /// A comma and what the table's stream would write of the value, in a third
    /// of its time: 24,000 numbers tell the stress about a tip.
    void
    write_next(std::ostringstream &out, const double value)
    {
      std::array<char, 32> text;
      text[0]        = ',';
      const auto end = std::to_chars(text.data() + 1,
                                     text.data() + text.size(),
                                     value,
                                     std::chars_format::general,
                                     12);
      out.write(text.data(), end.ptr - text.data());
    }
  } // namespace


  std::string
  stress_intensity_csv(const std::vector<CrackTip>  &tips,
                       const std::vector<TipResult> &results)
  {
    std::ostringstream out = begin_table(
        "tip [1],crack [1],x [m],y [m],direction_x [1],direction_y [1],"
        "inner_radius [m],outer_radius [m],stress_intensity_I [Pa sqrt(m)],"
        "stress_intensity_II [Pa sqrt(m)],energy_release_rate [J/m^2]");
    for (const TipResult &result : results)
      for (unsigned int i = 0; i < result.rings.size(); ++i)
        {
          const CrackTip &tip = tips[result.tip];
          out << result.tip << ',' << tip.crack << ',' << tip.position[0] << ','
              << tip.position[1] << ',' << tip.direction[0] << ','
              << tip.direction[1] << ',' << result.rings[i].inner_radius << ','
              << result.rings[i].outer_radius << ',' << result.by_ring[i].mode_I
              << ',' << result.by_ring[i].mode_II << ','
              << result.energy_release[i] << '\n';
        }
    return out.str();
  }


  std::string
  crack_opening_csv(const PlateScene             &plate,
                    const std::vector<Crack>     &cracks,
                    const std::vector<TipResult> &results,
                    const FieldSampler           &sample)
  {
    constexpr unsigned int      n_places = 60;
    const std::vector<CrackTip> tips     = collect_tips(cracks);
    const double                offset =
        1e-8 * (plate.upper_corner - plate.lower_corner).norm();

    struct Place
    {
      unsigned int result;
      double       distance;
      Tensor<1, 2> along;
    };
    std::vector<Place>    places;
    std::vector<Point<2>> left, right;
    for (unsigned int k = 0; k < results.size(); ++k)
      {
        const CrackTip &tip   = tips[results[k].tip];
        const Crack    &crack = cracks[tip.crack];
        const CrackWalk walk(crack, tip);
        const double    length =
            crack.length() * (crack.has_tip(0) && crack.has_tip(1) ? 0.5 : 1.);
        for (unsigned int i = 1; i <= n_places; ++i)
          {
            const double s        = i / double(n_places);
            const auto [p, along] = walk.at(s * s * length);
            const Tensor<1, 2> aside =
                offset * Tensor<1, 2>({-along[1], along[0]});
            // The mouth lies beyond the boundary.
            if (depth_inside(plate, p) <= offset)
              continue;
            places.push_back({k, s * s * length, along});
            left.push_back(p + aside);
            right.push_back(p - aside);
          }
      }
    const auto above = sample(left), below = sample(right);

    const double       effective_modulus = material_of(plate).effective_modulus;
    std::ostringstream out               = begin_table(
        "tip [1],distance [m],opening [m],sliding [m],asymptotic_opening [m],"
                      "asymptotic_sliding [m]");
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        const TipResult    &result = results[places[i].result];
        const Tensor<1, 2>  jump   = above[i].value - below[i].value;
        const Tensor<1, 2> &along  = places[i].along;
        const double        law    = 8. / effective_modulus *
                           std::sqrt(places[i].distance / (2. * numbers::PI));
        out << result.tip << ',' << places[i].distance << ','
            << jump[1] * along[0] - jump[0] * along[1] << ',' << jump * along
            << ',' << law * result.statistics.mean.mode_I << ','
            << law * result.statistics.mean.mode_II << '\n';
      }
    return out.str();
  }


  std::string
  tip_stress_csv(const PlateScene             &plate,
                 const std::vector<CrackTip>  &tips,
                 const std::vector<TipResult> &results,
                 const FieldSampler           &sample)
  {
    constexpr unsigned int n_ahead = 60, n_circles = 24, n_around = 120;
    struct Place
    {
      unsigned int result;
      double       r, angle;
    };
    std::vector<Place>    places;
    std::vector<Point<2>> points;
    for (unsigned int k = 0; k < results.size(); ++k)
      {
        const double reach = results[k].rings.back().outer_radius;
        for (unsigned int i = 1; i <= n_ahead; ++i)
          places.push_back(
              {k, 0.999 * reach * std::pow(i / double(n_ahead), 2), 0.});
        // Angles between the ends: none lies on the crack.
        for (unsigned int c = 1; c <= n_circles; ++c)
          for (unsigned int i = 0; i < n_around; ++i)
            places.push_back({k,
                              0.4 * reach * std::pow(c / double(n_circles), 2),
                              numbers::PI * ((2. * i + 1.) / n_around - 1.)});
      }
    for (const Place &place : places)
      points.push_back(
          polar(tips[results[place.result].tip], place.r, place.angle));
    const auto samples = sample(points);

    const ElasticPlane material = material_of(plate);
    std::ostringstream out      = begin_table(
        "tip [1],radius [m],angle [degrees],stress_tt [Pa],stress_rt [Pa],"
             "stress_rr [Pa],asymptotic_tt [Pa],asymptotic_rt [Pa],asymptotic_rr "
             "[Pa]");
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        const TipResult &result = results[places[i].result];
        const CrackTip  &tip    = tips[result.tip];
        const auto       field  = williams_field(tip,
                                          material,
                                          result.statistics.mean.mode_I,
                                          result.statistics.mean.mode_II,
                                          points[i]);
        out << result.tip;
        write_next(out, places[i].r);
        write_next(out, places[i].angle * 180. / numbers::PI);
        for (const auto &gradient : {samples[i].gradient, field.gradient})
          for (const double s :
               polar_stress(tip, material.stress(gradient), places[i].angle))
            write_next(out, s);
        out << '\n';
      }
    return out.str();
  }


  std::string
  rings_vtu(const std::vector<CrackTip>  &tips,
            const std::vector<TipResult> &results)
  {
    constexpr unsigned int n_sides = 96;
    VtuGrid                grid;
    // No column may be missing from a file without rings.
    for (const char *name : {"tip",
                             "radius",
                             "stress_intensity_I",
                             "stress_intensity_II",
                             "energy_release_rate"})
      grid.cell_field(name, 1);
    for (const TipResult &result : results)
      for (unsigned int i = 0; i < result.rings.size(); ++i)
        for (const double radius :
             {result.rings[i].inner_radius, result.rings[i].outer_radius})
          {
            for (unsigned int s = 0; s <= n_sides; ++s)
              {
                const Point<2> p = polar(
                    tips[result.tip], radius, 2. * numbers::PI * s / n_sides);
                grid.add_point(p[0], p[1]);
              }
            grid.add_cell(VtuGrid::Shape::poly_line, n_sides + 1);
            grid.cell_field("tip", 1).push_back(result.tip);
            grid.cell_field("radius", 1).push_back(radius);
            grid.cell_field("stress_intensity_I", 1)
                .push_back(result.by_ring[i].mode_I);
            grid.cell_field("stress_intensity_II", 1)
                .push_back(result.by_ring[i].mode_II);
            grid.cell_field("energy_release_rate", 1)
                .push_back(result.energy_release[i]);
          }
    return grid.text();
  }


  std::string
  cracks_vtu(const PlateScene &plate, const std::vector<Crack> &cracks)
  {
    VtuGrid grid;
    grid.cell_field("crack", 1);
    for (unsigned int c = 0; c < cracks.size(); ++c)
      {
        const auto &vertices = cracks[c].get_vertices();
        for (const Point<2> &v : vertices)
          grid.add_point(
              std::clamp(v[0], plate.lower_corner[0], plate.upper_corner[0]),
              std::clamp(v[1], plate.lower_corner[1], plate.upper_corner[1]));
        grid.add_cell(VtuGrid::Shape::poly_line, vertices.size());
        grid.cell_field("crack", 1).push_back(c);
      }
    return grid.text();
  }
} // namespace Morsel::Fracture
