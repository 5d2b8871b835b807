#include <morsel/fe/cell_functions.h>
#include <morsel/fracture/tip_fields.h>

#include <algorithm>
#include <cmath>

namespace Morsel::FE
{
  using namespace dealii;

  std::vector<types::global_dof_index>
  dofs_of(const DoFHandler<2>::active_cell_iterator &cell)
  {
    std::vector<types::global_dof_index> dofs(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    return dofs;
  }


  void
  CellFunctions::evaluate(const Cell                  &cell,
                          const QuadMap               &map,
                          const std::vector<Point<2>> &points,
                          const std::vector<Point<2>> &reference)
  {
    const CellEnrichment &e = space.get_enrichment(cell->active_cell_index());
    const LocalNumbering &n = space.get_numbering(cell->active_fe_index());
    value.resize(points.size(), n.n_scalar);
    dx.resize(points.size(), n.n_scalar);
    dy.resize(points.size(), n.n_scalar);

    space.get_basis(n.degree).evaluate(reference, table, d_xi, d_eta);
    inverse.resize(points.size(), 4);
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const Tensor<2, 2> i = invert(map.jacobian(reference[q]));
        inverse.row(q) << i[0][0], i[0][1], i[1][0], i[1][1];
      }
    value.leftCols(n.n_base) = table;
    for (unsigned int i = 0; i < n.n_base; ++i)
      {
        dx.col(i).array() = inverse.col(0) * d_xi.col(i).array() +
                            inverse.col(2) * d_eta.col(i).array();
        dy.col(i).array() = inverse.col(1) * d_xi.col(i).array() +
                            inverse.col(3) * d_eta.col(i).array();
      }

    unsigned int first = n.n_base;
    for (unsigned int s = 0; s < CellEnrichment::max_slots; ++s)
      if (e.jump_crack[s] != CellEnrichment::none)
        {
          add_jump(first,
                   e.side[s],
                   e.cut ? &space.get_cracks()[e.jump_crack[s]] : nullptr,
                   points);
          first += n.n_base;
        }
    for (unsigned int s = 0; s < CellEnrichment::max_slots; ++s)
      if (e.tip[s] != CellEnrichment::none)
        {
          add_tip(first, e.tip[s], e.ramp[s], points, reference);
          first += 4 * n.n_tip;
        }
  }


  void
  CellFunctions::add_jump(const unsigned int           first,
                          const double                 side,
                          const Fracture::Crack       *crack,
                          const std::vector<Point<2>> &points)
  {
    Eigen::ArrayXd H = Eigen::ArrayXd::Constant(points.size(), side);
    if (crack != nullptr)
      for (unsigned int q = 0; q < points.size(); ++q)
        H(q) = crack->signed_distance(points[q]) < 0. ? -1. : 1.;
    for (unsigned int i = 0; i < table.cols(); ++i)
      {
        value.col(first + i).array() = H * value.col(i).array();
        dx.col(first + i).array()    = H * dx.col(i).array();
        dy.col(first + i).array()    = H * dy.col(i).array();
      }
  }


