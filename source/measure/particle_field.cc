#include <morsel/measure/particle_field.h>
#include <morsel/sph/host.h>
#include <morsel/sph/local_numbers.h>
#include <morsel/sph/neighbours.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace Morsel::Measure
{
  namespace
  {
    /// Whether the support of a particle, @p support spacings wide, ends within
    /// the body, with @p rows further rows up to the edge.
    bool
    has_full_support(const unsigned int rows, const double support)
    {
      return rows + 1. >= support * (1. - 1e-9);
    }


    /// Where the four neighbours of each particle within an even lattice stand.
    class LatticeNeighbours
    {
    public:
      LatticeNeighbours(const SPH::DeformableBody &body,
                        const Scene::ParticleBody &shape)
          : particles(body.get_particles())
          , nx(shape.particles_across)
          , ny(shape.particles_high())
          , alone(!body.ranks())
      {
        if (!alone)
          numbers = SPH::LocalNumbers(particles.id);
      }

      /// @param f of an owned particle's number and an array of its neighbours'
      template <typename Function>
      void
      for_each_inner(const Function &f) const
      {
        for (unsigned int i = 0; i < particles.n_owned; ++i)
          {
            const unsigned long long id = particles.id[i];
            const unsigned int       x = id % nx, y = id / nx;
            if (x > 0 && x + 1 < nx && y > 0 && y + 1 < ny)
              f(i,
                std::array<unsigned int, 4>{{place(id - 1),
                                             place(id + 1),
                                             place(id - nx),
                                             place(id + nx)}});
          }
      }

    private:
      /// Neighbours in the lattice are ghosts at least.
      unsigned int
      place(const unsigned long long id) const
      {
        return alone ? id : numbers.find(id);
      }

      const SPH::Particles &particles;
      const unsigned int    nx, ny;
      const bool            alone;
      SPH::LocalNumbers     numbers;
    };


    /// Appends the points of other ranks that are near the box of this one's.
    void
    append_near_ones(std::vector<dealii::Point<2>> &points,
                     const double                   reach,
                     const SPH::ParticleHost<2>    &ranks)
    {
      namespace MPI = dealii::Utilities::MPI;
      dealii::BoundingBox<2> box; // at a point: the default is one at zero
      if (!points.empty())
        {
          box = dealii::BoundingBox<2>(points);
          box.extend(reach);
        }
      const auto boxes = MPI::all_gather(ranks.communicator(),
                                         std::make_pair(!points.empty(), box));
      std::map<unsigned int, std::vector<dealii::Point<2>>> near;
      for (unsigned int r = 0; r < boxes.size(); ++r)
        if (boxes[r].first && r != MPI::this_mpi_process(ranks.communicator()))
          for (const auto &x : points)
            if (boxes[r].second.point_inside(x))
              near[r].push_back(x);
      for (const auto &[rank, from] :
           MPI::some_to_some(ranks.communicator(), near))
        points.insert(points.end(), from.begin(), from.end());
    }
  } // namespace


  double
  smallest_spacing(const SPH::DeformableBody &body)
  {
    const SPH::Particles         &p     = body.get_particles();
    constexpr double              reach = 2.;
    std::vector<dealii::Point<2>> points(p.n_owned);
    for (unsigned int i = 0; i < p.n_owned; ++i)
      points[i] = p.position(i);
    if (body.ranks())
      append_near_ones(points, reach * p.spacing, *body.ranks());
    SPH::CellGrid grid;
    grid.build(points, reach * p.spacing);
    double least = reach * reach * p.spacing * p.spacing;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      grid.for_each_near(points[i], [&](const unsigned int j) {
        if (j > i)
          least = std::min(least, (points[j] - points[i]).norm_square());
      });
    if (body.ranks())
      least = body.ranks()->minimum(least);
    return std::sqrt(least) / p.spacing;
  }


  Noise
  stress_noise(const SPH::DeformableBody &body,
               const Scene::ParticleBody &shape)
  {
    const SPH::Particles                     &p = body.get_particles();
    std::vector<Materials::PlaneStrainStress> s(p.n_local);
    for (unsigned int i = 0; i < p.n_owned; ++i)
      s[i] = body.stress(i);
    if (body.ranks())
      body.ranks()->exchange(s);
    const LatticeNeighbours lattice(body, shape);
    const auto noise = [&](double Materials::PlaneStrainStress::*component) {
      double sums[2] = {0., 0.}; // of the rough part and of the whole
      lattice.for_each_inner([&](const unsigned int i, const auto &four) {
        const auto  &t = s[i];
        const double mean =
            0.25 * (s[four[0]].*component + s[four[1]].*component +
                    s[four[2]].*component + s[four[3]].*component);
        sums[0] += (t.*component - mean) * (t.*component - mean);
        sums[1] += t.xx * t.xx + t.yy * t.yy + 2. * t.xy * t.xy;
      });
      body.sum_over_ranks(dealii::make_array_view(sums));
      return sums[1] > 0. ? std::sqrt(sums[0] / sums[1]) : 0.;
    };
    return {noise(&Materials::PlaneStrainStress::xx),
            noise(&Materials::PlaneStrainStress::yy)};
  }


  InteriorStress
  interior_stress(const SPH::DeformableBody &body,
                  const Scene::ParticleBody &shape,
                  const double               support)
  {
    const SPH::Particles &p    = body.get_particles();
    const unsigned int    nx   = shape.particles_across;
    const unsigned int    ny   = shape.particles_high();
    const auto            each = [&](const auto &f) {
      for (unsigned int i = 0; i < p.n_owned; ++i)
        {
          const unsigned int x = p.id[i] % nx, y = p.id[i] / nx;
          const unsigned int row    = std::min(y, ny - 1 - y);
          const unsigned int column = std::min(x, nx - 1 - x);
          if (has_full_support(std::min(row, column), support / p.spacing))
            f(body.stress(i));
        }
    };
    double sums[3] = {0., 0., 0.}; // count and means
    each([&](const Materials::PlaneStrainStress &s) {
      sums[0] += 1.;
      sums[1] += s.xx;
      sums[2] += s.yy;
    });
    body.sum_over_ranks(dealii::make_array_view(sums));
    InteriorStress result;
    result.count = sums[0];
    if (result.count == 0)
      return result;
    result.mean_xx    = sums[1] / result.count;
    result.mean_yy    = sums[2] / result.count;
    double squares[2] = {0., 0.};
    each([&](const Materials::PlaneStrainStress &s) {
      const double dx = s.xx - result.mean_xx, dy = s.yy - result.mean_yy;
      squares[0] += dx * dx / result.count;
      squares[1] += dy * dy / result.count;
    });
    body.sum_over_ranks(dealii::make_array_view(squares));
    result.deviation_xx = std::sqrt(squares[0]);
    result.deviation_yy = std::sqrt(squares[1]);
    return result;
  }


  double
  velocity_roughness(const SPH::DeformableBody &body,
                     const Scene::ParticleBody &shape)
  {
    const auto             &motion = body.get_particles().motion;
    const LatticeNeighbours lattice(body, shape);
    double                  sums[2] = {0., 0.}; // of squares, and their number
    lattice.for_each_inner([&](const unsigned int i, const auto &four) {
      const auto difference = [&](double Motion::*component) {
        const auto v = [&](const unsigned int j) {
          return motion[j].*component;
        };
        return v(i) -
               0.25 * (v(four[0]) + v(four[1]) + v(four[2]) + v(four[3]));
      };
      const double x = difference(&Motion::v_x);
      const double y = difference(&Motion::v_y);
      sums[0] += x * x + y * y;
      sums[1] += 1.;
    });
    body.sum_over_ranks(dealii::make_array_view(sums));
    return sums[1] > 0. ? std::sqrt(sums[0] / sums[1]) : 0.;
  }


  GradientErrors
  strain_rate_errors(const SPH::DeformableBody &body,
                     const Scene::ParticleBody &shape,
                     const double               support,
                     const Tensor2             &expected)
  {
    GradientErrors        errors{0., 0., 0.};
    const SPH::Particles &p     = body.get_particles();
    const unsigned int    nx    = shape.particles_across;
    const unsigned int    ny    = shape.particles_high();
    const double          ratio = support / p.spacing;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        const unsigned int x = p.id[i] % nx, y = p.id[i] / nx;
        const unsigned int a     = std::min(x, nx - 1 - x);
        const unsigned int b     = std::min(y, ny - 1 - y);
        const auto [least, most] = std::minmax(a, b);
        const auto   L           = body.velocity_gradient(i);
        const double error =
            std::max({std::abs(L.xx - expected.xx),
                      std::abs(L.yy - expected.yy),
                      0.5 * std::abs(L.xy + L.yx - expected.xy - expected.yx)});
        if (most == 0)
          errors.corner = std::max(errors.corner, error);
        else if (least == 0 && has_full_support(most, ratio))
          errors.edge = std::max(errors.edge, error);
        else if (has_full_support(least, ratio))
          errors.interior = std::max(errors.interior, error);
      }
    if (body.ranks())
      for (double *const largest :
           {&errors.interior, &errors.edge, &errors.corner})
        *largest = body.ranks()->maximum(*largest);
    return errors;
  }
} // namespace Morsel::Measure
