#include <morsel/core/atomic_file.h>
#include <morsel/core/errors.h>
#include <morsel/output/summary.h>

#include <deal.II/base/exceptions.h>

#include <cctype>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Morsel::Output
{
  namespace
  {
    void
    check_name(const std::string &name)
    {
      bool good = !name.empty() &&
                  std::islower(static_cast<unsigned char>(name.front())) != 0;
      for (const char c : name)
        good = good &&
               (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_');
      good = good && name != "effects" && name != "parts" && name != "text";
      AssertThrow(good,
                  dealii::ExcMessage("'" + name +
                                     "' is no name for a result: snake_case, "
                                     "beginning with a lower case letter."));
    }


    double
    finite(const std::string &name, const char *what, const double value)
    {
      if (!std::isfinite(value))
        throw NumericalError(std::string("The ") + what + " of the result '" +
                             name + "' is not a finite number.");
      return value;
    }
  } // namespace


  std::string
  effects_as_text(const std::vector<Effect> &effects)
  {
    std::ostringstream text;
    for (const Effect &effect : effects)
      text << (effect.on ? "  on   " : "  off  ") << std::left << std::setw(34)
           << effect.name << "  (" << effect.reason << ")\n";
    return text.str();
  }


  void
  Summary::add(const std::string          &name,
               const double                value,
               const std::string          &unit,
               const std::string          &meaning,
               const std::optional<double> reference,
               const std::optional<double> error)
  {
    check_name(name);
    nlohmann::ordered_json entry;
    entry["value"]   = finite(name, "value", value);
    entry["unit"]    = unit;
    entry["meaning"] = meaning;
    if (reference)
      entry["reference"] = finite(name, "reference", *reference);
    if (error)
      entry["error"] = finite(name, "error", *error);
    else if (reference && *reference != 0.)
      entry["error"] =
          finite(name, "error", (value - *reference) / std::abs(*reference));
    results[name] = std::move(entry);
  }


  void
  Summary::add_text(const std::string &name, const std::string &text)
  {
    check_name(name);
    texts[name] = text;
  }


  void
  Summary::add_effect(const Effect &effect)
  {
    effects.push_back(
        {{"name", effect.name},
         {"on", effect.on},
         {"reason", effect.reason},
         {"wall_time", finite(effect.name, "time", effect.wall_time)},
         {"share", finite(effect.name, "share", effect.share)}});
    if (effect.on && !effect.part.empty())
      effects.back()["part"] = effect.part;
    if (effect.on && !effect.without.empty())
      effects.back()["without"] = effect.without;
  }


  void
  Summary::add_part(const std::string &name, const double wall_time)
  {
    parts.push_back(
        {{"name", name}, {"wall_time", finite(name, "time", wall_time)}});
  }


  bool
  Summary::has(const std::string &name) const
  {
    return results.contains(name);
  }


  double
  Summary::value(const std::string &name) const
  {
    AssertThrow(has(name),
                dealii::ExcMessage("No result '" + name + "' was added."));
    return results.at(name).at("value").get<double>();
  }


  nlohmann::ordered_json
  Summary::json() const
  {
    nlohmann::ordered_json document = results;
    document["effects"]             = effects;
    document["parts"]               = parts;
    document["text"]                = texts;
    return document;
  }


  void
  Summary::write(const std::string &file_name) const
  {
    // Texts may come from files: what is not UTF-8 must not end the run.
    write_atomically(
        file_name,
        json().dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
            "\n");
  }
} // namespace Morsel::Output
