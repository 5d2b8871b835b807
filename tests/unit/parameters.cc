// Reading of parameter files: what is taken, and what a user is told.
#include <morsel/core/errors.h>
#include <morsel/core/parameters.h>
#include <morsel/core/sentences.h>
#include <morsel/core/suggestions.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/point.h>

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace Morsel;

namespace
{
  /// A folder that goes with the test.
  struct Folder
  {
    Folder()
    {
      path = std::filesystem::temp_directory_path() /
             ("morsel-parameters-" + std::to_string(getpid()));
      std::filesystem::create_directories(path / "sub");
    }

    ~Folder()
    {
      std::filesystem::remove_all(path);
    }

    std::string
    write(const std::string &name, const std::string &text) const
    {
      std::ofstream(path / name) << text;
      return (path / name).string();
    }

    std::filesystem::path path;
  };


  /// The message of the InputError that the work throws.
  template <typename Work>
  std::string
  mistake(const Work &work)
  {
    try
      {
        work();
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "no mistake";
  }


  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }


  struct Parameters
  {
    double           length = 0.5;
    std::string      law    = "linear";
    dealii::Point<2> corner;

    Parameters()
    {
      using namespace dealii;
      prm.enter_subsection("Block");
      prm.add_parameter(
          "Length", length, "Length [m], below 1.", Patterns::Double(0., 1.));
      prm.add_parameter("Corner", corner, "Corner [m].");
      prm.leave_subsection();
      prm.add_parameter(
          "Law", law, "Elastic law.", Patterns::Selection("linear|cubic"));
    }

    void
    set(const std::string &section,
        const std::string &key,
        const std::string &value)
    {
      set_parameters(prm, {{section, key, value, "a.prm:7"}});
    }

    dealii::ParameterHandler prm;
  };
} // namespace


BOOST_AUTO_TEST_SUITE(parameters)

BOOST_AUTO_TEST_CASE(a_file_gives_its_entries_in_order)
{
  const Folder      folder;
  const std::string file    = folder.write("a.prm",
                                        "# comment\n"
                                           "set Law = linear # more\n"
                                           "subsection  Body   food\n"
                                           "  set Long value = 1, \\\n"
                                           "    2\n"
                                           "end\n");
  const auto        entries = read_parameter_file(file);
  BOOST_REQUIRE_EQUAL(entries.size(), 2u);
  BOOST_TEST(entries[0].path() == "Law");
  BOOST_TEST(entries[0].value == "linear");
  BOOST_TEST(entries[0].where == file + ":2");
  BOOST_TEST(entries[1].path() == "Body food/Long value");
  BOOST_TEST(entries[1].value == "1, 2");
  BOOST_TEST(entries[1].where == file + ":4");
}


BOOST_AUTO_TEST_CASE(an_included_file_is_sought_beside_its_includer)
{
  const Folder folder;
  folder.write("base.prm", "set A = 1\nset B = 1\n");
  const std::string middle =
      folder.write("sub/middle.prm", "include ../base.prm\nset B = 2\n");
  const auto entries = read_parameter_file(middle);
  BOOST_REQUIRE_EQUAL(entries.size(), 3u);
  BOOST_TEST(last_value(entries, "A", "") == "1");
  BOOST_TEST(last_value(entries, "B", "") == "2");
  BOOST_TEST(last_value(entries, "C", "none") == "none");
  BOOST_TEST(last_place(entries, "B") == middle + ":2");
}


BOOST_AUTO_TEST_CASE(malformed_files_are_refused_with_their_line)
{
  const Folder folder;
  const auto   message = [&](const std::string &text) {
    return mistake([&] { read_parameter_file(folder.write("bad.prm", text)); });
  };
  BOOST_TEST(contains(message("\nend\n"), "bad.prm:2: This 'end'"));
  BOOST_TEST(contains(message("sett A = 1\n"), "Did you mean 'set'?"));
  BOOST_TEST(contains(message("set A\n"), "'set <entry> = <value>'"));
  BOOST_TEST(contains(message("subsection A\n"), "an 'end' is missing"));
  BOOST_TEST(contains(message("subsection\nend\n"), "needs a name"));
  BOOST_TEST(contains(message("include bad.prm\n"), "includes itself"));
  BOOST_TEST(contains(message("include ./bad.prm\n"), "includes itself"));
  BOOST_TEST(contains(message("include /dev/zero\n"), "no ordinary file"));
  BOOST_TEST(contains(message(std::string("s\0e\0t\0", 6)), "UTF-16"));
  BOOST_TEST(
      contains(message("\r\nset A = 1\rset B = 2\n"), "bad.prm:2: A carr"));
}


