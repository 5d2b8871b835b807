#include <morsel/core/errors.h>
#include <morsel/plan/plan.h>
#include <morsel/plan/setting.h>

#include <boost/test/unit_test.hpp>

#include <fstream>

using namespace Morsel;
using namespace Morsel::Plan;

BOOST_AUTO_TEST_SUITE(plan)

namespace
{
  /// First order, with one lucky run at size 2.
  Method
  coarse_method()
  {
    Method method;
    method.name       = "coarse";
    method.title      = "Coarse";
    method.size_label = "cells per crack length";
    method.entries    = {{"Method", "XFEM"}, {"XFEM/Degree", "1"}};
    method.formulas   = {{"XFEM/Cells along x", "ceil(size*width/length-1e-6)"},
                         {"XFEM/Enrichment radius", "0.9*length"}};
    method.runs       = {{1., 1e-1}, {2., 1e-5}, {4., 4e-2}, {8., 2e-2}};
    return method;
  }


  /// Fourth order.
  Method
  fine_method()
  {
    Method method = coarse_method();
    method.name   = "fine";
    method.title  = "Fine";
    method.runs   = {{1., 1e-2}, {10., 1e-6}};
    return method;
  }


  SceneSizes
  small_crack()
  {
    SceneSizes sizes;
    sizes.name  = "plate";
    sizes.kind  = "cracked plate";
    sizes.scene = {{"width", 0.01},
                   {"height", 0.02},
                   {"shorter", 0.01},
                   {"length", 0.0005}};
    return sizes;
  }


  Record
  record_of(const std::vector<Method> &methods)
  {
    Record record;
    record.kind    = "cracked plate";
    record.methods = methods;
    return record;
  }


  /// A second for each cell along x.
  Prediction
  by_cells(const std::vector<std::string> &overrides)
  {
    Prediction prediction;
    for (const std::string &text : overrides)
      if (text.rfind("XFEM/Cells along x=", 0) == 0)
        prediction.seconds = std::stod(text.substr(19));
    return prediction;
  }
} // namespace


BOOST_AUTO_TEST_CASE(accuracy_is_a_share_or_a_percentage)
{
  BOOST_CHECK_CLOSE(read_accuracy("1e-3"), 1e-3, 1e-9);
  BOOST_CHECK_CLOSE(read_accuracy("0.1%"), 1e-3, 1e-9);
  BOOST_CHECK_CLOSE(read_accuracy(" 0.1 % "), 1e-3, 1e-9);
  for (const char *text :
       {"", "%", "good", "0", "-1e-3", "1", "100%", "nan", "inf", "1e-3 m"})
    BOOST_CHECK_THROW(read_accuracy(text), InputError);
}


BOOST_AUTO_TEST_CASE(a_lucky_run_does_not_count)
{
  // 1e-5 at size 2 is followed by 4e-2 at size 4.
  const auto size = size_to_reach(coarse_method(), 3.6e-2);
  BOOST_REQUIRE(size);
  // First order between 4 and 8: error 0.16 / size, and the margin.
  BOOST_CHECK_CLOSE(*size, interpolation_margin * 0.16 / 3.6e-2, 1e-6);
  // No further than the next recorded size.
  BOOST_CHECK_EQUAL(*size_to_reach(coarse_method(), 2.5e-2), 8.);
  BOOST_CHECK_EQUAL(*size_to_reach(coarse_method(), 2e-2), 8.);
  BOOST_CHECK(!size_to_reach(coarse_method(), 1e-2));
  // Less than the smallest recorded size is never proposed.
  BOOST_CHECK_EQUAL(*size_to_reach(fine_method(), 0.5), 1.);
  BOOST_CHECK_EQUAL(largest_run(fine_method()).error, 1e-6);
}


BOOST_AUTO_TEST_CASE(sizes_are_translated_to_the_scene)
{
  const auto overrides =
      overrides_of(coarse_method(), 2.5, small_crack().scene, {});
  const std::vector<std::string> expected = {"Method=XFEM",
                                             "XFEM/Degree=1",
                                             "XFEM/Cells along x=50",
                                             "XFEM/Enrichment radius=0.00045"};
  BOOST_CHECK_EQUAL_COLLECTIONS(
      overrides.begin(), overrides.end(), expected.begin(), expected.end());
}


BOOST_AUTO_TEST_CASE(each_body_has_sizes_of_its_own)
{
  Method method;
  method.entries  = {{"Body {body}/Particles/Filling", "relaxed"},
                     {"Output/Fields", "false"}};
  method.formulas = {
      {"Body {body}/Particles/Particles across", "ceil(size*width/thickness)"}};
  const auto overrides =
      overrides_of(method,
                   4.,
                   {},
                   {{"ring", {{"width", 2.}, {"thickness", 1.}}},
                    {"beam", {{"width", 6.}, {"thickness", 0.5}}}});
  const std::vector<std::string> expected = {
      "Body ring/Particles/Filling=relaxed",
      "Output/Fields=false",
      "Body ring/Particles/Particles across=8",
      "Body beam/Particles/Filling=relaxed",
      "Body beam/Particles/Particles across=48"};
  BOOST_CHECK_EQUAL_COLLECTIONS(
      overrides.begin(), overrides.end(), expected.begin(), expected.end());
}


