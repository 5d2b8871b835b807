#ifndef morsel_sph_host_h
#define morsel_sph_host_h

#include <morsel/sph/background_grid.h>
#include <morsel/sph/halo.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <deal.II/particles/property_pool.h>

#include <memory>
#include <vector>

namespace dealii
{
  namespace parallel::distributed
  {
    template <int, int>
    class Triangulation;
  }

  namespace Particles
  {
    template <int, int>
    class ParticleHandler;
  }
} // namespace dealii

namespace Morsel::SPH
{
  /// What a step takes in each cell of a body's background mesh, in hundredths
  /// of what a bonded particle takes: by it the cells are shared among the
  /// ranks. Empty: by the number of particles.
  using CellWork = std::vector<unsigned int>;


  /// Where the particles of one body live: deal.II's ParticleHandler on a
  /// background mesh in the reference configuration. It decides which rank
  /// owns a particle, knows ghosts and identities, and leaves the fields to
  /// contiguous arrays outside, numbered as this class says:
  ///
  ///     [0, n_boundary())       owned, ghosts of some other rank
  ///     [n_boundary(), n_owned()) owned, of interest to no other rank
  ///     [n_owned(), n_local())  ghosts, grouped by owner
  ///
  /// each of the first two parts sorted by id; on one rank the numbering is
  /// that of the ids. Every method that is not const is collective, and so
  /// are exchanges.
  template <int dim>
  class ParticleHost
  {
  public:
    using Index       = dealii::types::particle_index;
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    /// Makes the background mesh.
    /// @param lower,upper box that holds all particles [m]
    /// @param support radius within which particles interact [m]
    /// @param spacing of the particles [m]; cells are a multiple of half of it
    ///   and stand a quarter of it off the box, so that no particle of a
    ///   lattice in the box lies on a face
    /// @param work by which the ranks share the cells
    ParticleHost(MPI_Comm                  communicator,
                 const dealii::Point<dim> &lower,
                 const dealii::Point<dim> &upper,
                 double                    support,
                 double                    spacing,
                 CellWork                  work = {});

    ~ParticleHost();

    ParticleHost(const ParticleHost &) = delete;
    ParticleHost &
    operator=(const ParticleHost &) = delete;

    /// Fills a rectangle with a lattice that begins half a spacing inside of
    /// it: @p particles_across along x, round(height/spacing) but at least one
    /// along the others. Ids are row-major: along x fastest. The host takes
    /// particles once.
    void
    insert_lattice(const dealii::Point<dim> &lower,
                   const dealii::Point<dim> &upper,
                   unsigned int              particles_across);

    /// Takes any set of points, which every rank gives alike, with their
    /// unique ids; each rank keeps its own. Give ids in the order in which
    /// particles shall lie in memory.
    /// @throws InputError if a point lies outside of the box.
    void
    insert(const std::vector<dealii::Point<dim>> &points,
           const std::vector<Index>              &ids);

    unsigned int
    n_owned() const
    {
      return owned;
    }

    unsigned int
    n_ghosts() const
    {
      return positions.size() - owned;
    }

    unsigned int
    n_local() const
    {
      return positions.size();
    }

    /// Owned particles that other ranks need; they come first.
    unsigned int
    n_boundary() const
    {
      return boundary;
    }

    Index
    n_global() const;

    /// Active cells of the background mesh on all ranks.
    unsigned long
    n_cells() const;

    /// Edge of the background mesh's cells [m], at least the support.
    double
    cell_size() const
    {
      return grid.cell_size;
    }

    /// Reference positions [m], owned then ghosts.
    const std::vector<dealii::Point<dim>> &
    reference_positions() const
    {
      return positions;
    }

    /// The same on any number of ranks; owned then ghosts.
    const std::vector<Index> &
    ids() const
    {
      return identities;
    }

    /// Ownership for deal.II's vectors; its local numbering is the one here.
    const std::shared_ptr<const Partitioner> &
    partitioner() const
    {
      return ownership;
    }

    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }

    /// Whether there is no other rank.
    bool
    is_alone() const
    {
      return dealii::Utilities::MPI::n_mpi_processes(mpi_communicator) == 1;
    }

    /// Begins to bring owned records to the ranks that hold them as ghosts.
    /// @p all has n_local() entries; see Halo::start(). Costs nothing on one
    /// rank.
    template <typename Record>
    void
    exchange_start(const dealii::ArrayView<Record> &all,
                   const unsigned int               channel = 0) const
    {
      halo->start(all, channel);
    }

    /// Returns when the ghosts of @p all are there.
    template <typename Record>
    void
    exchange_finish(const dealii::ArrayView<Record> &,
                    const unsigned int channel = 0) const
    {
      halo->finish(channel);
    }

    /// Both at once, for one array or several.
    template <typename... Record>
    void
    exchange(std::vector<Record> &...all) const
    {
      static_assert(sizeof...(all) <= Halo::n_channels, "Too many at once.");
      unsigned int channel = 0;
      (exchange_start(dealii::make_array_view(all), channel++), ...);
      channel = 0;
      (exchange_finish(dealii::make_array_view(all), channel++), ...);
    }

    /// @name The same value on all ranks, from each rank's. Collective.
    ///@{
    double
    sum(double value) const;
    double
    minimum(double value) const;
    double
    maximum(double value) const;
    /// Sums entry by entry, in place.
    void
    sum(const dealii::ArrayView<double> &values) const;
    ///@}

    /// The work in each cell, the same on all ranks; collective.
    /// @param of_particles what the owned ones take, in its units
    CellWork
    work_in_cells(const std::vector<unsigned int> &of_particles) const;

    /// Copies the owned entries of an array of displacements [m] into the
    /// handler's properties, for output and checkpoints: not for every step.
    void
    write_back(
        const dealii::ArrayView<const dealii::Tensor<1, dim>> &displacements);

    /// deal.II's view of the particles: property 0 is the global array index,
    /// properties 1 to dim the displacement as of the last write_back().
    const dealii::Particles::ParticleHandler<dim, dim> &
    handler() const
    {
      return *particle_handler;
    }

  private:
    using Mesh    = dealii::parallel::distributed::Triangulation<dim, dim>;
    using Handler = dealii::Particles::ParticleHandler<dim, dim>;

    /// Two particles at exactly the support count as interacting: the pair
    /// loops may differ in the last bit about them. Relative.
    static constexpr double support_tolerance = 1e-9;

    /// A particle as the traversal of the handler meets it.
    struct Found;

    void
    balance(const CellWork &work_of_cells);

    void
    number();

    void
    mark_pairs_across_ranks(std::vector<Found> &own,
                            std::vector<Found> &foreign) const;

    void
    number_owned(std::vector<Found> &own);

    void
    number_ghosts(const std::vector<Found> &own, std::vector<Found> &foreign);

    MPI_Comm            mpi_communicator;
    double              support;
    BackgroundGrid<dim> grid;
    CellWork            given_work;

    std::unique_ptr<Mesh>    mesh;
    std::unique_ptr<Handler> particle_handler;

    unsigned int                    owned = 0, boundary = 0;
    std::vector<dealii::Point<dim>> positions;
    std::vector<Index>              identities;

    std::shared_ptr<const Partitioner> ownership;
    std::unique_ptr<Halo>              halo;
  };
} // namespace Morsel::SPH

#endif
