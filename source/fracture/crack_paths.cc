#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/fracture/crack_paths.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Fracture
{
  using namespace dealii;

  namespace
  {
    /// Refuses points outside the frame, a crack of no length and one along
    /// the boundary.
    void
    check_path(const CrackedFrame          &frame,
               const std::vector<Point<2>> &path,
               const std::string           &entry)
    {
      const double tolerance = 1e-9 * frame.size();
      if (path.size() < 2)
        throw InputError("'" + entry +
                         "' has a crack of one point; it needs at least two, "
                         "as in 'x, y > x, y'.");
      for (unsigned int i = 0; i < path.size(); ++i)
        {
          const bool   end   = i == 0 || i + 1 == path.size();
          const double depth = frame.depth_inside(path[i]);
          if (depth < -tolerance)
            throw InputError("The crack's point " + point_text(path[i]) +
                             " lies outside the " + frame.name +
                             ", which reaches from " + point_text(frame.lower) +
                             " to " + point_text(frame.upper) +
                             "; a crack may end on the boundary at most.");
          if (!end && depth < tolerance)
            throw InputError("The crack's point " + point_text(path[i]) +
                             " lies on the boundary of the " + frame.name +
                             "; only a crack's ends may lie there.");
          if (i > 0 && path[i].distance(path[i - 1]) <= tolerance)
            throw InputError("The crack from " + point_text(path[i - 1]) +
                             " to " + point_text(path[i]) +
                             " has no length; give two different points.");
        }
      // Interior vertices lie inside: only a straight crack can do this.
      if (path.size() == 2 &&
          frame.depth_inside(path[0] + 0.5 * (path[1] - path[0])) <= tolerance)
        throw InputError("The crack from " + point_text(path[0]) + " to " +
                         point_text(path[1]) +
                         " runs along the boundary of the " + frame.name +
                         "; a crack must run inside.");
    }
  } // namespace


  std::string
  point_text(const Point<2> &p)
  {
    return "(" + number_text(p[0]) + ", " + number_text(p[1]) + ") m";
  }


  double
  CrackedFrame::depth_inside(const Point<2> &p) const
  {
    if (depth)
      return depth(p);
    return std::min(
        {p[0] - lower[0], upper[0] - p[0], p[1] - lower[1], upper[1] - p[1]});
  }


  Point<2>
  read_pair(const std::string &pair, const std::string &entry)
  {
    const auto parts = Utilities::split_string_list(pair, ',');
    try
      {
        if (parts.size() == 2)
          {
            const Point<2> p(Utilities::string_to_double(parts[0]),
                             Utilities::string_to_double(parts[1]));
            if (std::isfinite(p[0]) && std::isfinite(p[1]))
              return p;
          }
      }
    catch (const dealii::ExceptionBase &)
      {
        // The sentence below serves for this mistake, too.
      }
    throw InputError("'" + entry + "' has '" + trimmed(pair) +
                     "' where two finite numbers 'x, y' are needed.");
  }


  std::vector<std::vector<Point<2>>>
  read_crack_paths(const std::string &text, const std::string &entry)
  {
    std::vector<std::vector<Point<2>>> paths;
    for (const std::string &path : Utilities::split_string_list(text, ';'))
      {
        if (path.empty())
          continue;
        paths.emplace_back();
        for (const std::string &point : Utilities::split_string_list(path, '>'))
          paths.back().push_back(read_pair(point, entry));
      }
    return paths;
  }


  std::vector<Crack>
  cracks_in(const CrackedFrame                       &frame,
            const std::vector<std::vector<Point<2>>> &paths,
            const std::string                        &entry)
  {
    const double       tolerance = 1e-9 * frame.size();
    std::vector<Crack> cracks;
    for (const std::vector<Point<2>> &path : paths)
      {
        check_path(frame, path, entry);
        const Crack crack(path,
                          frame.depth_inside(path.front()) > tolerance,
                          frame.depth_inside(path.back()) > tolerance);
        for (unsigned int c = 0; c < cracks.size(); ++c)
          if (cracks[c].distance(crack) <= tolerance)
            throw InputError("'" + entry + "': cracks " + std::to_string(c) +
                             " and " + std::to_string(cracks.size()) +
                             " touch or cross each other; they must stay "
                             "apart.");
        cracks.push_back(crack);
      }
    for (Crack &crack : cracks)
      crack = crack.with_extended_mouths(frame.mouth_overhang());
    return cracks;
  }
} // namespace Morsel::Fracture
