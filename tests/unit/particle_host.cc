// The hosting of particles: who owns what, in which order, and what reaches
// the other ranks. The tests hold on any number of ranks; ctest runs them on
// one, two and three.
#include <morsel/core/errors.h>
#include <morsel/sph/host.h>

#include <deal.II/base/mpi.h>

#include <deal.II/particles/particle_handler.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace
{
  using dealii::Point;
  using Host    = Morsel::SPH::ParticleHost<2>;
  using Index   = Host::Index;
  namespace mpi = dealii::Utilities::MPI;

  const MPI_Comm world = MPI_COMM_WORLD;


  /// A rectangle with a lattice, and what is expected of its host.
  struct Lattice
  {
    double       width, height;
    unsigned int across, rows;
    double       support; ///< in spacings
    Point<2>     lower = Point<2>();

    double
    spacing() const
    {
      return width / across;
    }

    Point<2>
    upper() const
    {
      return lower + Point<2>(width, height);
    }

    Point<2>
    point(const Index id) const
    {
      return lower + Point<2>((id % across + 0.5) * width / across,
                              (id / across + 0.5) * height / rows);
    }

    Index
    size() const
    {
      return Index(across) * rows;
    }

    std::vector<Point<2>>
    points() const
    {
      std::vector<Point<2>> all;
      for (Index id = 0; id < size(); ++id)
        all.push_back(point(id));
      return all;
    }
  };


  struct Six
  {
    double value[6];
  };


  /// A record as no one else has it.
  struct Mixed
  {
    double value[3];
    int    tag;
  };


  /// Every id is owned once; n_global() agrees.
  void
  check_ownership(const Host &host, const std::vector<Point<2>> &points)
  {
    BOOST_TEST(host.n_global() == points.size());
    BOOST_TEST(mpi::sum(host.n_owned(), world) == points.size());
    BOOST_TEST(host.ids().size() == host.n_local());
    BOOST_TEST(host.n_owned() + host.n_ghosts() == host.n_local());

    std::vector<unsigned int> owners(points.size(), 0);
    for (unsigned int i = 0; i < host.n_owned(); ++i)
      ++owners.at(host.ids()[i]);
    mpi::sum(owners, world, owners);
    BOOST_TEST(std::all_of(
        owners.begin(), owners.end(), [](const auto n) { return n == 1; }));
  }


  /// Positions are those of the ids, the order is as promised.
  void
  check_order(const Host                  &host,
              const std::vector<Point<2>> &points,
              const double                 spacing)
  {
    double error = 0.;
    for (unsigned int i = 0; i < host.n_local(); ++i)
      error = std::max(
          error, host.reference_positions()[i].distance(points[host.ids()[i]]));
    BOOST_TEST(error <= 1e-13 * spacing * points.size());

    const auto first = host.ids().begin();
    BOOST_TEST(std::is_sorted(first, first + host.n_boundary()));
    BOOST_TEST(
        std::is_sorted(first + host.n_boundary(), first + host.n_owned()));
    BOOST_TEST(host.n_boundary() <= host.n_owned());
    if (mpi::n_mpi_processes(world) == 1)
      {
        BOOST_TEST(host.n_ghosts() == 0);
        BOOST_TEST(host.n_boundary() == 0);
      }
  }


  /// Ghosts and boundary are exactly those within the support across ranks.
  void
  check_ghosts(const Host                  &host,
               const std::vector<Point<2>> &points,
               const double                 support)
  {
    std::vector<bool> mine(points.size(), false);
    for (unsigned int i = 0; i < host.n_owned(); ++i)
      mine[host.ids()[i]] = true;

    std::set<Index> ghosts, boundary;
    for (unsigned int i = 0; i < host.n_owned(); ++i)
      for (Index j = 0; j < points.size(); ++j)
        if (!mine[j] &&
            points[host.ids()[i]].distance(points[j]) <= support * (1. + 1e-12))
          {
            ghosts.insert(j);
            boundary.insert(host.ids()[i]);
          }
    const auto first = host.ids().begin();
    BOOST_TEST(
        (ghosts == std::set<Index>(first + host.n_owned(), host.ids().end())));
    BOOST_TEST((boundary == std::set<Index>(first, first + host.n_boundary())));
  }


  /// An exchange brings what the owner has, for records of many kinds, also
  /// for two at the same time.
  void
  check_exchange(Host &host)
  {
    const unsigned int    n = host.n_local();
    std::vector<Point<2>> two(n);
    std::vector<Six>      six(n);
    std::vector<Mixed>    mixed(n);
    std::vector<int>      whole(n, -1);
    std::vector<char>     small(n, 'x');
    for (unsigned int i = 0; i < host.n_owned(); ++i)
      {
        const double id = host.ids()[i];
        two[i]          = Point<2>(id, 0.5 * id);
        six[i]          = {{id, 0., 0., 0., 0., -id}};
        mixed[i]        = {{id, 0., 2. * id}, int(id)};
        whole[i]        = id;
        small[i]        = host.ids()[i] % 100;
      }
    const auto view_of_two = dealii::make_array_view(two);
    const auto view_of_six = dealii::make_array_view(six);
    host.exchange_start(view_of_two, 0);
    host.exchange_start(view_of_six, 1);
    host.exchange_finish(view_of_six, 1);
    host.exchange_finish(view_of_two, 0);
    host.exchange(mixed);
    host.exchange(whole);
    host.exchange(small);

    bool right = true;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double id = host.ids()[i];
        right           = right && two[i][0] == id && two[i][1] == 0.5 * id &&
                six[i].value[5] == -id && mixed[i].value[2] == 2. * id &&
                mixed[i].tag == int(id) && whole[i] == int(id) &&
                small[i] == char(host.ids()[i] % 100);
      }
    BOOST_TEST(right);
  }


  void
  check_lattice(const Lattice &lattice)
  {
    Host host(world,
              lattice.lower,
              lattice.upper(),
              lattice.support * lattice.spacing(),
              lattice.spacing());
    host.insert_lattice(lattice.lower, lattice.upper(), lattice.across);
    const std::vector<Point<2>> points = lattice.points();
    check_ownership(host, points);
    check_order(host, points, lattice.spacing());
    check_ghosts(host, points, lattice.support * lattice.spacing());
    check_exchange(host);
  }
} // namespace


