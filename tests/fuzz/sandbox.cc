#include "sandbox.h"
#include "gallery.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace Fuzz
{
  namespace
  {
    /// After SIGTERM, a run may take this long to write its last files [s].
    const double time_to_end = 30.;


    void
    limit(const __rlimit_resource resource, const double value)
    {
      const rlimit both = {static_cast<rlim_t>(value),
                           static_cast<rlim_t>(value)};
      ::setrlimit(resource, &both);
    }


    /// In the child: its folder, its files and its limits.
    void
    enter(const std::string &folder,
          const std::string &tree,
          const Limits      &limits,
          const pid_t        parent)
    {
      ::setpgid(0, 0);
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      // MPI's own files.
      ::setenv("TMPDIR", folder.c_str(), 1);
      if (::getppid() != parent || ::chdir(tree.c_str()) != 0)
        ::_exit(126);
      const int flags = O_WRONLY | O_CREAT | O_TRUNC;
      ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
      ::dup2(::open((folder + "/stdout").c_str(), flags, 0644), STDOUT_FILENO);
      ::dup2(::open((folder + "/stderr").c_str(), flags, 0644), STDERR_FILENO);
      limit(RLIMIT_CORE, 0.);
      limit(RLIMIT_CPU, limits.processor_time);
      limit(RLIMIT_FSIZE, 1e9);
      if (limits.memory > 0.)
        limit(RLIMIT_AS, limits.memory);
    }


    /// Of a process, of its children that have ended and of those that run, so
    /// far [s]: fields 14 to 17 of proc(5)'s stat.
    double
    processor_time_of(const pid_t process)
    {
      const std::string folder = "/proc/" + std::to_string(process);
      std::ifstream     file(folder + "/stat");
      std::string       text;
      std::getline(file, text);
      std::istringstream fields(text.substr(text.rfind(')') + 1));
      std::string        skipped;
      for (unsigned int i = 3; i < 14; ++i)
        fields >> skipped;
      double sum = 0.;
      for (unsigned int i = 14; i < 18; ++i)
        {
          double ticks = 0.;
          fields >> ticks;
          sum += ticks / ::sysconf(_SC_CLK_TCK);
        }
      std::ifstream children(folder + "/task/" + std::to_string(process) +
                             "/children");
      for (pid_t child; children >> child;)
        sum += processor_time_of(child);
      return sum;
    }


    double
    seconds(const timeval &time)
    {
      return static_cast<double>(time.tv_sec) + 1e-6 * time.tv_usec;
    }
  } // namespace


  Sandbox::Sandbox(const std::string              &folder,
                   const std::string              &root,
                   const std::vector<std::string> &files)
      : folder(folder)
      , tree(folder + "/a/b")
      , root(root)
  {
    for (const std::string &file : files)
      {
        const fs::path path = tree + "/" + file;
        fs::create_directories(path.parent_path());
        fs::copy_file(root + "/" + file, path);
      }
    before = snapshot();
  }


  Sandbox::~Sandbox()
  {
    if (child > 0)
      {
        ::kill(-child, SIGKILL);
        ::waitpid(child, nullptr, 0);
      }
    std::error_code error;
    fs::remove_all(folder, error);
  }


  Sandbox::Snapshot
  Sandbox::snapshot() const
  {
    Snapshot result;
    for (const auto &entry : fs::recursive_directory_iterator(folder + "/a"))
      {
        struct stat state;
        if (::lstat(entry.path().c_str(), &state) != 0)
          continue;
        std::string text = "folder";
        if (!S_ISDIR(state.st_mode))
          text = std::to_string(state.st_size) + " " +
                 std::to_string(state.st_mtim.tv_sec) + " " +
                 std::to_string(state.st_mtim.tv_nsec) + " " +
                 std::to_string(state.st_ino);
        result[entry.path().string()] = text;
      }
    return result;
  }


  void
  Sandbox::put(const std::string &file, const std::string &text)
  {
    replaced_file = file;
    std::ofstream(tree + "/" + file, std::ios::binary) << text;
    before = snapshot();
  }


  void
  Sandbox::start(const std::function<int()> &program, const Limits &its_limits)
  {
    limits             = its_limits;
    was_interrupted    = false;
    was_killed         = false;
    begin              = std::chrono::steady_clock::now();
    const pid_t parent = ::getpid();
    child              = ::fork();
    if (child < 0)
      throw std::runtime_error("no process can be started");
    if (child == 0)
      {
        enter(folder, tree, limits, parent);
        std::exit(program());
      }
  }


  std::optional<Outcome>
  Sandbox::poll()
  {
    int         state = 0;
    rusage      usage = {};
    const pid_t ended = ::wait4(child, &state, WNOHANG, &usage);
    if (ended == 0)
      {
        const double age = std::chrono::duration<double>(
                               std::chrono::steady_clock::now() - begin)
                               .count();
        if (limits.patience > 0. && !was_interrupted &&
            processor_time_of(child) > limits.patience)
          {
            was_interrupted = true;
            interrupted_at  = age;
            ::kill(child, SIGTERM);
          }
        const double end =
            was_interrupted ? interrupted_at + time_to_end : limits.wall_time;
        if (age > end && !was_killed)
          {
            was_killed = true;
            ::kill(-child, SIGKILL);
          }
        return std::nullopt;
      }
    // What it may have started and left behind.
    ::kill(-child, SIGKILL);
    child = 0;
    Outcome outcome;
    if (WIFSIGNALED(state))
      outcome.signal = WTERMSIG(state);
    else
      outcome.status = WEXITSTATUS(state);
    outcome.interrupted = was_interrupted;
    outcome.killed      = was_killed || outcome.signal == SIGXCPU ||
                     (outcome.signal == SIGKILL &&
                      seconds(usage.ru_utime) > limits.processor_time - 1.);
    outcome.processor_time = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    outcome.memory         = 1024. * usage.ru_maxrss;
    outcome.output         = read_file(folder + "/stdout");
    outcome.errors         = read_file(folder + "/stderr");
    restore(outcome);
    return outcome;
  }


  void
  Sandbox::restore(Outcome &outcome)
  {
    const Snapshot after = snapshot();
    for (const auto &[path, state] : after)
      {
        const auto        old  = before.find(path);
        const std::string name = fs::relative(path, tree).string();
        if (old == before.end())
          outcome.changes.push_back("written: " + name);
        else if (old->second != state)
          outcome.changes.push_back("changed: " + name);
        // A study keeps what its failed runs have said.
        if (old == before.end() && fs::path(name).extension() == ".messages")
          outcome.run_errors += read_file(path);
      }
    for (const auto &[path, state] : before)
      if (after.count(path) == 0)
        outcome.changes.push_back("removed: " +
                                  fs::relative(path, tree).string());

    for (const std::string &change : outcome.changes)
      {
        const std::string name = change.substr(change.find(' ') + 1);
        fs::remove_all(tree + "/" + name);
        if (fs::exists(root + "/" + name) && change[0] != 'w')
          fs::copy_file(root + "/" + name, tree + "/" + name);
      }
    if (!replaced_file.empty())
      fs::copy_file(root + "/" + replaced_file,
                    tree + "/" + replaced_file,
                    fs::copy_options::overwrite_existing);
    replaced_file.clear();
  }
} // namespace Fuzz
