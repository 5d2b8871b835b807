// Proves: the files of fields that runs leave hold what theory says of the
// solution: volumes, the mean stress that the loads ask for, an open crack,
// Lame's displacement and stress, tractions that add up to the plates' forces.
#include <morsel/core/vtu.h>
#include <morsel/fracture_run.h>
#include <morsel/scene/read.h>
#include <morsel/simulation.h>

#include <deal.II/base/hdf5.h>
#include <deal.II/base/utilities.h>

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>

#include <unistd.h>

using namespace Morsel;

namespace
{
  namespace tt = boost::test_tools;

  const std::string gallery = MORSEL_SOURCE_DIR "/prm/";


  /// A folder of results that is removed in the end.
  struct Folder
  {
    const std::string name =
        (std::filesystem::temp_directory_path() /
         ("morsel_field_files_" + std::to_string(::getpid())))
            .string();

    ~Folder()
    {
      std::filesystem::remove_all(name);
    }

    std::string
    content(const std::string &file) const
    {
      std::ifstream in(name + "/" + file, std::ios::binary);
      BOOST_REQUIRE_MESSAGE(in, "there is no file " << file);
      return {std::istreambuf_iterator<char>(in), {}};
    }

    /// A field of the last frame of a series.
    dealii::FullMatrix<double>
    frame(const std::string &series, const std::string &field) const
    {
      std::string last;
      for (const auto &file :
           std::filesystem::directory_iterator(name + "/solution"))
        if (file.path().extension() == ".h5" &&
            file.path().filename().string().rfind(series + "_0", 0) == 0)
          last = std::max(last, file.path().string());
      BOOST_REQUIRE_MESSAGE(!last.empty(), "no frames of " << series);
      return dealii::HDF5::File(last, dealii::HDF5::File::FileAccessMode::open)
          .open_dataset(field)
          .read<dealii::FullMatrix<double>>();
    }

    double
    result(const std::string &key) const
    {
      return nlohmann::json::parse(content("summary.json"))[key]["value"];
    }
  };


  /// An array of a ParaView file by its name.
  template <typename T = double>
  std::vector<T>
  array_of(const std::string &vtu, const std::string &name)
  {
    const std::size_t head = vtu.find("Name=\"" + name + "\"");
    BOOST_REQUIRE_MESSAGE(head != std::string::npos, "no array " << name);
    const std::size_t                begin = vtu.find('>', head) + 1;
    const std::vector<unsigned char> bytes = dealii::Utilities::decode_base64(
        vtu.substr(begin, vtu.find('<', begin) - begin));
    std::uint64_t length = 0;
    BOOST_REQUIRE(bytes.size() >= sizeof(length));
    std::memcpy(&length, bytes.data(), sizeof(length));
    BOOST_REQUIRE_EQUAL(bytes.size(), sizeof(length) + length);
    std::vector<T> values(length / sizeof(T));
    std::memcpy(values.data(), bytes.data() + sizeof(length), length);
    return values;
  }


  double
  sum(const std::vector<double> &values)
  {
    return std::accumulate(values.begin(), values.end(), 0.);
  }