BOOST_AUTO_TEST_CASE(an_unknown_size_in_a_formula_is_named)
{
  Method method   = coarse_method();
  method.formulas = {{"XFEM/Cells along x", "size*breadth"}};
  BOOST_CHECK_EXCEPTION(overrides_of(method, 1., small_crack().scene, {}),
                        FileError,
                        [](const FileError &error) {
                          return std::string(error.what()).find("breadth") !=
                                 std::string::npos;
                        });
}


BOOST_AUTO_TEST_CASE(the_cheapest_method_is_chosen)
{
  const std::vector<Record> records = {
      record_of({coarse_method(), fine_method()})};
  const auto plan = make_plan(small_crack(), records, 3e-2, by_cells);
  BOOST_REQUIRE(plan.chosen);
  // 160 cells of the one, 20 of the other.
  BOOST_CHECK_EQUAL(plan.proposals[*plan.chosen].title, "Fine");
  BOOST_CHECK_EQUAL(plan.proposals[0].prediction.seconds, 160.);
  BOOST_CHECK_EQUAL(plan.proposals[1].prediction.seconds, 20.);
  const std::string text = as_text(plan, "plate.prm", {"Title=Mine"});
  BOOST_CHECK(text.find("--set \"Title=Mine\"") != std::string::npos);
  BOOST_CHECK(text.find("--set \"XFEM/Cells along x=20\"") !=
              std::string::npos);
}


BOOST_AUTO_TEST_CASE(a_method_that_cannot_is_shown_and_not_chosen)
{
  const std::vector<Record> records = {
      record_of({coarse_method(), fine_method()})};
  const auto plan = make_plan(small_crack(), records, 1e-3, by_cells);
  BOOST_CHECK(!plan.proposals[0].possible);
  BOOST_CHECK_EQUAL(*plan.chosen, 1);
  BOOST_CHECK(as_text(plan, "plate.prm", {}).find("reaches 2 %") !=
              std::string::npos);

  // One whose setting the scene refuses.
  const auto refuse = [](const std::vector<std::string> &) -> Prediction {
    throw InputError("too many cells.");
  };
  BOOST_CHECK_THROW(make_plan(small_crack(), records, 1e-3, refuse),
                    InputError);
}


BOOST_AUTO_TEST_CASE(an_accuracy_out_of_reach_names_the_best)
{
  const std::vector<Record> records = {
      record_of({coarse_method(), fine_method()})};
  BOOST_CHECK_EXCEPTION(make_plan(small_crack(), records, 1e-8, by_cells),
                        InputError,
                        [](const InputError &error) {
                          const std::string text = error.what();
                          return text.find("0.0001 %") != std::string::npos &&
                                 text.find("'Fine'") != std::string::npos;
                        });
}


BOOST_AUTO_TEST_CASE(cracks_have_a_length_that_counts)
{
  Fracture::PlateScene plate;
  const auto           length = [&plate](const std::string &paths) {
    plate.paths = paths;
    return sizes_of_plate(plate).scene.at("length");
  };
  BOOST_CHECK_CLOSE(length("0, 0.005 > 0.0007, 0.005"), 7e-4, 1e-9);
  // At most a tenth of the plate.
  BOOST_CHECK_CLOSE(length("0, 0.005 > 0.004, 0.005"), 1e-3, 1e-9);
  // Half of a crack with two tips.
  BOOST_CHECK_CLOSE(length("0.0046, 0.005 > 0.0054, 0.005"), 4e-4, 1e-9);
  // Close to the far side; and to another crack.
  BOOST_CHECK_CLOSE(length("0, 0.005 > 0.0098, 0.005"), 2e-4, 1e-6);
  BOOST_CHECK_CLOSE(
      length("0, 0.005 > 0.005, 0.005; 0.01, 0.0056 > 0.005, 0.0056"),
      3e-4,
      1e-6);
  plate.paths = "";
  BOOST_CHECK(sizes_of_plate(plate).kind.empty());
}


BOOST_AUTO_TEST_CASE(thickness_is_that_of_strips)
{
  Scene::Scene        scene;
  Scene::ParticleBody body;
  body.name               = "beam";
  body.shape.upper_corner = {100., 1.};
  scene.particle_bodies.push_back(body);
  scene.time.solution    = "static";
  const SceneSizes sizes = sizes_of_bodies(scene);
  BOOST_CHECK_EQUAL(sizes.kind, "static body");
  BOOST_CHECK_CLOSE(
      sizes.bodies.front().second.at("thickness"), 100. / 101., 1e-9);
}


BOOST_AUTO_TEST_CASE(records_that_ship_are_understood)
{
  for (const char *kind :
       {"cracked plate", "static body", "body in motion", "stroke"})
    {
      const std::vector<Record> records = shipped_records(kind);
      BOOST_CHECK(!records.empty());
      for (const Record &record : records)
        for (const Method &method : record.methods)
          BOOST_CHECK(method.runs.size() > 2);
    }
  BOOST_CHECK_THROW(read_record({{"kind", "stroke"}}, "mine.json"), FileError);
}

BOOST_AUTO_TEST_SUITE_END()
