// Compares the results of two runs of one scene: every number of summary.json
// but costs, and every cell of history.csv.
//   compare_runs FOLDER FOLDER [TOLERANCE]
// TOLERANCE is relative to the largest magnitude of the quantity; without one,
// the results have to be alike to the last digit. With one, errors, which are
// made of round-off themselves, are left out.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
  const std::set<std::string> costs = {"wall_time",
                                       "wall_time_loop",
                                       "particle_steps_per_second",
                                       "peak_memory",
                                       "rank_count",
                                       "repartitions",
                                       "rank_busy_time",
                                       "rank_busy_time_largest",
                                       "rank_imbalance",
                                       "rank_imbalance_before_peak",
                                       "rank_imbalance_after_peak",
                                       "thread_count"};

  using Table = std::vector<std::vector<std::string>>;


  std::ifstream
  open(const std::string &name)
  {
    std::ifstream file(name);
    if (!file)
      throw std::runtime_error(name + " is missing");
    return file;
  }


  Table
  read_table(const std::string &name)
  {
    auto  file = open(name);
    Table table;
    for (std::string line; std::getline(file, line);)
      {
        std::istringstream cells(line);
        table.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');)
          table.back().push_back(cell);
      }
    return table;
  }


  class Comparison
  {
  public:
    explicit Comparison(const double tolerance)
        : tolerance(tolerance)
    {}

    void
    numbers(const std::string &name,
            const double       a,
            const double       b,
            const double       scale)
    {
      if (a != b && !(std::abs(a - b) <= tolerance * scale))
        complain(name + ": " + std::to_string(a) + " and " + std::to_string(b) +
                 ", difference " + std::to_string((a - b) / scale) +
                 " of the largest");
    }

    /// Whether a quantity can be compared.
    bool
    concerns(const std::string &name) const
    {
      return costs.count(name) == 0 &&
             (tolerance == 0. || name.find("error") == std::string::npos);
    }

    void
    complain(const std::string &what)
    {
      if (++differences <= 10)
        std::cerr << what << '\n';
    }

    unsigned int differences = 0;

  private:
    const double tolerance;
  };


  void
  compare_summaries(const std::string &a,
                    const std::string &b,
                    Comparison        &comparison)
  {
    const auto first  = nlohmann::json::parse(open(a + "/summary.json"));
    const auto second = nlohmann::json::parse(open(b + "/summary.json"));
    for (const auto &[name, entry] : first.items())
      {
        if (!entry.contains("value") || !comparison.concerns(name))
          continue;
        if (!second.contains(name))
          comparison.complain(name + " is missing");
        else
          {
            const double x = entry["value"], y = second[name]["value"];
            comparison.numbers(name, x, y, std::max(std::abs(x), std::abs(y)));
          }
      }
    for (const auto &[name, entry] : second.items())
      if (!first.contains(name) && comparison.concerns(name))
        comparison.complain(name + " is new");
  }


  void
  compare_histories(const std::string &a,
                    const std::string &b,
                    Comparison        &comparison)
  {
    const Table first  = read_table(a + "/history.csv");
    const Table second = read_table(b + "/history.csv");
    if (first.size() != second.size() || first[0] != second[0])
      {
        comparison.complain("The histories have " +
                            std::to_string(first.size()) + " and " +
                            std::to_string(second.size()) + " rows");
        return;
      }
    for (std::size_t column = 0; column < first[0].size(); ++column)
      {
        if (!comparison.concerns(first[0][column]))
          continue;
        double scale = 0.;
        for (std::size_t row = 1; row < first.size(); ++row)
          scale = std::max(scale, std::abs(std::stod(first[row].at(column))));
        for (std::size_t row = 1; row < first.size(); ++row)
          comparison.numbers(first[0][column] + " of row " +
                                 std::to_string(row),
                             std::stod(first[row][column]),
                             std::stod(second[row].at(column)),
                             scale);
      }
  }
} // namespace


int
main(int argc, char **argv)
{
  if (argc < 3)
    return 2;
  try
    {
      Comparison comparison(argc > 3 ? std::stod(argv[3]) : 0.);
      compare_summaries(argv[1], argv[2], comparison);
      compare_histories(argv[1], argv[2], comparison);
      if (comparison.differences > 0)
        std::cerr << comparison.differences << " differences\n";
      return comparison.differences == 0 ? 0 : 1;
    }
  catch (const std::exception &error)
    {
      std::cerr << error.what() << '\n';
      return 1;
    }
}
