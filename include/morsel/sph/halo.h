#ifndef morsel_sph_halo_h
#define morsel_sph_halo_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/partitioner.h>

#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace Morsel::SPH
{
  /// Brings plain records of owned particles to the ranks that hold them as
  /// ghosts. Who needs what comes from a Partitioner; the records may be of any
  /// trivially copyable type, so that a pair loop keeps the layout it likes.
  /// Buffers are kept: nothing is allocated from the second exchange on.
  class Halo
  {
  public:
    /// Exchanges that may be under way at the same time.
    static constexpr unsigned int n_channels = 4;

    /// Collective.
    explicit Halo(
        std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner);

    ~Halo();

    Halo(const Halo &) = delete;
    Halo &
    operator=(const Halo &) = delete;

    /// Packs and sends the owned records of @p all and posts the receives for
    /// its ghosts. @p all holds the owned particles, then the ghosts. Until
    /// finish() the ghosts must not be touched and @p all must not move; the
    /// owned records are free again at once.
    template <typename Record>
    void
    start(const dealii::ArrayView<Record> &all, const unsigned int channel = 0)
    {
      static_assert(std::is_trivially_copyable<Record>::value,
                    "Records travel as bytes.");
      if (silent)
        return;
      AssertDimension(all.size(), n_owned + n_ghosts);
      start_bytes(reinterpret_cast<const std::byte *>(all.data()),
                  reinterpret_cast<std::byte *>(all.data() + n_owned),
                  sizeof(Record),
                  channel);
    }

    /// Waits until the ghosts of the exchange begun by start() have arrived.
    void
    finish(const unsigned int channel = 0)
    {
      if (!silent)
        wait(channel);
    }

  private:
    struct Channel
    {
      std::vector<std::byte>   send_buffer;
      std::vector<MPI_Request> requests;
    };

    void
    start_bytes(const std::byte *owned,
                std::byte       *ghosts,
                std::size_t      record_size,
                unsigned int     channel);

    void
    wait(unsigned int channel);

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;

    MPI_Comm     communicator; ///< its own: tags cannot meet deal.II's
    bool         silent;       ///< neither sends nor receives anything
    unsigned int n_owned, n_ghosts;

    std::array<Channel, n_channels> channels;
  };
} // namespace Morsel::SPH

#endif
