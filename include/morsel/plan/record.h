#ifndef morsel_plan_record_h
#define morsel_plan_record_h

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace Morsel::Plan
{
  /// What one size of a method came to.
  struct RecordedRun
  {
    double size  = 0.; ///< what the method's formulas call "size"
    double error = 0.; ///< relative [1], the largest over the problems
  };


  /// A way to set a scene: what stands as it is, and what follows from a size.
  struct Method
  {
    using Texts = std::vector<std::pair<std::string, std::string>>;

    std::string              name, title;
    std::string              size_label; ///< "cells per crack length"
    Texts                    entries;    ///< "Section/Key", value
    Texts                    formulas;   ///< "Section/Key", formula
    std::vector<RecordedRun> runs;
  };


  /// What methods reached in a study, a file of data/recorded.
  struct Record
  {
    std::string         file;
    std::string         kind; ///< of scenes: "cracked plate"
    std::string         title, study, error, truth;
    std::string         remark; ///< for the user; may be empty
    std::vector<Method> methods;
  };


  /// @param file its name, for messages
  /// @throws FileError if something is missing or no number
  Record
  read_record(const nlohmann::ordered_json &document, const std::string &file);


  /// The shipped records of a kind of scenes.
  /// @throws FileError
  std::vector<Record>
  shipped_records(const std::string &kind);
} // namespace Morsel::Plan

#endif
