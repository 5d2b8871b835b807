#include <morsel/sph/halo.h>

#include <deal.II/base/mpi.h>

#include <cstring>
#include <utility>

namespace Morsel::SPH
{
  Halo::Halo(
      std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner_)
      : partitioner(std::move(partitioner_))
      , communicator(dealii::Utilities::MPI::duplicate_communicator(
            partitioner->get_mpi_communicator()))
      , silent(partitioner->ghost_targets().empty() &&
               partitioner->import_targets().empty())
      , n_owned(partitioner->locally_owned_size())
      , n_ghosts(partitioner->n_ghost_indices())
  {}


  Halo::~Halo()
  {
    // An exchange that an exception cut short must not write into freed
    // memory; its partner may never answer, so it is not waited for.
    for (Channel &channel : channels)
      for (MPI_Request &request : channel.requests)
        {
          MPI_Cancel(&request);
          MPI_Request_free(&request);
        }
    dealii::Utilities::MPI::free_communicator(communicator);
  }


  void
  Halo::start_bytes(const std::byte   *owned,
                    std::byte         *ghosts,
                    const std::size_t  record_size,
                    const unsigned int channel)
  {
    AssertIndexRange(channel, n_channels);
    Channel &own = channels[channel];
    Assert(own.requests.empty(),
           dealii::ExcMessage("This channel still waits for finish()."));
    own.send_buffer.resize(partitioner->n_import_indices() * record_size);

    for (const auto &[rank, n_records] : partitioner->ghost_targets())
      {
        own.requests.emplace_back();
        const int error = MPI_Irecv(ghosts,
                                    n_records * record_size,
                                    MPI_BYTE,
                                    rank,
                                    channel,
                                    communicator,
                                    &own.requests.back());
        AssertThrowMPI(error);
        ghosts += n_records * record_size;
      }

    std::byte *packed = own.send_buffer.data();
    for (const auto &[begin, end] : partitioner->import_indices())
      {
        const std::size_t n_bytes = (end - begin) * record_size;
        std::memcpy(packed, owned + begin * record_size, n_bytes);
        packed += n_bytes;
      }

    const std::byte *message = own.send_buffer.data();
    for (const auto &[rank, n_records] : partitioner->import_targets())
      {
        own.requests.emplace_back();
        const int error = MPI_Isend(message,
                                    n_records * record_size,
                                    MPI_BYTE,
                                    rank,
                                    channel,
                                    communicator,
                                    &own.requests.back());
        AssertThrowMPI(error);
        message += n_records * record_size;
      }
  }


  void
  Halo::wait(const unsigned int channel)
  {
    AssertIndexRange(channel, n_channels);
    std::vector<MPI_Request> &requests = channels[channel].requests;

    const int error =
        MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
    requests.clear();
  }
} // namespace Morsel::SPH
