#include <morsel/fe/sparse_assembly.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace Morsel::FE
{
  using namespace dealii;

  void
  assemble_matrix(const std::vector<ElementSystem> &elements,
                  const std::function<std::vector<types::global_dof_index>(
                      const ElementSystem &)>      &rows_of,
                  const IndexSet                   &owned,
                  const MPI_Comm                    communicator,
                  TrilinosWrappers::SparseMatrix   &matrix)
  {
    const auto kept = [&](const ElementSystem &e) {
      auto rows = rows_of(e);
      rows.erase(
          std::remove(rows.begin(), rows.end(), numbers::invalid_dof_index),
          rows.end());
      return rows;
    };
    std::vector<types::global_dof_index> touched;
    for (const ElementSystem &e : elements)
      for (const types::global_dof_index row : kept(e))
        touched.push_back(row);
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    IndexSet rows(owned);
    rows.add_indices(touched.begin(), touched.end());

    DynamicSparsityPattern pattern(owned.size(), owned.size(), rows);
    for (const ElementSystem &e : elements)
      {
        auto columns = kept(e);
        std::sort(columns.begin(), columns.end());
        for (const types::global_dof_index row : columns)
          pattern.add_entries(row, columns.begin(), columns.end(), true);
      }
    for (const types::global_dof_index row : owned)
      pattern.add(row, row);
    SparsityTools::distribute_sparsity_pattern(
        pattern, owned, communicator, rows);
    matrix.reinit(owned, owned, pattern, communicator);

    std::vector<types::global_dof_index> columns;
    std::vector<double>                  values;
    for (const ElementSystem &e : elements)
      {
        const auto all = rows_of(e);
        columns        = kept(e);
        for (unsigned int i = 0; i < all.size(); ++i)
          {
            if (all[i] == numbers::invalid_dof_index)
              continue;
            values.clear();
            for (unsigned int j = 0; j < all.size(); ++j)
              if (all[j] != numbers::invalid_dof_index)
                values.push_back(e.matrix(j, i));
            matrix.add(
                all[i], columns.size(), columns.data(), values.data(), false);
          }
      }
    matrix.compress(VectorOperation::add);
    for (const types::global_dof_index row : owned)
      if (matrix.diag_element(row) == 0.)
        matrix.set(row, row, 1.);
    matrix.compress(VectorOperation::insert);
  }
} // namespace Morsel::FE
