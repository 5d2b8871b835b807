// Shapes of particle bodies: outlines from corners, radii and meshes; cells
// that fill them; fillings.
#include <morsel/core/errors.h>
#include <morsel/sph/body_cloud.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_out.h>
#include <deal.II/grid/tria.h>

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>
#include <random>

using namespace Morsel;

namespace
{
  using dealii::Point;
  using dealii::Tensor;

  /// An L of 3 x 2 m with a square hole.
  const std::string l_with_hole =
      "0, 0 > 3, 0 > 3, 1 > 1.4, 1 > 1.4, 2 > 0, 2; "
      "0.45, 1.2 > 0.95, 1.2 > 0.95, 1.6 > 0.45, 1.6";


  Scene::ParticleBody
  polygon(const std::string &loops, const unsigned int across)
  {
    Scene::ParticleBody body;
    body.name             = "part";
    body.shape.kind       = "polygon";
    body.shape.loops      = loops;
    body.particles_across = across;
    body.shape.complete(across, "");
    body.spacing = body.shape.extent(0) / across;
    return body;
  }


  Scene::ParticleBody
  annulus(const double inner, const std::string &sector, const unsigned int n)
  {
    Scene::ParticleBody body;
    body.name               = "ring";
    body.shape.kind         = "annulus";
    body.shape.inner_radius = inner;
    body.shape.outer_radius = 2.;
    body.shape.sector       = sector;
    body.particles_across   = n;
    body.shape.complete(n, "");
    body.spacing = body.shape.extent(0) / n;
    return body;
  }


  /// Areas, closed cells and facets that both neighbours see alike.
  void
  check_cells(const SPH::Cloud &cloud, const Scene::Outline &outline)
  {
    double area = 0., gap = 0.;
    for (const SPH::VoronoiCell &cell : cloud.cells)
      {
        Tensor<1, 2> sum;
        area += cell.area;
        for (const SPH::CellFacet &facet : cell.facets)
          sum += facet.length() * facet.normal();
        gap = std::max(gap, sum.norm());
      }
    BOOST_TEST(std::abs(area - outline.area()) < 1e-12 * outline.area());
    BOOST_TEST(gap < 1e-8 * cloud.spacing);

    double mismatch = 0.;
    for (unsigned int i = 0; i < cloud.size(); ++i)
      for (const SPH::CellFacet &facet : cloud.cells[i].facets)
        if (!facet.at_boundary() && facet.length() > 1e-8 * cloud.spacing)
          {
            double best = 1.;
            for (const SPH::CellFacet &other :
                 cloud.cells[facet.neighbour].facets)
              if (other.neighbour == i)
                best = std::min(best,
                                other.first.distance(facet.second) +
                                    other.second.distance(facet.first));
            mismatch = std::max(mismatch, best);
          }
    BOOST_TEST(mismatch < 1e-8 * cloud.spacing);

    // The sides have their lengths.
    std::vector<double> length(outline.get_side_names().size(), 0.);
    for (const Scene::Outline::Edge &edge : outline.get_edges())
      length[edge.side] += edge.length();
    for (const SPH::VoronoiCell &cell : cloud.cells)
      for (const SPH::CellFacet &facet : cell.facets)
        if (facet.at_boundary())
          length[facet.side] -= facet.length();
    for (const double rest : length)
      BOOST_TEST(std::abs(rest) < 1e-9);
  }


