#ifndef morsel_output_hdf5_file_h
#define morsel_output_hdf5_file_h

#include <hdf5.h>
#include <mpi.h>

#include <string>
#include <vector>

namespace Morsel::Output
{
  /// A new HDF5 file of tables whose rows all ranks of a communicator hold. One
  /// rank gathers them and writes, without MPI's files: there, a full disk that
  /// one rank meets leaves the others waiting for it. All methods are
  /// collective. What fails is remembered until close(); HDF5's own messages
  /// are kept back.
  class HDF5File
  {
  public:
    HDF5File(const std::string &file_name, MPI_Comm communicator);

    ~HDF5File();

    HDF5File(const HDF5File &) = delete;
    HDF5File &
    operator=(const HDF5File &) = delete;

    /// @param values of this rank, row by row
    void
    write(const std::string         &name,
          const std::vector<double> &values,
          unsigned int               columns);

    void
    write(const std::string               &name,
          const std::vector<unsigned int> &values,
          unsigned int                     columns);

    /// Whether all has reached the file; the same answer on all ranks.
    bool
    close();

  private:
    template <typename Number>
    void
    gather_and_write(const std::string         &name,
                     const std::vector<Number> &values,
                     const hid_t                type,
                     unsigned int               columns);

    const MPI_Comm communicator;
    H5E_auto2_t    old_function = nullptr; ///< what prints messages
    void          *old_data     = nullptr;
    hid_t          file         = -1;
    bool           failed       = false;
  };
} // namespace Morsel::Output

#endif
