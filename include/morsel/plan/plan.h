#ifndef morsel_plan_plan_h
#define morsel_plan_plan_h

#include <morsel/plan/record.h>
#include <morsel/plan/scene_sizes.h>
#include <morsel/prediction.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace Morsel::Plan
{
  /// What one method would take for a scene.
  struct Proposal
  {
    std::string title;
    std::string resolution; ///< in words
    /// Whether the record reaches the accuracy and the scene takes the setting.
    bool                     possible = false;
    std::string              obstacle;        ///< if not
    double                   best_error = 0.; ///< that the record knows [1]
    std::vector<std::string> overrides;       ///< "Section/Key=value"
    Prediction               prediction;
  };


  /// What is proposed for an accuracy.
  struct Plan
  {
    double                accuracy = 0.; ///< relative [1]
    SceneSizes            sizes;
    std::vector<Record>   records;   ///< that fit the scene
    std::vector<Proposal> proposals; ///< in the order of the records
    /// The possible one that takes the least time; none without records.
    std::optional<unsigned int> chosen;
    /// Of the scene as it stands, where no record fits.
    Prediction as_it_stands;
  };


  /// Predicts a scene with further overrides.
  using Predict =
      std::function<Prediction(const std::vector<std::string> &overrides)>;


  /// Finds for every method of the records the smallest setting that reaches
  /// the accuracy, and its cost in this scene.
  /// @param records not empty
  /// @throws InputError if none reaches it, with the best that is known
  Plan
  make_plan(const SceneSizes          &sizes,
            const std::vector<Record> &records,
            double                     accuracy,
            const Predict             &predict);


  /// Reads the scene and plans it by the shipped records.
  /// @param accuracy as on the command line
  /// @throws InputError, FileError
  Plan
  plan_scene(const std::string              &scene_file,
             const std::vector<std::string> &overrides,
             const std::string              &accuracy);


  /// What --plan prints: the methods, the choice, and the command that runs it.
  /// @param overrides that the user gave
  std::string
  as_text(const Plan                     &plan,
          const std::string              &scene_file,
          const std::vector<std::string> &overrides);
} // namespace Morsel::Plan

#endif
