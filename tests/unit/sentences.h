#ifndef morsel_tests_unit_sentences_h
#define morsel_tests_unit_sentences_h

#include <boost/test/unit_test.hpp>

#include <string>
#include <vector>

namespace Morsel
{
  /// That a text for users is one full sentence in one line, with these parts.
  inline void
  check_says(const std::string &text, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      BOOST_TEST((text.find(part) != std::string::npos),
                 "'" << text << "' does not say '" << part << "'");
    BOOST_TEST(text.find('\n') == std::string::npos);
    BOOST_TEST(text.back() == '.');
  }
} // namespace Morsel

#endif
