#include <morsel/core/build.h>
#include <morsel/core/data_files.h>
#include <morsel/core/errors.h>

#include <algorithm>
#include <filesystem>

namespace Morsel
{
  namespace fs = std::filesystem;


  std::string
  shipped_file(const std::string &name)
  {
    std::error_code error;
    const fs::path  folder =
        fs::read_symlink("/proc/self/exe", error).parent_path();
    for (const fs::path &candidate : {fs::path(MORSEL_DATA_DIR),
                                      folder / "../share/morsel",
                                      folder / "../data",
                                      folder / "data"})
      if (fs::exists(candidate / name, error))
        return (candidate / name).lexically_normal().string();
    throw FileError("The program's data '" + name +
                    "' are neither in '" MORSEL_DATA_DIR
                    "' nor beside the program; install it again.");
  }


  std::vector<std::string>
  shipped_json_files(const std::string &folder)
  {
    std::vector<std::string> files;
    for (const auto &entry : fs::directory_iterator(shipped_file(folder)))
      if (entry.path().extension() == ".json")
        files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
  }
} // namespace Morsel
