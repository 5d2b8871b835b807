#include <morsel/core/errors.h>
#include <morsel/sph/host.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/mapping_cartesian.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/particles/particle_handler.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Morsel::SPH
{
  namespace
  {
    template <int dim>
    void
    report_lost(
        const dealii::Particles::ParticleIterator<dim> &particle,
        const typename dealii::Triangulation<dim>::active_cell_iterator &)
    {
      throw NumericalError("The background mesh lost particle " +
                           std::to_string(particle->get_id()) +
                           ": it has left the box of its body.");
    }
  } // namespace


  using dealii::ArrayView;
  using dealii::Point;

  template <int dim>
  ParticleHost<dim>::ParticleHost(MPI_Comm          communicator,
                                  const Point<dim> &lower,
                                  const Point<dim> &upper,
                                  const double      support,
                                  const double      spacing,
                                  CellWork          work)
      : mpi_communicator(communicator)
      , support(support)
      , given_work(std::move(work))
      , mesh(std::make_unique<Mesh>(communicator))
      , particle_handler(std::make_unique<Handler>())
  {
    grid = BackgroundGrid<dim>::around(
        lower, upper, support * (1. + support_tolerance), spacing);

    std::vector<unsigned int> n_coarse(dim);
    Point<dim>                end = grid.origin;
    for (int d = 0; d < dim; ++d)
      {
        n_coarse[d] = grid.n[d] >> grid.n_levels;
        end[d] += grid.n[d] * grid.cell_size;
      }
    dealii::GridGenerator::subdivided_hyper_rectangle(
        *mesh, n_coarse, grid.origin, end);
    mesh->refine_global(grid.n_levels);
  }


  template <int dim>
  ParticleHost<dim>::~ParticleHost() = default;


  template <int dim>
  void
  ParticleHost<dim>::insert_lattice(const Point<dim>  &lower,
                                    const Point<dim>  &upper,
                                    const unsigned int particles_across)
  {
    Assert(particles_across > 0, dealii::ExcMessage("No particles asked for."));
    const double spacing = (upper[0] - lower[0]) / particles_across;

    std::array<unsigned int, dim> n;
    Index                         n_points = 1;
    for (int d = 0; d < dim; ++d)
      {
        n[d] = std::max(1., std::round((upper[d] - lower[d]) / spacing));
        n_points *= n[d];
      }

    std::vector<Point<dim>> points(n_points);
    for (Index id = 0; id < n_points; ++id)
      {
        Index rest = id;
        for (int d = 0; d < dim; ++d)
          {
            points[id][d] =
                lower[d] + (upper[d] - lower[d]) * ((rest % n[d] + 0.5) / n[d]);
            rest /= n[d];
          }
      }
    std::vector<Index> ids(n_points);
    std::iota(ids.begin(), ids.end(), Index(0));
    insert(points, ids);
  }


  template <int dim>
  void
  ParticleHost<dim>::insert(const std::vector<Point<dim>> &points,
                            const std::vector<Index>      &ids)
  {
    AssertDimension(points.size(), ids.size());
    Assert(ownership == nullptr, dealii::ExcMessage("Already filled."));

    std::vector<unsigned int> cell_of(points.size());
    std::transform(points.begin(),
                   points.end(),
                   cell_of.begin(),
                   [this](const Point<dim> &x) { return grid.cell_of(x); });
    const Bins bins(cell_of, grid.n_cells());
    CellWork   counts(grid.n_cells());
    std::adjacent_difference(
        bins.start.begin() + 1, bins.start.end(), counts.begin());
    AssertThrow(given_work.empty() || given_work.size() == counts.size(),
                dealii::ExcDimensionMismatch(given_work.size(), counts.size()));
    balance(given_work.empty() ? counts : given_work);

    // The mapping matters: with MappingQ1 the handler's own search loses
    // particles that lie on faces, and says so only by this signal.
    static const dealii::MappingCartesian<dim> mapping;
    particle_handler->initialize(*mesh, mapping, 1 + dim);
    particle_handler->signals.particle_lost.connect(&report_lost<dim>);

    const std::vector<double> no_properties(1 + dim, 0.);
    for (const auto &cell : mesh->active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int number = grid.cell_of(cell->center());
          const Point<dim>   corner = cell->vertex(0);
          const auto         extent =
              cell->vertex(dealii::GeometryInfo<dim>::vertices_per_cell - 1) -
              corner;
          for (unsigned int k = bins.start[number]; k < bins.start[number + 1];
               ++k)
            {
              const unsigned int i = bins.order[k];
              Point<dim>         unit;
              for (int d = 0; d < dim; ++d)
                unit[d] = (points[i][d] - corner[d]) / extent[d];
              particle_handler->insert_particle(
                  points[i],
                  dealii::GeometryInfo<dim>::project_to_unit_cell(unit),
                  ids[i],
                  cell,
                  no_properties);
            }
        }
    particle_handler->update_cached_numbers();
    AssertThrow(particle_handler->n_global_particles() == points.size(),
                dealii::ExcInternalError());
    number();
  }


  template <int dim>
  void
  ParticleHost<dim>::balance(const CellWork &work_of_cells)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(mpi_communicator) == 1)
      return;
    const auto work_of = [&](const auto &cell) {
      return work_of_cells[grid.cell_of(cell->center())];
    };

    double mine = 0.;
    for (const auto &cell : mesh->active_cell_iterators())
      if (cell->is_locally_owned())
        mine += work_of(cell);

    // As many cells for every rank, as the mesh comes, does for a filled
    // rectangle, and to repartition takes as long as making the mesh.
    const double fair =
        std::accumulate(work_of_cells.begin(), work_of_cells.end(), 0.) /
        dealii::Utilities::MPI::n_mpi_processes(mpi_communicator);
    if (maximum(mine) <= 1.03 * fair)
      return;

    // As much for every rank, before there are particles to move.
    const auto connection = mesh->signals.weight.connect(
        [&](const typename Mesh::cell_iterator &cell,
            const typename Mesh::CellStatus) -> unsigned int {
          return work_of(cell);
        });
    mesh->repartition();
    connection.disconnect();
  }


  template <int dim>
  typename ParticleHost<dim>::Index
  ParticleHost<dim>::n_global() const
  {
    return particle_handler->n_global_particles();
  }


  template <int dim>
  unsigned long
  ParticleHost<dim>::n_cells() const
  {
    return mesh->n_global_active_cells();
  }


  template <int dim>
  double
  ParticleHost<dim>::sum(const double value) const
  {
    return dealii::Utilities::MPI::sum(value, mpi_communicator);
  }


  template <int dim>
  double
  ParticleHost<dim>::minimum(const double value) const
  {
    return dealii::Utilities::MPI::min(value, mpi_communicator);
  }


  template <int dim>
  double
  ParticleHost<dim>::maximum(const double value) const
  {
    return dealii::Utilities::MPI::max(value, mpi_communicator);
  }


  template <int dim>
  void
  ParticleHost<dim>::sum(const ArrayView<double> &values) const
  {
    dealii::Utilities::MPI::sum(
        ArrayView<const double>(values), mpi_communicator, values);
  }


  template <int dim>
  CellWork
  ParticleHost<dim>::work_in_cells(
      const std::vector<unsigned int> &of_particles) const
  {
    AssertDimension(of_particles.size(), owned);
    CellWork work(grid.n_cells(), 0);
    for (unsigned int i = 0; i < owned; ++i)
      work[grid.cell_of(positions[i])] += of_particles[i];
    dealii::Utilities::MPI::sum(work, mpi_communicator, work);
    return work;
  }


  template <int dim>
  void
  ParticleHost<dim>::write_back(
      const ArrayView<const dealii::Tensor<1, dim>> &displacements)
  {
    Assert(displacements.size() >= owned,
           dealii::ExcDimensionMismatch(displacements.size(), owned));
    const double offset = ownership->local_range().first;
    for (auto &particle : *particle_handler)
      {
        const auto         properties = particle.get_properties();
        const unsigned int i          = properties[0] - offset;
        for (int d = 0; d < dim; ++d)
          properties[1 + d] = displacements[i][d];
      }
  }


  template class ParticleHost<2>;
} // namespace Morsel::SPH
