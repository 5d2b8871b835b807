// Mutates the scenes of the gallery, and the meshes and tables that they name,
// runs the program on each mutant in a folder of its own, and judges whether
// it ended as promised. The same seed and number give the same mutant.

#include "gallery.h"
#include "judge.h"
#include "mutations.h"
#include "sandbox.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <thread>

#include <unistd.h>

/// The program's main(), renamed when it was compiled: a process that has
/// loaded the libraries once forks in a tenth of the time that they take to
/// load.
int
morsel_main(int argc, char **argv);

namespace fs = std::filesystem;
using namespace Fuzz;

namespace
{
  /// Of so many mutants that run, one has all of the patience. The others are
  /// interrupted after this share of it: set up they are by then, and in their
  /// steps, which are all alike.
  constexpr std::uint64_t mutants_for_a_long_one = 10;
  constexpr double        short_share            = 0.2;


  struct Settings
  {
    std::uint64_t seed      = 1;
    std::uint64_t first     = 0;
    std::uint64_t n_mutants = 2000;
    unsigned int  jobs      = 2;
    bool          run       = false;
    Limits        limits;
    std::string   keep = "fuzz_failures";
  };


  struct Mutant
  {
    std::uint64_t            number;
    Target                   target;
    Mutation                 mutation;
    std::vector<std::string> arguments;
  };


  /// Each worker has its sandbox and the mutant that runs there.
  struct Worker
  {
    std::unique_ptr<Sandbox> sandbox;
    Mutant                   mutant;
  };


  class Campaign
  {
  public:
    Campaign(const Settings &settings, const std::string &root);

    /// Runs all mutants; returns the number of failures.
    unsigned int
    run();

  private:
    Mutant
    make_mutant(std::uint64_t number) const;

    void
    start(Worker &worker, Mutant mutant) const;

    void
    finish(const Mutant &mutant, const Outcome &outcome);

    void
    keep(const Mutant      &mutant,
         const Outcome     &outcome,
         const std::string &complaint) const;

    void
    report() const;

    Settings              settings;
    std::string           root, scratch;
    Gallery               gallery;
    std::set<std::string> known_keys;
    std::vector<Worker>   workers;

    std::map<std::string, unsigned int> endings;
    std::uint64_t                       n_done         = 0;
    unsigned int                        n_failures     = 0;
    double                              processor_time = 0.;
    double                              longest = 0., largest = 0.;
    std::uint64_t                       longest_number = 0, largest_number = 0;
  };


  int
  call_program(std::vector<std::string> arguments)
  {
    arguments.insert(arguments.begin(), "morsel");
    std::vector<char *> pointers;
    for (std::string &argument : arguments)
      pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    return morsel_main(static_cast<int>(arguments.size()), pointers.data());
  }


  Campaign::Campaign(const Settings &settings, const std::string &root)
      : settings(settings)
      , root(root)
      , scratch((fs::temp_directory_path() /
                 ("morsel_fuzz_" + std::to_string(::getpid())))
                    .string())
      , gallery(root)
      , known_keys(gallery.keys)
  {
    for (unsigned int i = 0; i < settings.jobs; ++i)
      workers.push_back(
          {std::make_unique<Sandbox>(
               scratch + "/" + std::to_string(i), root, gallery.files),
           {}});
    // What a scene may set beside what the gallery sets.
    workers[0].sandbox->start(
        [] {
          return call_program({"--print-parameters", "prm"});
        },
        settings.limits);
    std::optional<Outcome> outcome;
    while (!(outcome = workers[0].sandbox->poll()))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (outcome->status != 0 || outcome->signal != 0)
      throw std::runtime_error("--print-parameters failed: " + outcome->errors);
    known_keys.merge(keys_of(outcome->output));
  }


  Mutant
  Campaign::make_mutant(const std::uint64_t number) const
  {
    // Three of four times the scene itself, in turn, so that each has its
    // share; else a file that it names.
    Random              random(settings.seed, number);
    const bool          itself = number % 4 != 3;
    const auto         &list   = itself ? gallery.scenes : gallery.dependencies;
    const std::uint64_t turn   = itself ? number - number / 4 : number / 4;

    Mutant mutant;
    mutant.number          = number;
    mutant.target          = list[turn % list.size()];
    const std::string file = mutant.target.file;
    std::string       text = read_file(root + "/" + file);
    if (fs::path(file).extension() == ".prm")
      mutant.mutation = mutate_scene(shrunk(text), gallery, known_keys, random);
    else
      mutant.mutation = mutate_data(text, random);

    mutant.arguments = {mutant.target.scene, "--threads", "1"};
    if (!settings.run)
      mutant.arguments.push_back("--validate");
    else if (random.chance(50))
      mutant.arguments.insert(mutant.arguments.end(), {"--output", "results"});
    return mutant;
  }


