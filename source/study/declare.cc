#include <morsel/study/declare.h>

#include <deal.II/base/patterns.h>

namespace Morsel::Study
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    void
    declare_top(Study &study, dealii::ParameterHandler &prm)
    {
      prm.add_parameter("Name",
                        study.name,
                        "Name of the study and of its folder of results; the "
                        "file's name if empty.");
      prm.add_parameter("Title", study.title, "What the study shows.");

      prm.enter_subsection("Study");
      prm.add_parameter("Base scene",
                        study.base_scene,
                        "Scene file that the runs start from, relative to the "
                        "study's file.");
      prm.add_parameter("Quantities",
                        study.recorded,
                        "Results to record, named as in summary.json, "
                        "separated by commas; those with a section 'Quantity "
                        "<name>' need not be listed.");
      prm.add_parameter("Resolution",
                        study.resolution,
                        "What errors are drawn and fitted against: a formula "
                        "of axes and results, such as 'n' or 'dof_count' [1]. "
                        "'unknowns' is dof_count, or twice particle_count.");
      prm.add_parameter("Resolution label",
                        study.resolution_label,
                        "What the resolution is, for figures.");
      prm.add_parameter(
          "Timing", study.timing, "Time matters: one run at a time, repeated.");
      prm.add_parameter("Repetitions",
                        study.repetitions,
                        "Of each run in a timing study; median and spread of "
                        "the time are recorded [1].",
                        Patterns::Integer(1, 1000));
      prm.add_parameter("Time",
                        study.time_result,
                        "Result that counts as the run's time [s].");
      prm.add_parameter("Side by side",
                        study.side_by_side,
                        "Runs at the same time, unless time matters [1].",
                        Patterns::Integer(1, 4096));
      prm.add_parameter("Threads",
                        study.threads,
                        "Of each run [1].",
                        Patterns::Integer(1, 4096));
      prm.add_parameter("Time limit",
                        study.time_limit,
                        "A run that takes longer has failed [s]; 0: none.",
                        Patterns::Double(0.));
      prm.add_parameter("Keep fields",
                        study.keep_fields,
                        "Keep the folder 'solution' of every run.");
      prm.leave_subsection();
    }


    void
    declare_axis(Axis &axis, dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Axis " + axis.name);
      prm.add_parameter(
          "Kind",
          axis.kind,
          "Its values: 'numbers' and 'texts' are listed in "
          "Values; 'linear' and 'logarithmic' are Count values "
          "from From to To; 'random' are Count draws between "
          "From and To; 'seeds' are Seed, Seed + 1, ...",
          Patterns::Selection("numbers|texts|linear|logarithmic|random|seeds"));
      prm.add_parameter("Values",
                        axis.values,
                        "List separated by commas, or by semicolons if there "
                        "is one.");
      prm.add_parameter("From", axis.from, "First value [unit of the axis].");
      prm.add_parameter("To", axis.to, "Last value [unit of the axis].");
      prm.add_parameter(
          "Count", axis.count, "Number of values [1].", Patterns::Integer(0));
      prm.add_parameter("Seed",
                        axis.seed,
                        "Of the draws, or the first of the seeds [1].",
                        Patterns::Integer(0));
      prm.add_parameter("Whole numbers",
                        axis.whole,
                        "Round the values of a range, and drop doubles.");
      prm.add_parameter("Entries",
                        axis.entries,
                        "What the value is put into, separated by semicolons: "
                        "'Section/Key', or 'Section/Key = text' with formulas "
                        "of the axes in braces.");
      prm.add_parameter("Together with",
                        axis.partner,
                        "Axis of as many values that this one goes along with; "
                        "else all combinations are run.");
      prm.add_parameter("Label", axis.label, "For figures; the name if empty.");
      prm.add_parameter("Unit", axis.unit, "Unit, for figures.");
      prm.leave_subsection();
    }


    void
    declare_series(Series &series, dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Series " + series.name);
      prm.add_parameter(
          "Title", series.title, "For figures; the name if empty.");
      prm.add_parameter("Base scene",
                        series.base_scene,
                        "As in section Study, which serves if this is empty.");
      prm.add_parameter("Axes",
                        series.axes,
                        "The axes of this series, separated by commas; all if "
                        "empty.");
      prm.add_parameter("Entries",
                        series.entries,
                        "'Section/Key = text' separated by semicolons, with "
                        "formulas of the axes in braces.");
      prm.leave_subsection();
    }


    void
    declare_quantity(Quantity &quantity, dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Quantity " + quantity.name);
      prm.add_parameter("Expression",
                        quantity.expression,
                        "Formula of results (names in summary.json) and axes; "
                        "the result of this name if empty.");
      prm.add_parameter("Label", quantity.label, "For figures.");
      prm.add_parameter(
          "Unit", quantity.unit, "Unit; the result's own if empty.");
      prm.add_parameter(
          "Truth",
          quantity.truth,
          "What errors are measured from: 'formula' of the axes "
          "(a number is one), 'table' over an axis, 'finest run' "
          "(the largest resolution), 'reference' that the "
          "run states itself, or 'none'.",
          Patterns::Selection("none|formula|table|finest run|reference"));
      prm.add_parameter("Truth formula",
                        quantity.truth_formula,
                        "Number or formula [unit of the quantity].");
      prm.add_parameter("Truth axis",
                        quantity.truth_axis,
                        "Axis of the table, or 'series'; for 'finest run' the "
                        "axes, separated by commas, along which the truth "
                        "differs.");
      prm.add_parameter("Truth table",
                        quantity.truth_table,
                        "'axis value: truth', separated by commas [unit of the "
                        "quantity].");
      prm.add_parameter("Truth accuracy",
                        quantity.accuracy,
                        "Relative error of the truth: smaller errors of runs "
                        "mean nothing and stay out of fits [1].",
                        Patterns::Double(0.));
      prm.add_parameter("Error scale",
                        quantity.scale,
                        "Errors are divided by this [unit of the quantity]; 0: "
                        "by the truth's magnitude.",
                        Patterns::Double(0.));
      prm.leave_subsection();
    }
  } // namespace


  void
  declare(Study &study, dealii::ParameterHandler &prm)
  {
    declare_top(study, prm);
    for (Axis &axis : study.axes)
      declare_axis(axis, prm);
    for (Series &series : study.series)
      declare_series(series, prm);
    for (Quantity &quantity : study.quantities)
      declare_quantity(quantity, prm);
  }
} // namespace Morsel::Study
