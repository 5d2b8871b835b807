#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/scene/lists.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <set>

namespace Morsel::Scene
{
  namespace
  {
    /// The names of one list. A section of something that is not listed is
    /// most likely a misspelt name.
    /// @param thing "body": its sections are "Body <name>".
    std::vector<std::string>
    list_names(const std::vector<ParameterEntry> &entries,
               const std::string                 &list_name,
               const std::string                 &thing)
    {
      const std::string list   = last_value(entries, list_name, "");
      const std::string place  = last_place(entries, list_name);
      std::string       prefix = thing + " ";
      prefix[0]                = static_cast<char>(std::toupper(prefix[0]));

      std::vector<std::string> result;
      std::set<std::string>    names;
      for (const std::string &name :
           dealii::Utilities::split_string_list(list, ','))
        {
          if (name.empty() || name.find_first_of(":/\"") != std::string::npos)
            throw InputError(place + ": '" + list_name + "' = '" + list +
                             "' is not allowed: a " + thing +
                             "'s name is not empty and has no ':', '/' or "
                             "'\"'.");
          if (!names.insert(name).second)
            throw InputError(place + ": '" + list_name + "' names '" + name +
                             "' twice.");
          result.push_back(name);
        }

      for (const ParameterEntry &entry : entries)
        {
          const std::string section =
              entry.section.substr(0, entry.section.find('/'));
          if (section.rfind(prefix, 0) == 0 &&
              names.count(section.substr(prefix.size())) == 0)
            throw InputError(
                entry.where + ": The section '" + section + "' is of a " +
                thing + " that is not in '" + list_name + "' (" + list + ")." +
                did_you_mean(section.substr(prefix.size()), result));
        }
      return result;
    }
  } // namespace


  NamedParts
  list_parts(const std::string                 &file_name,
             const std::vector<ParameterEntry> &entries)
  {
    const std::string place = last_place(entries, "Bodies");
    if (last_value(entries, "Bodies", "").empty())
      throw InputError((place.empty() ? file_name : place) +
                       ": The scene has no bodies; name them, as in 'set "
                       "Bodies = food, lower plate, upper plate'.");
    NamedParts parts;
    for (const std::string &name : list_names(entries, "Bodies", "body"))
      {
        const std::string path = "Body " + name + "/Kind";
        const std::string kind = last_value(entries, path, "particles");
        const std::vector<std::string> kinds = {
            "particles", "rigid", "elastic"};
        if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
          throw InputError(last_place(entries, path) + ": '" + path + "' = '" +
                           kind + "' is not allowed: give one of " +
                           quoted_list(kinds) + "." +
                           did_you_mean(kind, kinds));
        parts.bodies.push_back({name, kind});
      }
    parts.conditions = list_names(entries, "Conditions", "condition");
    parts.observers  = list_names(entries, "Observers", "observer");
    parts.muscles    = list_names(entries, "Muscles", "muscle");
    return parts;
  }
} // namespace Morsel::Scene
