#ifndef morsel_output_hdf5_file_h
#define morsel_output_hdf5_file_h

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace Morsel::Output
{
  /// A new HDF5 file of tables whose rows all ranks of a communicator hold.
  ///
  /// One rank lays the file out, under a temporary name, and tells the others
  /// where each table begins; then every rank writes its own rows in their
  /// place, by the system's calls. So no rank holds what others have, and
  /// none waits in MPI's files for one that meets the end of the disk.
  class HDF5File
  {
  public:
    enum class Number
    {
      real,   ///< double
      natural ///< unsigned int
    };

    /// All ranks name the same tables in the same order.
    struct Table
    {
      std::string   name;
      Number        number  = Number::real;
      unsigned int  columns = 1;
      std::uint64_t rows    = 0; ///< of this rank
    };

    /// Lays the file out; collective.
    /// @param tables none without any row on any rank
    /// @throws FileError with the file's name and the reason, on all ranks.
    HDF5File(const std::string &file_name,
             std::vector<Table> tables,
             const MPI_Comm     communicator);

    /// What has not been published goes. After a failure no rank may still be
    /// writing.
    ~HDF5File();

    HDF5File(const HDF5File &) = delete;
    HDF5File &
    operator=(const HDF5File &) = delete;

    /// Which of all rows this rank's first one is.
    std::uint64_t
    first_row(unsigned int table) const;

    /// Writes this rank's rows of a table, one after the other; not
    /// collective.
    /// @throws FileError with the file's name and the reason.
    void
    write(unsigned int table, const std::vector<double> &values);

    void
    write(unsigned int table, const std::vector<unsigned int> &values);

    /// This rank has written all of its tables; not collective.
    /// @throws FileError with the file's name and the reason.
    void
    close();

    /// Gives the file its name: by rank 0, once all ranks have closed it.
    /// @throws FileError with the file's name and the reason.
    void
    publish();

  private:
    /// With HDF5, on one rank.
    /// @return where each table begins [B]
    std::vector<std::uint64_t>
    lay_out(const std::vector<std::uint64_t> &rows_of_all) const;

    /// @param size of all values [B]
    void
    write_rows(unsigned int table, const void *values, std::uint64_t size);

    [[noreturn]] void
    fail(const std::string &reason) const;

    const std::string          file_name;
    const std::string          temporary;
    const std::vector<Table>   tables;
    const bool                 first_rank;
    bool                       published = false;
    int                        file      = -1; ///< its descriptor
    std::vector<std::uint64_t> first_rows;
    std::vector<std::uint64_t> begins; ///< of tables in the file [B]
  };
} // namespace Morsel::Output

#endif