BOOST_AUTO_TEST_SUITE(particle_host)

BOOST_AUTO_TEST_CASE(block_of_the_scenes)
{
  check_lattice({0.01, 0.01, 101, 101, 2.6, Point<2>(0.003, -0.002)});
}


BOOST_AUTO_TEST_CASE(one_rank_numbers_row_by_row)
{
  Host host(MPI_COMM_SELF, {0., 0.}, {0.01, 0.01}, 2.6e-4, 1e-4);
  host.insert_lattice({0., 0.}, {0.01, 0.01}, 101);
  BOOST_TEST(host.n_owned() == 10201);
  bool in_order = true;
  for (unsigned int i = 0; i < host.n_owned(); ++i)
    in_order = in_order && host.ids()[i] == i;
  BOOST_TEST(in_order);
}


// Unequal spacings across and along bring particles onto faces; so do points
// that ignore where the cells stand.
BOOST_AUTO_TEST_CASE(particles_on_faces)
{
  check_lattice({3., 2.5, 30, 25, 2.});
  check_lattice({1., 0.949, 20, 19, 2.25});

  Host                  host(world, {0., 0.}, {8., 8.}, 2., 1.);
  std::vector<Point<2>> points;
  std::vector<Index>    ids;
  for (int y = 0; y <= 32; ++y)
    for (int x = 0; x <= 32; ++x)
      {
        points.emplace_back(0.25 * x, 0.25 * y);
        ids.push_back(ids.size());
      }
  host.insert(points, ids);
  check_ownership(host, points);
  check_order(host, points, 1.);
  check_ghosts(host, points, 2.);
  check_exchange(host);
}


BOOST_AUTO_TEST_CASE(thin_and_tiny_bodies)
{
  check_lattice({1., 0.01, 100, 1, 2.6}); // a row
  check_lattice({0.01, 1., 1, 100, 2.6}); // a column
  check_lattice({0.2, 0.1, 2, 1, 2.6});   // two: some rank has none
  check_lattice({1., 1., 1, 1, 2.6});     // a single one
}


BOOST_AUTO_TEST_CASE(scattered_points)
{
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> uniform(0., 1.);
  std::vector<Point<2>>                  points;
  std::vector<Index>                     ids;
  for (unsigned int i = 0; i < 2000; ++i)
    {
      // All in the left half: the right half's cells stay empty.
      points.emplace_back(0.5 * uniform(random), uniform(random));
      ids.push_back(1999 - i);
    }
  Host host(world, {0., 0.}, {1., 1.}, 0.05, 0.02);
  host.insert(points, ids);

  std::reverse(points.begin(), points.end()); // now point(id)
  check_ownership(host, points);
  check_order(host, points, 1.);
  check_ghosts(host, points, 0.05);
  check_exchange(host);

  const double fair = 2000. / mpi::n_mpi_processes(world);
  BOOST_TEST(host.n_owned() > 0.85 * fair);
  BOOST_TEST(host.n_owned() < 1.15 * fair);
}


BOOST_AUTO_TEST_CASE(points_outside_are_refused)
{
  Host host(world, {0., 0.}, {1., 1.}, 0.25, 0.1);
  BOOST_CHECK_THROW(host.insert({{0.5, 0.5}, {1.9, 0.5}}, {0, 1}),
                    Morsel::InputError);
}


BOOST_AUTO_TEST_CASE(reductions_and_properties)
{
  Host host(world, {0., 0.}, {1., 1.}, 0.26, 0.1);
  host.insert_lattice({0., 0.}, {1., 1.}, 10);
  const int n_ranks = mpi::n_mpi_processes(world);
  const int rank    = mpi::this_mpi_process(world);
  BOOST_TEST(host.sum(1.) == n_ranks);
  BOOST_TEST(host.minimum(rank) == 0);
  BOOST_TEST(host.maximum(rank) == n_ranks - 1);
  std::vector<double> values = {1., 2.};
  host.sum(dealii::make_array_view(values));
  BOOST_TEST(values[1] == 2. * n_ranks);

  std::vector<dealii::Tensor<1, 2>> displacements(host.n_local());
  for (unsigned int i = 0; i < host.n_local(); ++i)
    displacements[i][1] = host.ids()[i];
  host.write_back(dealii::make_array_view(
      static_cast<const std::vector<dealii::Tensor<1, 2>> &>(displacements)));
  bool right = true;
  for (const auto &particle : host.handler())
    right = right && particle.get_properties()[2] == particle.get_id();
  BOOST_TEST(right);
}

BOOST_AUTO_TEST_SUITE_END()
