#ifndef morsel_fe_cell_functions_h
#define morsel_fe_cell_functions_h

#include <morsel/fe/cut_quadrature.h>
#include <morsel/fe/xfem_space.h>
#include <morsel/fracture/elastic_plane.h>
#include <morsel/fracture/tip_fields.h>

#include <Eigen/Dense>

namespace Morsel::FE
{
  /// The degrees of freedom of a cell, in the order of its element's functions.
  std::vector<dealii::types::global_dof_index>
  dofs_of(const dealii::DoFHandler<2>::active_cell_iterator &cell);


  /// The scalar functions of one cell, enriched ones included, at given
  /// points: value and global gradient. Rows: points; columns: functions in
  /// the order of LocalNumbering.
  class CellFunctions
  {
  public:
    using Cell = dealii::DoFHandler<2>::cell_iterator;

    explicit CellFunctions(const XFEMSpace &space)
        : space(space)
    {}

    /// @param points, reference the same points in both coordinates
    void
    evaluate(const Cell                          &cell,
             const QuadMap                       &map,
             const std::vector<dealii::Point<2>> &points,
             const std::vector<dealii::Point<2>> &reference);

    const Eigen::MatrixXd &
    values() const
    {
      return value;
    }
    const Eigen::MatrixXd &
    d_x() const
    {
      return dx;
    }
    const Eigen::MatrixXd &
    d_y() const
    {
      return dy;
    }

    /// The cell's coefficients by scalar function (rows) and component.
    Eigen::MatrixX2d
    coefficients(const Cell                &cell,
                 const std::vector<double> &local_dof_values) const;

    /// Displacement and gradient of a field at points of a cell, without
    /// tabulating the enriched functions one by one.
    std::vector<Fracture::DisplacementSample>
    sample(const Cell                          &cell,
           const QuadMap                       &map,
           const Eigen::MatrixX2d              &coefficients,
           const std::vector<dealii::Point<2>> &points,
           const std::vector<dealii::Point<2>> &reference);

    /// A quadrature that suits products of two of the cell's gradients.
    /// @param extra points per direction beyond that
    CellQuadrature
    quadrature(const Cell &cell, const QuadMap &map, unsigned int extra) const;

  private:
    void
    add_jump(const unsigned int                   first,
             const double                         side,
             const Fracture::Crack               *crack,
             const std::vector<dealii::Point<2>> &points);
    void
    add_tip(const unsigned int                   first,
            const unsigned int                   tip,
            const std::array<double, 4>         &ramp,
            const std::vector<dealii::Point<2>> &points,
            const std::vector<dealii::Point<2>> &reference);

    /// The ramp times each tip function.
    std::array<Fracture::ValueAndGradient, 4>
    blended_tip_functions(const unsigned int           tip,
                          const std::array<double, 4> &ramp,
                          const dealii::Tensor<2, 2>  &inverse_jacobian,
                          const dealii::Point<2>      &point,
                          const dealii::Point<2>      &reference) const;

    const XFEMSpace &space;
    Eigen::MatrixXd  value, dx, dy;
    Eigen::MatrixXd  table, d_xi, d_eta; ///< scratch: reference derivatives
    /// Scratch: dxi/dx, dxi/dy, deta/dx, deta/dy of each point [1/m].
    Eigen::ArrayX4d inverse;
  };


  /// Relative stiffness given to the enriched functions of what is solved
  /// for: it bounds the condition number and stays far below the
  /// discretisation error.
  inline constexpr double enrichment_regularisation = 1e-12;


  /// Element stiffness in the cell's dofs; evaluates the functions as it goes.
  /// @param regularisation relative stiffness added to the enriched
  ///   functions' diagonal; bounds the condition number where a crack leaves
  ///   a sliver
  Eigen::MatrixXd
  element_stiffness(CellFunctions                &functions,
                    const CellFunctions::Cell    &cell,
                    const QuadMap                &map,
                    const LocalNumbering         &numbering,
                    const CellQuadrature         &quadrature,
                    const Fracture::ElasticPlane &material,
                    const double                  regularisation);
} // namespace Morsel::FE

#endif
