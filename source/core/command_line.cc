#include <morsel/core/build.h>
#include <morsel/core/command_line.h>
#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace Morsel
{
  namespace
  {
    const char *const closing_words =
        "Exit status: 0 done, 2 bad input, 3 the numbers went bad, 4 reading "
        "or\nwriting failed, 130 interrupted, 1 a fault of the program.\n";


    /// What CLI11 says of a mistake, with the nearest option for an
    /// unknown one.
    std::string
    explain(const CLI::ParseError          &error,
            const CLI::App                 &app,
            const std::vector<std::string> &arguments)
    {
      std::vector<std::string> known;
      for (const CLI::Option *option : app.get_options())
        for (const std::string &name : option->get_lnames())
          known.push_back("--" + name);

      for (const std::string &argument : arguments)
        if (argument.rfind('-', 0) == 0 && argument.size() > 1)
          {
            const std::string option = argument.substr(0, argument.find('='));
            if (option.rfind("--", 0) == 0 &&
                std::find(known.begin(), known.end(), option) == known.end())
              return "There is no option '" + option + "'." +
                     did_you_mean(option, known) + " See --help.";
          }
      return std::string("Command line: ") + error.what() + " See --help.";
    }
  } // namespace


  CommandLine
  read_command_line(const std::vector<std::string> &arguments)
  {
    CommandLine command_line;
    CLI::App app("Morsel simulates how food breaks between teeth.", "morsel");
    app.footer(closing_words);
    app.set_version_flag("--version", "morsel " MORSEL_VERSION);

    app.add_option("scene", command_line.scene_file, "Scene file (*.prm)")
        ->type_name("SCENE.prm");
    app.add_option("--set",
                   command_line.overrides,
                   "Override an entry of the scene; may be repeated")
        ->type_name("\"Section/Sub/Key=value\"")
        ->take_all()
        ->allow_extra_args(false);
    app.add_option("--output",
                   command_line.run.output_directory,
                   "Folder of results (default: output/<scene name>)")
        ->type_name("DIR");
    app.add_flag("--validate",
                 command_line.run.validate_only,
                 "Read and check the scene, say what a run would do");
    app.add_option("--plan",
                   command_line.plan,
                   "Propose method and resolution for a relative error, such "
                   "as 1e-3 or 0.1%, with predicted time and memory")
        ->type_name("ACCURACY");
    app.add_flag("--calibrate",
                 command_line.calibrate,
                 "Find the damage parameters that give the scene's solid its "
                 "prescribed strengths (section Calibration)");
    app.add_option("--print-parameters",
                   command_line.print_parameters,
                   "Print every parameter with default, range, unit and "
                   "meaning; of a scene if one is given")
        ->type_name("prm|json|md")
        ->check(CLI::IsMember({"prm", "json", "md"}));
    app.add_flag("--resume",
                 command_line.resume,
                 "Go on from the newest good checkpoint of the folder of "
                 "results");
    app.add_option("--threads",
                   command_line.run.threads,
                   "Threads per rank (default: the cores of the machine, "
                   "shared among its ranks)")
        ->type_name("N")
        ->check(CLI::Range(1, 4096));
    app.add_flag("--quiet",
                 command_line.run.quiet,
                 "Print nothing but mistakes and faults");

    command_line.run.threads = 0;
    try
      {
        // CLI11 takes the arguments in reverse order.
        app.parse(
            std::vector<std::string>(arguments.rbegin(), arguments.rend()));
      }
    catch (const CLI::CallForHelp &)
      {
        command_line.message = app.help();
        return command_line;
      }
    catch (const CLI::CallForVersion &version)
      {
        command_line.message = std::string(version.what()) + "\n";
        return command_line;
      }
    catch (const CLI::ParseError &error)
      {
        throw InputError(explain(error, app, arguments));
      }

    if (command_line.scene_file.empty() &&
        command_line.print_parameters.empty())
      throw InputError("No scene is given; call 'morsel SCENE.prm', for "
                       "instance with prm/food/peanut.prm. See --help.");
    return command_line;
  }


  void
  prepare_output_directory(const std::string &directory)
  {
    namespace fs             = std::filesystem;
    const std::string advice = " Choose another folder with --output.";

    std::error_code error, ignored;
    fs::create_directories(directory, error);
    if (!fs::is_directory(directory, ignored))
      throw FileError(
          "The folder of results '" + directory + "' cannot be created" +
          (error ? " (" + error.message() + ")" : "") + "." + advice);

    // The only sure test of a permission is to use it.
    const fs::path probe =
        fs::path(directory) / (".probe-" + std::to_string(getpid()));
    std::ofstream file(probe);
    file << "probe" << std::flush;
    const bool written = file.good();
    const int  reason  = errno;
    file.close();
    fs::remove(probe, error);
    if (!written)
      throw FileError("The folder of results '" + directory +
                      "' cannot be written to (" + std::strerror(reason) +
                      ")." + advice);
  }
} // namespace Morsel
