#include "mutate_values.h"
#include "mutations.h"

#include <algorithm>
#include <utility>

namespace Fuzz
{
  namespace
  {
    using Lines = std::vector<std::string>;

    /// A scene while it is changed.
    struct Draft
    {
      Lines                        lines;
      const Gallery               &gallery;
      const std::set<std::string> &known_keys;
      bool                         unknown_name = false;
    };


    std::string
    shortened(const std::string &text)
    {
      return text.size() <= 60 ? text
                               : text.substr(0, 60) + "... (" +
                                     std::to_string(text.size()) + " bytes)";
    }


    bool
    opens(const std::string &line)
    {
      const std::size_t begin = line.find_first_not_of(" \t");
      return begin != std::string::npos &&
             line.compare(begin, 11, "subsection ") == 0;
    }


    bool
    closes(const std::string &line)
    {
      const std::size_t begin = line.find_first_not_of(" \t");
      return begin != std::string::npos && line.substr(begin) == "end";
    }


    /// Numbers of the lines for which a condition holds.
    template <typename Condition>
    std::vector<std::size_t>
    lines_where(const Lines &lines, const Condition &condition)
    {
      std::vector<std::size_t> result;
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (condition(lines[i]))
          result.push_back(i);
      return result;
    }


    /// One past the last line of the subsection that begins at a line.
    std::size_t
    end_of_section(const Lines &lines, const std::size_t begin)
    {
      std::size_t depth = 0;
      for (std::size_t i = begin; i < lines.size(); ++i)
        if (opens(lines[i]))
          ++depth;
        else if (closes(lines[i]) && --depth == 0)
          return i + 1;
      return lines.size();
    }


    /// A name with one letter wrong, or something else altogether.
    std::string
    misspelt(std::string name, Random &random)
    {
      if (name.empty())
        return "x";
      const std::size_t i = random.below(name.size());
      switch (random.below(8))
        {
          case 0:
            name.erase(i, 1);
            break;
          case 1:
            name.insert(i, 1, name[i]);
            break;
          case 2:
            name[i] = static_cast<char>('a' + random.below(26));
            break;
          case 3:
            std::swap(name[i], name[random.below(name.size())]);
            break;
          case 4:
            name[i] = static_cast<char>(128 + random.below(128));
            break;
          case 5:
            name.insert(i, "/");
            break;
          case 6:
            name = std::string(1 + random.below(5000), 'k');
            break;
          default:
            name += " zq";
        }
      return name;
    }


    /// White space between words counts as one blank.
    std::string
    single_blanks(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        if (c != ' ' && c != '\t')
          result += c;
        else if (!result.empty() && result.back() != ' ')
          result += ' ';
      while (!result.empty() && result.back() == ' ')
        result.pop_back();
      return result;
    }


    std::string
    change_value(Draft &draft, Random &random)
    {
      const auto entries = lines_where(
          draft.lines, [](const auto &line) { return !key_of(line).empty(); });
      if (entries.empty())
        return "";
      std::string      &line   = draft.lines[random.pick(entries)];
      const std::size_t equals = line.find('=');
      const std::string key    = key_of(line);
      std::size_t       begin  = line.find_first_not_of(" \t", equals + 1);
      begin                    = std::min(begin, line.size());
      const std::string value  = random.chance(15)
                                     ? random.pick(draft.gallery.values)
                                     : mutate_value(line.substr(begin), random);
      line                     = line.substr(0, equals + 1) + " " + value;
      return "value: " + key + " = " + shortened(value);
    }


    std::string
    change_key(Draft &draft, Random &random)
    {
      const auto entries = lines_where(
          draft.lines, [](const auto &line) { return !key_of(line).empty(); });
      if (entries.empty())
        return "";
      std::string      &line = draft.lines[random.pick(entries)];
      const std::string old  = key_of(line);
      const std::string key  = misspelt(old, random);
      line = line.substr(0, line.find("set ")) + "set " + key + " " +
             line.substr(line.find('='));
      draft.unknown_name = draft.known_keys.count(single_blanks(key)) == 0;
      return "key: '" + old + "' becomes '" + shortened(key) + "'";
    }


    std::string
    change_section_name(Draft &draft, Random &random)
    {
      const auto sections = lines_where(draft.lines, opens);
      if (sections.empty())
        return "";
      std::string      &line  = draft.lines[random.pick(sections)];
      const std::size_t begin = line.find("subsection ") + 11;
      const std::string old   = line.substr(begin);
      const std::string name  = misspelt(old, random);
      line                    = line.substr(0, begin) + name;
      return "section: '" + old + "' becomes '" + shortened(name) + "'";
    }


