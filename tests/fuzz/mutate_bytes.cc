#include "mutations.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace Fuzz
{
  namespace
  {
    using Change = std::pair<const char *, void (*)(std::string &, Random &)>;


    std::string
    replaced_all(const std::string &text,
                 const std::string &from,
                 const std::string &to)
    {
      std::string result;
      std::size_t begin = 0, found;
      while ((found = text.find(from, begin)) != std::string::npos)
        {
          result += text.substr(begin, found - begin) + to;
          begin = found + from.size();
        }
      return result + text.substr(begin);
    }


    std::string
    utf16(const std::string &text, const bool big_end_first)
    {
      std::string result = big_end_first ? "\xFE\xFF" : "\xFF\xFE";
      for (const char c : text)
        {
          if (big_end_first)
            result += '\0';
          result += c;
          if (!big_end_first)
            result += '\0';
        }
      return result;
    }


    /// Puts a text somewhere into another one.
    void
    insert(std::string &text, const std::string &what, Random &random)
    {
      text.insert(random.below(text.size() + 1), what);
    }


    const std::vector<Change> changes = {
        {"empty", [](std::string &text, Random &) { text.clear(); }},
        {"one line end", [](std::string &text, Random &) { text = "\n"; }},
        {"truncated",
         [](std::string &text, Random &random) {
           text.resize(random.below(text.size() + 1));
         }},
        {"truncated by a few bytes",
         [](std::string &text, Random &random) {
           text.resize(text.size() - std::min(text.size(), random.below(20)));
         }},
        {"start cut off",
         [](std::string &text, Random &random) {
           text.erase(0, random.below(text.size() + 1));
         }},
        {"line ends CRLF",
         [](std::string &text, Random &) {
           text = replaced_all(text, "\n", "\r\n");
         }},
        {"line ends CR",
         [](std::string &text, Random &) {
           text = replaced_all(text, "\n", "\r");
         }},
        {"line ends mixed",
         [](std::string &text, Random &random) {
           std::string result;
           for (const char c : text)
             if (c == '\n')
               result += random.pick<std::string>({"\n", "\r", "\r\n", "\n\r"});
             else
               result += c;
           text = result;
         }},
        {"no line ends",
         [](std::string &text, Random &) {
           text = replaced_all(text, "\n", " ");
         }},
        {"byte order mark",
         [](std::string &text, Random &) { text = "\xEF\xBB\xBF" + text; }},
        {"UTF-16, little end first",
         [](std::string &text, Random &) { text = utf16(text, false); }},
        {"UTF-16, big end first",
         [](std::string &text, Random &) { text = utf16(text, true); }},
        {"letters of Latin-1",
         [](std::string &text, Random &random) {
           for (unsigned int i = 0; i < 5; ++i)
             insert(text,
                    std::string(1, static_cast<char>(0xC0 + random.below(64))),
                    random);
         }},
        {"no-break spaces",
         [](std::string &text, Random &) {
           text = replaced_all(text, " ", "\xC2\xA0");
         }},
        {"typographic minus",
         [](std::string &text, Random &) {
           text = replaced_all(text, "-", "\xE2\x88\x92");
         }},
        {"decimal commas",
         [](std::string &text, Random &) {
           text = replaced_all(text, ".", ",");
         }},
        {"NUL bytes",
         [](std::string &text, Random &random) {
           for (std::size_t i = 0, n = 1 + random.below(20); i < n; ++i)
             insert(text, std::string(1, '\0'), random);
         }},
        {"control characters",
         [](std::string &text, Random &random) {
           for (unsigned int i = 0; i < 5; ++i)
             insert(text,
                    std::string(1, static_cast<char>(1 + random.below(31))),
                    random);
           insert(text, "\x1B[2J\x1B]0;title\x07", random);
         }},
        {"bits turned",
         [](std::string &text, Random &random) {
           for (std::size_t i = 0, n = 1 + random.below(10);
                i < n && !text.empty();
                ++i)
             text[random.below(text.size())] ^=
                 static_cast<char>(1 << random.below(8));
         }},
        {"bytes replaced",
         [](std::string &text, Random &random) {
           for (std::size_t i = 0, n = 1 + random.below(30);
                i < n && !text.empty();
                ++i)
             text[random.below(text.size())] =
                 static_cast<char>(random.below(256));
         }},
        {"random bytes put in",
         [](std::string &text, Random &random) {
           insert(text, random.bytes(1 + random.below(300)), random);
         }},
        {"nothing but random bytes",
         [](std::string &text, Random &random) {
           text = random.bytes(random.below(20000));
         }},
        {"a picture's head",
         [](std::string &text, Random &) {
           text = "\x89PNG\r\n\x1A\n" + text;
         }},
        {"a program's head",
         [](std::string &text, Random &) {
           text = "\x7F"
                  "ELF\x02\x01" +
                  text;
         }},
        {"a stretch twice",
         [](std::string &text, Random &random) {
           if (text.empty())
             return;
           const std::size_t begin = random.below(text.size());
           insert(text, text.substr(begin, random.below(2000)), random);
         }},
        {"a stretch cut out",
         [](std::string &text, Random &random) {
           if (!text.empty())
             text.erase(random.below(text.size()), random.below(500));
         }},
        {"two megabytes of blanks",
         [](std::string &text, Random &random) {
           insert(text, std::string(2000000, ' '), random);
         }},
        {"two megabytes of line ends",
         [](std::string &text, Random &random) {
           insert(text, std::string(2000000, '\n'), random);
         }},
        {"a line of two megabytes", [](std::string &text, Random &random) {
           insert(text, std::string(2000000, 'x'), random);
         }}};
  } // namespace


  std::string
  mutate_bytes(std::string &text, Random &random)
  {
    const Change &change = random.pick(changes);
    change.second(text, random);
    return change.first;
  }
} // namespace Fuzz