  /// Integral of a component of the particles' stress over the body [N].
  double
  integral_of_stress(const std::string &particles, const unsigned int component)
  {
    const auto stress = array_of(particles, "stress_xx_yy_zz_xy");
    const auto volume = array_of(particles, "volume");
    BOOST_REQUIRE_EQUAL(stress.size(), 4 * volume.size());
    double integral = 0.;
    for (std::size_t i = 0; i < volume.size(); ++i)
      integral += volume[i] * stress[4 * i + component];
    return integral;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(field_files)


BOOST_AUTO_TEST_CASE(a_cracked_plate_of_particles)
{
  const Folder folder;
  CommandLine  command_line;
  command_line.scene_file           = gallery + "fracture/m1_sph.prm";
  command_line.overrides            = {"SPH/Particles along x=30",
                                       "SPH/Particles along y=30"};
  command_line.run.output_directory = folder.name;
  command_line.run.quiet            = true;
  run_fracture_scene(command_line);

  // Against the virtual displacement (0, y) traction at the top works, and
  // nothing at the clamp.
  const std::string particles = folder.content("solution/particles.vtu");
  BOOST_TEST(array_of(particles, "volume").size() == 900u);
  BOOST_TEST(sum(array_of(particles, "volume")) == 1e-4, tt::tolerance(1e-10));
  BOOST_TEST(integral_of_stress(particles, 1) == 1000. * 1e-4,
             tt::tolerance(1e-8));

  // The faces of an edge crack in a half plane part by 4 * 1.454 sigma a/E' at
  // the mouth (Tada, Paris and Irwin).
  const std::string cells = folder.content("solution/plate.vtu");
  BOOST_TEST(sum(array_of(cells, "area")) == 1e-4, tt::tolerance(1e-10));
  const auto points   = array_of(cells, "points");
  const auto u        = array_of(cells, "displacement");
  const auto distance = array_of(cells, "distance_over_ring");
  double     lowest = 1., highest = -1.;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (points[3 * i] < 1e-9 && std::abs(points[3 * i + 1] - 0.005) < 1e-9)
      {
        lowest  = std::min(lowest, u[3 * i + 1]);
        highest = std::max(highest, u[3 * i + 1]);
      }
  BOOST_TEST(highest - lowest == 4. * 1.454 * 1000. * 0.001 * 0.91 / 1e7,
             tt::tolerance(0.1));
  BOOST_TEST(*std::min_element(distance.begin(), distance.end()) < 0.1);

  // The mean of the rings is the result.
  std::istringstream table(folder.content("stress_intensity.csv"));
  double             mean   = 0.;
  unsigned int       n_rows = 0;
  for (std::string row; std::getline(table, row);)
    {
      const auto words = dealii::Utilities::split_string_list(row, ',');
      if (words.size() != 11 || words[0] != "0")
        continue;
      mean += std::stod(words[8]);
      ++n_rows;
    }
  BOOST_REQUIRE(n_rows > 1u);
  BOOST_TEST(mean / n_rows == folder.result("stress_intensity_I"),
             tt::tolerance(1e-3));
}


BOOST_AUTO_TEST_CASE(a_static_body_of_particles)
{
  const Folder       folder;
  const Scene::Scene scene =
      Scene::read_scene(gallery + "sph/lame_cylinder.prm",
                        {"Body ring/Particles/Particles across=20"});
  RunOptions options;
  options.output_directory = folder.name;
  options.quiet            = true;
  run_simulation(scene, options);

  const double      area      = 0.25 * M_PI * (4. - 1.);
  const std::string particles = folder.content("solution/ring_particles.vtu");
  const auto        points    = array_of(particles, "points");
  const auto        u         = array_of(particles, "displacement");
  const auto        stress    = array_of(particles, "stress_xx_yy_zz_xy");
  const auto        mises     = array_of(particles, "von_mises_stress");
  BOOST_TEST(sum(array_of(particles, "volume")) == area, tt::tolerance(1e-3));
  const auto volume = array_of(particles, "volume");
  double     error = 0., size = 0., worst_trace = 0.;
  for (std::size_t i = 0; i < mises.size(); ++i)
    {
      // Lame: u_r = 4.33e-4 r (0.4 + 4/r^2), stress_xx + stress_yy = 2/3.
      const dealii::Point<2> p(points[3 * i], points[3 * i + 1]);
      const auto             exact = 4.333333e-4 * (0.4 + 4. / p.square()) * p;
      error += volume[i] *
               (dealii::Point<2>(u[3 * i], u[3 * i + 1]) - exact).norm_square();
      size += volume[i] * exact.square();
      const double *const s = &stress[4 * i];
      worst_trace = std::max(worst_trace, std::abs(1.5 * (s[0] + s[1]) - 1.));
      BOOST_TEST(s[2] == 0.3 * (s[0] + s[1]), tt::tolerance(1e-9));
    }
  BOOST_TEST(std::sqrt(error / size) < 0.01);
  BOOST_TEST(std::sqrt(error / size) ==
                 folder.result("displacement_error_ring"),
             tt::tolerance(1e-6));
  BOOST_TEST(worst_trace < 0.1);

  const std::string cells = folder.content("solution/ring_cells.vtu");
  BOOST_TEST(array_of(cells, "area").size() == mises.size());
  const std::string outline = folder.content("solution/ring_outline.vtu");
  const auto        line    = array_of(outline, "points");
  for (std::size_t i = 0; i < line.size(); i += 3)
    {
      const double r = std::hypot(line[i], line[i + 1]);
      BOOST_TEST((r > 0.999 && r < 2.001));
    }
  BOOST_TEST(line.front() == line[line.size() - 3]);
}


BOOST_AUTO_TEST_CASE(a_stroke_between_elastic_plates)
{
  const Folder             folder;
  std::vector<std::string> overrides = {
      "Body food/Particles/Particles across=24",
      "Body food/Damage/Enabled=false",
      "Time/End time=3e-4"};
  for (const std::string plate : {"lower", "upper"})
    overrides.push_back("Body " + plate +
                        " plate/Material/Young's modulus=239e6");
  const Scene::Scene scene =
      Scene::read_scene(gallery + "jaw/peanut_elastic.prm", overrides);
  RunOptions options;
  options.output_directory = folder.name;
  options.quiet            = true;
  run_simulation(scene, options);

  // As they were, the particles fill the block.
  const auto  &block = scene.particle_bodies[0].shape;
  const double half  = 0.5 * scene.particle_bodies[0].spacing;
  const auto   nodes = folder.frame("food", "nodes");
  const auto   moved = folder.frame("food", "displacement");
  BOOST_REQUIRE_EQUAL(nodes.m(), 576u);
  for (unsigned int d = 0; d < 2; ++d)
    {
      double lowest = 1., highest = -1.;
      for (unsigned int i = 0; i < nodes.m(); ++i)
        {
          lowest  = std::min(lowest, nodes(i, d) - moved(i, d));
          highest = std::max(highest, nodes(i, d) - moved(i, d));
        }
      BOOST_TEST(lowest == block.lower_corner[d] + half, tt::tolerance(1e-9));
      BOOST_TEST(highest == block.upper_corner[d] - half, tt::tolerance(1e-9));
    }

  for (unsigned int p = 0; p < 2; ++p)
    {
      const double force = folder.frame("plates", "force")(4 * p, 1);
      // Its tractions, linear along each facet, add up to its force.
      const auto line     = folder.frame("surfaces", "nodes");
      const auto number   = folder.frame("surfaces", "plate");
      const auto traction = folder.frame("surfaces", "traction");
      double     sum      = 0.;
      for (unsigned int k = 0; k < line.m(); k += 2)
        if (number(k, 0) == p)
          sum += 0.5 * (traction(k, 1) + traction(k + 1, 1)) * scene.depth *
                 std::hypot(line(k + 1, 0) - line(k, 0),
                            line(k + 1, 1) - line(k, 1));
      BOOST_TEST(sum == force, tt::tolerance(1e-4));
      // In equilibrium the mean stress is the force over the width.
      const auto stress = folder.frame("elastic_plates", "stress_yy");
      const auto of     = folder.frame("elastic_plates", "plate");
      double     mean = 0., count = 0.;
      for (unsigned int k = 0; k < of.m(); ++k)
        if (of(k, 0) == p)
          {
            mean += stress(k, 0);
            ++count;
          }
      BOOST_TEST(mean / count ==
                     -std::abs(force) /
                         (scene.depth * scene.plate_bodies[p].shape.extent(0)),
                 tt::tolerance(1e-4));
    }
}


BOOST_AUTO_TEST_SUITE_END()
