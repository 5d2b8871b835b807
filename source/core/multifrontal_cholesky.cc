#include <morsel/core/cholesky_kernels.h>
#include <morsel/core/multifrontal_cholesky.h>
#include <morsel/core/parallel.h>

#include <algorithm>
#include <utility>

namespace Morsel
{
  MultifrontalCholesky::MultifrontalCholesky(const Dissection    &order,
                                             const ElementNodes  &nodes,
                                             const ElementMatrix &matrix)
      : order(order)
      , nodes(nodes)
      , factors(order.fronts.size())
      , remainders(order.fronts.size())
  {
    for (const std::vector<unsigned int> &level : order.levels)
      {
        std::vector<char> good(level.size());
        parallel_for(
            level.size(),
            [&](const unsigned int begin, const unsigned int end) {
              for (unsigned int k = begin; k < end; ++k)
                good[k] = eliminate(level[k], matrix);
            },
            1);
        success = std::find(good.begin(), good.end(), 0) == good.end();
        if (!success)
          break;
      }
    remainders.clear();
  }


  unsigned int
  MultifrontalCholesky::place(const Dissection::Front &front,
                              const unsigned int       position) const
  {
    return position < front.end
               ? position - front.begin
               : front.n_own() + (std::lower_bound(front.boundary.begin(),
                                                   front.boundary.end(),
                                                   position) -
                                  front.boundary.begin());
  }


  void
  MultifrontalCholesky::add_elements(const unsigned int   f,
                                     const ElementMatrix &element_matrix,
                                     Remainder           &sum) const
  {
    const Dissection::Front  &front  = order.fronts[f];
    const std::size_t         n_rows = 2 * front.n_nodes();
    std::vector<double>       matrix;
    std::vector<unsigned int> row;
    for (const unsigned int e : front.elements)
      {
        row.clear();
        for (unsigned int k = nodes.start[e]; k < nodes.start[e + 1]; ++k)
          {
            const unsigned int p = place(front, order.position[nodes.index[k]]);
            row.push_back(2 * p);
            row.push_back(2 * p + 1);
          }
        const unsigned int n = row.size();
        matrix.resize(n * n);
        element_matrix(e, matrix);
        for (unsigned int j = 0; j < n; ++j)
          {
            sum.size[row[j]] += matrix[j * n + j];
            for (unsigned int i = j; i < n; ++i)
              sum.matrix[std::min(row[i], row[j]) * n_rows +
                         std::max(row[i], row[j])] += matrix[j * n + i];
          }
      }
  }


  void
  MultifrontalCholesky::add_children(const unsigned int f, Remainder &sum)
  {
    const Dissection::Front  &front  = order.fronts[f];
    const std::size_t         n_rows = 2 * front.n_nodes();
    std::vector<unsigned int> row;
    for (const unsigned int child : front.children)
      {
        Remainder &part = remainders[child];
        row.clear();
        for (const unsigned int position : order.fronts[child].boundary)
          {
            const unsigned int p = place(front, position);
            row.push_back(2 * p);
            row.push_back(2 * p + 1);
          }
        // Both lists ascend, so that lower triangles stay lower ones.
        const std::size_t n = row.size();
        for (std::size_t j = 0; j < n; ++j)
          {
            sum.size[row[j]] += part.size[j];
            double       *column = &sum.matrix[row[j] * n_rows];
            const double *from   = &part.matrix[j * n];
            for (std::size_t i = j; i < n; ++i)
              column[row[i]] += from[i];
          }
        part = Remainder();
      }
  }


  bool
  MultifrontalCholesky::eliminate(const unsigned int   f,
                                  const ElementMatrix &element_matrix)
  {
    const CholeskyKernels   &kernels = cholesky_kernels();
    const Dissection::Front &front   = order.fronts[f];
    const std::size_t        m       = 2 * front.n_nodes();
    const std::size_t        p       = 2 * front.n_own();
    Remainder                sum;
    sum.matrix.resize(m * m);
    sum.size.resize(m);
    add_elements(f, element_matrix, sum);
    add_children(f, sum);
    std::vector<double> work(kernels.workspace(m));
    if (!kernels.eliminate(
            sum.matrix.data(), m, p, sum.size.data(), work.data()))
      return false;
    factors[f].assign(sum.matrix.begin(), sum.matrix.begin() + p * m);
    Remainder &rest = remainders[f];
    rest.size.assign(sum.size.begin() + p, sum.size.end());
    rest.matrix.resize((m - p) * (m - p));
    for (std::size_t j = p; j < m; ++j)
      std::copy(sum.matrix.begin() + j * m + j,
                sum.matrix.begin() + (j + 1) * m,
                rest.matrix.begin() + (j - p) * (m - p) + (j - p));
    return true;
  }


  void
  MultifrontalCholesky::solve(double *y, const double *x) const
  {
    const CholeskyKernels &kernels = cholesky_kernels();
    std::vector<double>    z(2 * order.position.size()), rest;
    for (unsigned int node = 0; node < order.position.size(); ++node)
      for (unsigned int d = 0; d < 2; ++d)
        z[2 * order.position[node] + d] = x[2 * node + d];
    for (unsigned int f = 0; f < factors.size(); ++f)
      {
        const Dissection::Front &front = order.fronts[f];
        rest.assign(2 * front.boundary.size(), 0.);
        kernels.forward(factors[f].data(),
                        2 * front.n_nodes(),
                        2 * front.n_own(),
                        z.data() + 2 * front.begin,
                        rest.data());
        for (unsigned int k = 0; k < rest.size(); ++k)
          z[2 * front.boundary[k / 2] + k % 2] += rest[k];
      }
    for (unsigned int f = factors.size(); f-- > 0;)
      {
        const Dissection::Front &front = order.fronts[f];
        rest.resize(2 * front.boundary.size());
        for (unsigned int k = 0; k < rest.size(); ++k)
          rest[k] = z[2 * front.boundary[k / 2] + k % 2];
        kernels.backward(factors[f].data(),
                         2 * front.n_nodes(),
                         2 * front.n_own(),
                         z.data() + 2 * front.begin,
                         rest.data());
      }
    for (unsigned int node = 0; node < order.position.size(); ++node)
      for (unsigned int d = 0; d < 2; ++d)
        y[2 * node + d] = z[2 * order.position[node] + d];
  }
} // namespace Morsel
