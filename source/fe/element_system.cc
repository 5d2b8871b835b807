#include <morsel/fe/element_system.h>

#include <algorithm>

namespace Morsel::FE
{
  using namespace dealii;

  void
  condense(ElementSystem &e, const AffineConstraints<double> &constraints)
  {
    if (std::none_of(e.dofs.begin(), e.dofs.end(), [&](const unsigned int d) {
          return constraints.is_constrained(d);
        }))
      return;
    const unsigned int        n = e.dofs.size();
    std::vector<unsigned int> masters;
    struct Entry
    {
      unsigned int row, column;
      double       value;
    };
    std::vector<Entry> C;
    Eigen::VectorXd    g   = Eigen::VectorXd::Zero(n);
    const auto         add = [&](const unsigned int row,
                         const unsigned int dof,
                         const double       value) {
      const auto place = std::find(masters.begin(), masters.end(), dof);
      C.push_back(
          {row, static_cast<unsigned int>(place - masters.begin()), value});
      if (place == masters.end())
        masters.push_back(dof);
    };
    for (unsigned int i = 0; i < n; ++i)
      if (constraints.is_constrained(e.dofs[i]))
        {
          g(i) = constraints.get_inhomogeneity(e.dofs[i]);
          for (const auto &entry :
               *constraints.get_constraint_entries(e.dofs[i]))
            add(i, entry.first, entry.second);
        }
      else
        add(i, e.dofs[i], 1.);
    const unsigned int    m  = masters.size();
    const Eigen::VectorXd f  = e.rhs - e.matrix * g;
    Eigen::MatrixXd       KC = Eigen::MatrixXd::Zero(n, m);
    for (const Entry &c : C)
      KC.col(c.column) += c.value * e.matrix.col(c.row);
    e.matrix = Eigen::MatrixXd::Zero(m, m);
    e.rhs    = Eigen::VectorXd::Zero(m);
    for (const Entry &c : C)
      {
        e.matrix.row(c.column) += c.value * KC.row(c.row);
        e.rhs(c.column) += c.value * f(c.row);
      }
    e.dofs = masters;
  }


  Eigen::VectorXd
  assemble_rhs(const std::vector<ElementSystem> &elements,
               const unsigned int                n_dofs)
  {
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n_dofs);
    for (const ElementSystem &e : elements)
      for (unsigned int i = 0; i < e.dofs.size(); ++i)
        rhs(e.dofs[i]) += e.rhs(i);
    return rhs;
  }


  std::vector<ElementSystem>
  gather_elements(std::vector<ElementSystem> &&mine,
                  const MPI_Comm               communicator)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return std::move(mine);
    std::vector<double> packed;
    for (const ElementSystem &e : mine)
      {
        packed.push_back(e.dofs.size());
        packed.push_back(e.center[0]);
        packed.push_back(e.center[1]);
        packed.insert(packed.end(), e.dofs.begin(), e.dofs.end());
        packed.insert(packed.end(), e.rhs.data(), e.rhs.data() + e.rhs.size());
        packed.insert(
            packed.end(), e.matrix.data(), e.matrix.data() + e.matrix.size());
      }
    mine.clear();
    const auto parts = Utilities::MPI::gather(communicator, packed, 0);
    std::vector<ElementSystem> all;
    for (const std::vector<double> &part : parts)
      for (std::size_t i = 0; i < part.size();)
        {
          const unsigned int n = part[i];
          ElementSystem      e;
          e.center = Point<2>(part[i + 1], part[i + 2]);
          i += 3;
          e.dofs.assign(part.begin() + i, part.begin() + i + n);
          e.rhs    = Eigen::Map<const Eigen::VectorXd>(&part[i + n], n);
          e.matrix = Eigen::Map<const Eigen::MatrixXd>(&part[i + 2 * n], n, n);
          i += 2 * n + n * n;
          all.push_back(std::move(e));
        }
    return all;
  }
} // namespace Morsel::FE
