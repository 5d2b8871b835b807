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
      prm.add_parameter("Quick",
                        study.quick,
                        "A smaller study for a first look: axes take their "
                        "'Quick values' or 'Quick count', series add their "
                        "'Quick entries'.");
      prm.add_parameter("Numerical bound",
                        study.numerical_bound,
                        "What numerical entries of 'Sensitivity' sections may "
                        "change a quantity by [1].",
                        Patterns::Double(0.));
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
      prm.add_parameter("Count",
                        axis.count,
                        "Number of values [1].",
                        Patterns::Integer(0, 10000));
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
                        "of the axes in braces; ';;' is one in a text.");
      prm.add_parameter("Together with",
                        axis.partner,
                        "Axis of as many values that this one goes along with; "
                        "else all combinations are run.");
      prm.add_parameter("Quick values",
                        axis.quick_values,
                        "Values of a quick study; those of Values if empty.");
      prm.add_parameter("Quick count",
                        axis.quick_count,
                        "Number of values of a range, of draws or seeds in a "
                        "quick study [1]; 0: Count.",
                        Patterns::Integer(0));
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
                        "formulas of the axes in braces; ';;' is one in a "
                        "text.");
      prm.add_parameter("Quick entries",
                        series.quick_entries,
                        "What a quick study sets after Entries.");
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
      prm.add_parameter("Drawn",
                        quantity.drawn,
                        "Whether figures of this quantity are drawn.");
      prm.leave_subsection();
    }


    void
    declare_relation(Relation &relation, dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Relation " + relation.name);
      prm.add_parameter(
          "Label", relation.label, "For figures; the name if empty.");
      prm.add_parameter(
          "x", relation.x, "Quantity of the study on the horizontal axis.");
      prm.add_parameter("y",
                        relation.y,
                        "Quantity of the study whose straight line over x is "
                        "fitted, one for each series, means of draws taken "
                        "for points.");
      prm.add_parameter("Expected correlation",
                        relation.expected_correlation,
                        "Correlation coefficient to compare with [1]; empty: "
                        "none.",
                        Patterns::Anything());
      prm.add_parameter("Expected points",
                        relation.expected_points,
                        "Points that the expected correlation rests on [1]; 0: "
                        "not known, so that no test is possible.",
                        Patterns::Integer(0));
      prm.add_parameter(
          "Source", relation.source, "Where the expected correlation is from.");
      prm.leave_subsection();
    }


    void
    declare_claim(Claim &claim, dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Claim " + claim.name);
      prm.add_parameter("Source", claim.source, "Where it is stated.");
      prm.add_parameter("Says", claim.says, "What is stated, in words.");
      prm.add_parameter("Value",
                        claim.value,
                        "The number stated [unit of the quantity]; empty: "
                        "words only.");
      prm.add_parameter("Quantity",
                        claim.quantity,
                        "Ours is this quantity of the study; empty: no number "
                        "of ours.");
      prm.add_parameter("Relation",
                        claim.relation,
                        "Instead of a quantity: ours is the correlation of "
                        "this relation.");
      prm.add_parameter("Series",
                        claim.series,
                        "Ours is of this series; may be left out if there is "
                        "only one.");
      prm.add_parameter("At",
                        claim.at,
                        "Ours is of the run with these values of axes, 'n = "
                        "60; a = 0.1', with draws averaged; empty: of the "
                        "largest resolution.");
      prm.add_parameter(
          "Finding", claim.finding, "What the study finds, in words.");
      prm.add_parameter("Why", claim.why, "Why the two differ.");
      prm.leave_subsection();
    }


    void
    declare_figure(Figure &figure, dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Figure " + figure.name);
      prm.add_parameter("Kind",
                        figure.kind,
                        "'history' are curves from the runs' history.csv, "
                        "'picture' is a figure of the runs' own reports, side "
                        "by side (fields need 'Study/Keep fields').",
                        Patterns::Selection("history|picture"));
      prm.add_parameter("Title", figure.title, "Of the figure.");
      prm.add_parameter("Caption", figure.caption, "Below the figure.");
      prm.add_parameter("x",
                        figure.x,
                        "Column of history.csv with its unit, as it stands in "
                        "the file's first line.");
      prm.add_parameter("y", figure.y, "Columns over it, separated by commas.");
      prm.add_parameter("Picture",
                        figure.picture,
                        "Name of the runs' figure, without '.png'.");
      prm.add_parameter("Series",
                        figure.series,
                        "Only runs of these series, separated by commas.");
      prm.add_parameter("Where",
                        figure.where,
                        "Only runs with these values of axes, 'seed = 1; food "
                        "= peanut'.");
      prm.leave_subsection();
    }


    void
    declare_sensitivity(Sensitivity &sensitivity, dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Sensitivity " + sensitivity.name);
      prm.add_parameter(
          "Label", sensitivity.label, "For figures; the name if empty.");
      prm.add_parameter("Entries",
                        sensitivity.entries,
                        "What is varied, all else being as it is, separated "
                        "by semicolons: 'Section/Key', or 'Section/Key = "
                        "text' with formulas of 'value' in braces.");
      prm.add_parameter(
          "Low", sensitivity.low, "The one value [unit of the entry].");
      prm.add_parameter(
          "High", sensitivity.high, "The other value [unit of the entry].");
      prm.add_parameter("Relative",
                        sensitivity.relative,
                        "Low and High are multiples of the base scene's value "
                        "[1].");
      prm.add_parameter("Base",
                        sensitivity.base,
                        "The base scene's value [unit of the entry]; empty: "
                        "that of the first of Entries.",
                        Patterns::Anything());
      prm.add_parameter("Numerical",
                        sensitivity.numerical,
                        "Whether this is a coefficient of the method, which "
                        "should change quantities by less than 'Study/"
                        "Numerical bound', and no property of what is "
                        "simulated.");
      prm.add_parameter("Series",
                        sensitivity.series,
                        "Only in these series, separated by commas.");
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
    for (Relation &relation : study.relations)
      declare_relation(relation, prm);
    for (Claim &claim : study.claims)
      declare_claim(claim, prm);
    for (Figure &figure : study.figures)
      declare_figure(figure, prm);
    for (Sensitivity &sensitivity : study.sensitivities)
      declare_sensitivity(sensitivity, prm);
  }
} // namespace Morsel::Study
