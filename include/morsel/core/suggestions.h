#ifndef morsel_core_suggestions_h
#define morsel_core_suggestions_h

#include <string>
#include <vector>

namespace Morsel
{
  /// Smallest number of insertions, deletions, replacements and swaps of
  /// neighbouring letters that turn one word into the other; case is ignored.
  unsigned int
  edit_distance(const std::string &a, const std::string &b);


  /// The candidate closest to the word, or an empty string if none is so close
  /// that a slip of the pen explains the difference.
  std::string
  nearest(const std::string &word, const std::vector<std::string> &candidates);


  /// " Did you mean 'x'?" for the nearest candidate, or an empty string.
  std::string
  did_you_mean(const std::string              &word,
               const std::vector<std::string> &candidates);


  /// "'a', 'b' and 'c'", for messages that list what there is.
  std::string
  quoted_list(const std::vector<std::string> &words);


  /// Names of the files beside a path, prefixed with the path's folder as it
  /// was written: candidates for did_you_mean() where a file is missing.
  std::vector<std::string>
  files_beside(const std::string &path);


  /// The text without white space at both ends.
  std::string
  trimmed(const std::string &text);


  /// A short text of a number for messages: up to six digits.
  std::string
  number_text(double value);
} // namespace Morsel

#endif
