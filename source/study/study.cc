#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/study/check.h>
#include <morsel/study/declare.h>
#include <morsel/study/study.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace Morsel::Study
{
  namespace fs = std::filesystem;

  namespace
  {
    /// The names X of all sections "<kind> X", in order of appearance.
    std::vector<std::string>
    section_names(const std::vector<ParameterEntry> &entries,
                  const std::string                 &kind)
    {
      std::vector<std::string> names;
      for (const ParameterEntry &entry : entries)
        if (entry.section.rfind(kind + " ", 0) == 0)
          {
            const std::string name = entry.section.substr(
                kind.size() + 1, entry.section.find('/') - kind.size() - 1);
            if (std::find(names.begin(), names.end(), name) == names.end())
              names.push_back(name);
          }
      return names;
    }

    /// The base scene of a series as a path from the working folder.
    std::string
    base_scene_path(const Study &study, const Series &series)
    {
      const bool        own  = !series.base_scene.empty();
      const std::string path = own ? series.base_scene : study.base_scene;
      const std::string entry =
          own ? "Series " + series.name + "/Base scene" : "Study/Base scene";
      if (path.empty())
        throw InputError(study.place_of("Study/Base scene") +
                         " is missing: name the scene that the runs start "
                         "from.");
      const fs::path full =
          (fs::path(study.file).parent_path() / path).lexically_normal();
      std::error_code error;
      if (!fs::is_regular_file(full, error))
        throw InputError(
            study.place_of(entry) + " = '" + path + "': There is no file '" +
            full.string() + "'." +
            did_you_mean(full.string(), files_beside(full.string())));
      return full.string();
    }

    void
    make_quick(Study &study)
    {
      for (Axis &axis : study.axes)
        {
          if (!axis.quick_values.empty())
            axis.values = axis.quick_values;
          if (axis.quick_count > 0)
            axis.count = axis.quick_count;
        }
      for (Series &series : study.series)
        if (!series.quick_entries.empty())
          series.entries = series.entries.empty()
                               ? series.quick_entries
                               : series.entries + "; " + series.quick_entries;
    }

    struct StudyReading
    {
      Study                    study;
      dealii::ParameterHandler prm;
    };

    /// So that used.prm means the same wherever it lies.
    void
    name_base_scenes_absolutely(StudyReading &reading)
    {
      const fs::path folder = fs::path(reading.study.file).parent_path();
      for (const DeclaredParameter &parameter :
           declared_parameters(reading.prm))
        if (parameter.key == "Base scene" && !parameter.value.empty())
          {
            reading.prm.enter_subsection(parameter.section);
            reading.prm.set(
                parameter.key,
                fs::absolute(folder / parameter.value).lexically_normal());
            reading.prm.leave_subsection();
          }
    }

    void
    read(StudyReading                   &reading,
         const std::string              &file_name,
         const std::vector<std::string> &overrides)
    {
      Study &study  = reading.study;
      study.file    = file_name;
      study.entries = read_parameter_file(file_name);
      for (const std::string &text : overrides)
        study.entries.push_back(read_override(text));

      for (const std::string &name : section_names(study.entries, "Axis"))
        study.axes.emplace_back().name = name;
      for (const std::string &name : section_names(study.entries, "Series"))
        study.series.emplace_back().name = name;
      for (const std::string &name : section_names(study.entries, "Relation"))
        study.relations.emplace_back().name = name;
      for (const std::string &name : section_names(study.entries, "Claim"))
        study.claims.emplace_back().name = name;
      for (const std::string &name : section_names(study.entries, "Figure"))
        study.figures.emplace_back().name = name;
      for (const std::string &name :
           section_names(study.entries, "Sensitivity"))
        study.sensitivities.emplace_back().name = name;
      std::vector<std::string> names =
          list_items(last_value(study.entries, "Study/Quantities", ""));
      for (const std::string &name : section_names(study.entries, "Quantity"))
        if (std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
      for (const std::string &name : names)
        study.quantities.emplace_back().name = name;
      declare(study, reading.prm);
      set_parameters(reading.prm, study.entries);
    }
  } // namespace


  const Axis *
  Study::find_axis(const std::string &axis_name) const
  {
    const auto axis = std::find_if(
        axes.begin(), axes.end(), [&](auto &a) { return a.name == axis_name; });
    return axis == axes.end() ? nullptr : &*axis;
  }

  std::optional<unsigned int>
  Study::find_quantity(const std::string &quantity_name) const
  {
    for (unsigned int q = 0; q < quantities.size(); ++q)
      if (quantities[q].name == quantity_name)
        return q;
    return std::nullopt;
  }


  std::optional<unsigned int>
  Study::find_series(const std::string &series_name) const
  {
    for (unsigned int s = 0; s < series.size(); ++s)
      if (series[s].name == series_name)
        return s;
    return std::nullopt;
  }


  std::string
  Study::place_of(const std::string &path) const
  {
    const std::string place = last_place(entries, path);
    return (place.empty() ? file : place) + ": '" + path + "'";
  }

  bool
  has_section(const std::string &file_name, const std::string &section)
  {
    if (file_name.empty())
      return false;
    const std::vector<ParameterEntry> entries = read_parameter_file(file_name);
    return std::any_of(entries.begin(), entries.end(), [&](const auto &entry) {
      return entry.section == section;
    });
  }


  bool
  is_study(const std::string &file_name)
  {
    return has_section(file_name, "Study");
  }


  Study
  read_study(const std::string              &file_name,
             const std::vector<std::string> &overrides)
  {
    StudyReading reading;
    read(reading, file_name, overrides);
    Study study = reading.study;
    if (study.axes.empty() && study.series.empty() &&
        study.sensitivities.empty())
      throw InputError(file_name +
                       ": The study varies nothing; give it a section 'Axis "
                       "<name>' with 'Values' and 'Entries', or sections "
                       "'Series <name>' or 'Sensitivity <name>'.");
    if (study.name.empty())
      study.name = fs::path(file_name).stem().string();
    if (study.series.empty())
      study.series.emplace_back().name = "all";
    check(study);
    if (study.quick)
      make_quick(study);
    for (Series &series : study.series)
      {
        series.base_scene = base_scene_path(study, series);
        if (series.title.empty())
          series.title = series.name;
      }
    for (Axis &axis : study.axes)
      if (axis.label.empty())
        axis.label = axis.name;
    for (Quantity &quantity : study.quantities)
      {
        if (quantity.expression.empty())
          quantity.expression = quantity.name;
        if (quantity.label.empty())
          quantity.label = quantity.name;
      }
    for (Relation &relation : study.relations)
      if (relation.label.empty())
        relation.label = relation.name;
    for (Sensitivity &sensitivity : study.sensitivities)
      if (sensitivity.label.empty())
        sensitivity.label = sensitivity.name;
    name_base_scenes_absolutely(reading);
    study.used_parameters = parameters_as_prm(reading.prm, false);
    return study;
  }

  std::string
  study_parameters(const std::string              &format,
                   const std::string              &file_name,
                   const std::vector<std::string> &overrides)
  {
    StudyReading reading;
    read(reading, file_name, overrides);
    if (reading.study.name.empty())
      reading.prm.set("Name", fs::path(file_name).stem().string());
    if (format == "json")
      return parameters_as_json(reading.prm);
    return format == "md" ? parameters_as_markdown(reading.prm)
                          : parameters_as_prm(reading.prm, true);
  }

  std::vector<std::string>
  list_items(const std::string &text)
  {
    const char separator = text.find(';') != std::string::npos ? ';' : ',';
    std::vector<std::string> items;
    std::istringstream       stream(text);
    for (std::string item; std::getline(stream, item, separator);)
      items.push_back(trimmed(item));
    // "a, b," and "0, 1000;" end with a separator, not with an empty item.
    if (!items.empty() && items.back().empty())
      items.pop_back();
    return items;
  }
} // namespace Morsel::Study