  std::string
  message_of(const std::string &loops)
  {
    try
      {
        polygon(loops, 20);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace


BOOST_AUTO_TEST_SUITE(body_cloud)

BOOST_AUTO_TEST_CASE(outlines_are_put_in_order)
{
  const Scene::Outline outline = polygon(l_with_hole, 30).shape.outline();
  BOOST_TEST(std::abs(outline.area() - (4.4 - 0.2)) < 1e-14);
  BOOST_TEST(outline.contains(Point<2>(0.2, 1.4)));
  BOOST_TEST(!outline.contains(Point<2>(0.7, 1.4)));
  BOOST_TEST(!outline.contains(Point<2>(2., 1.5)));
  BOOST_TEST(outline.walls().size() == 10u);
  BOOST_TEST(annulus(0., "0, 360", 20).shape.outline().walls().empty());

  // Turned round, and the hole first: the same body, the same sides.
  Scene::ParticleBody turned =
      polygon("0.5, 0.5 > 0.6, 0.5 > 0.6, 0.6; 0, 0 > 0, 1 > 1, 1 > 1, 0", 10);
  BOOST_TEST(std::abs(turned.shape.outline().area() - 0.995) < 1e-14);
  turned.shape.side_names = "a, b, c, left, top, right, bottom";
  turned.shape.complete(10, "");
  const Scene::Outline named = turned.shape.outline();
  for (const Scene::Outline::Edge &edge : named.get_edges())
    {
      if (named.get_side_names()[edge.side] == "left")
        BOOST_TEST(edge.first[0] + edge.second[0] == 0.);
      if (named.get_side_names()[edge.side] == "bottom")
        BOOST_TEST(edge.first[1] + edge.second[1] == 0.);
      if (named.get_side_names()[edge.side] == "top")
        BOOST_TEST(edge.first[1] + edge.second[1] == 2.);
    }
}

BOOST_AUTO_TEST_CASE(bad_outlines_are_refused)
{
  const auto says = [](const std::string &loops, const std::string &part) {
    return message_of(loops).find(part) != std::string::npos;
  };
  BOOST_TEST(says("0, 0 > 1, 0", "at least three"));
  BOOST_TEST(says("0, 0 > 1, 1 > 1, 0 > 0, 1", "meet"));
  BOOST_TEST(says("0, 0 > 1, 0 > 1, 0 > 0, 1", "no length"));
  BOOST_TEST(says("0, 0 > 2, 0 > 1, 0 > 0, 1", "turns back"));
  BOOST_TEST(says("0, 0 > 2, 0 > 2, 2 > 0, 2; 3, 3 > 4, 3 > 4, 4", "outside"));
  BOOST_TEST(says("0, 0 > 9, 0 > 9, 9 > 0, 9; 1, 1 > 5, 1 > 5, 5 > 1, 5; "
                  "2, 2 > 3, 2 > 3, 3",
                  "another hole"));
  BOOST_TEST(says("0, 0 > 2, 0 > 2, 2 > 0, 2; 1, 1 > 3, 1 > 1, 1.5", "meet"));
  BOOST_TEST(says("0, 0 > 1 > 0, 1", "2"));
}

BOOST_AUTO_TEST_CASE(cells_fill_any_shape)
{
  std::vector<Scene::ParticleBody> bodies = {
      polygon(l_with_hole, 30),
      polygon("0, 0 > 48, 44 > 48, 60 > 0, 44", 24),
      annulus(1., "0, 360", 40),
      annulus(1., "0, 90", 20),
      annulus(0., "0, 360", 20),
      annulus(0., "-30, 200", 20)};
  for (Scene::ParticleBody &body : bodies)
    for (const char *filling : {"lattice", "relaxed"})
      for (const double scatter : {0., 0.3})
        {
          body.filling           = filling;
          body.relaxations       = 10;
          body.scatter           = scatter;
          const SPH::Cloud cloud = SPH::body_cloud(body, 5);
          BOOST_TEST_CONTEXT(body.shape.kind << ' ' << filling << ' '
                                             << scatter)
          {
            check_cells(cloud, body.shape.outline());
            const double expected =
                body.shape.area() / (body.spacing * body.spacing);
            BOOST_TEST(std::abs(cloud.size() / expected - 1.) < 0.15);
            if (scatter == 0.)
              BOOST_TEST(SPH::evenness(cloud).smallest > 0.35);
          }
        }
}

BOOST_AUTO_TEST_CASE(a_rectangle_by_either_way)
{
  // The cells of any points in a rectangle, cut by its sides or its outline.
  const Point<2>        upper(3., 2.);
  std::mt19937          generator(1);
  std::vector<Point<2>> points;
  for (unsigned int i = 0; i < 600; ++i)
    {
      const double x = generator() / 4294967296., y = generator() / 4294967296.;
      points.emplace_back(3. * x, 2. * y);
    }
  const auto a = SPH::voronoi_cells(points, Point<2>(), upper, 0.1);
  const auto b = SPH::voronoi_cells(
      points, Scene::Outline::rectangle(Point<2>(), upper), 0.1);
  for (unsigned int i = 0; i < points.size(); ++i)
    {
      BOOST_TEST(std::abs(a[i].area - b[i].area) < 1e-14);
      BOOST_TEST(a[i].facets.size() == b[i].facets.size());
      BOOST_TEST(a[i].centroid.distance(b[i].centroid) < 1e-10);
    }
}

BOOST_AUTO_TEST_CASE(relaxing_evens_out)
{
  Scene::ParticleBody ring = annulus(1., "0, 360", 40);
  const double clipped     = SPH::evenness(SPH::body_cloud(ring, 1)).deviation;
  ring.filling             = "relaxed";
  const SPH::Cloud cloud   = SPH::body_cloud(ring, 1);
  BOOST_TEST(SPH::evenness(cloud).deviation < 0.5 * clipped);
  BOOST_TEST(SPH::evenness(cloud).deviation < 0.05);
  BOOST_TEST(cloud.n_relaxations > 5u);
}

BOOST_AUTO_TEST_CASE(arcs_keep_the_area_of_their_circles)
{
  const double pi = dealii::numbers::PI;
  BOOST_TEST(std::abs(annulus(1., "0, 360", 20).shape.area() - 3. * pi) <
             1e-12);
  BOOST_TEST(std::abs(annulus(0., "0, 360", 20).shape.area() - 4. * pi) <
             1e-12);
  BOOST_TEST(std::abs(annulus(1., "0, 90", 20).shape.area() - 0.75 * pi) <
             1e-12);
  const Scene::Outline quarter = annulus(1., "0, 90", 20).shape.outline();
  for (const Scene::Outline::Edge &edge : quarter.get_edges())
    {
      const std::string &side = quarter.get_side_names()[edge.side];
      if (side == "first")
        BOOST_TEST(std::abs(edge.first[1]) + std::abs(edge.second[1]) < 1e-14);
      if (side == "last")
        BOOST_TEST(std::abs(edge.first[0]) + std::abs(edge.second[0]) < 1e-14);
      if (side == "inner")
        BOOST_TEST(edge.first.norm() < 1.1);
    }
}

BOOST_AUTO_TEST_CASE(a_thin_part_is_refused)
{
  // A bridge 0.1 m wide between two blocks.
  const Scene::ParticleBody body =
      polygon("0, 0 > 1, 0 > 1, 0.45 > 2, 0.45 > 2, 0 > 3, 0 > 3, 1 > 2, 1 > "
              "2, 0.55 > 1, 0.55 > 1, 1 > 0, 1",
              30);
  BOOST_CHECK_THROW(SPH::body_cloud(body, 1), InputError);
}

BOOST_AUTO_TEST_CASE(a_mesh_gives_its_outline)
{
  dealii::Triangulation<2> mesh;
  dealii::GridGenerator::hyper_cube_with_cylindrical_hole(
      mesh, 0.25, 1., 1., 1, false);
  for (const auto &cell : mesh.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(face->center().norm() < 0.5     ? 4
                              : face->center()[1] > 1. - 1e-9 ? 3
                                                              : 0);
  mesh.refine_global(2);
  const std::string file =
      (std::filesystem::temp_directory_path() / "morsel_outline.msh").string();
  {
    std::ofstream             stream(file);
    dealii::GridOut           writer;
    dealii::GridOutFlags::Msh flags(true, true);
    writer.set_flags(flags);
    writer.write_msh(mesh, stream);
  }
  const Scene::Outline outline = Scene::outline_of_mesh(file);
  std::filesystem::remove(file);
  BOOST_TEST(outline.get_side_names().size() == 3u);
  BOOST_TEST(outline.side_named("boundary 3") < 3u);
  BOOST_TEST(outline.loop_starts().size() == 3u);
  // Straight sides are joined: 4 edges around the square, 32 around the hole.
  BOOST_TEST(outline.get_edges().size() == 36u);
  const double hole = 4. - outline.area();
  BOOST_TEST(std::abs(hole / (dealii::numbers::PI * 0.0625) - 1.) < 0.01);
  BOOST_CHECK_THROW(Scene::outline_of_mesh("no_such.msh"), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
