#include <morsel/sph/body_contact.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  namespace
  {
    std::vector<dealii::Point<2>>
    positions(const Particles &particles)
    {
      std::vector<dealii::Point<2>> x(particles.n_owned);
      for (unsigned int i = 0; i < x.size(); ++i)
        x[i] = particles.position(i);
      return x;
    }


    bool
    any_moved(const Particles                     &particles,
              const std::vector<dealii::Point<2>> &then,
              const double                         distance)
    {
      for (unsigned int i = 0; i < particles.n_owned; ++i)
        if (particles.position(i).distance_square(then[i]) >
            distance * distance)
          return true;
      return false;
    }
  } // namespace


  BodyContact::BodyContact(const Particles &first,
                           const Particles &second,
                           const double     stiffness,
                           const double     friction)
      : a(first)
      , b(second)
      , k(stiffness)
      , friction(friction)
      , reach(0.5 * (first.spacing + second.spacing))
      , margin(reach)
  {
    search();
    for (const auto &pair : pairs)
      if (a.position(pair.i).distance(b.position(pair.j)) < reach)
        {
          closer_at_first.push_back(pair);
          closer_at_first.back().distance =
              a.position(pair.i).distance(b.position(pair.j));
        }
    search();
  }


  bool
  BodyContact::moved_far() const
  {
    return any_moved(a, searched_a, 0.5 * margin) ||
           any_moved(b, searched_b, 0.5 * margin);
  }


  void
  BodyContact::search()
  {
    searched_a = positions(a);
    searched_b = positions(b);
    pairs.clear();
    const double far = reach + margin;
    grid.build(searched_b, far);
    dealii::BoundingBox<2> box(searched_b);
    box.extend(far);
    for (unsigned int i = 0; i < searched_a.size(); ++i)
      if (box.point_inside(searched_a[i]))
        grid.for_each_near(searched_a[i], [&](const unsigned int j) {
          if (searched_a[i].distance_square(searched_b[j]) < far * far)
            pairs.push_back({i, j, reach});
        });
    for (const auto &close : closer_at_first)
      for (auto &pair : pairs)
        if (pair.i == close.i && pair.j == close.j)
          pair.distance = close.distance;
  }


  void
  BodyContact::compute(const double time_step)
  {
    if (moved_far())
      search();
    energy = penetration = 0.;
    forces[0].clear();
    forces[1].clear();
    for (const auto &pair : pairs)
      push(pair, time_step);
  }


  void
  BodyContact::push(const Pair &pair, const double time_step)
  {
    const auto   away = a.position(pair.i) - b.position(pair.j);
    const double r    = away.norm();
    const double gap  = r - pair.distance;
    if (gap >= 0. || r == 0.)
      return;
    const auto    n = away / r;
    const Motion &p = a.motion[pair.i], &q = b.motion[pair.j];
    const auto    v     = dealii::Tensor<1, 2>({p.v_x - q.v_x, p.v_y - q.v_y});
    const auto    slip  = v - (v * n) * n;
    const double  speed = slip.norm();
    auto          f     = -k * gap * n;
    energy += 0.5 * k * gap * gap;
    penetration = std::max(penetration, -gap);
    if (friction > 0. && speed > 0.)
      {
        const double lighter = std::min(a.mass[pair.i], b.mass[pair.j]);
        const double size =
            std::min(-friction * k * gap, 0.1 * lighter * speed / time_step);
        f -= size / speed * slip;
        heat += size * speed * time_step;
      }
    forces[0].push_back({pair.i, f});
    forces[1].push_back({pair.j, -f});
  }
} // namespace Morsel::SPH
