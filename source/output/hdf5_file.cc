#include <morsel/output/hdf5_file.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

namespace Morsel::Output
{
  namespace
  {
    hid_t
    checked(const hid_t id)
    {
      AssertThrow(id >= 0, dealii::ExcMessage("HDF5 failed."));
      return id;
    }


    /// An object of HDF5 that is closed at the end of the scope.
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*close)(hid_t))
          : id(checked(id))
          , close(close)
      {}

      Handle(const Handle &) = delete;
      Handle &
      operator=(const Handle &) = delete;

      ~Handle()
      {
        close(id);
      }

      operator hid_t() const
      {
        return id;
      }

    private:
      const hid_t id;
      herr_t (*const close)(hid_t);
    };
  } // namespace


  HDF5File::HDF5File(const std::string &file_name, const MPI_Comm communicator)
      : parallel(dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
  {
    H5Eget_auto2(H5E_DEFAULT, &old_function, &old_data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    if (parallel)
      checked(H5Pset_fapl_mpio(access, communicator, MPI_INFO_NULL));
    file = H5Fcreate(file_name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    if (file < 0)
      H5Eset_auto2(H5E_DEFAULT, old_function, old_data);
    checked(file);
  }


  HDF5File::~HDF5File()
  {
    if (file >= 0)
      H5Fclose(file);
    H5Eset_auto2(H5E_DEFAULT, old_function, old_data);
  }


  void
  HDF5File::close()
  {
    const hid_t closing = file;
    file                = -1;
    checked(H5Fclose(closing));
  }


  void
  HDF5File::write(const std::string &name,
                  const double      *values,
                  const Rows        &rows,
                  const unsigned int columns)
  {
    write_table(name, values, H5T_NATIVE_DOUBLE, rows, columns);
  }


  void
  HDF5File::write(const std::string  &name,
                  const unsigned int *values,
                  const Rows         &rows,
                  const unsigned int  columns)
  {
    write_table(name, values, H5T_NATIVE_UINT, rows, columns);
  }


  void
  HDF5File::write_table(const std::string &name,
                        const void        *values,
                        const hid_t        type,
                        const Rows        &rows,
                        const unsigned int columns)
  {
    const hsize_t all[2]   = {rows.all, columns};
    const hsize_t here[2]  = {rows.here, columns};
    const hsize_t first[2] = {rows.first, 0};
    const Handle  in_file(H5Screate_simple(2, all, nullptr), H5Sclose);
    const Handle  in_memory(H5Screate_simple(2, here, nullptr), H5Sclose);
    checked(H5Sselect_hyperslab(
        in_file, H5S_SELECT_SET, first, nullptr, here, nullptr));
    const Handle table(H5Dcreate2(file,
                                  name.c_str(),
                                  type,
                                  in_file,
                                  H5P_DEFAULT,
                                  H5P_DEFAULT,
                                  H5P_DEFAULT),
                       H5Dclose);
    const Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
    if (parallel)
      checked(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE));
    checked(H5Dwrite(table, type, in_memory, in_file, transfer, values));
  }
} // namespace Morsel::Output
