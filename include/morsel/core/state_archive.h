#ifndef morsel_core_state_archive_h
#define morsel_core_state_archive_h

#include <morsel/core/errors.h>

#include <deal.II/base/aligned_vector.h>

#include <Eigen/Core>

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Morsel
{
  /// What a run has to remember to go on as if it had never stopped, as a
  /// sequence of records. A class names its state once, in a function
  /// exchange_state(StateArchive &), for saving as for loading, so that the
  /// two cannot differ. What a constructor makes of the scene is no state: a
  /// run that goes on is set up as at first, and loaded then.
  ///
  /// On the ranks that saved, loading brings everything back bit by bit. Where
  /// the particles belong to other ranks now, each record says by the name it
  /// goes by what it becomes: same(), sum(), particles(), cache(). Each rank
  /// then brings some of the parts, and rows travel to where they are wanted:
  /// no rank sees all of a state.
  class StateArchive
  {
  public:
    /// For saving.
    StateArchive() = default;

    /// For loading on the ranks that saved.
    /// @param part of this rank
    explicit StateArchive(std::string part)
        : parts{std::move(part)}
        , cursors(1, 0)
        , loading(true)
    {}

    /// For loading where particles have other owners than when it was saved;
    /// loading is collective then.
    /// @param parts that this rank brings: each of the saved ones is brought by
    ///   one rank, the first of all by rank 0
    StateArchive(std::vector<std::string> parts, const MPI_Comm communicator)
        : parts(std::move(parts))
        , cursors(this->parts.size(), 0)
        , loading(true)
        , redistributes(true)
        , communicator(communicator)
    {}

    bool
    loads() const
    {
      return loading;
    }

    /// What was saved, on this rank.
    const std::string &
    buffer() const &
    {
      return saved;
    }

    /// The same without a copy, of an archive that is given up.
    std::string
    buffer() &&
    {
      return std::move(saved);
    }

    /// Saves what another archive has saved, on this rank.
    void
    append(const std::string &buffer_of_other)
    {
      saved += buffer_of_other;
    }

    /// Whether everything that was saved has been loaded.
    bool
    at_end() const
    {
      for (std::size_t p = 0; p < parts.size(); ++p)
        if (cursors[p] != parts[p].size())
          return false;
      return true;
    }

    /// Values that are alike on all ranks.
    template <typename... T>
    void
    same(T &...values)
    {
      (exchange(values,
                [this](T &value, std::deque<T> &of_parts) {
                  StateArchive first;
                  if (is_first_rank())
                    first.encode(of_parts.front());
                  decode_from(broadcast(std::move(first.saved)), value);
                }),
       ...);
    }

    /// Numbers, or lists of them, of which each rank has its part of the sum.
    template <typename... T>
    void
    sum(T &...values)
    {
      (exchange(values,
                [](T &value, std::deque<T> &of_parts) {
                  set_to_zero(value);
                  for (const T &part : of_parts)
                    add(value, part);
                }),
       ...);
    }

    /// What is made anew where it is missing; but then the order of sums may
    /// be another one.
    /// @return whether the values are there now, after loading
    template <typename... T>
    bool
    cache(T &...values)
    {
      (exchange(values, [](T &, std::deque<T> &) {}), ...);
      return !loading || !redistributes;
    }

    /// Says which particles those of particles() are, up to the next call.
    /// @param ids of all that the rank knows, the owned ones first; each is
    ///   owned by one rank, and there are no gaps.
    void
    name_particles(const std::vector<unsigned long long> &ids,
                   unsigned int                           n_owned);

    /// Values of the owned particles, or of all that the rank knows; empty
    /// where the run has none.
    template <typename... T>
    void
    particles(std::vector<T> &...values)
    {
      (exchange(
           values,
           [this](std::vector<T> &value, std::deque<std::vector<T>> &of_parts) {
             move_rows(value, of_parts);
           }),
       ...);
    }

  private:
    using Row = std::pair<unsigned int, unsigned int>; ///< part, its row

    /// What travels: by rank.
    using Messages = std::map<unsigned int, std::string>;

    /// A record that is but its bytes.
    template <typename T>
    static constexpr bool is_plain =
        std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

    void
    put(const void *data, std::size_t element, std::size_t count);

    /// Reads the head of a record. @return how many elements follow.
    std::size_t
    begin_get(std::size_t part, std::size_t element);

    void
    get_bytes(std::size_t part, void *data, std::size_t bytes);

    [[noreturn]] static void
    fail();

    bool
    is_first_rank() const;

    /// What the first rank gives.
    std::string
    broadcast(std::string bytes) const;

    /// @return what other ranks, and this one, have for this one
    Messages
    send(Messages messages) const;

    /// Finds the rows that each rank wants of the parts that this one brings.
    void
    find_rows(const std::vector<unsigned long long>             &ids,
              const std::deque<std::vector<unsigned long long>> &of_parts);

    template <typename T>
    void
    decode_from(std::string bytes, T &value)
    {
      StateArchive archive(std::move(bytes));
      archive.decode(0, value);
    }

    template <typename T>
    void
    encode(const T &value)
    {
      static_assert(is_plain<T>, "This type needs its own encoding.");
      put(&value, sizeof(T), 1);
    }

    template <typename T>
    void
    decode(const std::size_t part, T &value)
    {
      if (begin_get(part, sizeof(T)) != 1)
        fail();
      get_bytes(part, static_cast<void *>(&value), sizeof(T));
    }

    template <typename Array>
    void
    encode_array(const Array &values)
    {
      put(values.data(), sizeof(*values.data()), values.size());
    }

    template <typename Array>
    void
    decode_array(const std::size_t part, Array &values)
    {
      const std::size_t element = sizeof(*values.data());
      values.resize(begin_get(part, element));
      get_bytes(
          part, static_cast<void *>(values.data()), element * values.size());
    }

    template <typename T>
    void
    encode(const std::vector<T> &values)
    {
      if constexpr (is_plain<T>)
        encode_array(values);
      else
        {
          encode(values.size());
          for (const T &value : values)
            encode(value);
        }
    }

    template <typename T>
    void
    decode(const std::size_t part, std::vector<T> &values)
    {
      if constexpr (is_plain<T>)
        decode_array(part, values);
      else
        {
          std::size_t size;
          decode(part, size);
          // Each takes at least the head of a record.
          if (size > parts[part].size())
            fail();
          values.resize(size);
          for (T &value : values)
            decode(part, value);
        }
    }

    template <typename T>
    void
    encode(const std::optional<T> &value)
    {
      put(value ? &*value : nullptr, sizeof(T), value ? 1 : 0);
    }

    template <typename T>
    void
    decode(const std::size_t part, std::optional<T> &value)
    {
      static_assert(is_plain<T>);
      const std::size_t count = begin_get(part, sizeof(T));
      if (count > 1)
        fail();
      value.reset();
      if (count == 1)
        {
          value.emplace();
          get_bytes(part, static_cast<void *>(&*value), sizeof(T));
        }
    }

    void
    encode(const std::string &text)
    {
      encode_array(text);
    }
    void
    decode(const std::size_t part, std::string &text)
    {
      decode_array(part, text);
    }

    template <typename T>
    void
    encode(const dealii::AlignedVector<T> &values)
    {
      encode_array(values);
    }
    template <typename T>
    void
    decode(const std::size_t part, dealii::AlignedVector<T> &values)
    {
      decode_array(part, values);
    }

    void
    encode(const Eigen::VectorXd &values)
    {
      encode_array(values);
    }
    void
    decode(const std::size_t part, Eigen::VectorXd &values)
    {
      decode_array(part, values);
    }

    /// @param redistribute makes the value of those of all parts
    template <typename T, typename Redistribute>
    void
    exchange(T &value, const Redistribute &redistribute)
    {
      if (!loading)
        encode(value);
      else if (!redistributes)
        decode(0, value);
      else
        {
          std::deque<T> of_parts(parts.size());
          for (std::size_t p = 0; p < parts.size(); ++p)
            decode(p, of_parts[p]);
          redistribute(value, of_parts);
        }
    }

    template <typename T>
    static void
    set_to_zero(T &value)
    {
      value = T();
    }
    template <typename T>
    static void
    set_to_zero(std::vector<T> &values)
    {
      std::fill(values.begin(), values.end(), T());
    }

    template <typename T>
    static void
    add(T &sum, const T &part)
    {
      sum += part;
    }
    template <typename T>
    static void
    add(std::vector<T> &sums, const std::vector<T> &part)
    {
      sums.resize(std::max(sums.size(), part.size()), T());
      for (std::size_t k = 0; k < sums.size(); ++k)
        sums[k] += part[k];
    }

    template <typename T>
    void
    move_rows(std::vector<T> &value, const std::deque<std::vector<T>> &of_parts)
    {
      Messages messages;
      for (const auto &[rank, rows] : rows_for)
        {
          std::vector<T> chosen;
          for (const Row &row : rows)
            if (row.second < of_parts[row.first].size())
              chosen.push_back(of_parts[row.first][row.second]);
          StateArchive archive;
          archive.encode(chosen);
          messages[rank] = std::move(archive.saved);
        }
      for (auto &[rank, message] : send(std::move(messages)))
        {
          std::vector<T> rows;
          decode_from(std::move(message), rows);
          const std::vector<unsigned int> &places = places_from[rank];
          // A run has none of them where it has none of the values, and what
          // is longer is padding.
          if (rows.size() != (value.empty() ? 0 : places.size()))
            fail();
          for (std::size_t k = 0; k < rows.size(); ++k)
            if (places[k] < value.size())
              value[places[k]] = std::move(rows[k]);
        }
    }

    std::string              saved;
    std::vector<std::string> parts;
    std::vector<std::size_t> cursors;
    bool                     loading       = false;
    bool                     redistributes = false;
    MPI_Comm                 communicator  = MPI_COMM_SELF;

    /// Rows of the parts that this rank brings, by the rank that wants them.
    std::map<unsigned int, std::vector<Row>> rows_for;
    /// Where those from a rank belong.
    std::map<unsigned int, std::vector<unsigned int>> places_from;
  };
} // namespace Morsel

#endif
