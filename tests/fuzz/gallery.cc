#include "gallery.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace Fuzz
{
  namespace
  {
    bool
    ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() &&
             text.compare(text.size() - end.size(), end.size(), end) == 0;
    }


    std::string
    trimmed(const std::string &text)
    {
      const std::size_t begin = text.find_first_not_of(" \t\r");
      if (begin == std::string::npos)
        return "";
      return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
    }


    std::string
    value_of(const std::string &line)
    {
      return key_of(line).empty() ? ""
                                  : trimmed(line.substr(line.find('=') + 1));
    }


    /// The files that a scene names, and those that these name.
    void
    collect_dependencies(const std::string     &root,
                         const std::string     &file,
                         std::set<std::string> &found)
    {
      if (!ends_with(file, ".prm"))
        return;
      for (const std::string &line : split_lines(read_file(root + "/" + file)))
        {
          std::string words = trimmed(line).rfind("include ", 0) == 0
                                  ? trimmed(line).substr(8)
                                  : value_of(line);
          std::replace(words.begin(), words.end(), ',', ' ');
          std::istringstream stream(words);
          for (std::string word; stream >> word;)
            {
              const fs::path path =
                  (fs::path(file).parent_path() / word).lexically_normal();
              if (fs::is_regular_file(root / path) &&
                  found.insert(path.string()).second)
                collect_dependencies(root, path.string(), found);
            }
        }
    }


    /// Entries and subsections of a scene, each as a text of its own.
    std::vector<std::string>
    blocks_of(const std::string &text)
    {
      const std::vector<std::string> lines = split_lines(text);
      std::vector<std::string>       result;
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (!key_of(lines[i]).empty())
          result.push_back(lines[i]);
        else if (trimmed(lines[i]).rfind("subsection ", 0) == 0)
          {
            std::string  block;
            unsigned int depth = 0;
            for (std::size_t k = i; k < lines.size(); ++k)
              {
                block += lines[k] + "\n";
                if (trimmed(lines[k]).rfind("subsection ", 0) == 0)
                  ++depth;
                else if (trimmed(lines[k]) == "end" && --depth == 0)
                  break;
              }
            result.push_back(block);
          }
      return result;
    }


    /// A number of a scene divided, but not below a limit.
    struct Shrinking
    {
      double divisor, lower_limit;
    };


    const std::map<std::string, Shrinking> shrinkings = {
        {"Particles across", {4., 9.}},
        {"Particles along x", {3., 7.}},
        {"Particles along y", {3., 7.}},
        {"Cells along x", {2., 7.}},
        {"Cells along y", {2., 7.}},
        {"Corner refinements", {3., 1.}},
        {"End time", {10., 0.}},
        {"Count", {3., 2.}},
        {"Repetitions", {10., 1.}}};
  } // namespace


  Gallery::Gallery(const std::string &root)
  {
    for (const char *const folder : {"prm", "meshes"})
      if (fs::is_directory(root + "/" + folder))
        for (const auto &entry :
             fs::recursive_directory_iterator(root + "/" + folder))
          if (entry.is_regular_file())
            files.push_back(fs::relative(entry.path(), root).string());
    std::sort(files.begin(), files.end());

    for (const std::string &file : files)
      if (ends_with(file, ".prm"))
        {
          const std::string text = read_file(root + "/" + file);
          scenes.push_back({file, file});
          std::set<std::string> found;
          collect_dependencies(root, file, found);
          for (const std::string &dependency : found)
            dependencies.push_back({file, dependency});
          for (const std::string &line : split_lines(text))
            if (!key_of(line).empty())
              values.push_back(value_of(line));
          const std::vector<std::string> own_blocks = blocks_of(text);
          blocks.insert(blocks.end(), own_blocks.begin(), own_blocks.end());
          keys.merge(keys_of(text));
        }
    if (scenes.empty() || dependencies.empty())
      throw std::runtime_error("there is no gallery in '" + root + "'");
  }


  std::string
  read_file(const std::string &path)
  {
    std::ifstream file(path, std::ios::binary);
    if (!file)
      throw std::runtime_error("'" + path + "' cannot be read");
    return {std::istreambuf_iterator<char>(file),
            std::istreambuf_iterator<char>()};
  }


  std::vector<std::string>
  split_lines(const std::string &text)
  {
    std::vector<std::string> lines;
    std::istringstream       stream(text);
    for (std::string line; std::getline(stream, line);)
      lines.push_back(line);
    return lines;
  }


  std::string
  key_of(const std::string &line)
  {
    const std::string text   = trimmed(line);
    const std::size_t equals = text.find('=');
    if (text.rfind("set ", 0) != 0 || equals == std::string::npos)
      return "";
    return trimmed(text.substr(4, equals - 4));
  }


  std::set<std::string>
  keys_of(const std::string &text)
  {
    std::set<std::string> result;
    for (const std::string &line : split_lines(text))
      if (const std::string key = key_of(line); !key.empty())
        result.insert(key);
    return result;
  }


  std::string
  shrunk(const std::string &scene)
  {
    std::string result;
    for (const std::string &line : split_lines(scene))
      {
        const auto        shrinking = shrinkings.find(key_of(line));
        const std::string value     = value_of(line);
        char             *end       = nullptr;
        const double      number    = std::strtod(value.c_str(), &end);
        if (shrinking == shrinkings.end() || value.empty() || *end != '\0' ||
            number <= shrinking->second.lower_limit)
          {
            result += line + "\n";
            continue;
          }
        const bool   whole   = value.find_first_of(".eE") == std::string::npos;
        const double smaller = std::max(number / shrinking->second.divisor,
                                        shrinking->second.lower_limit);
        std::ostringstream text;
        text << line.substr(0, line.find('=') + 1) << " ";
        if (whole && shrinking->second.lower_limit > 0.)
          text << static_cast<long>(smaller);
        else
          text << smaller;
        result += text.str() + "\n";
      }
    return result;
  }
} // namespace Fuzz
