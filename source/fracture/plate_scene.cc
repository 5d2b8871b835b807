#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/fracture/crack_paths.h>
#include <morsel/fracture/plate_scene.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Morsel::Fracture
{
  using namespace dealii;

  const std::array<const char *, 4> side_names = {
      {"Left", "Right", "Bottom", "Top"}};


  namespace
  {
    CrackedFrame
    plate_frame(const PlateScene &plate)
    {
      return {"plate", plate.lower_corner, plate.upper_corner};
    }


    std::vector<std::vector<Point<2>>>
    paths_of(const PlateScene &plate)
    {
      if (plate.crack_form != "inclined")
        return read_crack_paths(plate.paths, "Cracks/Paths");
      const double       angle = plate.angle * numbers::PI / 180.;
      const Tensor<1, 2> half({plate.half_length * std::cos(angle),
                               plate.half_length * std::sin(angle)});
      const Point<2>     centre = read_pair(plate.centre, "Cracks/Centre");
      if (!(half.norm() > 1e-9 * plate_frame(plate).size()))
        throw InputError("The crack at " + point_text(centre) +
                         " has no length; give a 'Cracks/Half length' "
                         "above 0 (it is " +
                         number_text(plate.half_length) + " m).");
      return {{centre - half, centre + half}};
    }


    /// Section "Cracks".
    void
    declare_cracks(PlateScene &plate, ParameterHandler &prm)
    {
      prm.enter_subsection("Cracks");
      prm.add_parameter("Form",
                        plate.crack_form,
                        "'paths': as in Paths; 'inclined': one straight crack "
                        "by centre, half length and angle.",
                        Patterns::Selection("paths|inclined"));
      prm.add_parameter("Paths",
                        plate.paths,
                        "Cracks as 'x, y > x, y > ...; x, y > ...' [m]; an end "
                        "on the plate's boundary is a mouth, any other a tip. "
                        "Without any the plate is whole.");
      prm.add_parameter(
          "Centre", plate.centre, "Of the inclined crack: x, y [m].");
      prm.add_parameter("Half length",
                        plate.half_length,
                        "Of the inclined crack [m].",
                        Patterns::Double(0.));
      prm.add_parameter("Angle",
                        plate.angle,
                        "Of the inclined crack, from the x axis [degrees].",
                        Patterns::Double(-180., 180.));
      prm.leave_subsection();
    }


    /// Section "Boundary".
    void
    declare_boundary(PlateScene &plate, ParameterHandler &prm)
    {
      prm.enter_subsection("Boundary");
      for (unsigned int side = 0; side < 4; ++side)
        {
          prm.add_parameter(
              std::string(side_names[side]) + " support",
              plate.support[side],
              "'clamp': no displacement; 'roller': none normal to "
              "the side, or the one given below, and free along it; "
              "'displacement': the one given below; "
              "'free'. Rigid motions that no support holds are "
              "held by pins in the right corners.",
              Patterns::Selection("free|clamp|roller|displacement"));
          prm.add_parameter(std::string(side_names[side]) + " traction",
                            plate.traction[side],
                            "x, y [Pa].");
          prm.add_parameter(std::string(side_names[side]) + " displacement",
                            plate.displacement[side],
                            "x, y of a side whose support is 'displacement', "
                            "or that across a 'roller' [m].");
        }
      prm.leave_subsection();
    }


    /// Section "Stress intensity".
    void
    declare_stress_intensity(PlateScene &plate, ParameterHandler &prm)
    {
      prm.enter_subsection("Stress intensity");
      prm.add_parameter("Ring radius",
                        plate.ring_radius,
                        "Outer radius of the largest ring [m]; 0: the largest "
                        "that fits.",
                        Patterns::Double(0.));
      prm.add_parameter("Energy growth",
                        plate.energy_growth,
                        "Growth da of the energy route T3-47 [m]; 0: off. Its "
                        "bias falls with da, noise grows with 1/da.",
                        Patterns::Double(0.));
      prm.add_parameter("Two directions",
                        plate.two_directions,
                        "K_I and K_II by the thesis's mixed-mode recipe T3-15 "
                        "from the two components of the J vector, too.");
      prm.add_parameter("Formula",
                        plate.formula,
                        "Handbook formula to compare with: 'edge crack in "
                        "tension' (T3-48) for a straight crack from the left "
                        "side along x.",
                        Patterns::Selection("none|edge crack in tension"));
      prm.add_parameter(
          "Reference I",
          plate.reference_I,
          "K_I expected at each tip, in their order, separated by "
          "commas [Pa sqrt(m)]; 0: none.",
          Patterns::List(Patterns::Double()));
      prm.add_parameter(
          "Reference II",
          plate.reference_II,
          "K_II expected at each tip, in their order, separated by "
          "commas [Pa sqrt(m)]; 0: none.",
          Patterns::List(Patterns::Double()));
      prm.leave_subsection();
    }
  } // namespace


  double
  depth_inside(const PlateScene &plate, const Point<2> &p)
  {
    return plate_frame(plate).depth_inside(p);
  }


  Tensor<1, 2>
  traction_on(const PlateScene &plate, const unsigned int side)
  {
    return read_pair(plate.traction[side],
                     std::string("Boundary/") + side_names[side] + " traction");
  }


  Tensor<1, 2>
  displacement_of(const PlateScene &plate, const unsigned int side)
  {
    return read_pair(plate.displacement[side],
                     std::string("Boundary/") + side_names[side] +
                         " displacement");
  }


  std::vector<ObservedPoint>
  observed_points(const PlateScene &plate)
  {
    const std::string          entry = "Plate/Observed points";
    std::vector<ObservedPoint> points;
    for (const std::string &item :
         Utilities::split_string_list(plate.observed_points, ';'))
      {
        const std::size_t colon = item.find(':');
        const std::string name  = trimmed(item.substr(0, colon));
        if (colon == std::string::npos || name.empty() ||
            !std::all_of(name.begin(), name.end(), [](unsigned char c) {
              return std::isalnum(c) != 0 || c == '_';
            }))
          throw InputError("'" + entry + "' has '" + trimmed(item) +
                           "' where 'name: x, y' is needed, the name of "
                           "letters, digits and '_'.");
        for (const ObservedPoint &other : points)
          if (other.name == name)
            throw InputError("'" + entry + "' has two points '" + name +
                             "'; give each a name of its own.");
        const Point<2> place = read_pair(item.substr(colon + 1), entry);
        if (depth_inside(plate, place) < 0.)
          throw InputError("'" + entry + "': the point '" + name + "' at " +
                           point_text(place) + " lies outside the plate.");
        points.push_back({name, place});
      }
    return points;
  }


  HeldQuantity
  held_quantity(const PlateScene &plate)
  {
    bool traction = false, displacement = false;
    for (unsigned int side = 0; side < 4; ++side)
      {
        traction     = traction || traction_on(plate, side).norm() > 0.;
        displacement = displacement || displacement_of(plate, side).norm() > 0.;
      }
    if (traction && displacement)
      throw InputError(
          "'Stress intensity/Energy growth' is set, but both tractions and "
          "displacements load the plate: the energy difference T3-47 holds "
          "for one of them; set it to 0 or use one kind of load.");
    return displacement ? HeldQuantity::displacement : HeldQuantity::traction;
  }


  double
  mouth_overhang(const PlateScene &plate)
  {
    return plate_frame(plate).mouth_overhang();
  }


  std::vector<Crack>
  make_cracks(const PlateScene &plate)
  {
    return cracks_in(plate_frame(plate), paths_of(plate), "Cracks/Paths");
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
    prm.add_parameter("Observed points",
                      observed_points,
                      "Places whose displacement and stress the summary tells, "
                      "as 'name: x, y; ...' [m].");
    prm.leave_subsection();

    prm.enter_subsection("Material");
    prm.add_parameter(
        "Young's modulus", youngs_modulus, "[Pa].", Patterns::Double(1., 1e15));
    prm.add_parameter(
        "Poisson's ratio", poissons_ratio, "[1].", Patterns::Double(0., 0.499));
    prm.add_parameter(
        "Plane stress", plane_stress, "A thin plate instead of plane strain.");
    prm.leave_subsection();

    declare_cracks(*this, prm);
    declare_boundary(*this, prm);
    declare_stress_intensity(*this, prm);
  }


  double
  formula_stress_intensity(const PlateScene         &plate,
                           const std::vector<Crack> &cracks)
  {
    if (plate.formula == "none" || cracks.empty() || cracks[0].tips().empty())
      return 0.;
    const Point<2> tip    = cracks[0].tips()[0].position;
    const double   a      = tip[0] - plate.lower_corner[0];
    const double   x      = a / (plate.upper_corner[0] - plate.lower_corner[0]);
    const double   stress = traction_on(plate, 3)[1];
    const double   Y =
        1.12 + x * (-0.23 + x * (10.56 + x * (-21.74 + x * 30.42)));
    return stress * std::sqrt(numbers::PI * a) * Y;
  }
} // namespace Morsel::Fracture
