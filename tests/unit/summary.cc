#include <morsel/core/errors.h>
#include <morsel/output/digest.h>
#include <morsel/output/summary.h>

#include <deal.II/base/exceptions.h>

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>
#include <limits>

using namespace Morsel;

namespace
{
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  std::string
  temporary(const std::string &name)
  {
    const auto folder =
        std::filesystem::temp_directory_path() / "morsel_unit_summary";
    std::filesystem::create_directories(folder);
    return (folder / name).string();
  }


  std::string
  content(const std::string &file_name)
  {
    std::ifstream in(file_name);
    return {std::istreambuf_iterator<char>(in), {}};
  }


  template <typename Error>
  auto
  says(const std::string &part)
  {
    return [part](const Error &e) {
      return std::string(e.what()).find(part) != std::string::npos;
    };
  }
} // namespace


BOOST_AUTO_TEST_SUITE(summaries)


BOOST_AUTO_TEST_CASE(what_is_added_is_found_in_the_file)
{
  Output::Summary summary;
  summary.add("compressive_strength", 1.0e5, "Pa", "Peak stress", 1.25e5);
  summary.add("step_count", 12., "1", "Steps");
  summary.add("step_count", 13., "1", "Steps");
  summary.add("zero_error", 3., "J", "With its own error", 0., 0.5);
  summary.add_effect({"damage",
                      true,
                      "the scene asks for it",
                      "damage and broken bonds",
                      true,
                      "nothing breaks",
                      1.5,
                      0.25});
  summary.add_effect({"friction", false, "", "contact"});
  summary.add_part("time loop", 2.5);
  summary.add_text("scene", "peanut \xff with a byte that is not UTF-8");

  const auto file = temporary("summary.json");
  summary.write(file);
  const auto read = nlohmann::json::parse(content(file));
  BOOST_CHECK_EQUAL(read["compressive_strength"]["value"], 1.0e5);
  BOOST_CHECK_EQUAL(read["compressive_strength"]["unit"], "Pa");
  BOOST_CHECK_CLOSE(
      read["compressive_strength"]["error"].get<double>(), -0.2, 1e-10);
  BOOST_CHECK_EQUAL(read["step_count"]["value"], 13.);
  BOOST_CHECK(!read["step_count"].contains("reference"));
  BOOST_CHECK_EQUAL(read["zero_error"]["error"], 0.5);
  BOOST_CHECK_EQUAL(read["effects"][0]["name"], "damage");
  BOOST_CHECK_EQUAL(read["effects"][0]["share"], 0.25);
  BOOST_CHECK_EQUAL(read["effects"][0]["without"], "nothing breaks");
  BOOST_CHECK_EQUAL(read["effects"][0]["part"], "damage and broken bonds");
  BOOST_CHECK_EQUAL(read["effects"][1]["wall_time"], 0.);
  BOOST_CHECK(!read["effects"][1].contains("part"));
  BOOST_CHECK_EQUAL(read["parts"][0]["wall_time"], 2.5);
  BOOST_CHECK(read["text"].contains("scene"));
  BOOST_CHECK(summary.has("step_count") && !summary.has("damage"));
  BOOST_CHECK_EQUAL(summary.value("step_count"), 13.);
}


BOOST_AUTO_TEST_CASE(bad_numbers_and_names_are_refused)
{
  Output::Summary summary;
  BOOST_CHECK_EXCEPTION(summary.add("force", not_a_number, "N", ""),
                        NumericalError,
                        says<NumericalError>("'force'"));
  BOOST_CHECK_THROW(summary.add("force", 1., "N", "", not_a_number),
                    NumericalError);
  BOOST_CHECK_THROW(summary.add("Peak force", 1., "N", ""),
                    dealii::ExceptionBase);
  BOOST_CHECK_THROW(summary.add("effects", 1., "N", ""), dealii::ExceptionBase);
  BOOST_CHECK_NO_THROW(summary.add("stress_intensity_I", 1., "Pa", ""));
  BOOST_CHECK_THROW(summary.value("force"), dealii::ExceptionBase);
}


BOOST_AUTO_TEST_CASE(an_unwritable_place_is_named)
{
  const Output::Summary summary;
  BOOST_CHECK_EXCEPTION(summary.write("/nonexistent/summary.json"),
                        FileError,
                        says<FileError>("/nonexistent/summary.json"));
}


BOOST_AUTO_TEST_CASE(digests)
{
  Output::Digest digest;
  digest.add("closure_mm", 0.0015, 1e3);
  BOOST_CHECK_THROW(digest.add("force", not_a_number), NumericalError);
  const auto file = temporary("output");
  digest.write(file);
  BOOST_CHECK_EQUAL(content(file), "closure_mm 1.5\n");
}


BOOST_AUTO_TEST_SUITE_END()
