#ifndef morsel_scene_conditions_h
#define morsel_scene_conditions_h

#include <morsel/scene/rectangle.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <string>

namespace Morsel::Scene
{
  /// A support, a load or a prescribed motion of a particle body.
  struct Condition
  {
    enum class Side
    {
      left,
      right,
      bottom,
      top,
      none
    };

    std::string name;
    std::string body; ///< the first particle body if empty
    std::string where = "right";
    std::string kind  = "traction";
    Rectangle   box; ///< where = box, or the part of a side; else empty
    std::string components = "x and y";
    std::string value      = "0; 0"; ///< of x, y (now) and t

    void
    declare(dealii::ParameterHandler &prm);

    /// The rectangle's side of that name.
    Side
    side() const;

    /// Whether it is on a side of the shape, whatever its name.
    bool
    on_side() const
    {
      return where != "box" && where != "everywhere";
    }

    bool
    has_box() const
    {
      return box.extent(0) > 0. && box.extent(1) > 0.;
    }

    /// Whether it prescribes motion rather than forces.
    bool
    prescribes_motion() const
    {
      return kind == "clamp" || kind == "roller" || kind == "velocity" ||
             kind == "displacement";
    }

    /// Traction that a value of it is on a side [Pa].
    /// @param normal unit vector out of the body
    dealii::Tensor<1, 2>
    traction(const dealii::Tensor<1, 2> &value,
             const dealii::Tensor<1, 2> &normal) const;

    /// Whether it prescribes the motion in direction @p d (0: x, 1: y).
    bool
    prescribes(unsigned int d) const;
  };


  /// A point of a particle body whose motion and stress are recorded.
  struct Observer
  {
    std::string      name;
    std::string      body; ///< the first particle body if empty
    dealii::Point<2> point;
    std::string      frequency = "none"; ///< of which displacement

    // Known answers, empty where there is none.
    std::string expected_displacement; ///< at the end [m]
    std::string expected_stress;       ///< at the end, xx, yy, xy [Pa]
    double      expected_frequency = 0.;

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Morsel::Scene

#endif
