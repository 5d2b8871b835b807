#include <morsel/core/errors.h>
#include <morsel/scene/gmsh.h>
#include <morsel/scene/mesh_words.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace Morsel::Scene
{
  using dealii::Point;

  namespace
  {
    /// What the sections of a file have told so far.
    class Reader
    {
    public:
      explicit Reader(const std::string &file)
          : words(file)
          , file(file)
      {}

      GmshMesh
      read();

    private:
      void
      read_format();

      void
      skip_section(const std::string &name);

      void
      read_entities();

      /// @param end of the section
      void
      read_nodes(const std::string &end);

      void
      read_node_position(unsigned long tag);

      void
      read_elements(const std::string &end);

      /// Its corners; @param group physical one, 0 if none
      void
      read_element(unsigned long type, unsigned long group);

      void
      add_cell(const std::vector<unsigned int> &corners, unsigned long group);

      MeshWords     words;
      std::string   file;
      unsigned long version = 0;
      GmshMesh      mesh;

      std::map<unsigned long, unsigned int> vertex_of_node;
      /// Of the curves and surfaces of version 4.
      std::map<std::pair<unsigned int, unsigned long>, unsigned long>
          group_of_entity;
      /// With their cells to the left.
      std::set<std::pair<unsigned int, unsigned int>> faces;
    };


    GmshMesh
    Reader::read()
    {
      std::string word;
      if (!words.next(word) || (word != "$MeshFormat" && word != "$NOD"))
        throw InputError("'" + file +
                         "' is no mesh that can be read; give a .msh of Gmsh "
                         "(text, version 1, 2 or 4), which begins with "
                         "'$MeshFormat' or '$NOD'.");
      if (word == "$NOD")
        {
          version = 1;
          read_nodes("$ENDNOD");
        }
      else
        read_format();
      while (words.next(word))
        if (word == "$Entities" && version == 4)
          read_entities();
        else if (word == "$Nodes" && version > 1)
          read_nodes("$EndNodes");
        else if (word == "$Elements" && version > 1)
          read_elements("$EndElements");
        else if (word == "$ELM" && version == 1)
          read_elements("$ENDELM");
        else if (word.size() > 1 && word[0] == '$')
          skip_section(word.substr(1));
        else
          words.refuse(word, "a section such as '$Nodes'");
      if (mesh.cells.empty())
        throw InputError("the mesh '" + file +
                         "' has neither triangles nor quadrilaterals; mesh the "
                         "surface and save it, physical groups or all.");
      return mesh;
    }


    void
    Reader::read_format()
    {
      std::string text;
      words.next(text);
      version = text.rfind("2.", 0) == 0 || text == "2" ? 2
                : text == "4.1"                         ? 4
                                                        : 0;
      if (version == 0)
        words.refuse(text, "version 2.2 or 4.1 of the format");
      if (words.whole("the kind of file") != 0)
        words.fail("tells of a binary file; save it as text");
      words.whole("the size of numbers");
      words.expect_word("$EndMeshFormat");
    }


    void
    Reader::skip_section(const std::string &name)
    {
      std::string word;
      while (words.next(word))
        if (word == "$End" + name)
          return;
      throw InputError("the mesh '" + file + "' ends inside of section '$" +
                       name + "'.");
    }


    void
    Reader::read_entities()
    {
      std::array<unsigned long, 4> n;
      for (unsigned long &count : n)
        count = words.whole("the number of entities");
      for (unsigned int dimension = 0; dimension < 4; ++dimension)
        for (unsigned long i = 0; i < n[dimension]; ++i)
          {
            const unsigned long tag = words.whole("an entity's number");
            for (unsigned int k = 0; k < (dimension == 0 ? 3 : 6); ++k)
              words.coordinate();
            const unsigned long n_groups =
                words.whole("the number of physical groups");
            for (unsigned long k = 0; k < n_groups; ++k)
              {
                const unsigned long group = words.whole("a physical group");
                group_of_entity.emplace(std::pair(dimension, tag), group);
              }
            // What bounds it follows, with signs.
            words.skip_line();
          }
      words.expect_word("$EndEntities");
    }


    void
    Reader::read_node_position(const unsigned long tag)
    {
      const double x = words.coordinate(), y = words.coordinate();
      words.coordinate();
      if (!vertex_of_node.emplace(tag, mesh.vertices.size()).second)
        words.fail("gives node " + std::to_string(tag) + " a second time");
      mesh.vertices.emplace_back(x, y);
    }


    void
    Reader::read_nodes(const std::string &end)
    {
      const unsigned long n = words.whole("the number of nodes");
      if (version < 4)
        for (unsigned long i = 0; i < n; ++i)
          read_node_position(words.whole("a node's number"));
      else
        {
          for (unsigned int k = 0; k < 3; ++k)
            words.whole("a number or range of nodes");
          for (unsigned long block = 0; block < n; ++block)
            {
              words.whole("an entity's dimension");
              words.whole("an entity's number");
              if (words.whole("0 (no parameters)") != 0)
                words.fail("has nodes with parameters; save it without");
              const unsigned long n_here = words.whole("the number of nodes");
              std::vector<unsigned long> tags;
              for (unsigned long i = 0; i < n_here; ++i)
                tags.push_back(words.whole("a node's number"));
              for (const unsigned long tag : tags)
                read_node_position(tag);
            }
        }
      words.expect_word(end);
    }


    void
    Reader::read_elements(const std::string &end)
    {
      const unsigned long n = words.whole("the number of elements");
      if (version < 4)
        for (unsigned long i = 0; i < n; ++i)
          {
            words.whole("an element's number");
            const unsigned long type = words.whole("an element's type");
            // The groups, and in version 1 the number of nodes.
            const unsigned long n_tags =
                version == 1 ? 3 : words.whole("the number of tags");
            unsigned long group = 0;
            for (unsigned long k = 0; k < n_tags; ++k)
              {
                const unsigned long tag = words.whole("a tag");
                group                   = k == 0 ? tag : group;
              }
            read_element(type, group);
          }
      else
        {
          for (unsigned int k = 0; k < 3; ++k)
            words.whole("a number or range of elements");
          for (unsigned long block = 0; block < n; ++block)
            {
              const unsigned int dimension =
                  words.whole("an entity's dimension");
              const unsigned long tag  = words.whole("an entity's number");
              const unsigned long type = words.whole("an element's type");
              const unsigned long n_here =
                  words.whole("the number of elements");
              const auto group = group_of_entity.find({dimension, tag});
              for (unsigned long i = 0; i < n_here; ++i)
                {
                  words.whole("an element's number");
                  read_element(
                      type, group == group_of_entity.end() ? 0 : group->second);
                }
            }
        }
      words.expect_word(end);
    }


    void
    Reader::read_element(const unsigned long type, const unsigned long group)
    {
      // Gmsh's numbers of lines, triangles, quadrilaterals and points.
      static const std::map<unsigned long, unsigned int> n_corners = {
          {1, 2}, {2, 3}, {3, 4}, {15, 1}};
      const auto n = n_corners.find(type);
      if (n == n_corners.end())
        words.fail("has an element of type " + std::to_string(type) +
                   "; give lines, triangles and quadrilaterals of first "
                   "order (1, 2 and 3)");
      std::vector<unsigned int> corners;
      for (unsigned int k = 0; k < n->second; ++k)
        {
          const unsigned long tag    = words.whole("a node's number");
          const auto          vertex = vertex_of_node.find(tag);
          if (vertex == vertex_of_node.end())
            words.fail("has an element with node " + std::to_string(tag) +
                       ", which the mesh does not have");
          corners.push_back(vertex->second);
        }
      if (std::set<unsigned int>(corners.begin(), corners.end()).size() !=
          corners.size())
        words.fail("has an element with the same node twice");
      if (type == 1)
        {
          dealii::CellData<1> line;
          line.vertices    = corners;
          line.boundary_id = group;
          mesh.lines.boundary_lines.push_back(line);
        }
      else if (type != 15)
        add_cell(corners, group);
    }


    void
    Reader::add_cell(const std::vector<unsigned int> &corners,
                     const unsigned long              group)
    {
      const unsigned int n        = corners.size();
      unsigned int       n_turned = 0;
      for (unsigned int k = 0; k < n; ++k)
        {
          const auto  &a     = mesh.vertices[corners[k]];
          const auto  &b     = mesh.vertices[corners[(k + 1) % n]];
          const auto   along = b - a;
          const auto   next  = mesh.vertices[corners[(k + 2) % n]] - b;
          const double turn  = along[0] * next[1] - along[1] * next[0];
          if (!(std::abs(turn) > 1e-12 * along.norm() * next.norm()))
            words.fail("has a cell without area, or with corners in line");
          n_turned += turn < 0. ? 1 : 0;
        }
      if (n_turned != 0 && n_turned != n)
        words.fail("has a quadrilateral that is not convex");
      // Neighbours that both go round to the left pass their face in opposite
      // directions.
      for (unsigned int k = 0; k < n; ++k)
        {
          std::pair<unsigned int, unsigned int> face(corners[k],
                                                     corners[(k + 1) % n]);
          if (n_turned == n)
            std::swap(face.first, face.second);
          if (!faces.insert(face).second)
            words.fail("has a cell that overlaps another one at a face");
        }

      dealii::CellData<2> cell;
      cell.vertices    = corners;
      cell.material_id = group;
      if (n_turned == n)
        std::reverse(cell.vertices.begin() + 1, cell.vertices.end());
      // Gmsh goes round a quadrilateral, deal.II along its rows.
      if (n == 4)
        std::swap(cell.vertices[2], cell.vertices[3]);
      mesh.cells.push_back(cell);
    }
  } // namespace


  GmshMesh
  read_gmsh(const std::string &file)
  {
    return Reader(file).read();
  }
} // namespace Morsel::Scene
