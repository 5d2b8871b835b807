#ifndef morsel_output_hdf5_file_h
#define morsel_output_hdf5_file_h

#include <hdf5.h>
#include <mpi.h>

#include <cstdint>
#include <string>

namespace Morsel::Output
{
  /// The rows of a table that this rank holds.
  struct Rows
  {
    std::uint64_t first, here, all;
  };


  /// A new HDF5 file into which the ranks of a communicator write tables
  /// together; a single one goes without MPI's files, whose library would
  /// print what a full disk makes it think. All methods are collective and
  /// throw dealii::ExcMessage where HDF5 fails; HDF5's own messages are kept
  /// back.
  class HDF5File
  {
  public:
    HDF5File(const std::string &file_name, MPI_Comm communicator);

    ~HDF5File();

    HDF5File(const HDF5File &) = delete;
    HDF5File &
    operator=(const HDF5File &) = delete;

    /// @param values row by row, rows.here times @p columns
    void
    write(const std::string &name,
          const double      *values,
          const Rows        &rows,
          unsigned int       columns);

    void
    write(const std::string  &name,
          const unsigned int *values,
          const Rows         &rows,
          unsigned int        columns);

    /// Says whether all has reached the file.
    void
    close();

  private:
    void
    write_table(const std::string &name,
                const void        *values,
                hid_t              type,
                const Rows        &rows,
                unsigned int       columns);

    const bool  parallel;
    H5E_auto2_t old_function = nullptr; ///< what prints messages
    void       *old_data     = nullptr;
    hid_t       file         = -1;
  };
} // namespace Morsel::Output

#endif
