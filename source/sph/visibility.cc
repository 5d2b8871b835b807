#include <morsel/core/errors.h>
#include <morsel/sph/visibility.h>

#include <algorithm>
#include <sstream>

namespace Morsel::SPH
{
  using dealii::Point;
  using dealii::Tensor;
  using Fracture::Crack;
  using Fracture::CrackTip;

  TipHandling
  tip_handling_named(const std::string &name)
  {
    return name == "diffraction"    ? TipHandling::diffraction
           : name == "transparency" ? TipHandling::transparency
                                    : TipHandling::visibility;
  }


  WallGrid::WallGrid(const std::vector<Scene::Outline::Edge> &edges,
                     const double                             cell_size)
      : size(cell_size)
  {
    if (edges.empty())
      return;
    Point<2> upper = origin = edges.front().first;
    for (const Scene::Outline::Edge &edge : edges)
      {
        walls.push_back(Crack({edge.first, edge.second}, false, false));
        for (unsigned int d = 0; d < 2; ++d)
          {
            origin[d] = std::min(origin[d], edge.first[d]);
            upper[d]  = std::max(upper[d], edge.first[d]);
          }
      }
    n_x = 1 + static_cast<unsigned int>((upper[0] - origin[0]) / size);
    n_y = 1 + static_cast<unsigned int>((upper[1] - origin[1]) / size);
    cells.resize(n_x * n_y);
    for (unsigned int w = 0; w < walls.size(); ++w)
      any_cell(cells,
               walls[w].get_vertices()[0],
               walls[w].get_vertices()[1],
               [w](std::vector<unsigned int> &list) {
                 list.push_back(w);
                 return false;
               });
  }


  template <typename Lists, typename Function>
  bool
  WallGrid::any_cell(Lists          &lists,
                     const Point<2> &p,
                     const Point<2> &q,
                     const Function &f) const
  {
    const auto cell = [&](const double x, const unsigned int d) {
      const double place = (x - origin[d]) / size;
      return static_cast<unsigned int>(
          std::clamp(place, 0., (d == 0 ? n_x : n_y) - 0.5));
    };
    for (unsigned int y = cell(std::min(p[1], q[1]), 1);
         y <= cell(std::max(p[1], q[1]), 1);
         ++y)
      for (unsigned int x = cell(std::min(p[0], q[0]), 0);
           x <= cell(std::max(p[0], q[0]), 0);
           ++x)
        if (f(lists[y * n_x + x]))
          return true;
    return false;
  }


  bool
  WallGrid::separates(const Point<2> &p, const Point<2> &q) const
  {
    return !walls.empty() &&
           any_cell(cells, p, q, [&](const std::vector<unsigned int> &list) {
             return std::any_of(
                 list.begin(), list.end(), [&](const unsigned int w) {
                   return walls[w].separates(p, q);
                 });
           });
  }


  Visibility::Visibility(const std::vector<Crack>                &all,
                         const TipHandling                        handling,
                         const double                             reach,
                         const std::vector<Scene::Outline::Edge> &edges)
      : walls(edges, 2. * reach)
      , handling(handling)
      , reach(reach)
  {
    // Cells of a fitted cloud meet in the tip: lines through it are not cut.
    for (const Crack &crack : all)
      cracks.push_back(crack.with_moved_tips(-1e-6 * reach));
    tips = Fracture::collect_tips(cracks);
  }


  bool
  Visibility::sees(const Point<2> &p, const Point<2> &q) const
  {
    return are_joined(p, q) && !walls.separates(p, q);
  }


  bool
  Visibility::are_joined(const Point<2> &p, const Point<2> &q) const
  {
    return std::none_of(cracks.begin(), cracks.end(), [&](const Crack &crack) {
      return crack.separates(p, q);
    });
  }


  double
  Visibility::distance(const Point<2> &eye,
                       const Point<2> &x,
                       const Point<2> &node) const
  {
    const double straight = x.distance(node);
    if (sees(eye, node))
      return straight;
    double best = hidden;
    for (const CrackTip &tip : tips)
      {
        if (handling == TipHandling::diffraction)
          {
            const Point<2> around = tip.position + 1e-6 * reach * tip.direction;
            if (sees(eye, around) && sees(around, node))
              best = std::min(
                  best, x.distance(tip.position) + tip.position.distance(node));
          }
        else if (handling == TipHandling::transparency)
          {
            // Where the line meets that of the tip's segment, behind the tip.
            const Tensor<1, 2> a = tip.to_local(eye), b = tip.to_local(node);
            if (a[1] * b[1] >= 0.)
              continue;
            const double behind = -(a[0] * b[1] - b[0] * a[1]) / (b[1] - a[1]);
            if (behind > 0. && behind < reach)
              best =
                  std::min(best, straight + behind * behind / (0.25 * reach));
          }
      }
    return best;
  }


  void
  keep_visible(NeighbourList               &list,
               const std::vector<Point<2>> &reference,
               const Visibility            &visibility)
  {
    if (!visibility.hides())
      return;
    unsigned int kept = 0, begin = 0;
    for (unsigned int i = 0; i < list.n_rows(); ++i)
      {
        const unsigned int end = list.start[i + 1];
        for (unsigned int k = begin; k < end; ++k)
          if (visibility.sees(reference[i], reference[list.index[k]]))
            list.index[kept++] = list.index[k];
        list.start[i + 1] = kept;
        begin             = end;
      }
    list.index.resize(kept);
  }


  void
  check_off_cracks(const std::vector<Point<2>> &particles,
                   const std::vector<Crack>    &cracks,
                   const double                 spacing,
                   const std::string           &advice)
  {
    for (const Point<2> &p : particles)
      for (const Crack &crack : cracks)
        if (crack.distance(p) < 1e-3 * spacing)
          {
            std::ostringstream message;
            message << "A particle at (" << p
                    << ") m lies on a crack: " << advice;
            throw InputError(message.str());
          }
  }
} // namespace Morsel::SPH
