#include <morsel/core/atomic_file.h>
#include <morsel/core/errors.h>
#include <morsel/output/history.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace Morsel::Output
{
  namespace
  {
    /// Twelve digits: beyond what a measurement means, and rows stay short.
    constexpr int digits = 12;


    std::string
    header(const std::vector<std::string> &columns)
    {
      std::string line;
      for (const auto &column : columns)
        {
          Assert(column.find(',') == std::string::npos,
                 dealii::ExcMessage("A column's name holds a comma."));
          line += (line.empty() ? "" : ",") + column;
        }
      return line + "\n";
    }


    std::string
    row(const std::string              &file_name,
        const std::vector<std::string> &columns,
        const std::vector<double>      &values)
    {
      AssertDimension(values.size(), columns.size());
      std::ostringstream line;
      line.precision(digits);
      for (std::size_t c = 0; c < values.size(); ++c)
        {
          if (!std::isfinite(values[c]))
            throw NumericalError("The quantity '" + columns[c] + "' of '" +
                                 file_name + "' is not a finite number.");
          line << (c == 0 ? "" : ",") << values[c];
        }
      line << '\n';
      return line.str();
    }
  } // namespace


  History::History(const std::string              &file_name,
                   const std::vector<std::string> &columns)
      : file_name(file_name)
      , columns(columns)
      , stream(file_name, std::ios::trunc)
  {
    stream << header(columns) << std::flush;
    if (!stream)
      throw FileError("Cannot write '" + file_name +
                      "': " + std::strerror(errno) + ".");
  }


  void
  History::add_row(const std::vector<double> &values)
  {
    const std::string line = row(file_name, columns, values);
    // A file that somebody removed would take rows without a word.
    if (!std::filesystem::exists(file_name))
      throw FileError("Cannot write to '" + file_name + "': it has vanished.");
    stream << line << std::flush;
    if (!stream)
      {
        const std::string reason = std::strerror(errno);
        // What there is remains a table of complete rows.
        stream.close();
        std::error_code ignored;
        std::filesystem::resize_file(
            file_name, header(columns).size() + content.size(), ignored);
        throw FileError("Cannot write to '" + file_name + "': " + reason + ".");
      }
    content += line;
    ++row_count;
  }


  void
  History::restore(const std::string &rows)
  {
    content   = rows;
    row_count = std::count(rows.begin(), rows.end(), '\n');
    stream.close();
    write_atomically(file_name, header(columns) + content);
    stream.open(file_name, std::ios::app);
    if (!stream)
      throw FileError("Cannot write to '" + file_name +
                      "': " + std::strerror(errno) + ".");
  }


  unsigned int
  History::n_rows() const
  {
    return row_count;
  }


  void
  write_table(const std::string                      &file_name,
              const std::vector<std::string>         &columns,
              const std::vector<std::vector<double>> &rows)
  {
    std::string content = header(columns);
    for (const auto &values : rows)
      content += row(file_name, columns, values);
    write_atomically(file_name, content);
  }
} // namespace Morsel::Output
