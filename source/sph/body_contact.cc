#include <morsel/sph/body_contact.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  unsigned long long
  BodyContact::Side::id(const unsigned int i) const
  {
    return owns(i) ? particles.id[i] : foreign[i - particles.n_owned].id;
  }


  BodyContact::State
  BodyContact::Side::state(const unsigned int i) const
  {
    if (!owns(i))
      return foreign_now[i - particles.n_owned];
    const Motion &m = particles.motion[i];
    return {particles.position(i), dealii::Tensor<1, 2>({m.v_x, m.v_y})};
  }


  double
  BodyContact::Side::mass(const unsigned int i) const
  {
    return owns(i) ? particles.mass[i] : foreign[i - particles.n_owned].mass;
  }


  bool
  BodyContact::Side::has_moved(const double distance) const
  {
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      if (particles.position(i).distance_square(searched[i]) >
          distance * distance)
        return true;
    return false;
  }


  BodyContact::BodyContact(const Particles &first,
                           const Particles &second,
                           const double     stiffness,
                           const double     friction,
                           const MPI_Comm   communicator)
      : communicator(communicator)
      , sides{Side(first), Side(second)}
      , k(stiffness)
      , friction(friction)
      , reach(0.5 * (first.spacing + second.spacing))
      , margin(reach)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      for (Side &side : sides)
        side.exchange = std::make_unique<MemberExchange>(communicator);
    search();
    for (const Pair &pair : pairs)
      {
        const double distance =
            sides[0].state(pair.i).x.distance(sides[1].state(pair.j).x);
        if (distance < reach)
          closer_at_first[{sides[0].id(pair.i), sides[1].id(pair.j)}] =
              distance;
      }
    search();
  }


  bool
  BodyContact::moved_far() const
  {
    const bool here = std::any_of(
        std::begin(sides), std::end(sides), [this](const Side &side) {
          return side.has_moved(0.5 * margin);
        });
    return dealii::Utilities::MPI::logical_or(here, communicator);
  }


  void
  BodyContact::search()
  {
    const double far = reach + margin;
    for (Side &side : sides)
      {
        side.searched.resize(side.particles.n_owned);
        for (unsigned int i = 0; i < side.searched.size(); ++i)
          side.searched[i] = side.particles.position(i);
        side.grid.build(side.searched, far);
      }
    find_foreign(sides[0], sides[1]);
    find_foreign(sides[1], sides[0]);

    pairs.clear();
    const auto &first = sides[0], &second = sides[1];
    const auto  add = [&](const unsigned int      i,
                         const dealii::Point<2> &a,
                         const unsigned int      j,
                         const dealii::Point<2> &b) {
      if (a.distance_square(b) < far * far)
        pairs.push_back({i, j, reach});
    };
    const auto add_near_second = [&](const unsigned int      i,
                                     const dealii::Point<2> &a) {
      second.grid.for_each_near(
          a, [&](const unsigned int j) { add(i, a, j, second.searched[j]); });
    };
    for (unsigned int i = 0; i < first.searched.size(); ++i)
      add_near_second(i, first.searched[i]);
    for (unsigned int f = 0; f < first.foreign.size(); ++f)
      add_near_second(first.particles.n_owned + f, first.foreign[f].place);
    for (unsigned int f = 0; f < second.foreign.size(); ++f)
      first.grid.for_each_near(second.foreign[f].place,
                               [&](const unsigned int i) {
                                 add(i,
                                     first.searched[i],
                                     second.particles.n_owned + f,
                                     second.foreign[f].place);
                               });
    if (!closer_at_first.empty())
      for (Pair &pair : pairs)
        {
          const auto closer =
              closer_at_first.find({first.id(pair.i), second.id(pair.j)});
          if (closer != closer_at_first.end())
            pair.distance = closer->second;
        }
  }


  void
  BodyContact::find_foreign(Side &wanted, const Side &other)
  {
    if (!wanted.exchange)
      return;
    std::vector<dealii::Point<2>> all = wanted.searched, sought;
    all.insert(all.end(), other.searched.begin(), other.searched.end());
    for (const unsigned int i : other.grid.sorted())
      sought.push_back(other.searched[i]);
    wanted.exchange->find(
        wanted.searched, all, sought, other.grid, reach + margin, 0.);
    wanted.foreign.clear();
    wanted.foreign_now.clear();
    const Particles &p = wanted.particles;
    wanted.exchange->exchange<Foreign>(
        [&](const unsigned int i) -> Foreign {
          return {p.id[i], wanted.searched[i], p.mass[i]};
        },
        [&](const unsigned int, const Foreign &f) {
          wanted.foreign.push_back(f);
          wanted.foreign_now.push_back({f.place, {}});
        });
  }


  void
  BodyContact::compute(const double time_step)
  {
    if (moved_far())
      search();
    for (Side &side : sides)
      {
        side.forces.clear();
        if (side.exchange)
          side.exchange->exchange<State>(
              [&](const unsigned int i) { return side.state(i); },
              [&](const unsigned int f, const State &state) {
                side.foreign_now[f] = state;
              });
      }
    energy = penetration = 0.;
    for (const Pair &pair : pairs)
      push(pair, time_step);
  }


  void
  BodyContact::push(const Pair &pair, const double time_step)
  {
    Side        &a = sides[0], &b = sides[1];
    const State  p = a.state(pair.i), q = b.state(pair.j);
    const auto   away = p.x - q.x;
    const double r    = away.norm();
    const double gap  = r - pair.distance;
    if (gap >= 0. || r == 0.)
      return;
    const double part  = a.owns(pair.i) && b.owns(pair.j) ? 1. : 0.5;
    const auto   n     = away / r;
    const auto   v     = p.v - q.v;
    const auto   slip  = v - (v * n) * n;
    const double speed = slip.norm();
    auto         f     = -k * gap * n;
    energy += part * 0.5 * k * gap * gap;
    penetration = std::max(penetration, -gap);
    if (friction > 0. && speed > 0.)
      {
        const double lighter = std::min(a.mass(pair.i), b.mass(pair.j));
        const double size =
            std::min(-friction * k * gap, 0.1 * lighter * speed / time_step);
        f -= size / speed * slip;
        heat += part * size * speed * time_step;
      }
    if (a.owns(pair.i))
      a.forces.push_back({pair.i, f});
    if (b.owns(pair.j))
      b.forces.push_back({pair.j, -f});
  }
} // namespace Morsel::SPH
