#ifndef morsel_tests_unit_text_file_h
#define morsel_tests_unit_text_file_h

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace Morsel
{
  /// A file with a text, for as long as this lives.
  class TextFile
  {
  public:
    /// @param ending of its name, ".csv"
    TextFile(const std::string &text, const std::string &ending)
        : name((std::filesystem::temp_directory_path() /
                ("morsel_unit_" + std::to_string(::getpid()) + ending))
                   .string())
    {
      std::ofstream(name) << text;
    }

    TextFile(const TextFile &) = delete;
    TextFile &
    operator=(const TextFile &) = delete;

    ~TextFile()
    {
      std::filesystem::remove(name);
    }

    const std::string name;
  };
} // namespace Morsel

#endif
