#include <morsel/core/errors.h>
#include <morsel/fracture/plate_scene.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Morsel::Fracture
{
  using namespace dealii;

  namespace
  {
    constexpr std::array<const char *, 4> side_names = {
        {"Left", "Right", "Bottom", "Top"}};


    std::string
    text(const Point<2> &p)
    {
      std::ostringstream out;
      out << '(' << p[0] << ", " << p[1] << ") m";
      return out.str();
    }


    /// Distance inside the plate (negative outside) [m].
    double
    depth_inside(const PlateScene &plate, const Point<2> &p)
    {
      return std::min({p[0] - plate.lower_corner[0],
                       plate.upper_corner[0] - p[0],
                       p[1] - plate.lower_corner[1],
                       plate.upper_corner[1] - p[1]});
    }


    std::vector<std::vector<Point<2>>>
    read_paths(const PlateScene &plate)
    {
      std::vector<std::vector<Point<2>>> paths;
      if (plate.crack_form == "inclined")
        {
          const double       angle = plate.angle * numbers::PI / 180.;
          const Tensor<1, 2> half({plate.half_length * std::cos(angle),
                                   plate.half_length * std::sin(angle)});
          const Point<2>     centre = read_pair(plate.centre, "Cracks/Centre");
          paths.push_back({centre - half, centre + half});
          return paths;
        }
      for (const std::string &path :
           Utilities::split_string_list(plate.paths, ';'))
        {
          if (path.empty())
            continue;
          paths.emplace_back();
          for (const std::string &point :
               Utilities::split_string_list(path, '>'))
            paths.back().push_back(read_pair(point, "Cracks/Paths"));
        }
      return paths;
    }


    /// Whether a crack from mouth to mouth leaves a part of the plate that
    /// touches no support.
    bool
    cuts_off(const PlateScene &plate, const Crack &crack)
    {
      if (crack.has_tip(0) || crack.has_tip(1))
        return false;
      // Points along each side, supported ones remembered by side of crack.
      bool held[2] = {false, false}, present[2] = {false, false};
      for (unsigned int side = 0; side < 4; ++side)
        for (unsigned int i = 1; i < 1000; ++i)
          {
            const double       t    = i / 1000.;
            Point<2>           p    = plate.lower_corner;
            const Tensor<1, 2> size = plate.upper_corner - plate.lower_corner;
            p[side < 2 ? 0 : 1] += side % 2 == 0 ? 0. : size[side < 2 ? 0 : 1];
            p[side < 2 ? 1 : 0] += t * size[side < 2 ? 1 : 0];
            const unsigned int k = crack.signed_distance(p) > 0. ? 0 : 1;
            present[k]           = true;
            held[k]              = held[k] || plate.support[side] != "free";
          }
      return (present[0] && !held[0]) || (present[1] && !held[1]);
    }
  } // namespace


  Point<2>
  read_pair(const std::string &pair, const std::string &entry)
  {
    const auto parts = Utilities::split_string_list(pair, ',');
    try
      {
        if (parts.size() == 2)
          return Point<2>(Utilities::string_to_double(parts[0]),
                          Utilities::string_to_double(parts[1]));
      }
    catch (const dealii::ExceptionBase &)
      {
        // The sentence below serves for this mistake, too.
      }
    throw InputError("'" + entry + "' has '" + pair +
                     "' where two numbers 'x, y' are needed.");
  }


  std::vector<Crack>
  make_cracks(const PlateScene &plate)
  {
    const double       size = (plate.upper_corner - plate.lower_corner).norm();
    const double       tolerance = 1e-9 * size;
    std::vector<Crack> cracks;
    for (const std::vector<Point<2>> &path : read_paths(plate))
      {
        if (path.size() < 2)
          throw InputError("'Cracks/Paths': a crack needs at least two points "
                           "'x, y > x, y'.");
        for (unsigned int i = 0; i < path.size(); ++i)
          {
            const bool   end   = i == 0 || i + 1 == path.size();
            const double depth = depth_inside(plate, path[i]);
            if (depth < (end ? -tolerance : tolerance))
              throw InputError("The crack's point " + text(path[i]) +
                               " lies outside the plate from " +
                               text(plate.lower_corner) + " to " +
                               text(plate.upper_corner) + ".");
          }
        const bool  tip_first = depth_inside(plate, path.front()) > tolerance;
        const bool  tip_last  = depth_inside(plate, path.back()) > tolerance;
        const Crack crack(path, tip_first, tip_last);
        if (path.size() == 2 && !tip_first && !tip_last &&
            depth_inside(plate, path[0] + 0.5 * (path[1] - path[0])) <=
                tolerance)
          throw InputError("The crack from " + text(path[0]) + " to " +
                           text(path[1]) + " runs along the plate's boundary.");
        if (cuts_off(plate, crack))
          throw InputError("The crack from " + text(path.front()) + " to " +
                           text(path.back()) +
                           " cuts the plate in two, and nothing holds one of "
                           "the parts: end the crack inside the plate or "
                           "support both parts.");
        for (unsigned int c = 0; c < cracks.size(); ++c)
          if (cracks[c].distance(crack) <= tolerance)
            throw InputError("Cracks " + std::to_string(c) + " and " +
                             std::to_string(cracks.size()) +
                             " touch or cross each other; they must stay "
                             "apart.");
        cracks.push_back(crack.with_extended_mouths(0.01 * size));
      }
    return cracks;
  }


  void
  check(const PlateScene &plate)
  {
    const Tensor<1, 2> size = plate.upper_corner - plate.lower_corner;
    if (size[0] <= 0. || size[1] <= 0.)
      throw InputError("'Plate/Upper corner' must exceed 'Plate/Lower corner' "
                       "in both coordinates.");
    if (std::all_of(plate.support.begin(), plate.support.end(), [](auto &s) {
          return s == "free";
        }))
      {
        Tensor<1, 2> force;
        for (unsigned int side = 0; side < 4; ++side)
          force += size[side < 2 ? 1 : 0] *
                   read_pair(plate.traction[side], "Boundary/traction");
        double total = 0.;
        for (unsigned int side = 0; side < 4; ++side)
          total += size[side < 2 ? 1 : 0] *
                   read_pair(plate.traction[side], "Boundary/traction").norm();
        if (force.norm() > 1e-9 * total)
          throw InputError("Nothing holds the plate, and its tractions are not "
                           "in balance: clamp a side, put it on rollers, or "
                           "load the opposite side, too.");
      }
    make_cracks(plate);
  }


  void
  PlateScene::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Name", name, "Name of the scene; its file's if empty.");
    prm.add_parameter("Title", title, "What the scene shows.");
    prm.add_parameter("Method",
                      method,
                      "A cracked plate by extended finite elements ('XFEM') or "
                      "by total Lagrangian particles ('SPH'); only the "
                      "method's own section is used.",
                      Patterns::Selection("XFEM|SPH"));

    prm.enter_subsection("Plate");
    prm.add_parameter("Lower corner", lower_corner, "x, y [m].");
    prm.add_parameter("Upper corner", upper_corner, "x, y [m].");
    prm.leave_subsection();

    prm.enter_subsection("Material");
    prm.add_parameter(
        "Young's modulus", youngs_modulus, "[Pa].", Patterns::Double(1e-3));
    prm.add_parameter(
        "Poisson's ratio", poissons_ratio, "[1].", Patterns::Double(0., 0.499));
    prm.add_parameter(
        "Plane stress", plane_stress, "A thin plate instead of plane strain.");
    prm.leave_subsection();

    prm.enter_subsection("Cracks");
    prm.add_parameter("Form",
                      crack_form,
                      "'paths': as in Paths; 'inclined': one straight crack "
                      "by centre, half length and angle.",
                      Patterns::Selection("paths|inclined"));
    prm.add_parameter("Paths",
                      paths,
                      "Cracks as 'x, y > x, y > ...; x, y > ...' [m]; an end "
                      "on the plate's boundary is a mouth, any other a tip.");
    prm.add_parameter("Centre", centre, "Of the inclined crack: x, y [m].");
    prm.add_parameter("Half length",
                      half_length,
                      "Of the inclined crack [m].",
                      Patterns::Double(0.));
    prm.add_parameter("Angle",
                      angle,
                      "Of the inclined crack, from the x axis [degrees].",
                      Patterns::Double(-180., 180.));
    prm.leave_subsection();

    prm.enter_subsection("Boundary");
    for (unsigned int side = 0; side < 4; ++side)
      {
        prm.add_parameter(std::string(side_names[side]) + " support",
                          support[side],
                          "'clamp': no displacement; 'roller': none normal to "
                          "the side; 'free'. Rigid motions that no support "
                          "holds are held by pins in the right corners.",
                          Patterns::Selection("free|clamp|roller"));
        prm.add_parameter(std::string(side_names[side]) + " traction",
                          traction[side],
                          "x, y [Pa].");
      }
    prm.leave_subsection();

    prm.enter_subsection("Stress intensity");
    prm.add_parameter("Ring radius",
                      ring_radius,
                      "Outer radius of the largest ring [m]; 0: the largest "
                      "that fits.",
                      Patterns::Double(0.));
    prm.add_parameter("Energy growth",
                      energy_growth,
                      "Growth da of the energy route T3-47 [m]; 0: off. Its "
                      "bias falls with da, noise grows with 1/da.",
                      Patterns::Double(0.));
    prm.add_parameter("Formula",
                      formula,
                      "Handbook formula to compare with.",
                      Patterns::Selection("none|edge crack in tension"));
    prm.add_parameter("Reference I",
                      reference_I,
                      "K_I expected at the first tip [Pa sqrt(m)]; 0: none.");
    prm.add_parameter("Reference II",
                      reference_II,
                      "K_II expected at the first tip [Pa sqrt(m)]; 0: none.");
    prm.leave_subsection();
  }


  double
  formula_stress_intensity(const PlateScene         &plate,
                           const std::vector<Crack> &cracks)
  {
    if (plate.formula == "none" || cracks.empty() || cracks[0].tips().empty())
      return 0.;
    const Point<2> tip = cracks[0].tips()[0].position;
    const double   a   = tip[0] - plate.lower_corner[0];
    const double   x   = a / (plate.upper_corner[0] - plate.lower_corner[0]);
    const double   stress =
        read_pair(plate.traction[3], "Boundary/Top traction")[1];
    const double Y =
        1.12 + x * (-0.23 + x * (10.56 + x * (-21.74 + x * 30.42)));
    return stress * std::sqrt(numbers::PI * a) * Y;
  }
} // namespace Morsel::Fracture