    std::string
    change_lines(Draft &draft, Random &random)
    {
      Lines &lines = draft.lines;
      if (lines.empty())
        return "";
      const std::size_t i = random.below(lines.size());
      switch (random.below(6))
        {
          case 0:
            lines.erase(lines.begin() + i);
            return "a line left out";
          case 1:
            lines.insert(lines.begin() + i, lines[i]);
            return "a line twice";
          case 2:
            std::swap(lines[i], lines[random.below(lines.size())]);
            return "two lines swapped";
          case 3:
            lines[i] += " \\";
            return "a line that goes on in the next";
          case 4:
            lines[i] = "# " + lines[i];
            return "a line commented out";
          default:
            lines.insert(lines.begin() + i, 2000, lines[i]);
            return "a line two thousand times";
        }
    }


    std::string
    change_section(Draft &draft, Random &random)
    {
      Lines     &lines    = draft.lines;
      const auto sections = lines_where(lines, opens);
      if (sections.empty())
        return "";
      const std::size_t begin = random.pick(sections);
      const std::size_t end   = end_of_section(lines, begin);
      const Lines       section(lines.begin() + begin, lines.begin() + end);
      switch (random.below(5))
        {
          case 0:
            lines.erase(lines.begin() + begin, lines.begin() + end);
            return "a section left out";
          case 1:
            lines.insert(lines.begin() + end, section.begin(), section.end());
            return "a section twice";
          case 2:
            lines.insert(
                lines.begin() + end - 1, section.begin(), section.end());
            return "a section inside of itself";
          case 3:
            lines.erase(lines.begin() + end - 1);
            return "a section left open";
          default:
            lines.erase(lines.begin() + begin, lines.begin() + end);
            lines.insert(lines.begin() + random.below(lines.size() + 1),
                         section.begin(),
                         section.end());
            return "a section elsewhere";
        }
    }


    /// Lines that do not belong there.
    std::string
    strange_line(Random &random)
    {
      static const std::vector<std::string> strange = {
          "end",
          "set",
          "set =",
          "set = 3",
          "set Title",
          "subsection",
          "subsection   ",
          "subsection x",
          "end of it",
          "include",
          "include .",
          "include ..",
          "include /",
          "include /dev/null",
          "include /dev/zero",
          "include /etc/passwd",
          "include no_such_file.prm",
          "include ../food/peanut.prm",
          "include ../studies/thesis/thesis.prm",
          "include ../../meshes/cusp.msh",
          "SET Title = x",
          "Set Title = x",
          "set Title = \\",
          "%s%n",
          "<xml/>",
          "{\"json\": 1}",
          "\\",
          "\\\\",
          "# nothing \\"};
      return random.chance(10) ? "subsection " + random.bytes(30)
                               : random.pick(strange);
    }


    std::string
    insert_lines(Draft &draft, Random &random)
    {
      Lines            &lines = draft.lines;
      const std::size_t i     = random.below(lines.size() + 1);
      const auto        at    = lines.begin() + i;
      switch (random.below(5))
        {
          case 0:
            {
              const std::string &block = random.pick(draft.gallery.blocks);
              lines.insert(at, block);
              return "from another scene: " + shortened(block);
            }
          case 1:
            lines.insert(at, 20000, "subsection x");
            return "twenty thousand sections opened";
          case 2:
            lines.insert(at, "include " + random.pick(draft.gallery.files));
            return *(lines.begin() + i);
          default:
            lines.insert(at, strange_line(random));
            return "line: " + shortened(lines[i]);
        }
    }


    std::string
    change_bytes(Draft &draft, Random &random)
    {
      std::string text;
      for (const std::string &line : draft.lines)
        text += line + "\n";
      const std::string what = mutate_bytes(text, random);
      draft.lines            = {text};
      return what;
    }


    using Change = std::string (*)(Draft &, Random &);

    /// What is changed how often [%].
    const std::vector<std::pair<unsigned int, Change>> changes = {
        {50, change_value},
        {12, change_key},
        {5, change_section_name},
        {5, change_lines},
        {6, change_section},
        {8, insert_lines},
        {14, change_bytes}};


    std::string
    change(Draft &draft, Random &random)
    {
      unsigned int choice = random.below(100);
      for (const auto &[share, apply] : changes)
        {
          if (choice < share)
            return apply(draft, random);
          choice -= share;
        }
      return "";
    }
  } // namespace


  Mutation
  mutate_scene(const std::string           &text,
               const Gallery               &gallery,
               const std::set<std::string> &known_keys,
               Random                      &random)
  {
    Draft              draft{split_lines(text), gallery, known_keys};
    const unsigned int choice = random.below(100);
    const unsigned int n      = choice < 75 ? 1 : choice < 92 ? 2 : 3;
    Mutation           mutation;
    for (unsigned int i = 0; i < n; ++i)
      mutation.what += (i > 0 ? "; " : "") + change(draft, random);
    // A later change may have taken the unknown name away again.
    mutation.unknown_name = n == 1 && draft.unknown_name;
    for (const std::string &line : draft.lines)
      mutation.text += line + "\n";
    return mutation;
  }
} // namespace Fuzz
