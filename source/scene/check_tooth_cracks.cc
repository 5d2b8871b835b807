#include <morsel/scene/findings.h>

namespace Morsel::Scene
{
  void
  check_tooth_cracks(const PlateBody &body, Findings &findings)
  {
    const std::string section = "Body " + body.name + "/";
    if (body.cracks.paths.empty())
      {
        if (body.deformation.tip_refinements > 0)
          findings.advise(section + "Deformation/Tip refinements",
                          "it does nothing, since the body has no cracks: "
                          "name '" +
                              section + "Cracks/Paths'.");
        return;
      }
    if (body.deformation.response == "rigid")
      findings.mistake(section + "Deformation/Response",
                       "a rigid body has no stress and its cracks no K: take "
                       "'quasi-static', 'dynamic' or 'auto', or no '" +
                           section + "Cracks/Paths'.");
    if (!(body.deformation.fracture_toughness > 0.))
      findings.mistake(section + "Material/Fracture toughness",
                       "the body has cracks, and whether they grow depends on "
                       "K_Ic, in Pa sqrt(m): enamel about 1e6, dentine 2e6.");
  }
} // namespace Morsel::Scene
