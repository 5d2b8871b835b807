#include <morsel/sph/discrete_gradient.h>

#include <algorithm>
#include <utility>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /// Least squares need a moment matrix that is not nearly singular.
    constexpr double smallest_eigenvalue_share = 1e-6;

    /// Inverse of a symmetric matrix, zero where it is nearly singular.
    Tensor<2, 2>
    inverse_or_zero(const Tensor<2, 2> &m)
    {
      const double trace = m[0][0] + m[1][1];
      if (!(determinant(m) > smallest_eigenvalue_share * trace * trace))
        return Tensor<2, 2>();
      return invert(m);
    }


    /// The pairs within the kernel's support that see each other, and the
    /// distance that the kernel takes.
    NeighbourList
    visible_pairs(const ShapeFunctions &shape, std::vector<double> &distance)
    {
      const auto         &points = shape.get_cloud().points;
      const double        reach  = shape.get_kernel().support();
      const NeighbourList all = find_neighbours(points, points.size(), reach);
      NeighbourList       list;
      for (unsigned int i = 0; i < all.n_rows(); ++i)
        {
          for (unsigned int k = all.start[i]; k < all.start[i + 1]; ++k)
            {
              const unsigned int j = all.index[k];
              const double       r = shape.get_visibility().distance(
                  points[i], points[i], points[j]);
              if (r >= reach)
                continue;
              list.index.push_back(j);
              distance.push_back(r);
            }
          list.start.push_back(list.index.size());
        }
      return list;
    }


    /// Rows of entries that are summed up before they become a list.
    class RowBuilder
    {
    public:
      RowBuilder(const unsigned int n)
          : place(n, nowhere)
      {}

      void
      add(const unsigned int j, const Tensor<1, 2> &value)
      {
        if (place[j] == nowhere)
          {
            place[j] = entries.size();
            entries.emplace_back(j, Tensor<1, 2>());
          }
        entries[place[j]].second += value;
      }

      /// Appends the row but for the particle itself, sorted by j.
      void
      finish(const unsigned int itself,
             const double       scale,
             NeighbourList     &list,
             VectorField       &weight)
      {
        for (const auto &entry : entries)
          place[entry.first] = nowhere;
        std::sort(
            entries.begin(), entries.end(), [](const auto &a, const auto &b) {
              return a.first < b.first;
            });
        for (const auto &entry : entries)
          if (entry.first != itself)
            {
              list.index.push_back(entry.first);
              weight.push_back(scale * entry.second);
            }
        list.start.push_back(list.index.size());
        entries.clear();
      }

    private:
      static constexpr unsigned int nowhere = static_cast<unsigned int>(-1);
      std::vector<unsigned int>     place;
      std::vector<std::pair<unsigned int, Tensor<1, 2>>> entries;
    };
  } // namespace


  Tensor<2, 2>
  DiscreteGradient::gradient(const unsigned int i, const VectorField &u) const
  {
    Tensor<2, 2> H;
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      H += outer_product(u[list.index[k]] - u[i], weight[k]);
    return H;
  }


  void
  DiscreteGradient::add_force(const TensorField &stress,
                              VectorField       &force) const
  {
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
        {
          const Tensor<1, 2> f = volume[i] * (stress[i] * weight[k]);
          force[list.index[k]] -= f;
          force[i] += f;
        }
  }


  DiscreteGradient
  normalised_gradient(const ShapeFunctions &shape,
                      const Normalisation   normalisation)
  {
    const Cloud        &cloud = shape.get_cloud();
    DiscreteGradient    result;
    std::vector<double> distance;
    result.list = visible_pairs(shape, distance);
    result.weight.resize(result.list.index.size());
    for (unsigned int i = 0; i < cloud.size(); ++i)
      {
        NeighbourSums sums{{0., 0., 0.},
                           cloud.cells[i].area * shape.get_kernel().value(0.)};
        for (unsigned int k = result.list.start[i];
             k < result.list.start[i + 1];
             ++k)
          {
            const unsigned int j = result.list.index[k];
            const Tensor<1, 2> X = cloud.points[j] - cloud.points[i];
            const double       V = cloud.cells[j].area;
            const Tensor<1, 2> w =
                V * shape.get_kernel().gradient_weight(distance[k]) * X;
            result.weight[k] = w;
            sums.moment.xx += w[0] * X[0];
            sums.moment.yy += w[1] * X[1];
            sums.moment.xy += w[0] * X[1];
            sums.kernel += V * shape.get_kernel().value(distance[k]);
          }
        const Symmetric2 B = gradient_correction(normalisation, sums);
        for (unsigned int k = result.list.start[i];
             k < result.list.start[i + 1];
             ++k)
          {
            const Tensor<1, 2> w = result.weight[k];
            result.weight[k][0]  = B.xx * w[0] + B.xy * w[1];
            result.weight[k][1]  = B.xy * w[0] + B.yy * w[1];
          }
        result.volume.push_back(cloud.cells[i].area);
      }
    return result;
  }


  DiscreteGradient
  conforming_gradient(const ShapeFunctions &shape)
  {
    const Cloud     &cloud = shape.get_cloud();
    DiscreteGradient result;
    RowBuilder       row(cloud.size());
    ShapeValues      values;
    for (unsigned int i = 0; i < cloud.size(); ++i)
      {
        for (const CellFacet &facet : cloud.cells[i].facets)
          {
            Point<2> eye = cloud.points[i];
            if (!facet.at_boundary())
              {
                const Point<2> &other = cloud.points[facet.neighbour];
                if (shape.get_visibility().sees(eye, other))
                  eye += 0.5 * (other - eye);
                else if (shape.get_visibility().are_joined(eye, other))
                  eye = facet.first + 0.5 * (facet.second - facet.first);
              }
            const Tensor<1, 2> half = 0.5 * facet.length() * facet.normal();
            for (const Point<2> &x : gauss_points(facet))
              {
                shape.evaluate(eye, x, values);
                for (unsigned int k = 0; k < values.index.size(); ++k)
                  row.add(values.index[k], values.value[k] * half);
              }
          }
        result.volume.push_back(cloud.cells[i].area);
        row.finish(i, 1. / cloud.cells[i].area, result.list, result.weight);
      }
    return result;
  }


  ResidualControl
  residual_control(const ShapeFunctions &shape, const double modulus)
  {
    const Cloud        &cloud = shape.get_cloud();
    ResidualControl     result;
    std::vector<double> distance;
    result.list = visible_pairs(shape, distance);
    for (unsigned int i = 0; i < cloud.size(); ++i)
      {
        Tensor<2, 2> moment;
        for (unsigned int k = result.list.start[i];
             k < result.list.start[i + 1];
             ++k)
          {
            const unsigned int j = result.list.index[k];
            const Tensor<1, 2> X = cloud.points[j] - cloud.points[i];
            result.offset.push_back(X);
            result.stiffness.push_back(
                modulus * cloud.cells[i].area * cloud.cells[j].area *
                shape.get_kernel().value(distance[k]) / X.norm_square());
            moment += result.stiffness.back() * outer_product(X, X);
          }
        result.inverse_moment.push_back(inverse_or_zero(moment));
        if (result.inverse_moment.back().norm_square() == 0.)
          std::fill(result.stiffness.begin() + result.list.start[i],
                    result.stiffness.end(),
                    0.);
      }
    return result;
  }


  void
  ResidualControl::residual(const unsigned int i,
                            const VectorField &u,
                            VectorField       &residuals) const
  {
    residuals.clear();
    Tensor<2, 2> H;
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      {
        residuals.push_back(u[list.index[k]] - u[i]);
        H += stiffness[k] * outer_product(residuals.back(), offset[k]);
      }
    H = H * inverse_moment[i];
    for (unsigned int k = list.start[i]; k < list.start[i + 1]; ++k)
      residuals[k - list.start[i]] -= H * offset[k];
  }


  double
  ResidualControl::energy(const VectorField &u) const
  {
    double      sum = 0.;
    VectorField r;
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      {
        residual(i, u, r);
        for (unsigned int k = 0; k < r.size(); ++k)
          sum += 0.25 * stiffness[list.start[i] + k] * r[k].norm_square();
      }
    return sum;
  }


  void
  ResidualControl::add_force(const VectorField &u, VectorField &force) const
  {
    VectorField r;
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      {
        residual(i, u, r);
        for (unsigned int k = 0; k < r.size(); ++k)
          {
            const Tensor<1, 2> f = 0.5 * stiffness[list.start[i] + k] * r[k];
            force[list.index[list.start[i] + k]] -= f;
            force[i] += f;
          }
      }
  }


  namespace
  {
    /// Adds one facet to the trace on its side.
    void
    add_facet(const ShapeFunctions &shape,
              const CellFacet      &facet,
              BoundaryFacet        &trace,
              ShapeValues          &values)
    {
      const double       length = facet.length();
      const Tensor<1, 2> normal = facet.normal();
      const Tensor<1, 2> moment = trace.length * trace.centre +
                                  0.5 * length * (facet.first + facet.second);
      trace.length += length;
      trace.centre = Point<2>(moment / trace.length);
      for (const Point<2> &x : gauss_points(facet))
        {
          shape.evaluate(shape.get_cloud().points[trace.particle], x, values);
          for (unsigned int k = 0; k < values.index.size(); ++k)
            {
              const unsigned int place = std::find(trace.index.begin(),
                                                   trace.index.end(),
                                                   values.index[k]) -
                                         trace.index.begin();
              if (place == trace.index.size())
                {
                  trace.index.push_back(values.index[k]);
                  trace.weight.push_back(0.);
                  trace.flux.emplace_back();
                }
              const double w = 0.5 * length * values.value[k];
              trace.weight[place] += w;
              trace.flux[place] += w * normal;
            }
        }
    }
  } // namespace


  std::vector<BoundaryFacet>
  boundary_facets(const ShapeFunctions &shape)
  {
    const Cloud               &cloud = shape.get_cloud();
    std::vector<BoundaryFacet> result;
    ShapeValues                values;
    for (unsigned int i = 0; i < cloud.size(); ++i)
      {
        const unsigned int before = result.size();
        for (const CellFacet &facet : cloud.cells[i].facets)
          {
            if (!facet.at_boundary())
              continue;
            auto trace = std::find_if(result.begin() + before,
                                      result.end(),
                                      [&](const BoundaryFacet &other) {
                                        return other.side == facet.side;
                                      });
            if (trace == result.end())
              {
                result.emplace_back();
                trace           = result.end() - 1;
                trace->side     = facet.side;
                trace->particle = i;
              }
            add_facet(shape, facet, *trace, values);
          }
      }
    return result;
  }
} // namespace Morsel::SPH
