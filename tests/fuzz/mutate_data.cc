#include "mutate_values.h"
#include "mutations.h"

#include <algorithm>
#include <utility>

namespace Fuzz
{
  namespace
  {
    /// Words of a line and the white space or commas between them.
    std::vector<std::pair<std::size_t, std::size_t>>
    words_of(const std::string &line)
    {
      std::vector<std::pair<std::size_t, std::size_t>> result;
      std::size_t                                      begin = 0;
      while ((begin = line.find_first_not_of(" \t,;", begin)) !=
             std::string::npos)
        {
          const std::size_t end =
              std::min(line.find_first_of(" \t,;", begin), line.size());
          result.emplace_back(begin, end - begin);
          begin = end;
        }
      return result;
    }


    std::string
    change_word(std::vector<std::string> &lines, Random &random)
    {
      // Heads and counts stand at a file's start and would be met too rarely.
      const std::size_t n     = random.chance(50)
                                    ? std::min<std::size_t>(lines.size(), 12)
                                    : lines.size();
      const std::size_t i     = random.below(n);
      std::string      &line  = lines[i];
      const auto        words = words_of(line);
      if (words.empty())
        return "";
      const auto [begin, length] = random.pick(words);
      const std::string word     = line.substr(begin, length);
      const std::string other =
          random.chance(10) ? "" : mutate_value(word, random);
      line = line.substr(0, begin) + other + line.substr(begin + length);
      return "line " + std::to_string(i + 1) + ": '" + word + "' becomes '" +
             other.substr(0, 60) + "'";
    }


    std::string
    change_line(std::vector<std::string> &lines, Random &random)
    {
      const std::size_t i    = random.below(lines.size());
      const std::size_t k    = random.below(lines.size());
      const std::string name = "line " + std::to_string(i + 1);
      switch (random.below(5))
        {
          case 0:
            lines.erase(lines.begin() + i);
            return name + " left out";
          case 1:
            lines.insert(lines.begin() + i, lines[i]);
            return name + " twice";
          case 2:
            std::swap(lines[i], lines[k]);
            return name + " swapped with line " + std::to_string(k + 1);
          case 3:
            lines.erase(lines.begin() + std::min(i, k),
                        lines.begin() + std::max(i, k));
            return "lines from " + name + " to " + std::to_string(k + 1) +
                   " left out";
          default:
            lines[i] += " " + lines[k];
            return name + " made longer";
        }
    }
  } // namespace


  Mutation
  mutate_data(const std::string &text, Random &random)
  {
    Mutation                 mutation;
    std::vector<std::string> lines  = split_lines(text);
    const unsigned int       choice = random.below(100);
    if (lines.empty() || choice < 30)
      {
        mutation.text = text;
        mutation.what = mutate_bytes(mutation.text, random);
        return mutation;
      }
    mutation.what =
        choice < 80 ? change_word(lines, random) : change_line(lines, random);
    for (const std::string &line : lines)
      mutation.text += line + "\n";
    return mutation;
  }
} // namespace Fuzz
