#include <morsel/core/sentences.h>

#include <algorithm>

namespace Morsel
{
  namespace
  {
    /// Bytes of the character of UTF-8 that begins here, 0 if it is none or
    /// none that a terminal shows.
    std::size_t
    character_length(const std::string &text, const std::size_t begin)
    {
      const auto byte = [&](const std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
      };
      const unsigned int first = byte(begin);
      if (first < 128)
        return first == '\n' || first == '\t' || (first >= 32 && first != 127)
                   ? 1
                   : 0;
      const std::size_t length = first >= 0xC2 && first < 0xE0   ? 2
                                 : first >= 0xE0 && first < 0xF0 ? 3
                                 : first >= 0xF0 && first < 0xF5 ? 4
                                                                 : 0;
      for (std::size_t i = 1; i < length; ++i)
        if (byte(begin + i) >> 6 != 2)
          return 0;
      // U+0080 to U+009F control terminals, too.
      return first == 0xC2 && byte(begin + 1) < 0xA0 ? 0 : length;
    }
  } // namespace


  std::size_t
  find_strange_byte(const std::string &text)
  {
    for (std::size_t i = 0; i < text.size();)
      {
        const std::size_t length = character_length(text, i);
        if (length == 0)
          return i;
        i += length;
      }
    return std::string::npos;
  }


  std::string
  as_sentence(const std::string &text)
  {
    const bool ends = !text.empty() && std::string(".?!").find(text.back()) < 3;
    return ends ? text : text + ".";
  }


  std::string
  presentable(const std::string &text)
  {
    // No sentence of the program's own is as long without a quotation.
    const std::size_t longest = 800, kept = 100;
    std::string       result;
    for (std::size_t begin = 0; begin <= text.size();)
      {
        const std::size_t end =
            std::min(text.find_first_of("'\n", begin), text.size());
        if (end - begin > longest)
          result += text.substr(begin, kept) + " ... " +
                    text.substr(end - kept, kept);
        else
          result += text.substr(begin, end - begin);
        if (end < text.size())
          result += text[end];
        begin = end + 1;
      }
    for (std::size_t i = 0; i < result.size();)
      {
        const std::size_t length = character_length(result, i);
        if (length == 0)
          result[i] = '?';
        else if (result[i] == '\t')
          result[i] = ' ';
        i += std::max<std::size_t>(1, length);
      }
    return result;
  }
} // namespace Morsel
