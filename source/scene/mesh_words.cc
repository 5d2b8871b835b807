#include <morsel/core/errors.h>
#include <morsel/core/sentences.h>
#include <morsel/scene/mesh_words.h>

#include <cmath>
#include <cstdlib>

namespace Morsel::Scene
{
  MeshWords::MeshWords(const std::string &file)
      : name(file)
      , stream(file)
  {}


  bool
  MeshWords::next(std::string &word)
  {
    while (!(line >> word))
      {
        std::string text;
        if (!std::getline(stream, text))
          return false;
        ++number;
        line.clear();
        line.str(text);
      }
    return true;
  }


  void
  MeshWords::skip_line()
  {
    line.str("");
  }


  unsigned long
  MeshWords::whole(const std::string &what)
  {
    const std::string word = expect(what);
    if (word.empty() || word.size() > 10 ||
        word.find_first_not_of("0123456789") != std::string::npos ||
        std::stoul(word) > largest_tag)
      refuse(word, what);
    return std::stoul(word);
  }


  double
  MeshWords::coordinate()
  {
    const std::string word  = expect("a coordinate");
    char             *end   = nullptr;
    const double      value = std::strtod(word.c_str(), &end);
    if (*end != '\0' || !(std::abs(value) <= 1e100))
      refuse(word, "a coordinate");
    return value;
  }


  void
  MeshWords::expect_word(const std::string &expected)
  {
    const std::string word = expect("'" + expected + "'");
    if (word != expected)
      refuse(word, "'" + expected + "'");
  }


  void
  MeshWords::refuse(const std::string &word, const std::string &what) const
  {
    fail("has '" + presentable(word) + "' where " + what + " is expected");
  }


  void
  MeshWords::fail(const std::string &what) const
  {
    throw InputError("line " + std::to_string(number) + " of the mesh '" +
                     name + "' " + what + ".");
  }


  std::string
  MeshWords::expect(const std::string &what)
  {
    std::string word;
    if (!next(word))
      throw InputError("the mesh '" + name + "' ends where " + what +
                       " is expected.");
    return word;
  }
} // namespace Morsel::Scene
