#ifndef morsel_output_summary_h
#define morsel_output_summary_h

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace Morsel::Output
{
  /// One effect that a scene may call for, and what it cost.
  struct Effect
  {
    std::string name; ///< for people: "hourglass control"
    bool        on = false;
    std::string reason; ///< who asked for it
    /// The part of the run that takes its time, see Summary::add_part().
    std::string part = {};
    /// Whether that part does nothing else, so that its time is known.
    bool fills_part = false;
    /// What comes out without it, of a study that is named; or nothing.
    std::string without   = {};
    double      wall_time = 0.; ///< [s], where it is known
    double      share     = 0.; ///< of the loop's wall time [1]
  };


  /// A line for each: on or off, and who asked for it.
  std::string
  effects_as_text(const std::vector<Effect> &effects);


  /// What a run found, for summary.json. Keys keep their order of insertion.
  ///
  /// Each scalar result stands at the top level under its snake_case name as
  /// {"value", "unit", "meaning"}, with "reference" and "error" where a
  /// reference is known. Beside them stand the reserved keys "effects" (a list
  /// of {"name", "on", "reason", "wall_time", "share"} with "part" and
  /// "without" where they are known), "parts" (wall time of the run's parts,
  /// {"name", "wall_time"}) and "text" (name: text; versions, hashes, the
  /// scene's title).
  class Summary
  {
  public:
    /// Adds a scalar result; a name given again replaces the former value.
    ///
    /// @param name snake_case (letters, digits, underscores; may hold capitals
    ///   after the first letter, as in stress_intensity_I).
    /// @param reference the value expected, in the same unit.
    /// @param error relative to the reference, dimensionless; if omitted it is
    ///   (value - reference) / |reference|.
    /// @throws NumericalError if a number is not finite.
    void
    add(const std::string          &name,
        double                      value,
        const std::string          &unit,
        const std::string          &meaning,
        const std::optional<double> reference = std::nullopt,
        const std::optional<double> error     = std::nullopt);

    /// Adds a text, such as a version or a hash.
    void
    add_text(const std::string &name, const std::string &text);

    void
    add_effect(const Effect &effect);

    /// Adds the wall time [s] of one part of the run.
    void
    add_part(const std::string &name, double wall_time);

    /// Whether a scalar result of that name was added.
    bool
    has(const std::string &name) const;

    /// The value of a result that was added.
    double
    value(const std::string &name) const;

    /// The document as it will be written.
    nlohmann::ordered_json
    json() const;

    /// Writes the document, atomically.
    ///
    /// @throws FileError with the file's name.
    void
    write(const std::string &file_name) const;

  private:
    nlohmann::ordered_json results = nlohmann::ordered_json::object();
    nlohmann::ordered_json effects = nlohmann::ordered_json::array();
    nlohmann::ordered_json parts   = nlohmann::ordered_json::array();
    nlohmann::ordered_json texts   = nlohmann::ordered_json::object();
  };
} // namespace Morsel::Output

#endif
