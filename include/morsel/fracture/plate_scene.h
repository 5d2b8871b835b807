#ifndef morsel_fracture_plate_scene_h
#define morsel_fracture_plate_scene_h

#include <morsel/fracture/crack_paths.h>
#include <morsel/fracture/energy_release.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace Morsel::Fracture
{
  /// A cracked plate under static load, whatever method computes it.
  struct PlateScene
  {
    std::string name;
    std::string title;
    std::string method = "XFEM";

    dealii::Point<2> lower_corner;
    dealii::Point<2> upper_corner{0.01, 0.01}; ///< [m]

    std::string observed_points; ///< "name: x, y; ..."

    double youngs_modulus = 1e7; ///< [Pa]
    double poissons_ratio = 0.3;
    bool   plane_stress   = false;

    std::string crack_form = "paths"; ///< or "inclined"
    std::string paths;                ///< "x, y > x, y; ..."
    std::string centre      = "0.005, 0.005";
    double      half_length = 5e-4; ///< [m]
    double      angle       = 0.;   ///< from the x axis [degrees]

    /// By side: left, right, bottom, top.
    std::array<std::string, 4> support{{"free", "free", "free", "free"}};
    std::array<std::string, 4> traction{{"0, 0", "0, 0", "0, 0", "0, 0"}};
    std::array<std::string, 4> displacement{{"0, 0", "0, 0", "0, 0", "0, 0"}};

    double      ring_radius    = 0.; ///< [m], 0: the largest that fits
    double      energy_growth  = 0.; ///< [m], 0: no energy route
    bool        two_directions = false;
    std::string formula        = "none";
    /// By tip [Pa sqrt(m)], 0: none.
    std::vector<double> reference_I, reference_II;

    /// Binds all members to entries.
    void
    declare(dealii::ParameterHandler &prm);
  };


  /// The cracks of the parameters: an end on the plate's boundary is a mouth,
  /// any other a tip. Mouths are carried on beyond the boundary.
  /// @throws InputError for a crack outside the plate or along its boundary,
  ///   of no length, or crossing another one or itself
  std::vector<Crack>
  make_cracks(const PlateScene &parameters);


  /// How far make_cracks() carries mouths on beyond the boundary, so that
  /// cracks cut the outermost cells through [m].
  double
  mouth_overhang(const PlateScene &parameters);


  /// Checks what no single entry shows.
  /// @throws InputError, one sentence
  void
  check(const PlateScene &parameters);


  /// The load on one side of the plate [Pa], or what it is moved by [m].
  dealii::Tensor<1, 2>
  traction_on(const PlateScene &parameters, const unsigned int side);
  dealii::Tensor<1, 2>
  displacement_of(const PlateScene &parameters, const unsigned int side);


  /// A place whose displacement and stress are told.
  struct ObservedPoint
  {
    std::string      name;
    dealii::Point<2> place; ///< [m]
  };

  /// Those of "Plate/Observed points".
  /// @throws InputError for anything else than 'name: x, y; ...', a name with
  ///   other characters than letters, digits and '_', given twice, or a place
  ///   outside of the plate
  std::vector<ObservedPoint>
  observed_points(const PlateScene &parameters);


  /// Whether tractions load the plate, or displacements of its sides do,
  /// which decides the sign of T3-47.
  /// @throws InputError if both do
  HeldQuantity
  held_quantity(const PlateScene &parameters);


  /// Distance inside the plate, negative outside [m].
  double
  depth_inside(const PlateScene &plate, const dealii::Point<2> &p);


  /// "Left", "Right", "Bottom", "Top".
  extern const std::array<const char *, 4> side_names;


  /// K_I of the formula named [Pa sqrt(m)], 0 for "none". "edge crack in
  /// tension" is T3-48, sigma sqrt(pi a) Y(a/W).
  double
  formula_stress_intensity(const PlateScene         &parameters,
                           const std::vector<Crack> &cracks);
} // namespace Morsel::Fracture

#endif
