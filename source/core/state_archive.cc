#include <morsel/core/state_archive.h>

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


  void
  StateArchive::name_particles(const std::vector<unsigned long long> &ids,
                               const unsigned int                     n_owned)
  {
    std::vector<unsigned long long> owned(ids.begin(), ids.begin() + n_owned);
    exchange(owned,
             [&](std::vector<unsigned long long> &,
                 const std::deque<std::vector<unsigned long long>> &of_parts) {
               std::map<unsigned long long, Row> places;
               for (unsigned int p = 0; p < of_parts.size(); ++p)
                 for (unsigned int row = 0; row < of_parts[p].size(); ++row)
                   places.emplace(of_parts[p][row], Row(p, row));
               rows.clear();
               for (const unsigned long long id : ids)
                 {
                   const auto place = places.find(id);
                   if (place == places.end())
                     fail();
                   rows.push_back(place->second);
                 }
             });
    if (loading && same_rank_count &&
        !std::equal(owned.begin(), owned.end(), ids.begin()))
      fail();
  }
} // namespace Morsel
