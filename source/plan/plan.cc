#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/plan/plan.h>
#include <morsel/plan/setting.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace Morsel::Plan
{
  namespace
  {
    std::string
    two_digits(const double value)
    {
      std::ostringstream text;
      text << std::setprecision(2) << value;
      return text.str();
    }


    std::string
    percent(const double error)
    {
      return two_digits(100. * error) + " %";
    }


    Proposal
    propose(const SceneSizes &sizes,
            const Method     &method,
            const double      accuracy,
            const Predict    &predict)
    {
      Proposal proposal;
      proposal.title          = method.title;
      const RecordedRun &best = largest_run(method);
      proposal.best_error     = best.error;
      const auto size         = size_to_reach(method, accuracy);
      proposal.resolution =
          two_digits(size.value_or(best.size)) + " " + method.size_label;
      if (!size)
        {
          proposal.obstacle = "reaches " + percent(best.error);
          return proposal;
        }
      proposal.overrides =
          overrides_of(method, *size, sizes.scene, sizes.bodies);
      try
        {
          proposal.prediction = predict(proposal.overrides);
          proposal.possible   = true;
        }
      catch (const InputError &error)
        {
          proposal.obstacle = std::string("does not fit: ") + error.what();
        }
      return proposal;
    }


    [[noreturn]] void
    refuse(const Plan &plan)
    {
      const Proposal &best =
          *std::min_element(plan.proposals.begin(),
                            plan.proposals.end(),
                            [](const Proposal &a, const Proposal &b) {
                              return a.best_error < b.best_error;
                            });
      for (const Proposal &proposal : plan.proposals)
        if (!proposal.overrides.empty())
          throw InputError("--plan: '" + proposal.title + "' would reach " +
                           percent(plan.accuracy) + ", but " +
                           proposal.obstacle);
      throw InputError("--plan: no recorded " + plan.sizes.kind + " reaches " +
                       percent(plan.accuracy) + "; the best that is known is " +
                       percent(best.best_error) + " by '" + best.title +
                       "' with " + best.resolution + ".");
    }


    std::string
    quoted_sets(const std::vector<std::string> &overrides)
    {
      std::string text;
      for (const std::string &item : overrides)
        text += "    --set \"" + item + "\" \\\n";
      return text;
    }


    void
    add_table(std::ostream &text, const Plan &plan)
    {
      const auto row = [&text](const std::string &title,
                               const std::string &resolution,
                               const std::string &unknowns,
                               const std::string &time,
                               const std::string &memory) {
        text << std::left << std::setw(32) << title << std::setw(34)
             << resolution << std::right << std::setw(9) << unknowns
             << std::setw(9) << time << std::setw(9) << memory << '\n';
      };
      row("Method", "Resolution", "Unknowns", "Time", "Memory");
      for (const Proposal &proposal : plan.proposals)
        if (proposal.possible)
          row(proposal.title,
              proposal.resolution,
              std::to_string(std::llround(proposal.prediction.unknowns)),
              duration_text(proposal.prediction.seconds),
              memory_text(proposal.prediction.bytes));
        else
          text << std::left << std::setw(32) << proposal.title << std::setw(34)
               << proposal.resolution << proposal.obstacle << '\n';
    }
  } // namespace


  Plan
  make_plan(const SceneSizes          &sizes,
            const std::vector<Record> &records,
            const double               accuracy,
            const Predict             &predict)
  {
    Plan plan;
    plan.accuracy = accuracy;
    plan.sizes    = sizes;
    plan.records  = records;
    for (const Record &record : records)
      for (const Method &method : record.methods)
        if (!method.runs.empty())
          plan.proposals.push_back(propose(sizes, method, accuracy, predict));
    for (unsigned int k = 0; k < plan.proposals.size(); ++k)
      if (plan.proposals[k].possible &&
          (!plan.chosen || plan.proposals[k].prediction.seconds <
                               plan.proposals[*plan.chosen].prediction.seconds))
        plan.chosen = k;
    if (!plan.chosen)
      refuse(plan);
    return plan;
  }


  Plan
  plan_scene(const std::string              &scene_file,
             const std::vector<std::string> &overrides,
             const std::string              &accuracy)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      throw InputError("--plan works on one rank: start it without mpirun.");
    const double              wanted  = read_accuracy(accuracy);
    const SceneSizes          sizes   = read_sizes(scene_file, overrides);
    const std::vector<Record> records = shipped_records(sizes.kind);
    const Predict             predict = [&](const auto &more) {
      std::vector<std::string> all = overrides;
      all.insert(all.end(), more.begin(), more.end());
      return predict_scene(scene_file, all);
    };
    if (!sizes.kind.empty() && !records.empty())
      return make_plan(sizes, records, wanted, predict);
    Plan plan;
    plan.accuracy     = wanted;
    plan.sizes        = sizes;
    plan.as_it_stands = predict({});
    return plan;
  }


  std::string
  as_text(const Plan                     &plan,
          const std::string              &scene_file,
          const std::vector<std::string> &overrides)
  {
    std::ostringstream text;
    if (!plan.chosen)
      {
        text << "No record fits scene '" << plan.sizes.name << "'"
             << (plan.sizes.obstacle.empty() ? "" : ": " + plan.sizes.obstacle)
             << ". As it stands:\n"
             << as_text(plan.as_it_stands);
        return text.str();
      }
    text << "Scene '" << plan.sizes.name << "', a " << plan.sizes.kind
         << ", with an error of " << percent(plan.accuracy) << ":\n";
    add_table(text, plan);
    const Proposal &choice = plan.proposals[*plan.chosen];
    text << "Chosen: " << choice.title << ", " << choice.resolution << ".\n"
         << "Predicted memory about " << memory_text(choice.prediction.bytes)
         << '\n'
         << "Predicted time   about "
         << duration_text(choice.prediction.seconds) << " ("
         << choice.prediction.basis << ")\n";
    for (const Record &record : plan.records)
      text << "Errors are those " << record.error << "; truth: " << record.truth
           << " (" << record.study << ").\n"
           << (record.remark.empty() ? "" : record.remark + "\n");
    text << "Run it by\n  morsel \\\n"
         << quoted_sets(overrides) << quoted_sets(choice.overrides) << "    "
         << scene_file << '\n';
    return text.str();
  }
} // namespace Morsel::Plan
