// Runs a scene and writes a digest of its results to the file `output`, which
// deal.II's test macros compare with numdiff. The scene's comments say what
// goes into it:
//   # digest: NAME...          the value, all digits that numdiff compares
//   # below: NAME LIMIT        that the value's magnitude is below a limit
//   # band: NAME LOWER UPPER   that the value lies in a band
// Names are those of summary.json. numdiff takes numbers that differ by less
// than 1e-6 for equal, so a value is written as its mantissa and its power of
// ten; it takes nan for equal to nan, so what is not finite fails here.
#include <morsel/core/failure.h>
#include <morsel/fracture_run.h>
#include <morsel/scene/read.h>
#include <morsel/simulation.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace
{
  using namespace Morsel;

  double
  value_of(const nlohmann::json &summary, const std::string &name)
  {
    if (!summary.contains(name) || !summary[name].contains("value") ||
        !summary[name]["value"].is_number())
      throw std::runtime_error("summary.json has no number '" + name + "'");
    const double value = summary[name]["value"];
    if (!std::isfinite(value))
      throw std::runtime_error("'" + name + "' is not finite");
    return value;
  }


  std::string
  scientific_text(const double value)
  {
    const int power =
        value == 0. ? 0
                    : static_cast<int>(std::floor(std::log10(std::abs(value))));
    std::ostringstream text;
    text << std::fixed << std::setprecision(9) << value / std::pow(10., power)
         << " times 10 to " << power;
    return text.str();
  }


  void
  write_digest(const std::string    &scene_file,
               const nlohmann::json &summary,
               std::ostream         &out)
  {
    std::ifstream scene(scene_file);
    for (std::string line; std::getline(scene, line);)
      {
        std::istringstream words(line);
        std::string        hash, kind, name;
        words >> hash >> kind;
        if (hash != "#")
          continue;
        if (kind == "digest:")
          while (words >> name)
            out << name << ' ' << scientific_text(value_of(summary, name))
                << '\n';
        else if (kind == "below:")
          {
            std::string limit;
            words >> name >> limit;
            out << name << " below " << limit << ": "
                << (std::abs(value_of(summary, name)) < std::stod(limit) ? "yes"
                                                                         : "no")
                << '\n';
          }
        else if (kind == "band:")
          {
            std::string lower, upper;
            words >> name >> lower >> upper;
            const double value = value_of(summary, name);
            out << name << " from " << lower << " to " << upper << ": "
                << (value >= std::stod(lower) && value <= std::stod(upper)
                        ? "yes"
                        : "no")
                << '\n';
          }
      }
  }
} // namespace


int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  return exit_status_of([&] {
    if (argc != 2)
      throw std::runtime_error("call: digest SCENE.prm");
    CommandLine command_line;
    command_line.scene_file           = argv[1];
    command_line.run.output_directory = "results";
    command_line.run.quiet            = true;

    const FirstRank first_rank;
    first_rank.run([&] { std::filesystem::create_directories("results"); });
    if (is_fracture_scene(command_line.scene_file, {}))
      run_fracture_scene(command_line);
    else
      run_simulation(Scene::read_scene(command_line.scene_file),
                     command_line.run);
    first_rank.run([&] {
      std::ifstream file("results/summary.json");
      std::ofstream out("output");
      write_digest(command_line.scene_file, nlohmann::json::parse(file), out);
    });
  });
}
