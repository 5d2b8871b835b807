#include <morsel/sph/member_exchange.h>

#include <algorithm>
#include <array>
#include <limits>

namespace Morsel::SPH
{
  using dealii::Point;

  MemberExchange::MemberExchange(const MPI_Comm communicator)
      : communicator(
            dealii::Utilities::MPI::duplicate_communicator(communicator))
      , send_start(1, 0)
      , receive_start(1, 0)
  {}


  MemberExchange::~MemberExchange()
  {
    dealii::Utilities::MPI::free_communicator(communicator);
  }


  void
  MemberExchange::find(const std::vector<Point<2>> &own,
                       const std::vector<Point<2>> &all,
                       const std::vector<Point<2>> &seeking,
                       const CellGrid              &grid,
                       const double                 reach,
                       const double                 margin)
  {
    near_others = reach + margin;
    find_partners(all);
    offer(own, reach);
    exchange_counts();

    // Of what is offered, each rank says what is near any point of its own.
    std::vector<char> wanted;
    exchange<Point<2>>(
        [&](const unsigned int m) { return own[m]; },
        [&](const unsigned int, const Point<2> &x) {
          bool near = false;
          grid.for_each_run(
              x, [&](const unsigned int begin, const unsigned int end) {
                for (unsigned int m = begin; m < end && !near; ++m)
                  near = (seeking[m] - x).norm_square() < reach * reach;
              });
          wanted.push_back(near);
        });
    std::swap(send_start, receive_start);
    std::vector<char> needed(send_index.size());
    exchange_bytes(reinterpret_cast<const std::byte *>(wanted.data()),
                   reinterpret_cast<std::byte *>(needed.data()),
                   1);
    std::swap(send_start, receive_start);

    std::vector<unsigned int> kept, kept_start(1, 0), left_start(1, 0);
    for (unsigned int p = 0; p < partners.size(); ++p)
      {
        for (unsigned int k = send_start[p]; k < send_start[p + 1]; ++k)
          if (needed[k])
            kept.push_back(send_index[k]);
        kept_start.push_back(kept.size());
        left_start.push_back(left_start.back() +
                             std::count(wanted.begin() + receive_start[p],
                                        wanted.begin() + receive_start[p + 1],
                                        1));
      }
    send_index.swap(kept);
    send_start.swap(kept_start);
    receive_start.swap(left_start);
  }


  void
  MemberExchange::find_partners(const std::vector<Point<2>> &own)
  {
    constexpr double far = std::numeric_limits<double>::infinity();
    Box              box{{far, far}, {-far, -far}};
    for (const Point<2> &x : own)
      for (unsigned int d = 0; d < 2; ++d)
        {
          box.lower[d] = std::min(box.lower[d], x[d]);
          box.upper[d] = std::max(box.upper[d], x[d]);
        }
    std::vector<std::array<double, 4>> all(
        dealii::Utilities::MPI::n_mpi_processes(communicator));
    const std::array<double, 4> mine{
        {box.lower[0], box.lower[1], box.upper[0], box.upper[1]}};
    const int error = MPI_Allgather(
        mine.data(), 4, MPI_DOUBLE, all.data(), 4, MPI_DOUBLE, communicator);
    AssertThrowMPI(error);

    const unsigned int rank =
        dealii::Utilities::MPI::this_mpi_process(communicator);
    partners.clear();
    boxes.clear();
    for (unsigned int r = 0; r < all.size(); ++r)
      {
        const Box other{{all[r][0], all[r][1]}, {all[r][2], all[r][3]}};
        // The same comparisons on both sides.
        bool meet = r != rank;
        for (unsigned int d = 0; d < 2; ++d)
          meet = meet && box.lower[d] - near_others <= other.upper[d] &&
                 other.lower[d] - near_others <= box.upper[d];
        if (!meet)
          continue;
        partners.push_back(r);
        boxes.push_back(other);
      }
  }


