#ifndef morsel_sph_member_exchange_h
#define morsel_sph_member_exchange_h

#include <morsel/sph/neighbours.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace Morsel::SPH
{
  /// Brings records of points that move freely to the ranks whose points they
  /// are near, wherever the reference configuration had them: a halo by present
  /// positions. Collective but for n_foreign().
  class MemberExchange
  {
  public:
    explicit MemberExchange(MPI_Comm communicator);

    ~MemberExchange();

    MemberExchange(const MemberExchange &) = delete;
    MemberExchange &
    operator=(const MemberExchange &) = delete;

    /// Finds the points of other ranks that this rank's need, and who needs
    /// this rank's. Both ranks of a pair agree about it.
    /// @param own points of this rank that others may need
    /// @param all that this rank may ever take part with
    /// @param seeking points of this rank that need others', in the order of
    ///   the grid's sorted()
    /// @param grid of these, whose cells are no smaller than @p reach
    /// @param reach within which points need each other [m]
    /// @param margin by which all may move until is_near_others() is asked [m]
    void
    find(const std::vector<dealii::Point<2>> &own,
         const std::vector<dealii::Point<2>> &all,
         const std::vector<dealii::Point<2>> &seeking,
         const CellGrid                      &grid,
         double                               reach,
         double                               margin);

    /// Whether what another rank may take part with can be within reach of
    /// @p x, a place of this rank, since find().
    bool
    is_near_others(const dealii::Point<2> &x) const;

    /// Points of other ranks that this rank needs, grouped by rank.
    unsigned int
    n_foreign() const
    {
      return receive_start.back();
    }

    /// @param of makes the record of one of this rank's points
    /// @param take gets the record of each foreign point
    template <typename Record, typename Make, typename Take>
    void
    exchange(const Make &of, const Take &take)
    {
      static_assert(std::is_trivially_copyable<Record>::value,
                    "Records travel as bytes.");
      std::vector<Record> sent, received(n_foreign());
      sent.reserve(send_index.size());
      for (const unsigned int m : send_index)
        sent.push_back(of(m));
      exchange_bytes(reinterpret_cast<const std::byte *>(sent.data()),
                     reinterpret_cast<std::byte *>(received.data()),
                     sizeof(Record));
      for (unsigned int n = 0; n < received.size(); ++n)
        take(n, received[n]);
    }

    /// @name Who sends what to whom, to go on from.
    ///@{
    std::vector<std::vector<unsigned int>>
    get_plan() const;

    void
    set_plan(const std::vector<std::vector<unsigned int>> &plan);

    /// And where the others are.
    std::vector<double>
    get_boxes() const;

    void
    set_boxes(const std::vector<double> &numbers);
    ///@}

  private:
    /// The box of this rank's points, and whose boxes are near it.
    void
    find_partners(const std::vector<dealii::Point<2>> &own);

    /// Points of this rank near each partner's box.
    void
    offer(const std::vector<dealii::Point<2>> &own, double reach);

    void
    exchange_counts();

    void
    exchange_bytes(const std::byte *sent,
                   std::byte       *received,
                   std::size_t      record_size);

    /// The corners of one rank's points, apart where it has none.
    struct Box
    {
      dealii::Point<2> lower, upper;
    };

    /// Communicator of its own: tags cannot meet another's.
    MPI_Comm communicator;

    std::vector<unsigned int> partners; ///< ranks
    std::vector<Box>          boxes;    ///< theirs
    double near_others = 0.; ///< reach and margin of the last find() [m]
    /// Per partner, n_partners + 1 places.
    std::vector<unsigned int> send_start, receive_start;
    std::vector<unsigned int> send_index; ///< of this rank's points
  };
} // namespace Morsel::SPH

#endif
