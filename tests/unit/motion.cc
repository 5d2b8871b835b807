#include <morsel/core/errors.h>
#include <morsel/jaw/prescribed_motion.h>

#include "text_file.h"

#include <boost/test/unit_test.hpp>

#include <map>


using namespace Morsel::Jaw;

BOOST_AUTO_TEST_SUITE(motion)

namespace
{
  MotionParameters
  with_approach()
  {
    MotionParameters motion;
    motion.velocity        = dealii::Point<2>(0.06, -0.08);
    motion.ramp_time       = 1e-4;
    motion.approach        = 4e-4;
    motion.approach_factor = 5.;
    return motion;
  }


  /// A table that is read from a file with this text.
  MotionTable
  table_of(const std::string &text)
  {
    return read_motion_table(Morsel::TextFile(text, ".csv").name);
  }
} // namespace

BOOST_AUTO_TEST_CASE(velocity_is_the_derivative_of_the_displacement)
{
  for (const double factor : {1., 5.})
    {
      MotionParameters motion = with_approach();
      motion.approach_factor  = factor;
      const double dt         = 1e-8;
      for (double t = 0.; t < 6e-3; t += 1.37e-5)
        {
          const auto slope = (displacement_at(motion, t + 2. * dt) -
                              displacement_at(motion, t)) /
                             (2. * dt);
          BOOST_TEST((slope - velocity_at(motion, t + dt)).norm() < 1e-6);
        }
    }
}

BOOST_AUTO_TEST_CASE(the_approach_ends_where_it_is_told_to)
{
  const MotionParameters motion = with_approach();
  // 0.05 of the ramp, (0.2 - 0.025) mm at 0.5 m/s, then 0.2 mm at 0.3 m/s.
  const double end = 1e-4 + 0.175e-3 / 0.5 + 0.2e-3 / 0.3;
  BOOST_TEST(displacement_at(motion, end).norm() == 4e-4,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(velocity_at(motion, end).norm() == 0.1,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(velocity_at(motion, 3e-4).norm() == 0.5,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(displacement_at(motion, end + 1e-3).norm() == 5e-4,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(delay_is_what_the_displacement_lacks)
{
  for (const double factor : {1., 5.})
    {
      MotionParameters motion = with_approach();
      motion.approach_factor  = factor;
      BOOST_TEST(displacement_at(motion, 0.01).norm() ==
                     0.1 * (0.01 - motion.delay()),
                 boost::test_tools::tolerance(1e-12));
    }
  BOOST_TEST(with_approach().delay() < 0.);
  BOOST_TEST(MotionParameters().delay() == 0.);
}

BOOST_AUTO_TEST_CASE(tables_are_read_with_their_separators)
{
  // A head, comments, the separators of spreadsheets; the motion begins with
  // the first line.
  const auto table = table_of("t,x,y,angle\n# of the jaw\n"
                              "0.5, 1, 2, 10\n0.6; 1.5; 2; 40\n"
                              "\n0.7 1 3 100\n0.9\t1\t2\t10\n");
  BOOST_REQUIRE_EQUAL(table.time.size(), 4u);
  BOOST_TEST(table.time[1] == 0.6);
  BOOST_TEST(table.shift_x[1] == 0.5);
  BOOST_TEST(table.shift_y[2] == 1.);
  BOOST_TEST(table.shift_y[3] == 0.);
  BOOST_TEST(table.angle[2] == 0.5 * dealii::numbers::PI,
             boost::test_tools::tolerance(1e-14));

  MotionParameters motion;
  motion.kind  = "table";
  motion.table = table;
  BOOST_TEST(motion.turns());
  // Its fastest way between two lines: back from (1, 3) to (1, 2) takes 0.2 s,
  // from (1.5, 2) to (1, 3) 0.1 s.
  BOOST_TEST(motion.typical_velocity()[0] == -5.,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(motion.typical_velocity()[1] == 10.,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(mistakes_in_tables_are_told)
{
  const std::string good = "0 0 0\n1 0 0\n2 0 0\n3 0 0\n";
  BOOST_TEST(table_of(good).time.size() == 4u);
  for (const auto &[text, reason] : std::map<std::string, std::string>{
           {good + "4 0\n", "line 5 is not 't x y' or 't x y angle'"},
           {good + "4 0 0 0 0\n", "line 5 is not 't x y'"},
           {good + "4 0 north\n", "line 5 is not 't x y'"},
           {good + "2.5 0 0\n", "line 5: times must increase"},
           {"0 0 0\n1 0 0\n", "it has 2 lines of numbers; give at least 4"},
           {"", "it has 0 lines of numbers"}})
    BOOST_CHECK_EXCEPTION(table_of(text),
                          Morsel::InputError,
                          [reason = reason](const auto &error) {
                            return std::string(error.what()).find(reason) == 0;
                          });
  BOOST_CHECK_EXCEPTION(
      read_motion_table("/dev/zero"),
      Morsel::InputError,
      [](const auto &error) {
        return std::string(error.what()).find("there is no file") == 0;
      });
}

BOOST_AUTO_TEST_SUITE_END()
