#ifndef morsel_fe_cell_geometry_h
#define morsel_fe_cell_geometry_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace Morsel::FE
{
  /// Vertices of a cell's faces, counter-clockwise about the cell.
  constexpr std::array<std::array<unsigned int, 2>, 4> face_vertices = {
      {{{2, 0}}, {{1, 3}}, {{0, 1}}, {{3, 2}}}};


  /// The bilinear map of a straight-sided quadrilateral (deal.II's MappingQ1)
  /// with its inverse, cheap enough to be built for every cell.
  class QuadMap
  {
  public:
    /// @param vertices in deal.II's order (0,0), (1,0), (0,1), (1,1) [m]
    explicit QuadMap(const std::array<dealii::Point<2>, 4> &vertices);

    dealii::Point<2>
    to_physical(const dealii::Point<2> &reference) const;

    /// Inverse of to_physical(), by Newton's method (one step on a
    /// parallelogram).
    dealii::Point<2>
    to_reference(const dealii::Point<2> &physical) const;

    /// dx_i/dxi_j [m].
    dealii::Tensor<2, 2>
    jacobian(const dealii::Point<2> &reference) const;

    double
    area() const;

    double
    diameter() const;

    bool
    is_parallelogram() const
    {
      return affine;
    }

    const std::array<dealii::Point<2>, 4> &
    get_vertices() const
    {
      return vertices;
    }

    /// The vertices counter-clockwise, as a polygon.
    std::vector<dealii::Point<2>>
    polygon() const
    {
      return {vertices[0], vertices[1], vertices[3], vertices[2]};
    }

  private:
    std::array<dealii::Point<2>, 4> vertices;
    dealii::Tensor<1, 2>            edge_x, edge_y, twist;
    bool                            affine;
  };


  /// The map of a cell of a triangulation.
  template <typename CellIterator>
  QuadMap
  make_map(const CellIterator &cell)
  {
    std::array<dealii::Point<2>, 4> vertices;
    for (unsigned int v = 0; v < 4; ++v)
      vertices[v] = cell->vertex(v);
    return QuadMap(vertices);
  }


  /// The scalar Lagrange basis of degree p on the unit square, numbered as
  /// FE_Q<2>(p) numbers it, tabulated at points. Rows: points; columns:
  /// functions.
  class LagrangeBasis
  {
  public:
    /// @pre 1 <= degree
    explicit LagrangeBasis(const unsigned int degree);

    unsigned int
    n_functions() const
    {
      return numbering.size();
    }

    /// Values and derivatives by the two reference coordinates.
    void
    evaluate(const std::vector<dealii::Point<2>> &points,
             Eigen::MatrixXd                     &value,
             Eigen::MatrixXd                     &d_xi,
             Eigen::MatrixXd                     &d_eta) const;

  private:
    std::vector<double>       nodes;     ///< one-dimensional support points
    std::vector<double>       scale;     ///< 1/prod_{j != i} (x_i - x_j)
    std::vector<unsigned int> numbering; ///< FE_Q index -> i + (p+1) j
  };
} // namespace Morsel::FE

#endif
