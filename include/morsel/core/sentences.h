#ifndef morsel_core_sentences_h
#define morsel_core_sentences_h

#include <cstddef>
#include <string>

namespace Morsel
{
  /// Where a text has its first byte that is no part of a character of UTF-8,
  /// or controls a terminal (other than tab and line end); npos if nowhere.
  std::size_t
  find_strange_byte(const std::string &text);


  /// The text with a full stop at its end, unless a sentence ends there.
  std::string
  as_sentence(const std::string &text);


  /// The text as a message may show it: bytes that are no characters of UTF-8
  /// or would control a terminal become '?', tabs blanks, and of what is too
  /// long between two quotation marks start and end are kept.
  std::string
  presentable(const std::string &text);
} // namespace Morsel

#endif
