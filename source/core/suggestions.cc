#include <morsel/core/suggestions.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>
#include <sstream>

namespace Morsel
{
  namespace
  {
    std::string
    lower_case(std::string text)
    {
      for (char &c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      return text;
    }
  } // namespace


  unsigned int
  edit_distance(const std::string &first, const std::string &second)
  {
    const std::string a = lower_case(first);
    const std::string b = lower_case(second);

    // Optimal string alignment, with three rows of the table kept.
    std::vector<unsigned int> before_last(b.size() + 1), last(b.size() + 1),
        row(b.size() + 1);
    for (unsigned int j = 0; j <= b.size(); ++j)
      last[j] = j;

    for (unsigned int i = 1; i <= a.size(); ++i)
      {
        row[0] = i;
        for (unsigned int j = 1; j <= b.size(); ++j)
          {
            row[j] = std::min({last[j] + 1,
                               row[j - 1] + 1,
                               last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
              row[j] = std::min(row[j], before_last[j - 2] + 1);
          }
        before_last.swap(last);
        last.swap(row);
      }
    return last[b.size()];
  }


  std::string
  nearest(const std::string &word, const std::vector<std::string> &candidates)
  {
    // A long text in place of a word is near to nothing, and takes its time.
    if (word.size() > 500)
      return "";
    std::string  best;
    unsigned int best_distance = std::numeric_limits<unsigned int>::max();
    for (const std::string &candidate : candidates)
      {
        const unsigned int distance = edit_distance(word, candidate);
        const std::size_t  length   = std::max(word.size(), candidate.size());
        // A third of the letters may be wrong; a word that merely leaves out a
        // part ("carrot" for "raw carrot") counts as near, too.
        const bool near =
            distance <= std::max<std::size_t>(1, length / 3) ||
            (word.size() >= 4 &&
             lower_case(candidate).find(lower_case(word)) != std::string::npos);
        if (near && distance < best_distance)
          {
            best          = candidate;
            best_distance = distance;
          }
      }
    return best;
  }


  std::string
  did_you_mean(const std::string              &word,
               const std::vector<std::string> &candidates)
  {
    const std::string best = nearest(word, candidates);
    return best.empty() ? "" : " Did you mean '" + best + "'?";
  }


  std::string
  quoted_list(const std::vector<std::string> &words)
  {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
      text += (i == 0 ? "" : (i + 1 == words.size() ? " and " : ", ")) +
              ("'" + words[i] + "'");
    return text;
  }


  std::vector<std::string>
  files_beside(const std::string &path)
  {
    namespace fs          = std::filesystem;
    const fs::path folder = fs::path(path).parent_path();

    std::vector<std::string> names;
    std::error_code          error;
    for (const fs::directory_entry &entry :
         fs::directory_iterator(folder.empty() ? "." : folder, error))
      if (entry.is_regular_file(error))
        names.push_back((folder / entry.path().filename()).string());
    std::sort(names.begin(), names.end());
    return names;
  }


  std::string
  trimmed(const std::string &text)
  {
    const char *const white = " \t\r\n\v\f";
    const std::size_t begin = text.find_first_not_of(white);
    if (begin == std::string::npos)
      return "";
    return text.substr(begin, text.find_last_not_of(white) - begin + 1);
  }


  std::string
  number_text(const double value)
  {
    std::ostringstream text;
    text << value;
    return text.str();
  }
} // namespace Morsel
