#include <morsel/fe/multifrontal.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Morsel::FE
{
  namespace
  {
    constexpr unsigned int nowhere = static_cast<unsigned int>(-1);

    /// Pivots below this share of the dof's diagonal entry are round-off.
    constexpr double significant_pivot = 1e-14;

    constexpr unsigned int panel_width = 48;
  } // namespace


  void
  Multifrontal::order(const unsigned int begin, const unsigned int end)
  {
    if (end - begin <= 1)
      return;
    // Halve the longer side of the elements' bounding box.
    double low[2]  = {std::numeric_limits<double>::max(),
                      std::numeric_limits<double>::max()};
    double high[2] = {-low[0], -low[1]};
    for (unsigned int i = begin; i < end; ++i)
      for (unsigned int d = 0; d < 2; ++d)
        {
          const double x = elements[position[i]].center[d];
          low[d]         = std::min(low[d], x);
          high[d]        = std::max(high[d], x);
        }
    const unsigned int d      = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
    const unsigned int middle = (begin + end) / 2;
    std::nth_element(position.begin() + begin,
                     position.begin() + middle,
                     position.begin() + end,
                     [&](const unsigned int a, const unsigned int b) {
                       const auto &p = elements[a].center;
                       const auto &q = elements[b].center;
                       return p[d] != q[d] ? p[d] < q[d] : p[1 - d] < q[1 - d];
                     });
    order(begin, middle);
    order(middle, end);
  }


  Multifrontal::Front
  Multifrontal::factor(const unsigned int begin, const unsigned int end)
  {
    if (end - begin == 1)
      {
        ElementSystem &e = elements[position[begin]];
        return eliminate({std::move(e.dofs), std::move(e.matrix)}, begin, end);
      }
    const unsigned int middle = (begin + end) / 2;
    Front              a      = factor(begin, middle);
    Front              b      = factor(middle, end);
    return eliminate(merge(a, b), begin, end);
  }


  Multifrontal::Front
  Multifrontal::merge(Front &a, Front &b)
  {
    // Lower triangles only are kept; rows keep a's order, b's own follow.
    Front merged;
    merged.dofs = a.dofs;
    for (unsigned int i = 0; i < a.dofs.size(); ++i)
      place[a.dofs[i]] = i;
    std::vector<unsigned int> to(b.dofs.size());
    for (unsigned int i = 0; i < b.dofs.size(); ++i)
      {
        if (place[b.dofs[i]] == nowhere)
          {
            place[b.dofs[i]] = merged.dofs.size();
            merged.dofs.push_back(b.dofs[i]);
          }
        to[i] = place[b.dofs[i]];
      }
    for (const unsigned int dof : merged.dofs)
      place[dof] = nowhere;

    const unsigned int n = merged.dofs.size(), na = a.dofs.size();
    merged.matrix                       = Eigen::MatrixXd::Zero(n, n);
    merged.matrix.topLeftCorner(na, na) = a.matrix;
    for (unsigned int j = 0; j < to.size(); ++j)
      for (unsigned int i = j; i < to.size(); ++i)
        merged.matrix(std::max(to[i], to[j]), std::min(to[i], to[j])) +=
            b.matrix(i, j);
    a = Front();
    b = Front();
    return merged;
  }


  Multifrontal::Front
  Multifrontal::eliminate(Front            &&front,
                          const unsigned int begin,
                          const unsigned int end)
  {
    // Fully summed dofs come first.
    const unsigned int        n = front.dofs.size();
    std::vector<unsigned int> permutation;
    for (const bool summed : {true, false})
      for (unsigned int i = 0; i < n; ++i)
        if ((first[front.dofs[i]] >= begin && last[front.dofs[i]] < end) ==
            summed)
          permutation.push_back(i);
    unsigned int n_eliminated = 0;
    for (const unsigned int i : permutation)
      if (first[front.dofs[i]] >= begin && last[front.dofs[i]] < end)
        ++n_eliminated;
    if (n_eliminated == 0)
      return std::move(front);

    Eigen::MatrixXd A(n, n);
    Factor          factor;
    factor.dofs.resize(n);
    factor.n_eliminated = n_eliminated;
    for (unsigned int j = 0; j < n; ++j)
      {
        const unsigned int pj = permutation[j];
        factor.dofs[j]        = front.dofs[pj];
        for (unsigned int i = j; i < n; ++i)
          {
            const unsigned int pi = permutation[i];
            A(i, j) = pi >= pj ? front.matrix(pi, pj) : front.matrix(pj, pi);
          }
      }
    front     = Front();
    max_front = std::max(max_front, n);

    factor.dropped.assign(n_eliminated, false);
    for (unsigned int k = 0; k < n_eliminated; k += panel_width)
      {
        const unsigned int w = std::min(panel_width, n_eliminated - k);
        for (unsigned int c = k; c < k + w; ++c)
          {
            double      &pivot = A(c, c);
            const double scale = diagonal[factor.dofs[c]];
            if (!(pivot > significant_pivot * scale))
              {
                factor.dropped[c] = true;
                ++n_dropped;
                A.col(c).tail(n - c).setZero();
                pivot = 1.;
                continue;
              }
            smallest_pivot = std::min(smallest_pivot, pivot / scale);
            pivot          = std::sqrt(pivot);
            A.col(c).segment(c + 1, k + w - c - 1) /= pivot;
            for (unsigned int j = c + 1; j < k + w; ++j)
              A.col(j).segment(j, k + w - j) -=
                  A(j, c) * A.col(c).segment(j, k + w - j);
          }
        const unsigned int rest = n - k - w;
        const auto         L =
            A.block(k, k, w, w).template triangularView<Eigen::Lower>();
        if (rest == 0)
          continue;
        auto below = A.block(k + w, k, rest, w);
        L.transpose().template solveInPlace<Eigen::OnTheRight>(below);
        for (unsigned int c = 0; c < w; ++c)
          if (factor.dropped[k + c])
            below.col(c).setZero();
        A.block(k + w, k + w, rest, rest)
            .template selfadjointView<Eigen::Lower>()
            .rankUpdate(below, -1.);
      }

    const unsigned int rest = n - n_eliminated;
    Front              schur;
    schur.dofs.assign(factor.dofs.begin() + n_eliminated, factor.dofs.end());
    schur.matrix   = A.bottomRightCorner(rest, rest);
    factor.columns = A.leftCols(n_eliminated);
    factors.push_back(std::move(factor));
    return schur;
  }


  Eigen::VectorXd
  Multifrontal::solve(const Eigen::VectorXd &rhs) const
  {
    Eigen::VectorXd x = rhs;
    Eigen::VectorXd rest;
    for (const Factor &factor : factors)
      {
        const unsigned int m = factor.n_eliminated, n = factor.dofs.size();
        Eigen::VectorXd    y(m);
        for (unsigned int i = 0; i < m; ++i)
          y(i) = x(factor.dofs[i]);
        factor.columns.topRows(m)
            .template triangularView<Eigen::Lower>()
            .solveInPlace(y);
        // The unknown of a dropped pivot is zero.
        for (unsigned int i = 0; i < m; ++i)
          x(factor.dofs[i]) = factor.dropped[i] ? 0. : y(i);
        rest = factor.columns.bottomRows(n - m) * y;
        for (unsigned int i = m; i < n; ++i)
          x(factor.dofs[i]) -= rest(i - m);
      }
    for (auto factor = factors.rbegin(); factor != factors.rend(); ++factor)
      {
        const unsigned int m = factor->n_eliminated, n = factor->dofs.size();
        Eigen::VectorXd    y(m);
        rest.resize(n - m);
        for (unsigned int i = 0; i < m; ++i)
          y(i) = x(factor->dofs[i]);
        for (unsigned int i = m; i < n; ++i)
          rest(i - m) = x(factor->dofs[i]);
        y -= factor->columns.bottomRows(n - m).transpose() * rest;
        factor->columns.topRows(m)
            .template triangularView<Eigen::Lower>()
            .transpose()
            .solveInPlace(y);
        for (unsigned int i = 0; i < m; ++i)
          x(factor->dofs[i]) = factor->dropped[i] ? 0. : y(i);
      }
    for (unsigned int i = 0; i < first.size(); ++i)
      if (first[i] == nowhere)
        x(i) = 0.;
    return x;
  }


  void
  Multifrontal::factorise(std::vector<ElementSystem> &&systems,
                          const unsigned int           n_dofs)
  {
    elements       = std::move(systems);
    n_dropped      = 0;
    smallest_pivot = 1.;
    max_front      = 0;
    factors.clear();
    position.resize(elements.size());
    std::iota(position.begin(), position.end(), 0u);
    order(0, elements.size());

    first.assign(n_dofs, nowhere);
    last.assign(n_dofs, 0);
    diagonal.assign(n_dofs, 0.);
    place.assign(n_dofs, nowhere);
    for (unsigned int p = 0; p < position.size(); ++p)
      {
        const ElementSystem &e = elements[position[p]];
        for (unsigned int i = 0; i < e.dofs.size(); ++i)
          {
            first[e.dofs[i]] = std::min(first[e.dofs[i]], p);
            last[e.dofs[i]]  = p;
            diagonal[e.dofs[i]] += e.matrix(i, i);
          }
      }
    if (!elements.empty())
      factor(0, elements.size());
    elements.clear();
  }
} // namespace Morsel::FE
