#include <morsel/contact/traction.h>

#include <algorithm>

namespace Morsel::Contact
{
  namespace
  {
    /// Share of the peak pressure below which there is no contact.
    constexpr double pressed_share = 0.01;


    /// Neighbours along the loops and the ways to the next ones.
    struct Chain
    {
      std::vector<unsigned int> next, previous;
      std::vector<double>       length; ///< of the facet that begins there [m]
    };


    Chain
    chain_of(const Surface &surface)
    {
      const unsigned int n = surface.nodes.size();
      Chain              chain{std::vector<unsigned int>(n),
                  std::vector<unsigned int>(n),
                  std::vector<double>(n)};
      for (const auto &[first, second] : surface.facets)
        {
          chain.next[first]      = second;
          chain.previous[second] = first;
          chain.length[first] =
              surface.nodes[first].distance(surface.nodes[second]);
        }
      return chain;
    }


    void
    find_arcs(const Chain &chain, std::vector<double> &arc)
    {
      std::vector<char> known(arc.size(), 0);
      for (unsigned int begin = 0; begin < arc.size(); ++begin)
        {
          double way = 0.;
          for (unsigned int k = begin; known[k] == 0; k = chain.next[k])
            {
              known[k] = 1;
              arc[k]   = way;
              way += chain.length[k];
            }
        }
    }


    /// Nodes within a way along the loop and their hat functions; ends before
    /// the loop meets itself.
    std::vector<std::pair<unsigned int, double>>
    nodes_about(const Chain &chain, const unsigned int node, const double width)
    {
      std::vector<std::pair<unsigned int, double>> list = {{node, 1.}};
      double                                       way  = chain.length[node];
      unsigned int                                 k    = chain.next[node];
      for (; way < width && k != node;
           way += chain.length[k], k = chain.next[k])
        list.emplace_back(k, 1. - way / width);
      if (k == node)
        return list;
      const unsigned int end = k;
      way                    = 0.;
      for (k = node; k != end;)
        {
          k = chain.previous[k];
          way += chain.length[k];
          if (way >= width || k == end)
            break;
          list.emplace_back(k, 1. - way / width);
        }
      return list;
    }
  } // namespace


  Traction
  traction_of(const Surface &surface, const double width, const double depth)
  {
    const unsigned int n = surface.nodes.size();
    Traction           t;
    t.arc.resize(n);
    t.normal.resize(n);
    t.vector.resize(n);
    const Chain chain = chain_of(surface);
    find_arcs(chain, t.arc);
    for (const auto &[first, second] : surface.facets)
      {
        const auto along = surface.nodes[second] - surface.nodes[first];
        const dealii::Tensor<1, 2> outward({along[1], -along[0]});
        t.normal[first] += outward;
        t.normal[second] += outward;
      }
    for (unsigned int k = 0; k < n; ++k)
      {
        t.normal[k] /= t.normal[k].norm();
        if (surface.force[k].norm_square() == 0.)
          continue;
        const auto about = nodes_about(chain, k, width);
        double     area  = 0.;
        for (const auto &[node, weight] : about)
          area += weight * surface.tributary[node] * depth;
        for (const auto &[node, weight] : about)
          t.vector[node] += weight / area * surface.force[k];
      }
    return t;
  }


  Load
  load_on(const Surface &surface, const Traction &traction)
  {
    const unsigned int n = surface.nodes.size();
    Load               load;
    double             weights = 0.;
    dealii::Point<2>   sum, middle;
    for (unsigned int k = 0; k < n; ++k)
      {
        const double size = surface.force[k].norm();
        load.force += surface.force[k];
        sum += size * surface.nodes[k];
        middle += surface.nodes[k] / n;
        weights += size;
        load.peak_pressure = std::max(load.peak_pressure, traction.pressure(k));
      }
    load.centre = weights > 0. ? dealii::Point<2>(sum / weights) : middle;
    for (unsigned int k = 0; k < n; ++k)
      if (load.peak_pressure > 0. &&
          traction.pressure(k) > pressed_share * load.peak_pressure)
        load.contact_length += surface.tributary[k];
    return load;
  }
} // namespace Morsel::Contact
