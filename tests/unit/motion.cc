#include <morsel/jaw/prescribed_motion.h>

#include <boost/test/unit_test.hpp>

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

BOOST_AUTO_TEST_SUITE_END()
