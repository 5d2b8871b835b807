#include <morsel/core/multifrontal_cholesky.h>

#include <algorithm>

namespace Morsel
{
  using dealii::Point;

  namespace
  {
    using Indices = std::vector<unsigned int>;

    /// Sets of no more nodes are not divided any further.
    constexpr unsigned int leaf_size = 24;


    class Divider
    {
    public:
      Divider(const std::vector<Point<2>> &points,
              const ElementNodes          &nodes,
              Dissection                  &result)
          : points(points)
          , nodes(nodes)
          , result(result)
          , part(points.size(), outside)
      {}

      /// Puts a set of nodes into the order; all nodes of the elements that
      /// are not in it come later.
      /// @return its front
      unsigned int
      divide(Indices set, const Indices &elements)
      {
        Indices halves[2], separator;
        if (set.size() > leaf_size)
          cut(set, elements, halves, separator);
        Indices children;
        if (!halves[0].empty() && !halves[1].empty())
          {
            Indices touching[2];
            for (unsigned int h = 0; h < 2; ++h)
              mark(halves[h], h);
            for (const unsigned int e : elements)
              for (unsigned int h = 0; h < 2; ++h)
                if (touches(e, h))
                  touching[h].push_back(e);
            mark(set, outside);
            for (unsigned int h = 0; h < 2; ++h)
              children.push_back(divide(halves[h], touching[h]));
            set = separator;
          }
        const unsigned int begin = n_ordered;
        for (const unsigned int node : set)
          result.position[node] = n_ordered++;
        result.fronts.push_back({begin, n_ordered, {}, children, {}});
        return result.fronts.size() - 1;
      }

    private:
      static constexpr char outside = 2;

      void
      mark(const Indices &set, const char value)
      {
        for (const unsigned int node : set)
          part[node] = value;
      }


      bool
      touches(const unsigned int e, const char which) const
      {
        return std::any_of(
            nodes.index.begin() + nodes.start[e],
            nodes.index.begin() + nodes.start[e + 1],
            [&](const unsigned int node) { return part[node] == which; });
      }


      /// Nodes of the second half that share an element with the first one.
      Indices
      separator_of(const Indices &elements) const
      {
        Indices result;
        for (const unsigned int e : elements)
          if (touches(e, 0))
            for (unsigned int k = nodes.start[e]; k < nodes.start[e + 1]; ++k)
              if (part[nodes.index[k]] == 1)
                result.push_back(nodes.index[k]);
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
      }


      /// Cuts a set across its longer extent such that either side of the
      /// separator is left about as many nodes.
      void
      cut(Indices       &set,
          const Indices &elements,
          Indices (&halves)[2],
          Indices &separator)
      {
        Point<2> low = points[set[0]], high = low;
        for (const unsigned int node : set)
          for (unsigned int d = 0; d < 2; ++d)
            {
              low[d]  = std::min(low[d], points[node][d]);
              high[d] = std::max(high[d], points[node][d]);
            }
        const unsigned int axis = high[0] - low[0] > high[1] - low[1] ? 0 : 1;
        std::sort(set.begin(),
                  set.end(),
                  [&](const unsigned int a, const unsigned int b) {
                    return points[a][axis] != points[b][axis]
                               ? points[a][axis] < points[b][axis]
                               : a < b;
                  });
        for (unsigned int pass = 0; pass < 2; ++pass)
          {
            const auto middle =
                set.begin() + (set.size() - separator.size()) / 2;
            halves[0].assign(set.begin(), middle);
            halves[1].assign(middle, set.end());
            for (unsigned int h = 0; h < 2; ++h)
              mark(halves[h], h);
            separator = separator_of(elements);
          }
        mark(separator, outside);
        halves[1].erase(std::remove_if(halves[1].begin(),
                                       halves[1].end(),
                                       [&](const unsigned int node) {
                                         return part[node] == outside;
                                       }),
                        halves[1].end());
        mark(set, outside);
      }

      const std::vector<Point<2>> &points;
      const ElementNodes          &nodes;
      Dissection                  &result;
      std::vector<char>            part;
      unsigned int                 n_ordered = 0;
    };


    Indices
    all_up_to(const unsigned int n)
    {
      Indices result(n);
      for (unsigned int k = 0; k < n; ++k)
        result[k] = k;
      return result;
    }
  } // namespace


  Dissection::Dissection(const std::vector<Point<2>> &points,
                         const ElementNodes          &nodes)
      : position(points.size())
  {
    Divider(points, nodes, *this)
        .divide(all_up_to(points.size()), all_up_to(nodes.n_elements()));

    Indices front_at(points.size());
    for (unsigned int f = 0; f < fronts.size(); ++f)
      for (unsigned int k = fronts[f].begin; k < fronts[f].end; ++k)
        front_at[k] = f;
    for (unsigned int e = 0; e < nodes.n_elements(); ++e)
      {
        unsigned int first = points.size();
        for (unsigned int k = nodes.start[e]; k < nodes.start[e + 1]; ++k)
          first = std::min(first, position[nodes.index[k]]);
        fronts[front_at[first]].elements.push_back(e);
      }

    Indices height(fronts.size(), 0);
    for (unsigned int f = 0; f < fronts.size(); ++f)
      {
        Front &front = fronts[f];
        for (const unsigned int e : front.elements)
          for (unsigned int k = nodes.start[e]; k < nodes.start[e + 1]; ++k)
            front.boundary.push_back(position[nodes.index[k]]);
        for (const unsigned int child : front.children)
          {
            front.boundary.insert(front.boundary.end(),
                                  fronts[child].boundary.begin(),
                                  fronts[child].boundary.end());
            height[f] = std::max(height[f], height[child] + 1);
          }
        std::sort(front.boundary.begin(), front.boundary.end());
        front.boundary.erase(front.boundary.begin(),
                             std::lower_bound(front.boundary.begin(),
                                              front.boundary.end(),
                                              front.end));
        front.boundary.erase(
            std::unique(front.boundary.begin(), front.boundary.end()),
            front.boundary.end());
        if (height[f] >= levels.size())
          levels.resize(height[f] + 1);
        levels[height[f]].push_back(f);
      }
  }


  double
  Dissection::n_entries() const
  {
    double sum = 0.;
    for (const Front &front : fronts)
      sum += 4. * front.n_own() * front.n_nodes();
    return sum;
  }
} // namespace Morsel
