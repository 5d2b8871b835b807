#include <morsel/core/atomic_file.h>
#include <morsel/core/errors.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <system_error>
#include <unistd.h>

namespace Morsel
{
  namespace
  {
    [[noreturn]] void
    fail(const std::string &file_name, const int error)
    {
      throw FileError("Cannot write '" + file_name +
                      "': " + std::strerror(error) + ".");
    }


    /// Writes everything, also where the system takes it in portions; returns
    /// 0 or the system's error number.
    int
    write_all(const int descriptor, const std::string &content)
    {
      std::size_t written = 0;
      while (written < content.size())
        {
          const ssize_t n = ::write(
              descriptor, content.data() + written, content.size() - written);
          if (n < 0 && errno != EINTR)
            return errno;
          if (n > 0)
            written += static_cast<std::size_t>(n);
        }
      return ::fsync(descriptor) == 0 ? 0 : errno;
    }
  } // namespace


  void
  create_folder(const std::string &folder)
  {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw FileError("Cannot create the folder '" + folder +
                      "': " + error.message() + ".");
  }


  void
  write_atomically(const std::string &file_name, const std::string &content)
  {
    const std::string temporary =
        file_name + ".tmp" + std::to_string(::getpid());
    const int descriptor =
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (descriptor < 0)
      fail(file_name, errno);

    int error = write_all(descriptor, content);
    if (::close(descriptor) != 0 && error == 0)
      error = errno;
    if (error == 0 && std::rename(temporary.c_str(), file_name.c_str()) != 0)
      error = errno;
    if (error != 0)
      {
        ::unlink(temporary.c_str());
        fail(file_name, error);
      }
  }
} // namespace Morsel
