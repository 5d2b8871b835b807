#include <morsel/fe/cell_functions.h>
#include <morsel/fe/elastic_body.h>
#include <morsel/materials/elasticity.h>

#include <array>
#include <map>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    using Cell = DoFHandler<2>::active_cell_iterator;


    /// Vertices of a face, counter-clockwise about the cell.
    constexpr std::array<std::array<unsigned int, 2>, 4> face_vertices = {
        {{{2, 0}}, {{1, 3}}, {{0, 1}}, {{3, 2}}}};


    std::vector<types::global_dof_index>
    dofs_of(const Cell &cell)
    {
      std::vector<types::global_dof_index> dofs(
          cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      return dofs;
    }


    /// Consistent mass of unit density and depth, in the cell's dofs.
    Eigen::MatrixXd
    element_mass(const CellFunctions       &functions,
                 const LocalNumbering      &numbering,
                 const std::vector<double> &weights)
    {
      const Eigen::Map<const Eigen::VectorXd> w(weights.data(), weights.size());
      const Eigen::MatrixXd                   products =
          functions.values().transpose() * w.asDiagonal() * functions.values();
      const unsigned int n = numbering.function.size();
      Eigen::MatrixXd    mass(n, n);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          mass(i, j) =
              numbering.component[i] == numbering.component[j]
                  ? products(numbering.function[i], numbering.function[j])
                  : 0.;
      return mass;
    }
  } // namespace


  ElasticBody::ElasticBody(std::unique_ptr<Triangulation<2>> mesh,
                           const ElasticBodyProperties      &properties)
      : properties(properties)
      , material(properties.youngs_modulus, properties.poissons_ratio)
      , mesh(std::move(mesh))
      , space(std::make_unique<XFEMSpace>(*this->mesh,
                                          std::vector<Fracture::Crack>(),
                                          std::vector<EnrichmentParameters>()))
  {
    space->distribute(std::vector<unsigned int>(this->mesh->n_active_cells(),
                                                properties.degree));
    make_matrices();
    find_held_dofs();
    make_surface();
  }


  void
  ElasticBody::for_each_element(const UseOfElement &use) const
  {
    CellFunctions functions(*space);
    for (const auto &cell : space->get_dof_handler().active_cell_iterators())
      {
        const QuadMap         map = make_map(cell);
        const LocalNumbering &n = space->get_numbering(cell->active_fe_index());
        const CellQuadrature  q = functions.quadrature(cell, map, 1);
        functions.evaluate(cell, map, q.points, q.reference);
        use({cell->center(),
             dofs_of(cell),
             properties.depth *
                 element_stiffness(functions, n, q.weights, material, 0.),
             properties.depth * properties.density *
                 element_mass(functions, n, q.weights)});
      }
  }


  void
  ElasticBody::make_matrices()
  {
    std::vector<Eigen::Triplet<double>> stiffness, mass;
    for_each_element([&](const Element &e) {
      for (unsigned int i = 0; i < e.dofs.size(); ++i)
        for (unsigned int j = 0; j < e.dofs.size(); ++j)
          {
            stiffness.emplace_back(e.dofs[i], e.dofs[j], e.stiffness(i, j));
            if (e.mass(i, j) != 0.)
              mass.emplace_back(e.dofs[i], e.dofs[j], e.mass(i, j));
          }
    });
    K.resize(n_dofs(), n_dofs());
    M.resize(n_dofs(), n_dofs());
    K.setFromTriplets(stiffness.begin(), stiffness.end());
    M.setFromTriplets(mass.begin(), mass.end());
  }


  void
  ElasticBody::find_held_dofs()
  {
    held_dofs = Eigen::VectorXd::Zero(n_dofs());
    for (const auto &cell : space->get_dof_handler().active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f) &&
            properties.held.count(cell->face(f)->boundary_id()) > 0)
          {
            const auto dofs = dofs_of(cell);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (cell->get_fe().has_support_on_face(i, f))
                held_dofs[dofs[i]] = 1.;
          }
  }


  void
  ElasticBody::make_surface()
  {
    struct Face
    {
      Cell         cell;
      unsigned int face, second;
    };
    std::map<unsigned int, Face> faces; // by the first vertex
    for (const auto &cell : space->get_dof_handler().active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          faces.emplace(cell->vertex_index(face_vertices[f][0]),
                        Face{cell, f, cell->vertex_index(face_vertices[f][1])});

    // A polyline follows a function of higher degree the closer, the more
    // facets it has.
    const unsigned int pieces =
        properties.degree == 1 ? 1 : 2 * properties.degree;
    std::vector<Eigen::Triplet<double>> rows;
    CellFunctions                       functions(*space);
    while (!faces.empty())
      {
        const unsigned int first_node = nodes.size();
        for (auto face = faces.begin(); face != faces.end();)
          {
            const auto [cell, f, next] = face->second;
            const QuadMap         map  = make_map(cell);
            const LocalNumbering &n =
                space->get_numbering(cell->active_fe_index());
            const auto     dofs = dofs_of(cell);
            const Point<2> a    = cell->vertex(face_vertices[f][0]);
            const Point<2> b    = cell->vertex(face_vertices[f][1]);
            for (unsigned int p = 0; p < pieces; ++p)
              {
                const Point<2> x =
                    a + (static_cast<double>(p) / pieces) * (b - a);
                functions.evaluate(cell, map, {x}, {map.to_reference(x)});
                for (unsigned int i = 0; i < dofs.size(); ++i)
                  if (const double value = functions.values()(0, n.function[i]);
                      std::abs(value) > 1e-14)
                    rows.emplace_back(
                        2 * nodes.size() + n.component[i], dofs[i], value);
                facets.emplace_back(nodes.size(), nodes.size() + 1);
                nodes.push_back(x);
              }
            faces.erase(face);
            face = faces.find(next);
          }
        facets.back().second = first_node;
      }
    surface_trace.resize(2 * nodes.size(), n_dofs());
    surface_trace.setFromTriplets(rows.begin(), rows.end());
  }


  Eigen::VectorXd
  ElasticBody::uniform(const unsigned int component) const
  {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(n_dofs());
    for (const auto &cell : space->get_dof_handler().active_cell_iterators())
      {
        const LocalNumbering &n = space->get_numbering(cell->active_fe_index());
        const auto            dofs = dofs_of(cell);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (n.kind[i] == 0 && n.component[i] == component)
            u[dofs[i]] = 1.;
      }
    return u;
  }


  Multifrontal
  ElasticBody::factorise(const double stiffness_factor,
                         const double mass_factor) const
  {
    Assert(mass_factor > 0. || is_held(),
           ExcMessage("A body that nothing holds has no static stiffness."));
    std::vector<ElementSystem> elements;
    for_each_element([&](const Element &element) {
      std::vector<unsigned int> is_free;
      ElementSystem             e;
      e.center = element.center;
      for (unsigned int i = 0; i < element.dofs.size(); ++i)
        if (held_dofs[element.dofs[i]] == 0.)
          {
            is_free.push_back(i);
            e.dofs.push_back(element.dofs[i]);
          }
      if (is_free.empty())
        return;
      const Eigen::MatrixXd matrix =
          stiffness_factor * element.stiffness + mass_factor * element.mass;
      e.matrix = matrix(is_free, is_free);
      e.rhs    = Eigen::VectorXd::Zero(is_free.size());
      elements.push_back(std::move(e));
    });
    Multifrontal factors;
    factors.factorise(std::move(elements), n_dofs());
    return factors;
  }


  CellCornerFields
  ElasticBody::corner_fields(const Eigen::VectorXd &displacement) const
  {
    const std::vector<Point<2>> corners = {
        {0., 0.}, {1., 0.}, {0., 1.}, {1., 1.}};
    CellCornerFields fields;
    CellFunctions    functions(*space);
    for (const auto &cell : space->get_dof_handler().active_cell_iterators())
      {
        const QuadMap       map = make_map(cell);
        std::vector<double> local;
        for (const auto dof : dofs_of(cell))
          local.push_back(displacement[dof]);
        std::vector<Point<2>> points;
        for (unsigned int v = 0; v < 4; ++v)
          points.push_back(cell->vertex(v));
        const auto samples = functions.sample(
            cell, map, functions.coefficients(cell, local), points, corners);
        for (unsigned int v = 0; v < 4; ++v)
          {
            const auto   s  = material.stress(samples[v].gradient);
            const double zz = material.out_of_plane_stress(s);
            fields.points.push_back(points[v]);
            for (unsigned int d = 0; d < 2; ++d)
              fields.displacement.push_back(samples[v].value[d]);
            for (unsigned int d = 0; d < 2; ++d)
              for (unsigned int e = 0; e < 2; ++e)
                fields.stress.push_back(s[d][e]);
            fields.von_mises.push_back(
                Materials::von_mises({s[0][0], s[1][1], s[0][1], zz}));
          }
      }
    return fields;
  }
} // namespace Morsel::FE
