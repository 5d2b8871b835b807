#include <morsel/measure/fragments.h>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace Morsel::Measure;
using dealii::Point;

namespace
{
  /// A lattice of 20 x 20 particles of spacing 1 with a dead column and, right
  /// of it, a dead row: pieces of 8 x 20, 11 x 12 and 11 x 7.
  struct Lattice
  {
    Lattice()
    {
      for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x)
          {
            points.emplace_back(x, y);
            alive.push_back(x != 8 && !(x > 8 && y == 12));
          }
      areas.assign(points.size(), 1.);
    }

    Fragments
    find(const BondList &bonds, const double share) const
    {
      return find_fragments(dealii::make_array_view(alive),
                            bonds,
                            dealii::make_array_view(points),
                            dealii::make_array_view(areas),
                            1.,
                            share);
    }

    std::vector<Point<2>> points;
    std::vector<char>     alive;
    std::vector<double>   areas;
  };
} // namespace


BOOST_AUTO_TEST_SUITE(fragments)


BOOST_AUTO_TEST_CASE(pieces_of_a_cut_lattice)
{
  const Lattice lattice;
  const auto    bonds = friends(dealii::make_array_view(lattice.points), 1.2);
  BOOST_CHECK_EQUAL(bonds.neighbour.size(), 2u * 19u * 20u);
  const auto found = lattice.find(bonds, 0.005);

  BOOST_REQUIRE_EQUAL(found.pieces.size(), 3u);
  BOOST_CHECK_EQUAL(found.count, 3u);
  BOOST_CHECK_EQUAL(found.pieces[0].n_particles, 160u);
  BOOST_CHECK_EQUAL(found.pieces[1].n_particles, 132u);
  BOOST_CHECK_EQUAL(found.pieces[2].n_particles, 77u);
  BOOST_CHECK_CLOSE(found.largest_share(), 0.4, 1e-10);
  BOOST_CHECK_CLOSE(found.dust_share, 31. / 400., 1e-10);
  BOOST_CHECK_EQUAL(found.label[0], 0);
  BOOST_CHECK_EQUAL(found.label[8], -1);
  BOOST_CHECK_EQUAL(found.label[9], 1);
  BOOST_CHECK_EQUAL(found.label[399], 2);
  BOOST_CHECK_CLOSE(found.pieces[0].centroid[0], 3.5, 1e-10);
  BOOST_CHECK_CLOSE(found.pieces[0].centroid[1], 9.5, 1e-10);
  BOOST_CHECK_CLOSE(found.pieces[0].perimeter, 56., 1.);
  BOOST_CHECK_CLOSE(found.pieces[1].perimeter, 46., 1.);
  BOOST_CHECK_CLOSE(found.pieces[2].perimeter, 36., 1.);
}


BOOST_AUTO_TEST_CASE(crumbs_are_counted_apart)
{
  const Lattice lattice;
  const auto    found =
      lattice.find(friends(dealii::make_array_view(lattice.points), 1.2), 0.25);
  BOOST_CHECK_EQUAL(found.count, 2u);
  BOOST_CHECK_EQUAL(found.pieces.size(), 3u);
  BOOST_CHECK_CLOSE(found.crumb_share, 77. / 400., 1e-10);
  BOOST_CHECK_EQUAL(found.pieces[2].perimeter, 0.);
}


BOOST_AUTO_TEST_CASE(broken_bonds_separate)
{
  // All alive; the bonds across x = 9.5 are broken.
  Lattice lattice;
  lattice.alive.assign(lattice.alive.size(), 1);
  const auto whole = friends(dealii::make_array_view(lattice.points), 1.2);
  BOOST_CHECK_EQUAL(lattice.find(whole, 0.).count, 1u);

  BondList cut;
  cut.first.push_back(0);
  for (std::size_t i = 0; i < lattice.points.size(); ++i)
    {
      for (auto k = whole.first[i]; k < whole.first[i + 1]; ++k)
        {
          const auto j = whole.neighbour[k];
          if ((lattice.points[i][0] < 9.5) == (lattice.points[j][0] < 9.5))
            cut.neighbour.push_back(j);
        }
      cut.first.push_back(cut.neighbour.size());
    }
  const auto found = lattice.find(cut, 0.);
  BOOST_CHECK_EQUAL(found.count, 2u);
  // Equal pieces keep the order of their first particles.
  BOOST_CHECK_EQUAL(found.label[0], 0);
  BOOST_CHECK_EQUAL(found.label[19], 1);
}


BOOST_AUTO_TEST_CASE(friends_agree_with_all_pairs)
{
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> place(0., 10.);
  std::vector<Point<2>>                  points;
  for (int i = 0; i < 300; ++i)
    points.emplace_back(place(random), place(random));
  points.emplace_back(1e6, 1e6); // a runaway must not ask for a huge grid
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      pairs += points[i].distance(points[j]) <= 0.7;
  const auto bonds = friends(dealii::make_array_view(points), 0.7);
  BOOST_CHECK_EQUAL(bonds.neighbour.size(), pairs);
}


BOOST_AUTO_TEST_CASE(nothing_left)
{
  Lattice lattice;
  lattice.alive.assign(lattice.alive.size(), 0);
  const auto found =
      lattice.find(friends(dealii::make_array_view(lattice.points), 1.2), 0.);
  BOOST_CHECK_EQUAL(found.count, 0u);
  BOOST_CHECK_EQUAL(found.largest_share(), 0.);
  BOOST_CHECK_CLOSE(found.dust_share, 1., 1e-10);
  BOOST_CHECK_EQUAL(friends({}, 1.).neighbour.size(), 0u);
}


BOOST_AUTO_TEST_SUITE_END()
