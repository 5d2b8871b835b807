#ifndef morsel_calibrate_outcome_h
#define morsel_calibrate_outcome_h

#include <morsel/calibrate/rounds.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace Morsel::Calibrate
{
  /// What a calibration has found so far.
  struct Outcome
  {
    std::vector<Round> rounds;
    bool               converged = false;

    /// The last round once converged, else that of the smallest error.
    /// @pre a round has been carried out
    const Round &
    best() const;
  };


  /// The catalogue's object "damage" with the values of a round.
  nlohmann::ordered_json
  catalogue_damage(const Problem &problem, const Round &round);


  /// The content of calibration.json.
  nlohmann::ordered_json
  calibration_json(const Problem &problem, const Outcome &outcome);


  /// "round 1: factor 1.16: compressive strength 101.2 kPa (-1.3 %)", for the
  /// log.
  std::string
  line_of(const Problem &problem, const Round &round);


  /// What was found, how well it is known, and what to write where.
  std::string
  conclusion(const Problem &problem, const Outcome &outcome);
} // namespace Morsel::Calibrate

#endif
