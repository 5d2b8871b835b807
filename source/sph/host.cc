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
#include <utility>

namespace Morsel::SPH
{
  using dealii::ArrayView;
  using dealii::Point;

  namespace
  {
    /// Two particles at exactly the support count as interacting: the pair
    /// loops may differ in the last bit about them.
    constexpr double tolerance = 1e-9;


    /// The global index of this rank's first particle, and how many particles
    /// there are on all ranks.
    std::pair<dealii::types::global_dof_index, dealii::types::global_dof_index>
    offset_and_total(const unsigned int owned, MPI_Comm communicator)
    {
      const std::vector<unsigned int> counts =
          dealii::Utilities::MPI::all_gather(communicator, owned);
      const auto here = counts.begin() +
                        dealii::Utilities::MPI::this_mpi_process(communicator);
      return {std::accumulate(counts.begin(), here, 0u),
              std::accumulate(counts.begin(), counts.end(), 0u)};
    }
  } // namespace


  template <int dim>
  struct ParticleHost<dim>::Found
  {
    Index        id;
    Point<dim>   position;
    unsigned int cell;
    /// Owned: another rank needs it. Foreign: this rank needs it.
    bool         wanted = false;
    unsigned int index  = 0; ///< in the arrays (owned), global (foreign)
  };


  template <int dim>
  ParticleHost<dim>::ParticleHost(MPI_Comm          communicator,
                                  const Point<dim> &lower,
                                  const Point<dim> &upper,
                                  const double      support,
                                  const double      spacing)
      : mpi_communicator(communicator)
      , support(support)
      , mesh(std::make_unique<Mesh>(communicator))
      , particle_handler(std::make_unique<Handler>())
  {
    grid = BackgroundGrid<dim>::around(
        lower, upper, support * (1. + tolerance), spacing);

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
    balance(bins.start);

    // The mapping matters: with MappingQ1 the handler's own search loses
    // particles that lie on faces, and says so only by this signal.
    static const dealii::MappingCartesian<dim> mapping;
    particle_handler->initialize(*mesh, mapping, 1 + dim);
    particle_handler->signals.particle_lost.connect(
        [](const auto &particle, const auto &) {
          throw NumericalError("The background mesh lost particle " +
                               std::to_string(particle->get_id()) +
                               ": it has left the box of its body.");
        });

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
  ParticleHost<dim>::balance(const std::vector<unsigned int> &start)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(mpi_communicator) == 1)
      return;
    // As many particles for every rank, before there are any to move.
    const auto connection = mesh->signals.weight.connect(
        [&](const typename Mesh::cell_iterator &cell,
            const typename Mesh::CellStatus) -> unsigned int {
          const unsigned int number = grid.cell_of(cell->center());
          return start[number + 1] - start[number];
        });
    mesh->repartition();
    connection.disconnect();
  }


  template <int dim>
  void
  ParticleHost<dim>::number()
  {
    const bool alone =
        dealii::Utilities::MPI::n_mpi_processes(mpi_communicator) == 1;
    if (!alone)
      particle_handler->exchange_ghost_particles(/*enable_cache=*/true);

    const auto find = [this](const auto begin, const auto end) {
      std::vector<Found> found;
      for (auto particle = begin; particle != end; ++particle)
        {
          const Point<dim> &x = particle->get_location();
          found.push_back({particle->get_id(), x, grid.cell_of(x)});
        }
      return found;
    };
    std::vector<Found> own =
        find(particle_handler->begin(), particle_handler->end());
    std::vector<Found> foreign =
        find(particle_handler->begin_ghost(), particle_handler->end_ghost());

    mark_pairs_across_ranks(own, foreign);
    number_owned(own);
    number_ghosts(own, foreign);
  }


  template <int dim>
  void
  ParticleHost<dim>::mark_pairs_across_ranks(std::vector<Found> &own,
                                             std::vector<Found> &foreign) const
  {
    if (foreign.empty())
      return;
    std::vector<unsigned int> cell_of;
    for (const Found &ghost : foreign)
      cell_of.push_back(ghost.cell);
    const Bins bins(cell_of, grid.n_cells());

    // Both ranks of a pair see the same two positions, bit for bit, and so
    // agree about it without a message.
    const double reach = support * (1. + 0.5 * tolerance);
    for (Found &particle : own)
      for_each_run_around(
          grid, particle.cell, [&](const auto first, const auto last) {
            for (unsigned int k = bins.start[first]; k < bins.start[last + 1];
                 ++k)
              {
                Found &ghost = foreign[bins.order[k]];
                if (particle.position.distance_square(ghost.position) <=
                    reach * reach)
                  particle.wanted = ghost.wanted = true;
              }
          });
  }


  template <int dim>
  void
  ParticleHost<dim>::number_owned(std::vector<Found> &own)
  {
    std::vector<unsigned int> order(own.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
      return own[a].wanted != own[b].wanted ? own[a].wanted
                                            : own[a].id < own[b].id;
    });

    owned = own.size();
    positions.clear();
    identities.clear();
    for (unsigned int i = 0; i < owned; ++i)
      {
        own[order[i]].index = i;
        positions.push_back(own[order[i]].position);
        identities.push_back(own[order[i]].id);
      }
    boundary = std::count_if(own.begin(), own.end(), [](const Found &particle) {
      return particle.wanted;
    });
  }


  template <int dim>
  void
  ParticleHost<dim>::number_ghosts(const std::vector<Found> &own,
                                   std::vector<Found>       &foreign)
  {
    using dealii::IndexSet;
    const auto [offset, n_all] = offset_and_total(owned, mpi_communicator);

    // The array index travels to the other ranks as a property: exact in a
    // double up to 2^53.
    auto particle = particle_handler->begin();
    for (const Found &found : own)
      {
        particle->get_properties()[0] = offset + found.index;
        ++particle;
      }
    if (dealii::Utilities::MPI::n_mpi_processes(mpi_communicator) > 1)
      particle_handler->update_ghost_particles();
    particle = particle_handler->begin_ghost();
    for (Found &ghost : foreign)
      {
        ghost.index = particle->get_properties()[0];
        ++particle;
      }

    // A Partitioner numbers ghosts by their global index.
    foreign.erase(
        std::remove_if(foreign.begin(),
                       foreign.end(),
                       [](const Found &ghost) { return !ghost.wanted; }),
        foreign.end());
    std::sort(foreign.begin(),
              foreign.end(),
              [](const Found &a, const Found &b) { return a.index < b.index; });

    IndexSet own_indices(n_all), ghost_indices(n_all);
    own_indices.add_range(offset, offset + owned);
    for (const Found &ghost : foreign)
      {
        ghost_indices.add_index(ghost.index);
        positions.push_back(ghost.position);
        identities.push_back(ghost.id);
      }
    ownership = std::make_shared<const Partitioner>(
        own_indices, ghost_indices, mpi_communicator);
    halo = std::make_unique<Halo>(ownership);
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
