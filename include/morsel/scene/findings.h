#ifndef morsel_scene_findings_h
#define morsel_scene_findings_h

#include <morsel/core/parameters.h>
#include <morsel/scene/scene.h>

#include <string>
#include <vector>

namespace Morsel::Scene
{
  /// What was found, with the entry that each finding is about.
  class Findings
  {
  public:
    Findings(const std::vector<ParameterEntry> &entries,
             const std::string                 &file_name)
        : entries(entries)
        , file_name(file_name)
    {}

    void
    mistake(const std::string &path, const std::string &text)
    {
      mistakes += (mistakes.empty() ? "" : "\n") + place(path) + text;
    }

    void
    advise(const std::string &path, const std::string &text)
    {
      advice.push_back(place(path) + text);
    }

    /// Whether an entry is fine as far as it is known, for checks that
    /// build upon others.
    bool
    clean() const
    {
      return mistakes.empty();
    }

    bool
    is_given(const std::string &path) const
    {
      return !last_place(entries, path).empty();
    }

    std::string              mistakes;
    std::vector<std::string> advice;

  private:
    std::string
    place(const std::string &path) const
    {
      const std::string where = last_place(entries, path);
      return where.empty() ? file_name + ": '" + path + "' (not given): "
                           : where + ": '" + path + "' = '" +
                                 last_value(entries, path, "") + "': ";
    }

    const std::vector<ParameterEntry> &entries;
    const std::string                 &file_name;
  };


  /// Checks that shapes are sound, inside of the domain and apart.
  void
  check_geometry(const Scene &scene, Findings &findings);


  /// Checks how a plate that deforms is made, held and moved.
  void
  check_elastic(const PlateBody &body, const Scene &scene, Findings &findings);


  /// Checks what the cracks of a plate need: a body that deforms, and a
  /// toughness.
  void
  check_tooth_cracks(const PlateBody &body, Findings &findings);


  /// Checks what moves the plates, the jaw and its muscles, and which plates
  /// may meet.
  void
  check_drives(const Scene &scene, Findings &findings);


  /// Checks that a body has particles enough, not too many, and rows that fit.
  void
  check_particles(const ParticleBody &body,
                  const Scene        &scene,
                  Findings           &findings);


  /// Checks how a body fails: numerics that can break, flaws and softening that
  /// the spacing resolves.
  void
  check_damage(const ParticleBody &body,
               const Scene        &scene,
               Findings           &findings);


  /// Checks that formulation, normalisation, kernel and corrections of a
  /// body go together.
  void
  check_formulation(const ParticleBody &body,
                    const Scene        &scene,
                    Findings           &findings);


  /// Checks that what a static solution cannot do is not asked for, nor of
  /// transients what they cannot.
  void
  check_solution(const Scene &scene, Findings &findings);


  /// Checks that inertia is no part of what a scene with scaled mass asks for.
  void
  check_mass_scaling(const Scene &scene, Findings &findings);


  /// Checks supports, loads, observers and fields of velocity.
  void
  check_conditions(const Scene &scene, Findings &findings);


  /// Overlap of two rectangles: the smaller of their common extents [m],
  /// negative where there is a gap.
  double
  overlap(const Rectangle &a, const Rectangle &b);

  /// Between food and a plate: that of their boxes if both are rectangles,
  /// else that of their outlines, negative where they overlap [m].
  double
  gap_between(const ParticleBody &food, const PlateBody &plate);
} // namespace Morsel::Scene

#endif
