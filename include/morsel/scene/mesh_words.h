#ifndef morsel_scene_mesh_words_h
#define morsel_scene_mesh_words_h

#include <fstream>
#include <sstream>
#include <string>

namespace Morsel::Scene
{
  /// The words of a mesh's file, one after the other. Mistakes throw InputError
  /// that names the file and the line.
  class MeshWords
  {
  public:
    /// Numbers of physical groups and entities stay far from deal.II's own
    /// marks.
    static constexpr unsigned long largest_tag = 1000000000;

    explicit MeshWords(const std::string &file);

    /// False at the end of the file.
    bool
    next(std::string &word);

    void
    skip_line();

    /// A whole number, at most largest_tag.
    /// @param what is expected here, "a node's number"
    unsigned long
    whole(const std::string &what);

    /// At most 1e100: beyond this, areas are no longer numbers.
    double
    coordinate();

    void
    expect_word(const std::string &expected);

    [[noreturn]] void
    refuse(const std::string &word, const std::string &what) const;

    [[noreturn]] void
    fail(const std::string &what) const;

  private:
    std::string
    expect(const std::string &what);

    const std::string  name;
    std::ifstream      stream;
    std::istringstream line;
    unsigned int       number = 0;
  };
} // namespace Morsel::Scene

#endif
