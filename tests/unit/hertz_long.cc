// Proves: a cylinder of finite elements on a block of particles, rigid or
// elastic, presses on it as Hertz says.
#include "../../source/bite.h"

#include <morsel/scene/read.h>

#include <deal.II/base/numbers.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace Morsel;

namespace
{
  struct Indentation
  {
    double force;         ///< per depth [N/m]
    double half_width;    ///< [m]
    double peak_pressure; ///< [Pa]
  };


  /// Of p^2 = p_0^2 (1 - x^2/a^2), by least squares over the nodes that bear
  /// more than a tenth of the largest pressure.
  Indentation
  measure(const Bite &bite, const double depth)
  {
    const auto         &surface = bite.get_plates()[0].surface;
    std::vector<double> x2, p2;
    double              largest = 0.;
    for (unsigned int k = 0; k < surface.nodes.size(); ++k)
      {
        const double p = surface.force[k][1] / (surface.tributary[k] * depth);
        x2.push_back(surface.nodes[k][0] * surface.nodes[k][0]);
        p2.push_back(p * p);
        largest = std::max(largest, p);
      }
    double n = 0., x = 0., y = 0., xx = 0., xy = 0.;
    for (unsigned int k = 0; k < x2.size(); ++k)
      if (p2[k] > 0.01 * largest * largest)
        {
          n += 1.;
          x += x2[k];
          y += p2[k];
          xx += x2[k] * x2[k];
          xy += x2[k] * p2[k];
        }
    const double slope = (n * xy - x * y) / (n * xx - x * x);
    const double top   = (y - slope * x) / n;
    return {surface.total_force()[1] / depth,
            std::sqrt(-top / slope),
            std::sqrt(top)};
  }
} // namespace


BOOST_AUTO_TEST_SUITE(hertz_long)

BOOST_AUTO_TEST_CASE(cylinder_on_block)
{
  constexpr double R = 0.05, flexibility = 1. - 0.3 * 0.3;
  for (const char *response : {"rigid", "quasi-static", "dynamic"})
    for (const unsigned int n : {100u, 200u})
      {
        const Scene::Scene scene = Scene::read_scene(
            MORSEL_SOURCE_DIR "/prm/jaw/hertz.prm",
            {std::string("Body cylinder/Deformation/Response=") + response,
             "Body block/Particles/Particles across=" + std::to_string(n)});
        RunLog log("", true, false);
        Bite   bite(scene, MPI_COMM_SELF, log);
        double error = 0., scale = 0.;
        for (bite.evaluate(); bite.time() < scene.time.end_time;
             bite.evaluate())
          {
            if (bite.step() % 20 == 0)
              {
                const auto e = bite.energies();
                scale        = std::max(scale, e.largest_term());
                error        = std::max(
                    error,
                    std::abs(e.external_work - e.stored() - e.dissipated()));
              }
            bite.advance();
          }
        const Indentation c = measure(bite, scene.depth);
        const double      of_both =
            flexibility / 70e9 +
            (response == std::string("rigid") ? 0. : flexibility / 210e9);
        const double a =
            std::sqrt(4. * c.force * R * of_both / dealii::numbers::PI);
        const double p = 2. * c.force / (dealii::numbers::PI * a);
        BOOST_TEST_MESSAGE(response
                           << ", " << n << " across: force " << 1e-6 * c.force
                           << " kN/mm, half width " << 1e3 * c.half_width
                           << " mm, over Hertz " << c.half_width / a
                           << ", peak pressure " << 1e-6 * c.peak_pressure
                           << " MPa, over Hertz " << c.peak_pressure / p
                           << "; ledger within " << error / scale << ", "
                           << bite.step() << " steps");
        BOOST_TEST(c.half_width == a, boost::test_tools::tolerance(0.03));
        BOOST_TEST(c.peak_pressure == p, boost::test_tools::tolerance(0.03));
        BOOST_TEST(error < 0.005 * scale);
      }
}

BOOST_AUTO_TEST_SUITE_END()
