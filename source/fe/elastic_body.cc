#include <morsel/fe/cell_functions.h>
#include <morsel/fe/elastic_body.h>
#include <morsel/fe/enrichment_rule.h>
#include <morsel/materials/elasticity.h>

#include <array>
#include <map>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    using Cell = DoFHandler<2>::active_cell_iterator;


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


    /// The corners of quadrilaterals that make up a cell's picture, four each
    /// in deal.II's order: the cell itself, or the pieces that cracks cut it
    /// into, in which corners may coincide.
    std::vector<Point<2>>
    picture_corners(const QuadMap                      &map,
                    const bool                          cut,
                    const std::vector<Fracture::Crack> &cracks)
    {
      const auto &v = map.get_vertices();
      if (!cut)
        return {v.begin(), v.end()};
      std::vector<Point<2>> corners;
      for (const Polygon &piece : cut_into_pieces(map.polygon(), cracks))
        for (unsigned int k = 1; k + 1 < piece.size(); k += 2)
          {
            const Point<2> &last =
                piece[std::min<std::size_t>(k + 2, piece.size() - 1)];
            corners.insert(corners.end(),
                           {piece[0], piece[k], last, piece[k + 1]});
          }
      return corners;
    }


    /// A corner of such a quadrilateral, a little way towards its middle.
    Point<2>
    moved_inwards(const std::vector<Point<2>> &corners, const unsigned int k)
    {
      constexpr double share = 1e-6;
      Tensor<1, 2>     middle;
      for (unsigned int i = 0; i < 4; ++i)
        middle += 0.25 * corners[k - k % 4 + i];
      return corners[k] + share * (middle - corners[k]);
    }
  } // namespace


  ElasticBody::ElasticBody(std::unique_ptr<Triangulation<2>> mesh,
                           const ElasticBodyProperties      &properties,
                           const ElasticBodyCracks          &given)
      : properties(properties)
      , material(properties.youngs_modulus, properties.poissons_ratio)
      , mesh(std::move(mesh))
      , space(std::make_unique<XFEMSpace>(
            *this->mesh,
            given.cracks,
            enrichment_by_rule(*this->mesh, given.cracks, properties.degree)))
  {
    const std::string finer = "raise 'Deformation/Tip refinements', or lower "
                              "'Deformation/Cell size'";
    check_tips_apart(*this->mesh, space->get_tips(), finer);
    check_room_for_rings(*space, given.ring_radius, finer);
    space->distribute(std::vector<unsigned int>(this->mesh->n_active_cells(),
                                                properties.degree));
    make_expansion();
    make_matrices();
    find_held_dofs();
    make_surface();
    if (!given.cracks.empty())
      crack_functionals = std::make_unique<CrackFunctionals>(
          *space, material, given.ring_radius, expansion);
  }


  void
  ElasticBody::make_expansion()
  {
    constraints.reinit(space->get_relevant_dofs());
    constraints.merge(space->get_constraints());
    constraints.close();
    std::vector<Eigen::Triplet<double>> entries;
    for (unsigned int i = 0; i < n_dofs(); ++i)
      if (!constraints.is_constrained(i))
        entries.emplace_back(i, i, 1.);
      else
        for (const auto &[master, weight] :
             *constraints.get_constraint_entries(i))
          entries.emplace_back(i, master, weight);
    expansion.resize(n_dofs(), n_dofs());
    expansion.setFromTriplets(entries.begin(), entries.end());
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
        const Eigen::MatrixXd stiffness =
            properties.depth * element_stiffness(functions,
                                                 cell,
                                                 map,
                                                 n,
                                                 q,
                                                 material,
                                                 enrichment_regularisation);
        functions.evaluate(cell, map, q.points, q.reference);
        use({cell->center(),
             dofs_of(cell),
             stiffness,
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
    if (constraints.n_constraints() > 0)
      {
        const Eigen::SparseMatrix<double> C = expansion;
        K = Eigen::SparseMatrix<double>(C.transpose() * K * C);
        M = Eigen::SparseMatrix<double>(C.transpose() * M * C);
      }
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
                {
                  if (!constraints.is_constrained(dofs[i]))
                    held_dofs[dofs[i]] = 1.;
                  else // tied to another function of the same node
                    for (const auto &tie :
                         *constraints.get_constraint_entries(dofs[i]))
                      held_dofs[tie.first] = 1.;
                }
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
    surface_trace = surface_trace * expansion;
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
          if (n.kind[i] == 0 && n.component[i] == component &&
              !constraints.is_constrained(dofs[i]))
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
      ElementSystem e;
      e.center = element.center;
      e.dofs.assign(element.dofs.begin(), element.dofs.end());
      e.matrix =
          stiffness_factor * element.stiffness + mass_factor * element.mass;
      e.rhs = Eigen::VectorXd::Zero(e.dofs.size());
      condense(e, constraints);
      std::vector<unsigned int> is_free, free_dofs;
      for (unsigned int i = 0; i < e.dofs.size(); ++i)
        if (held_dofs[e.dofs[i]] == 0.)
          {
            is_free.push_back(i);
            free_dofs.push_back(e.dofs[i]);
          }
      if (is_free.empty())
        return;
      const Eigen::MatrixXd matrix = e.matrix(is_free, is_free);
      e.matrix                     = matrix;
      e.dofs                       = free_dofs;
      e.rhs                        = Eigen::VectorXd::Zero(is_free.size());
      elements.push_back(std::move(e));
    });
    Multifrontal factors;
    factors.factorise(std::move(elements), n_dofs());
    return factors;
  }


  CellCornerFields
  ElasticBody::corner_fields(const Eigen::VectorXd &displacement) const
  {
    const Eigen::VectorXd u = expansion * displacement;
    CellCornerFields      fields;
    CellFunctions         functions(*space);
    for (const auto &cell : space->get_dof_handler().active_cell_iterators())
      {
        const QuadMap       map = make_map(cell);
        std::vector<double> local;
        for (const auto dof : dofs_of(cell))
          local.push_back(u[dof]);
        const CellEnrichment &e =
            space->get_enrichment(cell->active_cell_index());
        const auto corners = picture_corners(map, e.cut, space->get_cracks());
        // Off the crack and the tip, where the fields have no value.
        std::vector<Point<2>> places, reference;
        for (unsigned int k = 0; k < corners.size(); ++k)
          {
            places.push_back(e.enriched() ? moved_inwards(corners, k)
                                          : corners[k]);
            reference.push_back(map.to_reference(places.back()));
          }
        const auto samples = functions.sample(
            cell, map, functions.coefficients(cell, local), places, reference);
        for (unsigned int k = 0; k < corners.size(); ++k)
          {
            const auto   s  = material.stress(samples[k].gradient);
            const double zz = material.out_of_plane_stress(s);
            fields.points.push_back(corners[k]);
            for (unsigned int d = 0; d < 2; ++d)
              fields.displacement.push_back(samples[k].value[d]);
            for (unsigned int d = 0; d < 2; ++d)
              for (unsigned int f = 0; f < 2; ++f)
                fields.stress.push_back(s[d][f]);
            fields.von_mises.push_back(
                Materials::von_mises({s[0][0], s[1][1], s[0][1], zz}));
          }
      }
    return fields;
  }
} // namespace Morsel::FE
