#ifndef morsel_output_history_h
#define morsel_output_history_h

#include <fstream>
#include <string>
#include <vector>

namespace Morsel::Output
{
  /// history.csv: one row per sample. Each row is flushed as soon as it is
  /// complete, so that a run that is killed keeps its rows.
  class History
  {
  public:
    /// Opens the file anew and writes the header.
    ///
    /// @param columns names with units, such as "time [s]"; no commas.
    /// @throws FileError with the file's name.
    History(const std::string              &file_name,
            const std::vector<std::string> &columns);

    /// Appends one row.
    ///
    /// @param values as many as there are columns, in the columns' units.
    /// @throws NumericalError naming the column of a non-finite value,
    ///   FileError if the row cannot be written.
    void
    add_row(const std::vector<double> &values);

    unsigned int
    n_rows() const;

    /// The text of all rows.
    const std::string &
    rows() const
    {
      return content;
    }

    /// Writes the file anew with these rows.
    void
    restore(const std::string &rows);

  private:
    std::string              file_name;
    std::vector<std::string> columns;
    std::ofstream            stream;
    std::string              content; ///< all rows
    unsigned int             row_count = 0;
  };


  /// Writes a small table as csv, atomically: fragments.csv and the like.
  ///
  /// @throws FileError, NumericalError as above.
  void
  write_table(const std::string                      &file_name,
              const std::vector<std::string>         &columns,
              const std::vector<std::vector<double>> &rows);
} // namespace Morsel::Output

#endif
