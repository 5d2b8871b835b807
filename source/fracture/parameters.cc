#include <morsel/fracture/parameters.h>

#include <deal.II/base/patterns.h>

namespace Morsel::Fracture
{
  namespace Patterns = dealii::Patterns;

  void
  CrackPaths::declare(dealii::ParameterHandler &prm, const std::string &meaning)
  {
    prm.add_parameter("Paths",
                      paths,
                      "Cracks of the body as 'x, y > x, y > ...; x, y > ...' "
                      "[m]; an end on its boundary is a mouth, any other a "
                      "tip. " +
                          meaning + " None if empty.");
    prm.add_parameter("Ring radius",
                      ring_radius,
                      "Outer radius of the largest ring of the interaction "
                      "integral about a tip [m]; 0: the largest that fits.",
                      Patterns::Double(0.));
  }


  void
  BodyCracks::declare(dealii::ParameterHandler &prm)
  {
    CrackPaths::declare(prm,
                        "Particles that do not see each other past a crack do "
                        "not interact.");
    prm.add_parameter("Expected I",
                      expected_I,
                      "K_I expected at each tip at the end, in their order "
                      "[Pa sqrt(m)]; 0: none.",
                      Patterns::List(Patterns::Double()));
    prm.add_parameter("Expected II",
                      expected_II,
                      "K_II expected at each tip at the end, in their order "
                      "[Pa sqrt(m)]; 0: none.",
                      Patterns::List(Patterns::Double()));
  }
} // namespace Morsel::Fracture
