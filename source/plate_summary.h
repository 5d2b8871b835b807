#ifndef morsel_plate_summary_h
#define morsel_plate_summary_h

#include <morsel/core/log.h>
#include <morsel/core/run_options.h>
#include <morsel/fracture/plate_output.h>
#include <morsel/fracture/plate_scene.h>
#include <morsel/fracture/tip_result.h>
#include <morsel/output/summary.h>

#include <deal.II/base/timer.h>

#include <functional>
#include <string>
#include <vector>

namespace Morsel
{
  /// What a solved cracked plate has to report, whatever method solved it.
  struct PlateRun
  {
    const Fracture::PlateScene             &plate;
    const std::vector<Fracture::Crack>     &cracks;
    const std::vector<Fracture::TipResult> &tips;
    std::vector<Output::Effect>             effects;
    std::string                             solver;
    std::string                             costs_in_words; ///< for the log

    std::function<double()>                energy_route; ///< [Pa sqrt(m)]
    std::function<void(Output::Summary &)> add_costs;
    std::function<void()>                  write_fields;
    Fracture::FieldSampler                 sample; ///< of the solution
  };


  /// Title and used.prm.
  void
  start_log(RunLog                     &log,
            const Fracture::PlateScene &plate,
            const RunOptions           &options,
            const std::string          &used_parameters);


  /// Stress intensities with their spread over the rings, references and
  /// ratios, energy route, costs, fields and provenance; the first rank writes
  /// summary.json. Collective over all ranks.
  /// @param whole runs since the program's start
  void
  finish_run(const PlateRun      &run,
             const dealii::Timer &whole,
             RunLog              &log,
             const std::string   &folder,
             const std::string   &used_parameters);
} // namespace Morsel

#endif
