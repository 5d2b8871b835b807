#include <morsel/sph/host.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/particles/particle_handler.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace Morsel::SPH
{
  using dealii::Point;

  namespace
  {
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
    const double reach = support * (1. + 0.5 * support_tolerance);
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


  template void
  ParticleHost<2>::number();
} // namespace Morsel::SPH
