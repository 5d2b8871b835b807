// Frames are written by the writers and read back through HDF5.
#include <morsel/core/errors.h>
#include <morsel/output/frames.h>

#include <deal.II/base/hdf5.h>

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>
#include <limits>

using namespace Morsel;
using dealii::Point;
using Kind = Output::Field::Kind;

namespace
{
  std::filesystem::path
  folder(const std::string &name)
  {
    return std::filesystem::temp_directory_path() / "morsel_unit_frames" / name;
  }


  std::string
  content(const std::filesystem::path &file)
  {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
} // namespace


BOOST_AUTO_TEST_SUITE(particle_output)


BOOST_AUTO_TEST_CASE(particles_come_back)
{
  const std::vector<Point<2>> points{{0., 1.}, {2., 3.}, {4., 5.}};
  const std::vector<double>   damage{0., 0.5, 1.};
  const std::vector<double>   velocity{1., 2., 3., 4., 5., 6.};
  const std::vector<double>   stress{
      1., 2., 2., 3., 4., 5., 5., 6., 7., 8., 8., 9.};

  Output::Frames<0> frames(folder("food").string(), "food", MPI_COMM_SELF);
  for (const double time : {0., 0.25})
    frames.write(time,
                 dealii::make_array_view(points),
                 {{"damage", Kind::scalar, {damage}},
                  {"velocity", Kind::vector, {velocity}},
                  {"stress", Kind::tensor, {stress}}});
  BOOST_CHECK_EQUAL(frames.n_frames(), 2u);

  dealii::HDF5::File file((folder("food") / "food_000001.h5").string(),
                          dealii::HDF5::File::FileAccessMode::open);
  const auto         nodes =
      file.open_dataset("nodes").read<dealii::FullMatrix<double>>();
  BOOST_CHECK_EQUAL(nodes.m(), 3u);
  BOOST_CHECK_EQUAL(nodes(1, 0), 2.);
  BOOST_CHECK_EQUAL(nodes(2, 1), 5.);
  const auto v =
      file.open_dataset("velocity").read<dealii::FullMatrix<double>>();
  BOOST_CHECK_EQUAL(v.n(), 3u);
  BOOST_CHECK_EQUAL(v(1, 1), 4.);
  const auto s =
      file.open_dataset("stress_yy").read<dealii::FullMatrix<double>>();
  BOOST_CHECK_EQUAL(s(2, 0), 9.);

  frames.finish();
  const auto xdmf = content(folder("food") / "food.xdmf");
  BOOST_CHECK(xdmf.find("food_000000.h5:/damage") != std::string::npos);
  BOOST_CHECK(xdmf.find("<Time Value=\"0.25\"") != std::string::npos);
}


BOOST_AUTO_TEST_CASE(plates_come_back)
{
  Output::Frames<2> frames(folder("plates").string(), "plates", MPI_COMM_WORLD);
  Output::PlateState plate;
  plate.corners     = {{0., 1.}, {2., 1.}, {0., 3.}, {2., 3.}};
  plate.velocity[1] = -0.1;
  Output::write_plates(frames, 0., {plate, plate});
  dealii::HDF5::File file((folder("plates") / "plates_000000.h5").string(),
                          dealii::HDF5::File::FileAccessMode::open);
  const auto         nodes =
      file.open_dataset("nodes").read<dealii::FullMatrix<double>>();
  BOOST_CHECK_EQUAL(nodes.m(), 8u);
  const auto cells =
      file.open_dataset("cells").read<dealii::FullMatrix<double>>();
  BOOST_CHECK_EQUAL(cells.m(), 2u);
  // Around the cell.
  BOOST_CHECK_EQUAL(cells(1, 1), 5.);
  BOOST_CHECK_EQUAL(cells(1, 2), 7.);
}


BOOST_AUTO_TEST_CASE(no_particles_is_no_frame)
{
  Output::Frames<0> frames(folder("none").string(), "none", MPI_COMM_WORLD);
  frames.write(0., {}, {{"damage", Kind::scalar, {}}});
  BOOST_CHECK_EQUAL(frames.n_frames(), 0u);
}


BOOST_AUTO_TEST_CASE(what_is_not_finite_is_named)
{
  Output::Frames<0> frames(folder("bad").string(), "bad", MPI_COMM_SELF);
  const std::vector<Point<2>> points{{0., 1.}};
  const std::vector<double>   bad{std::numeric_limits<double>::quiet_NaN()};
  BOOST_CHECK_EXCEPTION(frames.write(0.,
                                     dealii::make_array_view(points),
                                     {{"damage", Kind::scalar, {bad}}}),
                        NumericalError,
                        [](const auto &e) {
                          return std::string(e.what()).find("'damage'") !=
                                 std::string::npos;
                        });
  BOOST_CHECK_THROW(Output::Frames<0>("/proc/nowhere", "bad", MPI_COMM_SELF),
                    FileError);
}


BOOST_AUTO_TEST_SUITE_END()