  void
  MemberExchange::offer(const std::vector<Point<2>> &own, const double reach)
  {
    send_index.clear();
    send_start.assign(1, 0);
    for (const Box &box : boxes)
      {
        for (unsigned int m = 0; m < own.size(); ++m)
          {
            bool inside = true;
            for (unsigned int d = 0; d < 2; ++d)
              inside = inside && own[m][d] >= box.lower[d] - reach &&
                       own[m][d] <= box.upper[d] + reach;
            if (inside)
              send_index.push_back(m);
          }
        send_start.push_back(send_index.size());
      }
  }


  bool
  MemberExchange::is_near_others(const Point<2> &x) const
  {
    return std::any_of(boxes.begin(), boxes.end(), [&](const Box &box) {
      bool inside = true;
      for (unsigned int d = 0; d < 2; ++d)
        inside = inside && x[d] >= box.lower[d] - near_others &&
                 x[d] <= box.upper[d] + near_others;
      return inside;
    });
  }


  void
  MemberExchange::exchange_counts()
  {
    // One number for each partner.
    std::vector<unsigned int> offered, coming(partners.size());
    const auto                starts = send_start;
    for (unsigned int p = 0; p < partners.size(); ++p)
      {
        offered.push_back(starts[p + 1] - starts[p]);
        send_start[p + 1] = p + 1;
      }
    receive_start = send_start;
    exchange_bytes(reinterpret_cast<const std::byte *>(offered.data()),
                   reinterpret_cast<std::byte *>(coming.data()),
                   sizeof(unsigned int));
    send_start = starts;
    for (unsigned int p = 0; p < partners.size(); ++p)
      receive_start[p + 1] = receive_start[p] + coming[p];
  }


  void
  MemberExchange::exchange_bytes(const std::byte  *sent,
                                 std::byte        *received,
                                 const std::size_t record_size)
  {
    constexpr int            tag = 0;
    std::vector<MPI_Request> requests;
    const auto               begin = [&](const std::vector<unsigned int> &start,
                           const unsigned int               p,
                           const auto                      &call) {
      if (start[p] == start[p + 1])
        return;
      requests.emplace_back();
      const int error = call(start[p] * record_size,
                             (start[p + 1] - start[p]) * record_size,
                             &requests.back());
      AssertThrowMPI(error);
    };
    for (unsigned int p = 0; p < partners.size(); ++p)
      begin(receive_start,
            p,
            [&](const std::size_t from, const int n, MPI_Request *request) {
              return MPI_Irecv(received + from,
                               n,
                               MPI_BYTE,
                               partners[p],
                               tag,
                               communicator,
                               request);
            });
    for (unsigned int p = 0; p < partners.size(); ++p)
      begin(send_start,
            p,
            [&](const std::size_t from, const int n, MPI_Request *request) {
              return MPI_Isend(sent + from,
                               n,
                               MPI_BYTE,
                               partners[p],
                               tag,
                               communicator,
                               request);
            });
    const int error =
        MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
  }


  std::vector<std::vector<unsigned int>>
  MemberExchange::get_plan() const
  {
    return {partners, send_start, receive_start, send_index};
  }


  void
  MemberExchange::set_plan(const std::vector<std::vector<unsigned int>> &plan)
  {
    partners      = plan.at(0);
    send_start    = plan.at(1);
    receive_start = plan.at(2);
    send_index    = plan.at(3);
  }


  std::vector<double>
  MemberExchange::get_boxes() const
  {
    std::vector<double> numbers{near_others};
    for (const Box &box : boxes)
      numbers.insert(numbers.end(),
                     {box.lower[0], box.lower[1], box.upper[0], box.upper[1]});
    return numbers;
  }


  void
  MemberExchange::set_boxes(const std::vector<double> &numbers)
  {
    near_others = numbers.at(0);
    boxes.clear();
    for (std::size_t k = 1; k + 3 < numbers.size(); k += 4)
      boxes.push_back({Point<2>(numbers[k], numbers[k + 1]),
                       Point<2>(numbers[k + 2], numbers[k + 3])});
  }
} // namespace Morsel::SPH