  void
  CellFunctions::add_tip(const unsigned int           first,
                         const unsigned int           tip,
                         const std::array<double, 4> &ramp,
                         const std::vector<Point<2>> &points,
                         const std::vector<Point<2>> &reference)
  {
    const EnrichmentParameters &parameters = space.get_tip_parameters(tip);
    Eigen::MatrixXd             tip_table, tip_xi, tip_eta;
    space.get_basis(parameters.tip_degree)
        .evaluate(reference, tip_table, tip_xi, tip_eta);
    // Value and two derivatives of each product, by columns.
    Eigen::ArrayXXd RF(points.size(), 12);
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const auto at_point = blended_tip_functions(
            tip,
            ramp,
            Tensor<2, 2>({{inverse(q, 0), inverse(q, 1)},
                          {inverse(q, 2), inverse(q, 3)}}),
            points[q],
            reference[q]);
        for (unsigned int k = 0; k < 4; ++k)
          {
            RF(q, 3 * k)     = at_point[k].value;
            RF(q, 3 * k + 1) = at_point[k].gradient[0];
            RF(q, 3 * k + 2) = at_point[k].gradient[1];
          }
      }
    const unsigned int n = tip_table.cols();
    Eigen::ArrayXd     Nx, Ny;
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto N = tip_table.col(i).array();
        Nx           = inverse.col(0) * tip_xi.col(i).array() +
             inverse.col(2) * tip_eta.col(i).array();
        Ny = inverse.col(1) * tip_xi.col(i).array() +
             inverse.col(3) * tip_eta.col(i).array();
        for (unsigned int k = 0; k < 4; ++k)
          {
            const unsigned int c = first + k * n + i;
            value.col(c).array() = RF.col(3 * k) * N;
            dx.col(c).array()    = RF.col(3 * k) * Nx + RF.col(3 * k + 1) * N;
            dy.col(c).array()    = RF.col(3 * k) * Ny + RF.col(3 * k + 2) * N;
          }
      }
  }


  std::array<Fracture::ValueAndGradient, 4>
  CellFunctions::blended_tip_functions(const unsigned int           tip,
                                       const std::array<double, 4> &ramp,
                                       const Tensor<2, 2>          &inverse,
                                       const Point<2>              &point,
                                       const Point<2> &reference) const
  {
    auto F = Fracture::tip_functions(space.get_tips()[tip], point);
    if (!space.get_tip_parameters(tip).ramp)
      return F;
    // The ramp is bilinear on the cell.
    const double x = reference[0], y = reference[1];
    const double R = (1. - y) * ((1. - x) * ramp[0] + x * ramp[1]) +
                     y * ((1. - x) * ramp[2] + x * ramp[3]);
    const Tensor<1, 2> d(
        {(1. - y) * (ramp[1] - ramp[0]) + y * (ramp[3] - ramp[2]),
         (1. - x) * (ramp[2] - ramp[0]) + x * (ramp[3] - ramp[1])});
    const Tensor<1, 2> dR = transpose(inverse) * d;
    for (Fracture::ValueAndGradient &f : F)
      {
        f.gradient = R * f.gradient + f.value * dR;
        f.value *= R;
      }
    return F;
  }


  Eigen::MatrixX2d
  CellFunctions::coefficients(const Cell                &cell,
                              const std::vector<double> &local) const
  {
    const LocalNumbering &n = space.get_numbering(cell->active_fe_index());
    Eigen::MatrixX2d      c(n.n_scalar, 2);
    for (unsigned int i = 0; i < local.size(); ++i)
      c(n.function[i], n.component[i]) = local[i];
    return c;
  }


  std::vector<Fracture::DisplacementSample>
  CellFunctions::sample(const Cell                  &cell,
                        const QuadMap               &map,
                        const Eigen::MatrixX2d      &coefficients,
                        const std::vector<Point<2>> &points,
                        const std::vector<Point<2>> &reference)
  {
    const CellEnrichment &e = space.get_enrichment(cell->active_cell_index());
    const LocalNumbering &n = space.get_numbering(cell->active_fe_index());
    std::vector<Fracture::DisplacementSample> samples(points.size());
    std::vector<Tensor<2, 2>>                 inverse(points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      inverse[q] = invert(map.jacobian(reference[q]));

    // Adds factor(q) times the product of a multiplier's values, tabulated in
    // table, d_xi, d_eta, with its coefficients.
    unsigned int first     = 0;
    const auto   add_block = [&](const unsigned int size, const auto &factor) {
      const auto            c = coefficients.middleRows(first, size);
      const Eigen::MatrixXd v = table * c, vx = d_xi * c, vy = d_eta * c;
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const Fracture::ValueAndGradient f = factor(q);
          for (unsigned int i = 0; i < 2; ++i)
            {
              samples[q].value[i] += f.value * v(q, i);
              for (unsigned int j = 0; j < 2; ++j)
                samples[q].gradient[i][j] +=
                    f.gradient[j] * v(q, i) +
                    f.value * (inverse[q][0][j] * vx(q, i) +
                               inverse[q][1][j] * vy(q, i));
            }
        }
      first += size;
    };
    const auto constant = [](const double value) {
      Fracture::ValueAndGradient f;
      f.value = value;
      return f;
    };

    space.get_basis(n.degree).evaluate(reference, table, d_xi, d_eta);
    add_block(n.n_base, [&](const unsigned int) { return constant(1.); });
    for (unsigned int s = 0; s < CellEnrichment::max_slots; ++s)
      if (e.jump_crack[s] != CellEnrichment::none)
        {
          const Fracture::Crack &crack = space.get_cracks()[e.jump_crack[s]];
          add_block(n.n_base, [&](const unsigned int q) {
            return constant(!e.cut                                  ? e.side[s]
                            : crack.signed_distance(points[q]) < 0. ? -1.
                                                                    : 1.);
          });
        }
    for (unsigned int s = 0; s < CellEnrichment::max_slots; ++s)
      if (e.tip[s] != CellEnrichment::none)
        {
          space.get_basis(space.get_tip_parameters(e.tip[s]).tip_degree)
              .evaluate(reference, table, d_xi, d_eta);
          std::vector<std::array<Fracture::ValueAndGradient, 4>> products;
          for (unsigned int q = 0; q < points.size(); ++q)
            products.push_back(blended_tip_functions(
                e.tip[s], e.ramp[s], inverse[q], points[q], reference[q]));
          for (unsigned int k = 0; k < 4; ++k)
            add_block(n.n_tip,
                      [&](const unsigned int q) { return products[q][k]; });
        }
    return samples;
  }


  CellQuadrature
  CellFunctions::quadrature(const Cell        &cell,
                            const QuadMap     &map,
                            const unsigned int extra) const
  {
    const CellEnrichment &e = space.get_enrichment(cell->active_cell_index());
    const LocalNumbering &n = space.get_numbering(cell->active_fe_index());
    // Tip functions are analytic off the tip: n Gauss points more than their
    // polynomial factors need leave an error of (z + sqrt(z^2 - 1))^(-2n),
    // z = 1 + 2 distance/width (Davis and Rabinowitz); n for 1e-6.
    std::vector<Point<2>> near_tips;
    unsigned int          points = n.degree + 1;
    const double          width  = map.diameter() / std::sqrt(2.);
    for (const int t : e.tip)
      if (t != CellEnrichment::none)
        {
          const Point<2> tip      = space.get_tips()[t].position;
          const double   distance = distance_to_polygon(tip, map.polygon());
          if (distance < 2. * width)
            near_tips.push_back(tip);
          const double       z = 1. + 2. * std::max(distance / width, 0.2);
          const unsigned int more =
              std::ceil(6.9 / std::log(z + std::sqrt(z * z - 1.)));
          points = std::max(
              points,
              std::max(n.degree, space.get_tip_parameters(t).tip_degree) + 1 +
                  more);
        }
    if (!e.cut && near_tips.empty())
      return gauss_quadrature(map, points + extra);
    std::vector<Fracture::Crack> near_cracks;
    if (e.cut)
      near_cracks = space.get_cracks();
    return cut_quadrature(map,
                          cut_into_pieces(map.polygon(), near_cracks),
                          near_tips,
                          points + extra);
  }


  Eigen::MatrixXd
  element_stiffness(CellFunctions                &functions,
                    const CellFunctions::Cell    &cell,
                    const QuadMap                &map,
                    const LocalNumbering         &numbering,
                    const CellQuadrature         &quadrature,
                    const Fracture::ElasticPlane &material,
                    const double                  regularisation)
  {
    // Integrals of the products of two derivatives. Of the first two, which
    // are symmetric, only the lower half; points in blocks that stay in the
    // cache: about a tip there are thousands.
    constexpr unsigned int block = 128;
    const unsigned int     m     = numbering.n_scalar;
    Eigen::MatrixXd        xx = Eigen::MatrixXd::Zero(m, m), yy = xx, xy = xx;
    Eigen::MatrixXd        wx, wy;
    for (unsigned int first = 0; first < quadrature.points.size();
         first += block)
      {
        const auto n_points =
            std::min<std::size_t>(block, quadrature.points.size() - first);
        const auto part = [&](const std::vector<Point<2>> &all) {
          return std::vector<Point<2>>(all.begin() + first,
                                       all.begin() + first + n_points);
        };
        functions.evaluate(
            cell, map, part(quadrature.points), part(quadrature.reference));
        const Eigen::MatrixXd &dx = functions.d_x(), &dy = functions.d_y();
        const Eigen::Map<const Eigen::VectorXd> w(&quadrature.weights[first],
                                                  n_points);
        wx = w.asDiagonal() * dx;
        wy = w.asDiagonal() * dy;
        xx.triangularView<Eigen::Lower>() += dx.transpose() * wx;
        yy.triangularView<Eigen::Lower>() += dy.transpose() * wy;
        xy.noalias() += dx.transpose() * wy;
      }
    xx.triangularView<Eigen::StrictlyUpper>() = xx.transpose();
    yy.triangularView<Eigen::StrictlyUpper>() = yy.transpose();
    const double mu                           = material.mu;
    const double lam                          = material.lambda;

    const unsigned int n = numbering.function.size();
    Eigen::MatrixXd    K(n, n);
    for (unsigned int j = 0; j < n; ++j)
      {
        const unsigned int fj = numbering.function[j];
        const unsigned int cj = numbering.component[j];
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int fi = numbering.function[i];
            const unsigned int ci = numbering.component[i];
            if (ci == cj)
              K(i, j) = ci == 0
                            ? (lam + 2. * mu) * xx(fi, fj) + mu * yy(fi, fj)
                            : (lam + 2. * mu) * yy(fi, fj) + mu * xx(fi, fj);
            else
              K(i, j) = ci == 0 ? lam * xy(fi, fj) + mu * xy(fj, fi)
                                : lam * xy(fj, fi) + mu * xy(fi, fj);
          }
      }
    // A jump function has the stiffness of a base function of the order of
    // lambda + 2 mu; where a crack leaves a sliver, far less of it counts.
    for (unsigned int i = 0; i < n; ++i)
      if (numbering.kind[i] > CellEnrichment::max_slots)
        K(i, i) *= 1. + regularisation;
      else if (numbering.kind[i] != 0)
        K(i, i) += regularisation * (lam + 2. * mu);
    return K;
  }
} // namespace Morsel::FE
