// Frames that several ranks write together, one of which has nothing: also run
// on two and three ranks.
#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/output/frames.h>
#include <morsel/output/hdf5_file.h>

#include <deal.II/base/hdf5.h>
#include <deal.II/base/mpi.h>

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <unistd.h>

using namespace Morsel;
using dealii::Point;
using Kind    = Output::Field::Kind;
namespace Mpi = dealii::Utilities::MPI;
namespace fs  = std::filesystem;

namespace
{
  const MPI_Comm world = MPI_COMM_WORLD;


  /// One for all ranks.
  fs::path
  folder(const std::string &name)
  {
    const auto number = Mpi::broadcast(world, static_cast<int>(::getpid()), 0);
    return fs::temp_directory_path() /
           ("morsel_unit_frames_ranks_" + std::to_string(number)) / name;
  }


  /// Rank r has r particles in a row of its own; alone, it has three.
  std::vector<Point<2>>
  points_of_rank()
  {
    const unsigned int    r = Mpi::this_mpi_process(world);
    const unsigned int    n = Mpi::n_mpi_processes(world) == 1 ? 3 : r;
    std::vector<Point<2>> points;
    for (unsigned int k = 0; k < n; ++k)
      points.emplace_back(k, r);
    return points;
  }


  dealii::FullMatrix<double>
  table(const fs::path &file, const std::string &name)
  {
    dealii::HDF5::File h5(file.string(),
                          dealii::HDF5::File::FileAccessMode::open);
    return h5.open_dataset(name).read<dealii::FullMatrix<double>>();
  }
} // namespace


BOOST_AUTO_TEST_SUITE(frames_ranks)


BOOST_AUTO_TEST_CASE(each_rank_writes_its_rows)
{
  const fs::path      place  = folder("food");
  const auto          points = points_of_rank();
  std::vector<double> value, velocity;
  for (const auto &x : points)
    {
      value.push_back(10. * x[1] + x[0]);
      velocity.insert(velocity.end(), {x[1], -x[0]});
    }
  Output::Frames<0> frames(place.string(), "food", world);
  frames.write(0.,
               dealii::make_array_view(points),
               {{"value", Kind::scalar, {value}},
                {"velocity", Kind::vector, {velocity}}});
  frames.finish();
  BOOST_CHECK_EQUAL(frames.n_frames(), 1u);

  const std::size_t n_points = Mpi::sum(points.size(), world);
  if (Mpi::this_mpi_process(world) != 0)
    return;
  const fs::path file  = place / "food_000000.h5";
  const auto     nodes = table(file, "nodes");
  const auto     cells = table(file, "cells");
  const auto     found = table(file, "value");
  const auto     v     = table(file, "velocity");
  BOOST_REQUIRE_EQUAL(nodes.m(), n_points);
  // Those of rank 0 first, and none is left out.
  for (unsigned int k = 0; k < nodes.m(); ++k)
    {
      BOOST_CHECK_EQUAL(cells(k, 0), k);
      BOOST_CHECK_EQUAL(found(k, 0), 10. * nodes(k, 1) + nodes(k, 0));
      BOOST_CHECK_EQUAL(v(k, 0), nodes(k, 1));
      BOOST_CHECK_EQUAL(v(k, 1), -nodes(k, 0));
      BOOST_CHECK_EQUAL(v(k, 2), 0.);
      if (k > 0)
        BOOST_CHECK(found(k, 0) > found(k - 1, 0));
    }
  fs::remove_all(place.parent_path());
}


BOOST_AUTO_TEST_CASE(what_one_rank_meets_all_are_told)
{
  const fs::path place = folder("gone");
  if (Mpi::this_mpi_process(world) == 0)
    fs::create_directories(place);
  MPI_Barrier(world);
  const std::string         name = (place / "table.h5").string();
  const std::vector<double> mine(points_of_rank().size());
  const auto                write = [&] {
    using Number = Output::HDF5File::Number;
    Output::HDF5File file(
        name, {{"values", Number::real, 1, mine.size()}}, world);
    // Only ranks with rows can miss what has gone.
    if (Mpi::this_mpi_process(world) == 0)
      fs::remove(name + ".tmp");
    MPI_Barrier(world);
    run_on_all_ranks(world, [&] {
      file.write(0, mine);
      file.close();
    });
  };
  std::string sentence;
  BOOST_CHECK_EQUAL(exit_status_of([&] {
                      try
                        {
                          write();
                        }
                      catch (const FileError &error)
                        {
                          sentence = error.what();
                          throw;
                        }
                    }),
                    static_cast<int>(ExitStatus::bad_files));
  if (!mine.empty())
    BOOST_CHECK_EQUAL(
        sentence, "Cannot write '" + name + "': No such file or directory.");
  BOOST_CHECK(!fs::exists(name));
  MPI_Barrier(world);
  if (Mpi::this_mpi_process(world) == 0)
    fs::remove_all(place.parent_path());
}


BOOST_AUTO_TEST_SUITE_END()
