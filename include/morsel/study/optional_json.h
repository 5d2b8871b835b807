#ifndef morsel_study_optional_json_h
#define morsel_study_optional_json_h

#include <nlohmann/json.hpp>

#include <optional>

namespace Morsel::Study
{
  /// The number, or null.
  inline nlohmann::ordered_json
  json_of(const std::optional<double> &value)
  {
    return value ? nlohmann::ordered_json(*value)
                 : nlohmann::ordered_json(nullptr);
  }
} // namespace Morsel::Study

#endif
