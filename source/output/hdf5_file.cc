#include <morsel/output/hdf5_file.h>

#include <deal.II/base/mpi.h>

#include <numeric>

namespace Morsel::Output
{
  namespace
  {
    /// An object of HDF5 that is closed at the end of the scope, if it could be
    /// made.
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*close)(hid_t))
          : id(id)
          , close(close)
      {}

      Handle(const Handle &) = delete;
      Handle &
      operator=(const Handle &) = delete;

      ~Handle()
      {
        if (id >= 0)
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


    bool
    write_table(const hid_t        file,
                const std::string &name,
                const void        *values,
                const hid_t        type,
                const hsize_t      rows,
                const hsize_t      columns)
    {
      const hsize_t sizes[2] = {rows, columns};
      const Handle  space(H5Screate_simple(2, sizes, nullptr), H5Sclose);
      const Handle  table(H5Dcreate2(file,
                                    name.c_str(),
                                    type,
                                    space,
                                    H5P_DEFAULT,
                                    H5P_DEFAULT,
                                    H5P_DEFAULT),
                         H5Dclose);
      return H5Dwrite(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
    }


    MPI_Datatype
    mpi_type(const double)
    {
      return MPI_DOUBLE;
    }


    MPI_Datatype
    mpi_type(const unsigned int)
    {
      return MPI_UNSIGNED;
    }


    /// What all ranks have, in their order, on the first one.
    template <typename Number>
    std::vector<Number>
    gathered(const std::vector<Number> &mine, const MPI_Comm communicator)
    {
      const unsigned int n_ranks =
          dealii::Utilities::MPI::n_mpi_processes(communicator);
      const int        n_mine = mine.size();
      std::vector<int> sizes(n_ranks), begins(n_ranks);
      const int        root = 0;
      int              ierr = MPI_Gather(
          &n_mine, 1, MPI_INT, sizes.data(), 1, MPI_INT, root, communicator);
      AssertThrowMPI(ierr);
      std::exclusive_scan(sizes.begin(), sizes.end(), begins.begin(), 0);
      std::vector<Number> all(begins.back() + sizes.back());
      ierr = MPI_Gatherv(mine.data(),
                         n_mine,
                         mpi_type(Number()),
                         all.data(),
                         sizes.data(),
                         begins.data(),
                         mpi_type(Number()),
                         root,
                         communicator);
      AssertThrowMPI(ierr);
      return all;
    }
  } // namespace


  HDF5File::HDF5File(const std::string &file_name, const MPI_Comm communicator)
      : communicator(communicator)
  {
    H5Eget_auto2(H5E_DEFAULT, &old_function, &old_data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    file =
        H5Fcreate(file_name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    failed = file < 0;
  }


  HDF5File::~HDF5File()
  {
    if (file >= 0)
      H5Fclose(file);
    H5Eset_auto2(H5E_DEFAULT, old_function, old_data);
  }


  bool
  HDF5File::close()
  {
    if (file >= 0 && H5Fclose(file) < 0)
      failed = true;
    file = -1;
    return dealii::Utilities::MPI::max(failed ? 1 : 0, communicator) == 0;
  }


  void
  HDF5File::write(const std::string         &name,
                  const std::vector<double> &values,
                  const unsigned int         columns)
  {
    gather_and_write(name, values, H5T_NATIVE_DOUBLE, columns);
  }


  void
  HDF5File::write(const std::string               &name,
                  const std::vector<unsigned int> &values,
                  const unsigned int               columns)
  {
    gather_and_write(name, values, H5T_NATIVE_UINT, columns);
  }


  template <typename Number>
  void
  HDF5File::gather_and_write(const std::string         &name,
                             const std::vector<Number> &values,
                             const hid_t                type,
                             const unsigned int         columns)
  {
    const auto write = [&](const std::vector<Number> &all) {
      if (file >= 0 && !failed)
        failed = !write_table(
            file, name, all.data(), type, all.size() / columns, columns);
    };
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      write(values);
    else
      write(gathered(values, communicator));
  }
} // namespace Morsel::Output
