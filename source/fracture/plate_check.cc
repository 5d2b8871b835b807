// What no single entry of a cracked plate's scene shows.
#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/fracture/plate_scene.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Morsel::Fracture
{
  using namespace dealii;

  namespace
  {
    std::string
    entry(const unsigned int side, const char *what)
    {
      return std::string("'Boundary/") + side_names[side] + " " + what + "'";
    }


    bool
    holds(const PlateScene  &plate,
          const unsigned int side,
          const unsigned int component)
    {
      const unsigned int normal = side < 2 ? 0 : 1;
      return plate.support[side] == "clamp" ||
             plate.support[side] == "displacement" ||
             (plate.support[side] == "roller" && component == normal);
    }


    void
    check_size(const PlateScene &plate)
    {
      for (unsigned int d = 0; d < 2; ++d)
        {
          const double side = plate.upper_corner[d] - plate.lower_corner[d];
          if (!(side >= 1e-9 && side <= 1e6))
            throw InputError("'Plate/Upper corner' " +
                             point_text(plate.upper_corner) +
                             " must exceed 'Plate/Lower corner' " +
                             point_text(plate.lower_corner) +
                             " by 1e-9 to 1e6 m in both "
                             "coordinates.");
        }
    }


    /// What is given on one side must not contradict itself.
    void
    check_side(const PlateScene &plate, const unsigned int side)
    {
      const Tensor<1, 2> traction     = traction_on(plate, side);
      const Tensor<1, 2> displacement = displacement_of(plate, side);
      const std::string &support      = plate.support[side];
      if (traction.norm() > 1e15)
        throw InputError(entry(side, "traction") + " is '" +
                         plate.traction[side] +
                         "' Pa; at most 1e15 Pa are allowed.");
      for (unsigned int d = 0; d < 2; ++d)
        if (holds(plate, side, d) && traction[d] != 0.)
          throw InputError(
              entry(side, "traction") + " is '" + plate.traction[side] +
              "' Pa, but " + entry(side, "support") + " is '" + support +
              "', which takes no traction along " + (d == 0 ? "x" : "y") +
              ": set that to 0, or the support to 'free'.");
      for (unsigned int d = 0; d < 2; ++d)
        if (displacement[d] != 0. &&
            (support == "clamp" || !holds(plate, side, d)))
          throw InputError(entry(side, "displacement") + " is '" +
                           plate.displacement[side] + "' m, but " +
                           entry(side, "support") + " is '" + support +
                           "': set that to 'displacement'.");
      const double size = (plate.upper_corner - plate.lower_corner).norm();
      if (displacement.norm() > size)
        throw InputError(entry(side, "displacement") + " is '" +
                         plate.displacement[side] +
                         "' m; at most the plate's diagonal, " +
                         number_text(size) + " m, is allowed.");
    }


    /// Where no support holds the plate, its tractions must be in balance.
    void
    check_balance(const PlateScene &plate)
    {
      const Tensor<1, 2> size = plate.upper_corner - plate.lower_corner;
      Tensor<1, 2>       force;
      double             moment = 0., largest = 0.;
      bool               held[2] = {false, false};
      for (unsigned int side = 0; side < 4; ++side)
        {
          const unsigned int normal = side < 2 ? 0 : 1;
          const Tensor<1, 2> f   = size[1 - normal] * traction_on(plate, side);
          const double       arm = (side % 2 == 0 ? -0.5 : 0.5) * size[normal];
          force += f;
          moment += arm * (normal == 0 ? f[1] : -f[0]);
          largest = std::max(largest, f.norm());
          for (unsigned int d = 0; d < 2; ++d)
            held[d] = held[d] || holds(plate, side, d);
        }
      for (unsigned int d = 0; d < 2; ++d)
        if (!held[d] && std::abs(force[d]) > 1e-9 * largest)
          throw InputError(
              std::string("Nothing holds the plate along ") +
              (d == 0 ? "x" : "y") + ", and its tractions leave a force of " +
              number_text(force[d]) +
              " N/m that way: put a 'Boundary' side on a 'clamp' or "
              "'roller', or load the opposite side, too.");
      if (!held[0] && !held[1] &&
          std::abs(moment) > 1e-9 * largest * size.norm())
        throw InputError("Nothing holds the plate, and its tractions would "
                         "turn it with a moment of " +
                         number_text(moment) +
                         " N: put a 'Boundary' side on a 'clamp' or 'roller', "
                         "or balance the tractions.");
    }


    /// Distance along the plate's boundary, counter-clockwise from its lower
    /// left corner, of the boundary point nearest to a point [m].
    double
    along_boundary(const PlateScene &plate, const Point<2> &p)
    {
      const Tensor<1, 2> size  = plate.upper_corner - plate.lower_corner;
      const Tensor<1, 2> x     = p - plate.lower_corner;
      const double distance[4] = {x[1], size[0] - x[0], size[1] - x[1], x[0]};
      const auto   side = std::min_element(distance, distance + 4) - distance;
      switch (side)
        {
          case 0:
            return x[0];
          case 1:
            return size[0] + x[1];
          case 2:
            return 2. * size[0] + size[1] - x[0];
          default:
            return 2. * (size[0] + size[1]) - x[1];
        }
    }


    /// The four corners in the same order, with their distances.
    std::vector<std::pair<double, Point<2>>>
    corners(const PlateScene &plate)
    {
      const Point<2>    &low = plate.lower_corner, &high = plate.upper_corner;
      const Tensor<1, 2> size = high - low;
      return {{0., low},
              {size[0], Point<2>(high[0], low[1])},
              {size[0] + size[1], high},
              {2. * size[0] + size[1], Point<2>(low[0], high[1])}};
    }


    /// The crack from mouth to mouth closed along the boundary.
    std::vector<Point<2>>
    part_beside(const PlateScene &plate, const Crack &crack)
    {
      std::vector<Point<2>> polygon = crack.get_vertices();
      const double          begin   = along_boundary(plate, polygon.back());
      const double          end     = along_boundary(plate, polygon.front());
      const double round = 2. * (plate.upper_corner[0] - plate.lower_corner[0] +
                                 plate.upper_corner[1] - plate.lower_corner[1]);
      const double length = std::fmod(end - begin + round, round);
      std::vector<std::pair<double, Point<2>>> passed;
      for (const auto &[s, corner] : corners(plate))
        {
          const double way = std::fmod(s - begin + round, round);
          if (way < length)
            passed.emplace_back(way, corner);
        }
      std::sort(passed.begin(), passed.end(), [](auto &a, auto &b) {
        return a.first < b.first;
      });
      for (const auto &[way, corner] : passed)
        polygon.push_back(corner);
      return polygon;
    }


    /// Whether a point lies in a polygon, by the number of edges above it.
    bool
    contains(const std::vector<Point<2>> &polygon, const Point<2> &p)
    {
      bool inside = false;
      for (unsigned int i = 0; i < polygon.size(); ++i)
        {
          const Point<2> &a = polygon[i];
          const Point<2> &b = polygon[(i + 1) % polygon.size()];
          if ((a[0] > p[0]) != (b[0] > p[0]) &&
              p[1] < a[1] + (p[0] - a[0]) / (b[0] - a[0]) * (b[1] - a[1]))
            inside = !inside;
        }
      return inside;
    }


    /// A part of the plate that cracks from boundary to boundary divide off.
    struct Part
    {
      Point<2> place; ///< on its boundary
      bool     held[2] = {false, false};
    };


    /// Cracks do not meet, so each of them alone divides the plate, and a
    /// part is told by the side of each crack that it lies on. Every part has
    /// stretches of the boundary, between corners and mouths.
    std::map<std::vector<bool>, Part>
    find_parts(const PlateScene &plate, const std::vector<Crack> &cracks)
    {
      const auto          corner = corners(plate);
      const Tensor<1, 2>  size   = plate.upper_corner - plate.lower_corner;
      const double        round  = 2. * (size[0] + size[1]);
      std::vector<double> stretches(1, round);
      for (const auto &[s, p] : corner)
        stretches.push_back(s);
      std::vector<std::vector<Point<2>>> beside;
      for (const Crack &crack : cracks)
        if (!crack.has_tip(0) && !crack.has_tip(1))
          {
            const Crack inside =
                crack.with_extended_mouths(-mouth_overhang(plate));
            beside.push_back(part_beside(plate, inside));
            stretches.push_back(
                along_boundary(plate, inside.get_vertices().front()));
            stretches.push_back(
                along_boundary(plate, inside.get_vertices().back()));
          }
      std::sort(stretches.begin(), stretches.end());

      std::map<std::vector<bool>, Part> parts;
      constexpr unsigned int            side_of_edge[4] = {2, 1, 3, 0};
      for (unsigned int i = 0; i + 1 < stretches.size(); ++i)
        {
          const double length = stretches[i + 1] - stretches[i];
          if (length < 1e-12 * round)
            continue;
          const double middle = stretches[i] + 0.5 * length;
          unsigned int edge   = 3;
          while (corner[edge].first > middle)
            --edge;
          const Point<2>     from  = corner[edge].second;
          const Tensor<1, 2> along = corner[(edge + 1) % 4].second - from;
          const Tensor<1, 2> unit  = along / along.norm();
          const Point<2>    place = from + (middle - corner[edge].first) * unit;
          std::vector<bool> key;
          for (const auto &polygon : beside)
            key.push_back(contains(
                polygon,
                place + 1e-6 * length * Tensor<1, 2>({-unit[1], unit[0]})));
          Part &part = parts[key];
          part.place = place;
          for (unsigned int d = 0; d < 2; ++d)
            part.held[d] = part.held[d] || holds(plate, side_of_edge[edge], d);
        }
      return parts;
    }


    /// Refuses parts that can move; pins hold a plate in one piece only.
    void
    check_parts(const PlateScene &plate, const std::vector<Crack> &cracks)
    {
      const auto parts = find_parts(plate, cracks);
      if (parts.size() < 2)
        return;
      for (const auto &[key, part] : parts)
        for (unsigned int d = 0; d < 2; ++d)
          if (!part.held[d])
            throw InputError(
                "'Cracks/Paths': the cracks cut the plate into " +
                std::to_string(parts.size()) +
                " parts, and nothing holds the one at " +
                point_text(part.place) + " along " + (d == 0 ? "x" : "y") +
                ": end a crack inside the plate, or put a side of that part "
                "on a 'clamp'.");
    }


    /// The tips after a growth must still lie inside, apart from the others.
    void
    check_growth(const PlateScene &plate, const std::vector<Crack> &cracks)
    {
      if (plate.energy_growth == 0.)
        return;
      held_quantity(plate);
      std::vector<Crack> grown;
      for (const Crack &crack : cracks)
        {
          for (const CrackTip &tip : crack.tips())
            if (2. * plate.energy_growth >= tip.segment)
              throw InputError(
                  "'Stress intensity/Energy growth' is " +
                  number_text(plate.energy_growth) +
                  " m; it must be below half the length of the crack's "
                  "segment at the tip " +
                  point_text(tip.position) + ", " +
                  number_text(0.5 * tip.segment) + " m.");
          grown.push_back(crack.with_moved_tips(2. * plate.energy_growth));
        }
      const auto refuse = [&](const std::string &why) {
        throw InputError("'Stress intensity/Energy growth' is " +
                         number_text(plate.energy_growth) +
                         " m: grown by twice that, a crack " + why +
                         "; choose less.");
      };
      for (const CrackTip &tip : collect_tips(grown))
        if (depth_inside(plate, tip.position) <= 0.)
          refuse("leaves the plate");
      for (unsigned int a = 0; a < grown.size(); ++a)
        for (unsigned int b = 0; b < a; ++b)
          if (grown[a].distance(grown[b]) == 0.)
            refuse("meets another one");
    }


    void
    check_wanted_results(const PlateScene         &plate,
                         const std::vector<Crack> &cracks)
    {
      const std::vector<CrackTip> tips = collect_tips(cracks);
      for (const CrackTip &tip : tips)
        check_ring_radius(
            tip, cracks, depth_inside(plate, tip.position), plate.ring_radius);
      for (const auto &[name, references] :
           {std::make_pair("Reference I", plate.reference_I),
            std::make_pair("Reference II", plate.reference_II)})
        {
          if (references.size() > tips.size())
            throw InputError(std::string("'Stress intensity/") + name +
                             "' has " + std::to_string(references.size()) +
                             " value(s), but the scene has " +
                             std::to_string(tips.size()) + " crack tip(s).");
          for (const double value : references)
            if (!(std::abs(value) < 1e30))
              throw InputError(std::string("'Stress intensity/") + name +
                               "' has " + number_text(value) +
                               " Pa sqrt(m); less than 1e30 is allowed.");
        }
      if (plate.formula == "none")
        return;
      const auto &first =
          cracks.empty() ? std::vector<Point<2>>() : cracks[0].get_vertices();
      if (first.size() != 2 || tips.empty() || tips[0].crack != 0 ||
          cracks[0].has_tip(0) || first[0][0] > plate.lower_corner[0] ||
          std::abs(first[0][1] - first[1][1]) >
              1e-9 * (first[1] - first[0]).norm())
        throw InputError("'Stress intensity/Formula' is '" + plate.formula +
                         "', which holds for a straight crack from the left "
                         "side along x; write the first of 'Cracks/Paths' "
                         "that way, or set it to 'none'.");
    }
  } // namespace


  void
  check(const PlateScene &plate)
  {
    check_size(plate);
    for (unsigned int side = 0; side < 4; ++side)
      check_side(plate, side);
    check_balance(plate);
    const std::vector<Crack> cracks = make_cracks(plate);
    check_parts(plate, cracks);
    check_growth(plate, cracks);
    observed_points(plate);
    check_wanted_results(plate, cracks);
  }
} // namespace Morsel::Fracture
