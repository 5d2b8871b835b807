#include <morsel/fe/cell_functions.h>
#include <morsel/fe/crack_functionals.h>
#include <morsel/fe/ring_quadrature.h>

namespace Morsel::FE
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int places_per_crack = 32;

    using Triplets = std::vector<Eigen::Triplet<double>>;


    /// What one point of a ring adds to K_I and K_II per unit of each
    /// component of the gradient there [Pa sqrt(m)].
    using WeightOfGradient = std::array<Tensor<2, 2>, 2>;

    WeightOfGradient
    weight_at(const Fracture::InteractionIntegral &empty,
              const Fracture::ElasticPlane        &material,
              const Point<2>                      &p,
              const double                         weight)
    {
      WeightOfGradient result;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          {
            Tensor<2, 2> unit;
            unit[i][j]    = 1.;
            auto integral = empty;
            integral.add(p, unit, material.stress(unit), weight);
            const auto K    = integral.stress_intensity();
            result[0][i][j] = K.mode_I;
            result[1][i][j] = K.mode_II;
          }
      return result;
    }


    /// Rows of K_I and K_II of each ring of one tip.
    void
    add_intensity_rows(const XFEMSpace              &space,
                       const Fracture::ElasticPlane &material,
                       const TipResult              &tip,
                       const unsigned int            first_row,
                       Triplets                     &rows)
    {
      const Fracture::CrackTip &place = space.get_tips()[tip.tip];
      CellFunctions             functions(space);
      for_each_ring_cell(
          space,
          place,
          tip.rings,
          [&](const auto &cell, const QuadMap &map, const CellQuadrature &q) {
            functions.evaluate(cell, map, q.points, q.reference);
            const LocalNumbering &n =
                space.get_numbering(cell->active_fe_index());
            const auto dofs = dofs_of(cell);
            for (unsigned int r = 0; r < tip.rings.size(); ++r)
              {
                const Fracture::InteractionIntegral empty(
                    place, material, tip.rings[r]);
                Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(2, dofs.size());
                for (unsigned int p = 0; p < q.points.size(); ++p)
                  {
                    if (!empty.reaches(q.points[p]))
                      continue;
                    const auto A =
                        weight_at(empty, material, q.points[p], q.weights[p]);
                    for (unsigned int i = 0; i < dofs.size(); ++i)
                      for (unsigned int mode = 0; mode < 2; ++mode)
                        sums(mode, i) += A[mode][n.component[i]][0] *
                                             functions.d_x()(p, n.function[i]) +
                                         A[mode][n.component[i]][1] *
                                             functions.d_y()(p, n.function[i]);
                  }
                for (unsigned int i = 0; i < dofs.size(); ++i)
                  for (unsigned int mode = 0; mode < 2; ++mode)
                    rows.emplace_back(
                        first_row + 2 * r + mode, dofs[i], sums(mode, i));
              }
          });
    }


    /// Adds sign * normal . u(p) to a row.
    /// @return whether the point lies in the body
    bool
    add_value(const XFEMSpace    &space,
              const Point<2>     &p,
              const Tensor<1, 2> &weight,
              const unsigned int  row,
              Triplets           &rows)
    {
      CellFunctions functions(space);
      for (const auto &cell : space.get_dof_handler().active_cell_iterators())
        {
          const QuadMap map = make_map(cell);
          if (p.distance(cell->center()) > cell->diameter() ||
              distance_to_polygon(p, map.polygon()) > 0.)
            continue;
          functions.evaluate(cell, map, {p}, {map.to_reference(p)});
          const LocalNumbering &n =
              space.get_numbering(cell->active_fe_index());
          const auto dofs = dofs_of(cell);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            rows.emplace_back(row,
                              dofs[i],
                              weight[n.component[i]] *
                                  functions.values()(0, n.function[i]));
          return true;
        }
      return false;
    }


    /// A row for each of the places along a crack that lie in the body.
    void
    add_opening_rows(const XFEMSpace       &space,
                     const Fracture::Crack &crack,
                     unsigned int          &n_rows,
                     Triplets              &rows)
    {
      const auto  &v      = crack.get_vertices();
      const double length = crack.length();
      for (unsigned int k = 0; k < places_per_crack; ++k)
        {
          double       s       = (k + 0.5) / places_per_crack * length;
          unsigned int segment = 0;
          while (segment + 2 < v.size() &&
                 s > v[segment].distance(v[segment + 1]))
            {
              s -= v[segment].distance(v[segment + 1]);
              ++segment;
            }
          const Tensor<1, 2> along = (v[segment + 1] - v[segment]) /
                                     v[segment].distance(v[segment + 1]);
          const Tensor<1, 2> normal({-along[1], along[0]});
          const Point<2>     p   = v[segment] + s * along;
          const double       off = 1e-7 * length;
          Triplets           faces;
          if (add_value(space, p + off * normal, normal, n_rows, faces) &&
              add_value(space, p - off * normal, -normal, n_rows, faces))
            {
              rows.insert(rows.end(), faces.begin(), faces.end());
              ++n_rows;
            }
        }
    }


    Eigen::SparseMatrix<double>
    matrix_of(const Triplets                    &rows,
              const unsigned int                 n_rows,
              const Eigen::SparseMatrix<double> &expansion)
    {
      Eigen::SparseMatrix<double> matrix(n_rows, expansion.rows());
      matrix.setFromTriplets(rows.begin(), rows.end());
      return matrix * expansion;
    }
  } // namespace


  CrackFunctionals::CrackFunctionals(
      const XFEMSpace                   &space,
      const Fracture::ElasticPlane      &material,
      const double                       ring_radius,
      const Eigen::SparseMatrix<double> &expansion)
      : tips(space.get_tips())
  {
    Triplets     rows;
    unsigned int n_rows = 0;
    for (unsigned int t = 0; t < tips.size(); ++t)
      {
        Fracture::check_ring_radius(
            tips[t],
            space.get_cracks(),
            distance_to_boundary(space.get_dof_handler().get_triangulation(),
                                 tips[t].position),
            ring_radius,
            "Cracks/Ring radius");
        rings.push_back(choose_rings(space, t, ring_radius));
        add_intensity_rows(space, material, rings.back(), n_rows, rows);
        n_rows += 2 * rings.back().rings.size();
      }
    intensity = matrix_of(rows, n_rows, expansion);

    rows.clear();
    n_rows = 0;
    for (const auto &crack : space.get_cracks())
      add_opening_rows(space, crack, n_rows, rows);
    opening = matrix_of(rows, n_rows, expansion);
  }


  std::vector<Fracture::RingStatistics>
  CrackFunctionals::stress_intensity(const Eigen::VectorXd &displacement) const
  {
    const Eigen::VectorXd                 K = intensity * displacement;
    std::vector<Fracture::RingStatistics> result;
    unsigned int                          row = 0;
    for (const TipResult &tip : rings)
      {
        std::vector<Fracture::StressIntensity> by_ring;
        for (unsigned int r = 0; r < tip.rings.size(); ++r, row += 2)
          by_ring.push_back({K[row], K[row + 1]});
        result.push_back(Fracture::ring_statistics(by_ring));
      }
    return result;
  }


  double
  CrackFunctionals::smallest_opening(const Eigen::VectorXd &displacement) const
  {
    return (opening * displacement).minCoeff();
  }
} // namespace Morsel::FE
