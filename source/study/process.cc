#include <morsel/core/errors.h>
#include <morsel/study/process.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <limits.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace Morsel::Study
{
  namespace
  {
    /// The environment that this process was started with: MPI has put
    /// variables of its own into the present one, and a child that found them
    /// would take itself for a part of this run.
    std::vector<std::string>
    first_environment()
    {
      std::ifstream            file("/proc/self/environ", std::ios::binary);
      const std::string        all((std::istreambuf_iterator<char>(file)),
                            std::istreambuf_iterator<char>());
      std::vector<std::string> variables;
      for (std::size_t i = 0; i < all.size();)
        {
          const std::size_t end = std::min(all.find('\0', i), all.size());
          variables.push_back(all.substr(i, end - i));
          i = end + 1;
        }
      return variables;
    }


    std::string
    own_executable()
    {
      std::array<char, PATH_MAX> path;
      const ssize_t              length =
          ::readlink("/proc/self/exe", path.data(), path.size());
      if (length <= 0)
        throw FileError("The program's own file cannot be found: " +
                        std::string(std::strerror(errno)) + ".");
      return std::string(path.data(), length);
    }


    std::vector<char *>
    pointers(std::vector<std::string> &texts)
    {
      std::vector<char *> result;
      for (std::string &text : texts)
        result.push_back(text.data());
      result.push_back(nullptr);
      return result;
    }


    /// What the child does before it becomes the program; only calls that are
    /// safe after the fork of a process with several threads.
    [[noreturn]] void
    become(const char  *executable,
           char *const *arguments,
           char *const *environment,
           const int    output,
           const pid_t  parent)
    {
      // A terminal's interrupt is the study's to handle, not its children's.
      ::setpgid(0, 0);
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (::getppid() != parent)
        ::_exit(127);
      ::dup2(output, STDOUT_FILENO);
      ::dup2(output, STDERR_FILENO);
      ::execve(executable, arguments, environment);
      ::_exit(127);
    }


    double
    seconds(const timeval &time)
    {
      return static_cast<double>(time.tv_sec) + 1e-6 * time.tv_usec;
    }
  } // namespace


  ChildProcess::ChildProcess(const std::vector<std::string> &arguments,
                             const std::string              &output,
                             const double                    time_limit)
      : time_limit(time_limit)
      , begin(Clock::now())
  {
    const std::string        executable = own_executable();
    std::vector<std::string> all        = {executable};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<std::string>  variables     = first_environment();
    const std::vector<char *> argument_list = pointers(all);
    const std::vector<char *> environment   = pointers(variables);

    const int file =
        ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0)
      throw FileError("Cannot write '" + output + "': " + std::strerror(errno) +
                      ".");
    const pid_t parent = ::getpid();
    pid                = ::fork();
    if (pid == 0)
      become(executable.c_str(),
             argument_list.data(),
             environment.data(),
             file,
             parent);
    const int error = errno;
    ::close(file);
    if (pid < 0)
      throw FileError("A run cannot be started: " +
                      std::string(std::strerror(error)) + ".");
  }


  ChildProcess::~ChildProcess()
  {
    if (pid <= 0 || ended)
      return;
    ::kill(pid, SIGTERM);
    // It may write a last file, but not for ever.
    const Clock::time_point asked = Clock::now();
    int                     status;
    while (::waitpid(pid, &status, WNOHANG) == 0)
      {
        if (Clock::now() - asked > std::chrono::seconds(3))
          ::kill(pid, SIGKILL);
        ::usleep(10000);
      }
  }


  double
  ChildProcess::age() const
  {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }


  std::optional<Ended>
  ChildProcess::poll()
  {
    if (ended)
      return ended;
    int    status = 0;
    rusage usage  = {};
    if (::wait4(pid, &status, WNOHANG, &usage) != pid)
      {
        if (time_limit > 0. && age() > time_limit && !too_long)
          {
            too_long = true;
            ::kill(pid, SIGKILL);
          }
        return std::nullopt;
      }
    ended         = Ended();
    ended->status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    ended->wall_time = age();
    ended->cpu_time  = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    ended->too_long  = too_long;
    return ended;
  }
} // namespace Morsel::Study
