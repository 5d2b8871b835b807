#include <morsel/core/state_archive.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <limits>
#include <unordered_map>

namespace Morsel
{
  namespace
  {
    /// Stands before the bytes of each record.
    struct Head
    {
      std::uint64_t element, count;
    };
  } // namespace


  void
  StateArchive::fail()
  {
    throw FileError("The state does not belong to this scene or this version "
                    "of the program.");
  }


  void
  StateArchive::put(const void       *data,
                    const std::size_t element,
                    const std::size_t count)
  {
    const Head head{element, count};
    saved.append(reinterpret_cast<const char *>(&head), sizeof(head));
    if (count > 0)
      saved.append(static_cast<const char *>(data), element * count);
  }


  std::size_t
  StateArchive::begin_get(const std::size_t part, const std::size_t element)
  {
    Head head;
    get_bytes(part, &head, sizeof(head));
    if (head.element != element ||
        head.count > (parts[part].size() - cursors[part]) / element)
      fail();
    return head.count;
  }


  void
  StateArchive::get_bytes(const std::size_t part,
                          void             *data,
                          const std::size_t bytes)
  {
    if (bytes > parts[part].size() - cursors[part])
      fail();
    if (bytes > 0)
      std::memcpy(data, parts[part].data() + cursors[part], bytes);
    cursors[part] += bytes;
  }


  bool
  StateArchive::is_first_rank() const
  {
    return dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  }


  std::string
  StateArchive::broadcast(std::string bytes) const
  {
    unsigned long long size = bytes.size();
    int error = MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG_LONG, 0, communicator);
    AssertThrowMPI(error);
    bytes.resize(size);
    // MPI counts by int.
    constexpr std::size_t most = std::numeric_limits<int>::max();
    for (std::size_t begin = 0; begin < size; begin += most)
      {
        error = MPI_Bcast(&bytes[begin],
                          std::min<std::size_t>(most, size - begin),
                          MPI_BYTE,
                          0,
                          communicator);
        AssertThrowMPI(error);
      }
    return bytes;
  }


  StateArchive::Messages
  StateArchive::send(Messages messages) const
  {
    const unsigned int rank =
        dealii::Utilities::MPI::this_mpi_process(communicator);
    const auto own = messages.extract(rank);
    Messages   received =
        dealii::Utilities::MPI::some_to_some(communicator, messages);
    if (!own.empty())
      received[rank] = own.mapped();
    return received;
  }


  void
  StateArchive::name_particles(const std::vector<unsigned long long> &ids,
                               const unsigned int                     n_owned)
  {
    std::vector<unsigned long long> owned(ids.begin(), ids.begin() + n_owned);
    exchange(owned,
             [&](std::vector<unsigned long long> &,
                 const std::deque<std::vector<unsigned long long>> &of_parts) {
               find_rows(ids, of_parts);
             });
    if (loading && !redistributes &&
        !std::equal(
            owned.begin(), owned.end(), ids.begin(), ids.begin() + n_owned))
      fail();
  }


  void
  StateArchive::find_rows(
      const std::vector<unsigned long long>             &ids,
      const std::deque<std::vector<unsigned long long>> &of_parts)
  {
    unsigned long long n_ids = 0;
    for (const unsigned long long id : ids)
      n_ids = std::max(n_ids, id + 1);
    std::unordered_map<unsigned long long, Row> row_of;
    for (unsigned int p = 0; p < of_parts.size(); ++p)
      for (unsigned int row = 0; row < of_parts[p].size(); ++row)
        {
          row_of.emplace(of_parts[p][row], Row(p, row));
          n_ids = std::max(n_ids, of_parts[p][row] + 1);
        }
    n_ids = dealii::Utilities::MPI::max(n_ids, communicator);
    places_from.clear();
    rows_for.clear();
    if (n_ids == 0)
      return;

    // Who brings which.
    const auto index_set = [n_ids](std::vector<unsigned long long> sorted) {
      std::sort(sorted.begin(), sorted.end());
      dealii::IndexSet set(n_ids);
      set.add_indices(sorted.begin(), sorted.end());
      set.compress();
      return set;
    };
    std::vector<unsigned long long> brought;
    for (const auto &part : of_parts)
      brought.insert(brought.end(), part.begin(), part.end());
    const dealii::IndexSet          wanted = index_set(ids);
    const std::vector<unsigned int> rank_of =
        dealii::Utilities::MPI::compute_index_owner(
            index_set(std::move(brought)), wanted, communicator);

    std::map<unsigned int, std::vector<unsigned long long>> wishes;
    for (unsigned int place = 0; place < ids.size(); ++place)
      {
        const unsigned int rank = rank_of[wanted.index_within_set(ids[place])];
        wishes[rank].push_back(ids[place]);
        places_from[rank].push_back(place);
      }
    Messages messages;
    for (const auto &[rank, ids_there] : wishes)
      {
        StateArchive archive;
        archive.encode(ids_there);
        messages[rank] = std::move(archive.saved);
      }
    for (auto &[rank, message] : send(std::move(messages)))
      {
        std::vector<unsigned long long> ids_here;
        decode_from(std::move(message), ids_here);
        for (const unsigned long long id : ids_here)
          {
            const auto row = row_of.find(id);
            if (row == row_of.end())
              fail();
            rows_for[rank].push_back(row->second);
          }
      }
  }
} // namespace Morsel
