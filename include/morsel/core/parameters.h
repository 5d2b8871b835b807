#ifndef morsel_core_parameters_h
#define morsel_core_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Morsel
{
  /// One "set key = value" of a user, with the place where it stands.
  struct ParameterEntry
  {
    std::string section; ///< "Body food/Material", empty at the top
    std::string key;     ///< "Density"
    std::string value;
    std::string where; ///< "peanut.prm:12" or "--set"

    /// "Body food/Material/Density".
    std::string
    path() const;
  };


  /// One parameter that the program knows.
  struct DeclaredParameter
  {
    std::string section;
    std::string key;
    std::string default_value;
    std::string value;
    std::string documentation;
    std::string pattern; ///< deal.II's machine-readable description

    std::string
    path() const;
  };


  /// Reads the entries of a parameter file in deal.II's syntax (set,
  /// subsection, end, include, # comments, continuation by a backslash),
  /// in the order in which they hold. deal.II's own reader is not used since it
  /// takes included files relative to the working folder, not to the
  /// file that includes them, and cannot tell which section or which similar
  /// entry is concerned by a mistake.
  /// @throw InputError if a file is missing or a line is not understood.
  /// @throw FileError if a file is there but cannot be read.
  std::vector<ParameterEntry>
  read_parameter_file(const std::string &file_name);


  /// Reads "Section/Sub/Key=value" of the command line.
  /// @throw InputError if it has another form.
  ParameterEntry
  read_override(const std::string &text);


  /// The value of the last entry with this path, or the default.
  std::string
  last_value(const std::vector<ParameterEntry> &entries,
             const std::string                 &path,
             const std::string                 &default_value);


  /// Where the last entry with this path stands, or an empty string.
  std::string
  last_place(const std::vector<ParameterEntry> &entries,
             const std::string                 &path);


  /// All that is declared, in the order of declaration.
  std::vector<DeclaredParameter>
  declared_parameters(const dealii::ParameterHandler &prm);


  /// Sets the entries, and with them the members that were bound by
  /// add_parameter().
  /// @throw InputError if an entry is unknown or its value is not allowed.
  void
  set_parameters(dealii::ParameterHandler          &prm,
                 const std::vector<ParameterEntry> &entries);


  /// What a pattern allows, in words: "a number from 0 to 1".
  std::string
  allowed_values(const std::string &pattern);


  /// The first unit in brackets of a documentation text, or an empty string.
  std::string
  unit_of(const std::string &documentation);


  /// All parameters as a text that read_parameter_file() takes back; with or
  /// without documentation.
  std::string
  parameters_as_prm(const dealii::ParameterHandler &prm, bool documented);

  /// All parameters as a list of JSON objects.
  std::string
  parameters_as_json(const dealii::ParameterHandler &prm);

  /// All parameters as tables in Markdown, one a section.
  std::string
  parameters_as_markdown(const dealii::ParameterHandler &prm);


  /// A hash of a text (64 bits, FNV-1a) in hexadecimal digits: the same on
  /// every machine.
  std::string
  text_hash(const std::string &text);
} // namespace Morsel

#endif
