#include <morsel/core/errors.h>
#include <morsel/core/parameters.h>
#include <morsel/core/sentences.h>
#include <morsel/core/suggestions.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace Morsel
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Reads one file and what it includes; keeps the sections that are open
    /// and the files that are being read.
    class FileReader
    {
    public:
      void
      read(const std::string &file_name, const std::string &asked_by);

      std::vector<ParameterEntry> entries;

    private:
      void
      read_line(const std::string &line, const std::string &where);

      void
      read_assignment(const std::string &rest, const std::string &where);

      std::string
      section() const;

      std::vector<std::string> open_sections;
      std::vector<std::string> open_files;
    };


    /// Takes the first word off a text; returns it.
    std::string
    take_word(std::string &text)
    {
      const std::size_t end  = text.find_first_of(" \t");
      const std::string word = text.substr(0, end);
      text = end == std::string::npos ? "" : trimmed(text.substr(end));
      return word;
    }


    /// With which some editors begin a text in UTF-8.
    const std::string byte_order_mark = "\xEF\xBB\xBF";


    /// Takes the comment and white space off a line, and checks that the rest
    /// is text: results and reports are in UTF-8 and take names and titles as
    /// they are.
    std::string
    checked_line(std::string line, const std::string &where)
    {
      if (!line.empty() && line.back() == '\r')
        line.pop_back();
      // All of an old Macintosh's text would be one comment.
      if (line.find('\r') != std::string::npos)
        throw InputError(where + ": A carriage return (CR) stands within the "
                                 "line; save the file with line ends LF or "
                                 "CRLF.");
      line = trimmed(line.substr(0, line.find('#')));
      if (find_strange_byte(line) != std::string::npos)
        throw InputError(where + ": The line has a byte that is no letter of a "
                                 "text in UTF-8; save the file as such "
                                 "(UTF-16 and Latin-1 are not read).");
      return line;
    }


    /// White space between words counts as one blank, as in deal.II.
    std::string
    single_blanks(const std::string &text)
    {
      std::string result;
      for (const char c : trimmed(text))
        if (c != ' ' && c != '\t')
          result += c;
        else if (result.back() != ' ')
          result += ' ';
      return result;
    }


    void
    FileReader::read(const std::string &file_name, const std::string &asked_by)
    {
      const std::string prefix = asked_by.empty() ? "" : asked_by + ": ";
      std::error_code   error;
      if (!fs::exists(file_name, error))
        throw InputError(prefix + "There is no file '" + file_name + "'." +
                         did_you_mean(file_name, files_beside(file_name)));
      if (fs::is_directory(file_name, error))
        throw InputError(prefix + "'" + file_name +
                         "' is a folder; give a scene file (*.prm).");
      // A device or a pipe may have no end.
      if (!fs::is_regular_file(file_name, error))
        throw InputError(prefix + "'" + file_name +
                         "' is no ordinary file; give a scene file (*.prm).");
      if (std::any_of(open_files.begin(),
                      open_files.end(),
                      [&](const std::string &open_file) {
                        return fs::equivalent(file_name, open_file, error);
                      }))
        throw InputError(prefix + "The file '" + file_name +
                         "' includes itself.");
      std::ifstream file(file_name);
      if (!file)
        throw FileError(prefix + "The file '" + file_name +
                        "' cannot be opened for reading; check its "
                        "permissions.");

      open_files.push_back(file_name);
      const std::size_t depth       = open_sections.size();
      unsigned int      line_number = 0;
      std::string       where       = file_name, whole_line;
      for (std::string line; std::getline(file, line);)
        {
          ++line_number;
          if (whole_line.empty())
            where = file_name + ":" + std::to_string(line_number);
          if (line_number == 1 && line.rfind(byte_order_mark, 0) == 0)
            line.erase(0, byte_order_mark.size());
          line               = checked_line(line, where);
          const bool goes_on = !line.empty() && line.back() == '\\';
          if (goes_on)
            line.pop_back();
          whole_line += line;
          if (goes_on)
            continue;
          if (!whole_line.empty())
            read_line(whole_line, where);
          whole_line.clear();
          if (open_sections.size() < depth)
            throw InputError(where + ": This 'end' closes no subsection of "
                                     "its file.");
        }
      if (file.bad())
        throw FileError(prefix + "Reading the file '" + file_name +
                        "' failed.");
      if (open_sections.size() > depth)
        throw InputError(where + ": The file ends inside of subsection '" +
                         section() + "': an 'end' is missing.");
      open_files.pop_back();
    }


    void
    FileReader::read_line(const std::string &line, const std::string &where)
    {
      std::string       rest = line;
      const std::string word = take_word(rest);
      if (word == "set" || word == "SET")
        read_assignment(rest, where);
      else if (word == "subsection" || word == "SUBSECTION")
        {
          if (rest.empty())
            throw InputError(where + ": A subsection needs a name.");
          open_sections.push_back(single_blanks(rest));
        }
      else if (word == "end" || word == "END")
        {
          if (!rest.empty())
            throw InputError(where + ": Nothing may follow 'end', but '" +
                             rest + "' does.");
          if (open_sections.empty())
            throw InputError(where + ": This 'end' closes no subsection.");
          open_sections.pop_back();
        }
      else if (word == "include" || word == "INCLUDE")
        {
          const fs::path folder = fs::path(open_files.back()).parent_path();
          read((folder / rest).string(), where);
        }
      else
        throw InputError(
            where + ": The line '" + line +
            "' is not understood: give 'set <entry> = <value>', "
            "'subsection <name>', 'end' or 'include <file>'." +
            did_you_mean(word, {"set", "subsection", "end", "include"}));
    }


    void
    FileReader::read_assignment(const std::string &rest,
                                const std::string &where)
    {
      const std::size_t equals = rest.find('=');
      if (equals == std::string::npos || equals == 0)
        throw InputError(where + ": The line 'set " + rest +
                         "' is not understood: give 'set <entry> = <value>'.");
      entries.push_back({section(),
                         single_blanks(rest.substr(0, equals)),
                         trimmed(rest.substr(equals + 1)),
                         where});
    }


    std::string
    FileReader::section() const
    {
      std::string path;
      for (const std::string &name : open_sections)
        path += (path.empty() ? "" : "/") + name;
      return path;
    }
  } // namespace


  std::vector<ParameterEntry>
  read_parameter_file(const std::string &file_name)
  {
    FileReader reader;
    reader.read(file_name, "");
    return reader.entries;
  }


  ParameterEntry
  read_override(const std::string &text)
  {
    const std::string where = "--set \"" + text + "\"";
    if (find_strange_byte(text) != std::string::npos)
      throw InputError(where + ": This is no text in UTF-8.");
    const std::size_t equals = text.find('=');
    const std::string path   = trimmed(text.substr(0, equals));
    if (equals == std::string::npos || path.empty())
      throw InputError(where + ": Give '--set \"Section/Sub/Key=value\"'.");

    const std::size_t slash = path.rfind('/');
    ParameterEntry    entry;
    entry.where = where;
    entry.value = trimmed(text.substr(equals + 1));
    entry.key   = single_blanks(
        slash == std::string::npos ? path : path.substr(slash + 1));
    if (slash != std::string::npos)
      entry.section = single_blanks(path.substr(0, slash));
    if (entry.key.empty())
      throw InputError(where + ": Give '--set \"Section/Sub/Key=value\"'.");
    return entry;
  }
} // namespace Morsel