  void
  Campaign::start(Worker &worker, Mutant mutant) const
  {
    worker.mutant = std::move(mutant);
    worker.sandbox->put(worker.mutant.target.file, worker.mutant.mutation.text);
    const std::vector<std::string> &arguments = worker.mutant.arguments;
    Limits                          limits    = settings.limits;
    if (worker.mutant.number % mutants_for_a_long_one != 0)
      limits.patience *= short_share;
    worker.sandbox->start([&] { return call_program(arguments); }, limits);
  }


  unsigned int
  Campaign::run()
  {
    const auto          begin = std::chrono::steady_clock::now();
    const std::uint64_t end   = settings.first + settings.n_mutants;
    std::uint64_t       next  = settings.first;
    bool                busy  = true;
    while (busy)
      {
        busy = false;
        for (Worker &worker : workers)
          {
            if (!worker.sandbox->is_free())
              if (const auto outcome = worker.sandbox->poll())
                finish(worker.mutant, *outcome);
            if (worker.sandbox->is_free() && next < end)
              start(worker, make_mutant(next++));
            busy = busy || !worker.sandbox->is_free();
          }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    workers.clear();
    fs::remove_all(scratch);
    report();
    std::cout << "Wall time "
              << std::chrono::duration<double>(
                     std::chrono::steady_clock::now() - begin)
                     .count()
              << " s" << std::endl;
    return n_failures;
  }


  void
  Campaign::finish(const Mutant &mutant, const Outcome &outcome)
  {
    const std::uint64_t tenth =
        std::max<std::uint64_t>(settings.n_mutants / 10, 1);
    if (++n_done % tenth == 0)
      std::cout << n_done << " mutants, " << n_failures << " failures"
                << std::endl;
    ++endings[outcome.signal != 0 ? "signal " + std::to_string(outcome.signal)
                                  : "status " + std::to_string(outcome.status)];
    processor_time += outcome.processor_time;
    if (outcome.processor_time > longest)
      {
        longest        = outcome.processor_time;
        longest_number = mutant.number;
      }
    if (outcome.memory > largest)
      {
        largest        = outcome.memory;
        largest_number = mutant.number;
      }
    const std::string text = complaint(mutant.mutation, outcome, !settings.run);
    if (text.empty())
      return;
    ++n_failures;
    std::cout << "Mutant " << mutant.number << " (" << mutant.target.file
              << (mutant.target.file == mutant.target.scene
                      ? ""
                      : " beside " + mutant.target.scene)
              << "; " << mutant.mutation.what << "): " << text << "\n  "
              << outcome.errors.substr(0, 300)
              << "\n  again: fuzz_scenes --seed " << settings.seed
              << " --first " << mutant.number << " --mutants 1"
              << (settings.run ? " --run" : "") << std::endl;
    keep(mutant, outcome, text);
  }


  void
  Campaign::keep(const Mutant      &mutant,
                 const Outcome     &outcome,
                 const std::string &complaint) const
  {
    const std::string folder = settings.keep + "/seed_" +
                               std::to_string(settings.seed) + "_mutant_" +
                               std::to_string(mutant.number);
    fs::remove_all(folder);
    for (const std::string &file : gallery.files)
      {
        const fs::path path = folder + "/" + file;
        fs::create_directories(path.parent_path());
        fs::copy_file(root + "/" + file, path);
      }
    std::ofstream(folder + "/" + mutant.target.file, std::ios::binary)
        << mutant.mutation.text;
    std::ofstream about(folder + "/about.txt");
    about << "file: " << mutant.target.file
          << "\nmutation: " << mutant.mutation.what << "\ncommand: morsel";
    for (const std::string &argument : mutant.arguments)
      about << " " << argument;
    about << "\ncomplaint: " << complaint << "\nstatus: " << outcome.status
          << "\nsignal: " << outcome.signal
          << "\nprocessor time [s]: " << outcome.processor_time
          << "\nmemory [B]: " << outcome.memory << "\n--- standard output\n"
          << outcome.output << "--- standard error\n"
          << outcome.errors << "--- failed runs of a study\n"
          << outcome.run_errors;
  }


  void
  Campaign::report() const
  {
    std::cout << settings.n_mutants << " mutants of " << gallery.scenes.size()
              << " scenes and " << gallery.dependencies.size()
              << " files beside them, seed " << settings.seed << ":";
    for (const auto &[ending, count] : endings)
      std::cout << " " << ending << ": " << count << ",";
    std::cout << " failures: " << n_failures << "\nProcessor time "
              << processor_time << " s, at most " << longest << " s (mutant "
              << longest_number << "); memory at most " << largest / 1e6
              << " MB (mutant " << largest_number << ")" << std::endl;
    if (n_failures > 0)
      std::cout << "The failures are kept in '" << settings.keep << "'."
                << std::endl;
  }


  /// In the environment: the process that makes the mutants.
  const char *const campaign = "MORSEL_MUTANTS_OF";


  /// What makes a start quick: one rank needs no network and no daemon, and
  /// one thread no pool of them.
  void
  set_environment()
  {
    for (const auto &[name, value] : std::map<std::string, std::string>{
             {"OMPI_MCA_ess_singleton_isolated", "1"},
             {"OMPI_MCA_pml", "ob1"},
             {"OMPI_MCA_btl", "self"},
             {"OMPI_MCA_coll", "basic,self,libnbc"},
             {"OMP_NUM_THREADS", "1"},
             {"OPENBLAS_NUM_THREADS", "1"}})
      ::setenv(name.c_str(), value.c_str(), 1);
    // Sanitizers, unless told otherwise: what MPI leaves allocated is no
    // finding, and undefined behaviour is to end the run.
    ::setenv("ASAN_OPTIONS", "detect_leaks=0", 0);
    ::setenv("UBSAN_OPTIONS", "print_stacktrace=1:halt_on_error=1", 0);
  }


  /// A study starts the program's own file for its runs, in the environment
  /// with which it began itself. That file is this one: so it begins once more
  /// with an environment by which its children know what they are.
  bool
  is_child_of_a_mutant(char **argv)
  {
    const std::string self = std::to_string(::getpid());
    if (const char *const process = std::getenv(campaign))
      return process != self;
    set_environment();
    ::setenv(campaign, self.c_str(), 1);
    ::execv("/proc/self/exe", argv);
    throw std::runtime_error("fuzz_scenes cannot start itself");
  }
} // namespace


int
main(int argc, char **argv)
{
  if (is_child_of_a_mutant(argv))
    return morsel_main(argc, argv);

  Settings settings;
  CLI::App app("Runs Morsel on mutants of its scenes, meshes and tables.",
               "fuzz_scenes");
  app.add_option("--seed", settings.seed, "Of the mutants")
      ->capture_default_str();
  app.add_option("--first", settings.first, "Number of the first mutant");
  app.add_option("--mutants", settings.n_mutants, "How many")
      ->capture_default_str();
  app.add_option("--jobs", settings.jobs, "Runs at a time")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  app.add_flag("--run", settings.run, "Run the scenes; else --validate them");
  settings.limits.patience = -1.;
  app.add_option(
      "--patience",
      settings.limits.patience,
      "One run of ten is interrupted after this processor time [s], the others "
      "after a fifth of it, and must end (default: 6 with --run)");
  app.add_option("--memory", settings.limits.memory, "Limit of addresses [B]")
      ->capture_default_str();
  app.add_option("--time",
                 settings.limits.processor_time,
                 "Limit of processor time [s]")
      ->capture_default_str();
  app.add_option("--keep", settings.keep, "Folder of failing mutants")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (settings.limits.patience < 0.)
    settings.limits.patience = settings.run ? 6. : 0.;

  try
    {
      return Campaign(settings, MORSEL_SOURCE_DIR).run() == 0 ? 0 : 1;
    }
  catch (const std::exception &error)
    {
      std::cerr << "fuzz_scenes: " << error.what() << std::endl;
      return 1;
    }
}
