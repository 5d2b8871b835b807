// Proves: the three versions of Gmsh's text format give the same mesh, cells
// are turned to the left, groups are kept, and every mistake in a file is told
// with its line.
#include "sentences.h"
#include "text_file.h"

#include <morsel/core/errors.h>
#include <morsel/scene/gmsh.h>

#include <boost/test/unit_test.hpp>


using namespace Morsel;

namespace
{
  // A unit square, beside it a triangle that goes round to the right, and the
  // square's floor.
  const std::string nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 0\n";

  const std::string version_1 =
      "$NOD\n5\n" + nodes +
      "$ENDNOD\n$ELM\n3\n1 1 7 1 2 1 2\n2 3 3 1 4 1 2 3 4\n3 2 3 1 3 2 3 5\n"
      "$ENDELM\n";

  const std::string version_2 =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
      "$PhysicalNames\n1\n1 7 \"floor\"\n$EndPhysicalNames\n"
      "$Nodes\n5\n" +
      nodes +
      "$EndNodes\n$Elements\n4\n1 15 2 0 1 1\n2 1 2 7 1 1 2\n"
      "3 3 2 3 1 1 2 3 4\n4 2 2 3 1 2 3 5\n$EndElements\n";

  const std::string version_4 =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
      "$Entities\n1 1 1 0\n1 0 0 0 0\n1 0 0 0 1 0 0 1 7 2 1 -2\n"
      "1 0 0 0 2 1 0 1 3 1 1\n$EndEntities\n"
      "$Nodes\n1 5 1 5\n2 1 0 5\n1\n2\n3\n4\n5\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n$EndNodes\n"
      "$Elements\n3 3 1 3\n1 1 1 1\n1 1 2\n2 1 3 1\n2 1 2 3 4\n2 1 2 1\n"
      "3 2 3 5\n$EndElements\n";


  Scene::GmshMesh
  read(const std::string &text)
  {
    return Scene::read_gmsh(TextFile(text, ".msh").name);
  }


  std::string
  replaced(std::string text, const std::string &part, const std::string &other)
  {
    const std::size_t at = text.find(part);
    BOOST_REQUIRE_MESSAGE(at != std::string::npos, part);
    return text.replace(at, part.size(), other);
  }


  void
  check_refused(const std::string &text, const std::string &reason)
  {
    try
      {
        read(text);
        BOOST_ERROR("accepted, but expected: " << reason);
      }
    catch (const InputError &error)
      {
        check_says(error.what(), {reason, "morsel_unit_"});
      }
  }
} // namespace


BOOST_AUTO_TEST_SUITE(gmsh)


BOOST_AUTO_TEST_CASE(three_versions_give_one_mesh)
{
  for (const std::string &text : {version_1, version_2, version_4})
    BOOST_TEST_CONTEXT(text.substr(0, 20))
    {
      const Scene::GmshMesh mesh = read(text);
      BOOST_REQUIRE_EQUAL(mesh.vertices.size(), 5u);
      BOOST_TEST(mesh.vertices[4][0] == 2.);
      BOOST_TEST(mesh.vertices[3][1] == 1.);
      BOOST_REQUIRE_EQUAL(mesh.cells.size(), 2u);
      // deal.II numbers along the rows; the triangle has been turned.
      const std::vector<unsigned int> square{0, 1, 3, 2}, triangle{1, 4, 2};
      BOOST_TEST(mesh.cells[0].vertices == square,
                 boost::test_tools::per_element());
      BOOST_TEST(mesh.cells[1].vertices == triangle,
                 boost::test_tools::per_element());
      BOOST_TEST(mesh.cells[0].material_id == 3u);
      BOOST_REQUIRE_EQUAL(mesh.lines.boundary_lines.size(), 1u);
      BOOST_TEST(mesh.lines.boundary_lines[0].boundary_id == 7u);
      BOOST_TEST(mesh.lines.boundary_lines[0].vertices[1] == 1u);
    }
}


BOOST_AUTO_TEST_CASE(mistakes_in_the_frame_are_told)
{
  check_refused("solid tooth\n", "is no mesh that can be read");
  check_refused(replaced(version_2, "2.2", "3"), "line 2 of the mesh");
  check_refused(replaced(version_2, "2.2", "3"),
                "has '3' where version 2.2 or 4.1 of the format is expected");
  check_refused(replaced(version_2, "2.2 0", "2.2 1"),
                "tells of a binary file");
  check_refused(replaced(version_2, "$EndMeshFormat", "$End"),
                "has '$End' where '$EndMeshFormat' is expected");
  check_refused(version_2.substr(0, version_2.find("\"floor\"")),
                "ends inside of section '$PhysicalNames'");
  check_refused(version_2.substr(0, version_2.find("4 0 1 0")),
                "ends where a node's number is expected");
  check_refused(version_2 + "and so on\n",
                "has 'and' where a section such as '$Nodes' is expected");
  check_refused(version_2.substr(0, version_2.find("$Elements")),
                "has neither triangles nor quadrilaterals");
}


BOOST_AUTO_TEST_CASE(mistakes_in_nodes_are_told)
{
  check_refused(replaced(version_2, "$Nodes\n5", "$Nodes\n99999999999"),
                "where the number of nodes is expected");
  check_refused(replaced(version_2, "$Nodes\n5", "$Nodes\n-5"),
                "where the number of nodes is expected");
  check_refused(replaced(version_2, "$Nodes\n5", "$Nodes\n6"),
                "has '$EndNodes' where a node's number is expected");
  check_refused(replaced(version_2, "$Nodes\n5", "$Nodes\n4"),
                "has '5' where '$EndNodes' is expected");
  check_refused(replaced(version_2, "2 1 0 0\n", "1 1 0 0\n"),
                "gives node 1 a second time");
  for (const std::string bad : {"nan", "1e200", "1,5", "x"})
    check_refused(replaced(version_2, "2 1 0 0\n", "2 " + bad + " 0 0\n"),
                  "has '" + bad + "' where a coordinate is expected");
  check_refused(replaced(version_4, "2 1 0 5", "2 1 1 5"),
                "has nodes with parameters");
}


BOOST_AUTO_TEST_CASE(mistakes_in_cells_are_told)
{
  const std::string square = "3 3 2 3 1 1 2 3 4", triangle = "2 3 1 2 3 5";
  check_refused(replaced(version_2, square, "3 16 2 3 1 1 2 3 4"),
                "has an element of type 16; give lines");
  check_refused(replaced(version_2, square, "3 3 2 3 1 1 2 3 9"),
                "has an element with node 9, which the mesh does not have");
  check_refused(replaced(version_2, square, "3 3 2 3 1 1 2 3 3"),
                "has an element with the same node twice");
  check_refused(replaced(version_2, square, "3 3 2 3 1 1 2 4 3"),
                "has a quadrilateral that is not convex");
  check_refused(replaced(version_2, triangle, "2 3 1 1 2 5"),
                "has a cell without area, or with corners in line");
  check_refused(replaced(version_2, triangle, "2 3 1 1 2 3"),
                "has a cell that overlaps another one at a face");
}


BOOST_AUTO_TEST_SUITE_END()
