#include <morsel/core/kernel.h>
#include <morsel/core/suggestions.h>
#include <morsel/materials/damage.h>
#include <morsel/scene/findings.h>

#include <cmath>

namespace Morsel::Scene
{
  namespace
  {
    void
    check_numerics(const ParticleBody &body, Findings &findings)
    {
      const std::string section = "Body " + body.name + "/Solid/";
      if (body.solid.is_updated())
        findings.mistake(section + "Formulation",
                         "a solid that can fail (Damage/Enabled) is computed "
                         "in the total Lagrangian form: damage and broken "
                         "bonds belong to reference pairs.");
      if (body.normalisation() != "gradient matrix" &&
          body.normalisation() != "conforming")
        findings.mistake(section + "Normalisation",
                         "a solid that can fail takes the gradient matrix or "
                         "the conforming gradient, which are renewed when "
                         "bonds break.");
      const KernelKind kind = kernel_named(body.solid.kernel);
      if (kind != KernelKind::cubic_b_spline && kind != KernelKind::wendland_c2)
        findings.mistake(section + "Kernel",
                         "a solid that can fail takes 'cubic B-spline' or "
                         "'Wendland C2': failed food has no other.");
    }


    /// Of softening with a fracture energy.
    void
    check_fracture_energy(const ParticleBody &body,
                          const Scene        &scene,
                          Findings           &findings)
    {
      const auto       &material = body.material;
      const std::string path = "Body " + body.name + "/Damage/Fracture energy";
      if (body.damage.growth == "Grady-Kipp")
        {
          findings.mistake(path,
                           "Grady-Kipp growth has no fracture energy of its "
                           "own; give 0 or take 'Growth' = 'linear "
                           "softening'.");
          return;
        }
      if (!(material.youngs_modulus > 0. && material.density > 0. &&
            material.compressive_strength > 0. && body.spacing > 0. &&
            material.poissons_ratio >= 0. && material.poissons_ratio < 0.5))
        return;
      const Materials::DamageLaw law(
          body.damage,
          {material.youngs_modulus, material.poissons_ratio, material.density},
          material.compressive_strength,
          {body.spacing * body.spacing * scene.depth, body.spacing});
      const double      range = law.range_at(law.threshold_scale);
      const double      r0    = law.threshold_scale;
      const std::string limit =
          "at most " +
          number_text(body.spacing * law.end_times_threshold /
                      (r0 * r0 * law.least_range)) +
          " m between particles ('Particles across' = " +
          number_text(
              std::ceil(body.shape.extent(0) * law.least_range * r0 * r0 /
                        (body.spacing * law.end_times_threshold))) +
          ")";
      const std::string now = "with " + number_text(body.spacing) +
                              " m between particles a crack of this energy ";
      if (range <= law.least_range)
        findings.mistake(path,
                         now +
                             "would have to take less than a particle stores "
                             "at its strength; give " +
                             limit + ", or more energy.");
      else if (range < 1.5)
        findings.advise(path,
                        now + "fails within " + number_text(range) +
                            " times the threshold: the strongest particles "
                            "take more than this energy.");
    }
  } // namespace


  void
  check_damage(const ParticleBody &body, const Scene &scene, Findings &findings)
  {
    check_numerics(body, findings);
    const std::string section = "Body " + body.name + "/Damage/";
    // 0 has been filled, so what is too small now was given.
    if (body.damage.weibull_modulus < 1.)
      findings.mistake(section + "Weibull modulus",
                       "it must be at least 1; 0 takes the catalogue's.");
    if (body.damage.strength_ratio < 1.)
      findings.mistake(section + "Strength ratio",
                       "it must be at least 1; 0 takes the catalogue's.");
    if (body.damage.fracture_energy < 0.)
      findings.mistake(section + "Fracture energy",
                       "it must not be negative; 0 lets the softening range "
                       "decide, -1 takes the catalogue's.");
    if (body.damage.flaws == "correlated" &&
        !(body.damage.correlation_length > 0.))
      findings.mistake(section + "Correlation length",
                       "it must be positive, in m; for thresholds independent "
                       "of each other take 'Flaws' = 'Weibull'.");
    else if (body.damage.flaws == "correlated" &&
             body.damage.correlation_length < 2. * body.spacing)
      findings.advise(section + "Correlation length",
                      "with " + number_text(body.spacing) +
                          " m between particles the field of thresholds is not "
                          "resolved: give the length at least two spacings, or "
                          "more particles.");
    if (body.damage.fracture_energy > 0.)
      check_fracture_energy(body, scene, findings);
  }
} // namespace Morsel::Scene