BOOST_AUTO_TEST_CASE(overrides_name_section_and_key)
{
  const ParameterEntry entry = read_override("Body food/Material/Name = a=b");
  BOOST_TEST(entry.section == "Body food/Material");
  BOOST_TEST(entry.key == "Name");
  BOOST_TEST(entry.value == "a=b");
  BOOST_TEST(read_override("Depth=1").section.empty());
  BOOST_TEST(contains(mistake([] { read_override("Depth"); }), "Give '--set"));
  BOOST_TEST(
      contains(mistake([] { read_override("A=\xE9"); }), "no text in UTF-8"));
  BOOST_TEST(contains(mistake([] { read_override("=1"); }), "Give '--set"));
}


BOOST_AUTO_TEST_CASE(entries_reach_the_bound_members)
{
  Parameters p;
  p.set("Block", "Length", "0.25");
  p.set("Block", "Corner", "1e-3, -2");
  p.set("", "Law", "cubic");
  BOOST_TEST(p.length == 0.25);
  BOOST_TEST(p.corner[0] == 1e-3);
  BOOST_TEST(p.corner[1] == -2.);
  BOOST_TEST(p.law == "cubic");
}


BOOST_AUTO_TEST_CASE(refused_entries_are_explained)
{
  Parameters p;
  BOOST_TEST(mistake([&] { p.set("Block", "Length", "2"); }) ==
             "a.prm:7: 'Block/Length' = '2' is not allowed: give a number from "
             "0 to 1 in m.");
  BOOST_TEST(contains(mistake([&] { p.set("Block", "Length", "2 mm"); }),
                      "Write the number alone"));
  BOOST_TEST(contains(mistake([&] { p.set("Block", "Corner", "1"); }),
                      "2 numbers separated by commas"));
  BOOST_TEST(contains(mistake([&] { p.set("", "Law", "liner"); }),
                      "one of 'linear' and 'cubic'. Did you mean 'linear'?"));
  BOOST_TEST(contains(mistake([&] { p.set("Block", "Lenght", "1"); }),
                      "Did you mean 'Length'?"));
  BOOST_TEST(contains(mistake([&] { p.set("Blok", "Length", "1"); }),
                      "no section 'Blok'. Did you mean 'Block'?"));
  BOOST_TEST(contains(mistake([&] { p.set("", "Length", "1"); }),
                      "stands in section 'Block'"));
}


BOOST_AUTO_TEST_CASE(printed_parameters_read_back)
{
  const Folder folder;
  Parameters   p;
  p.set("Block", "Length", "0.125");
  for (const bool documented : {false, true})
    {
      Parameters q;
      const auto entries = read_parameter_file(
          folder.write("used.prm", parameters_as_prm(p.prm, documented)));
      set_parameters(q.prm, entries);
      BOOST_TEST(q.length == 0.125);
    }
  BOOST_TEST(contains(parameters_as_json(p.prm), "\"unit\": \"m\""));
  BOOST_TEST(contains(parameters_as_markdown(p.prm),
                      "| Length | `0.5` | a number from 0 to 1 |"));
}


BOOST_AUTO_TEST_CASE(suggestions_are_near)
{
  BOOST_TEST(edit_distance("Depth", "depth") == 0u);
  BOOST_TEST(edit_distance("penalty", "penatly") == 1u);
  BOOST_TEST(edit_distance("", "abc") == 3u);
  BOOST_TEST(nearest("carrot", {"almond", "raw carrot"}) == "raw carrot");
  BOOST_TEST(nearest("xyz", {"almond", "raw carrot"}).empty());
  BOOST_TEST(quoted_list({"a", "b", "c"}) == "'a', 'b' and 'c'");
}


BOOST_AUTO_TEST_CASE(messages_can_be_shown)
{
  BOOST_TEST(as_sentence("a") == "a.");
  BOOST_TEST(as_sentence("a?") == "a?");
  BOOST_TEST(as_sentence("") == ".");
  BOOST_TEST(presentable("\x1B[2J\r \xE9 \xC3\xA9\n") == "?[2J? ? \xC3\xA9\n");
  const std::string text = presentable("'" + std::string(800, 'a') + "' = '" +
                                       std::string(801, 'b') + "' is long.");
  BOOST_TEST(text == "'" + std::string(800, 'a') + "' = '" +
                         std::string(100, 'b') + " ... " +
                         std::string(100, 'b') + "' is long.");
}


BOOST_AUTO_TEST_CASE(the_hash_is_that_of_fnv_1a)
{
  BOOST_TEST(text_hash("") == "cbf29ce484222325");
  BOOST_TEST(text_hash("a") == "af63dc4c8601ec8c");
}

BOOST_AUTO_TEST_SUITE_END()
