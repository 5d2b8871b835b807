#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/output/hdf5_file.h>

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <hdf5.h>
#include <unistd.h>

namespace Morsel::Output
{
  namespace
  {
    namespace fs = std::filesystem;

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


    /// Keeps HDF5's own messages back for as long as it lives.
    class Silence
    {
    public:
      Silence()
      {
        H5Eget_auto2(H5E_DEFAULT, &function, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      }

      Silence(const Silence &) = delete;
      Silence &
      operator=(const Silence &) = delete;

      ~Silence()
      {
        H5Eset_auto2(H5E_DEFAULT, function, data);
      }

    private:
      H5E_auto2_t function = nullptr;
      void       *data     = nullptr;
    };


    /// A table whose values are written later, without HDF5: it gets its place
    /// now and nothing is written there.
    /// @return where it begins [B], HADDR_UNDEF if it failed
    haddr_t
    place_of_new_table(const hid_t            file,
                       const HDF5File::Table &table,
                       const hsize_t          rows)
    {
      const hsize_t sizes[2] = {rows, table.columns};
      const Handle  space(H5Screate_simple(2, sizes, nullptr), H5Sclose);
      const Handle  properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      H5Pset_layout(properties, H5D_CONTIGUOUS);
      H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY);
      H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER);
      const Handle dataset(H5Dcreate2(file,
                                      table.name.c_str(),
                                      table.number == HDF5File::Number::real
                                          ? H5T_NATIVE_DOUBLE
                                          : H5T_NATIVE_UINT,
                                      space,
                                      H5P_DEFAULT,
                                      properties,
                                      H5P_DEFAULT),
                           H5Dclose);
      return dataset < 0 ? HADDR_UNDEF : H5Dget_offset(dataset);
    }


    std::uint64_t
    row_size(const HDF5File::Table &table)
    {
      return table.columns * (table.number == HDF5File::Number::real
                                  ? sizeof(double)
                                  : sizeof(unsigned int));
    }


    /// With less room [B] on the disk, that is why a file cannot be laid out.
    constexpr std::uintmax_t smallest_space = 1 << 16;


    /// HDF5 does not say why it failed.
    std::string
    likely_reason(const std::string &folder)
    {
      std::error_code      error;
      const fs::space_info space = fs::space(folder, error);
      if (error)
        return error.message();
      if (::access(folder.c_str(), W_OK) != 0)
        return std::strerror(errno);
      return space.available < smallest_space ? "No space left on device"
                                              : "HDF5 failed";
    }
  } // namespace


  HDF5File::HDF5File(const std::string &file_name,
                     std::vector<Table> list,
                     const MPI_Comm     communicator)
      : file_name(file_name)
      , temporary(file_name + ".tmp")
      , tables(std::move(list))
      , first_rank(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      , first_rows(tables.size(), 0)
      , begins(tables.size(), 0)
  {
    std::vector<std::uint64_t> rows, all(tables.size());
    for (const Table &table : tables)
      rows.push_back(table.rows);
    // Leaves what rank 0 has as it is.
    int ierr = MPI_Exscan(rows.data(),
                          first_rows.data(),
                          rows.size(),
                          MPI_UINT64_T,
                          MPI_SUM,
                          communicator);
    AssertThrowMPI(ierr);
    ierr = MPI_Reduce(rows.data(),
                      all.data(),
                      rows.size(),
                      MPI_UINT64_T,
                      MPI_SUM,
                      0,
                      communicator);
    AssertThrowMPI(ierr);
    run_on_all_ranks(communicator, [&] {
      if (first_rank)
        begins = lay_out(all);
    });
    ierr =
        MPI_Bcast(begins.data(), begins.size(), MPI_UINT64_T, 0, communicator);
    AssertThrowMPI(ierr);
  }


  HDF5File::~HDF5File()
  {
    if (file >= 0)
      ::close(file);
    if (first_rank && !published)
      ::unlink(temporary.c_str());
  }


  std::vector<std::uint64_t>
  HDF5File::lay_out(const std::vector<std::uint64_t> &rows_of_all) const
  {
    const Silence              silence;
    std::vector<std::uint64_t> places;
    const hid_t                h5 =
        H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    bool good = h5 >= 0;
    for (unsigned int t = 0; t < tables.size() && good; ++t)
      {
        const haddr_t place = place_of_new_table(h5, tables[t], rows_of_all[t]);
        good                = place != HADDR_UNDEF;
        places.push_back(place);
      }
    // Closed, it has its full length.
    if (h5 >= 0 && H5Fclose(h5) < 0)
      good = false;
    if (good)
      return places;
    const std::string reason = likely_reason(fs::path(file_name).parent_path());
    ::unlink(temporary.c_str());
    fail(reason);
  }


  void
  HDF5File::fail(const std::string &reason) const
  {
    throw FileError("Cannot write '" + file_name + "': " + reason + ".");
  }


  std::uint64_t
  HDF5File::first_row(const unsigned int table) const
  {
    return first_rows[table];
  }


  void
  HDF5File::write(const unsigned int table, const std::vector<double> &values)
  {
    write_rows(table, values.data(), values.size() * sizeof(double));
  }


  void
  HDF5File::write(const unsigned int               table,
                  const std::vector<unsigned int> &values)
  {
    write_rows(table, values.data(), values.size() * sizeof(unsigned int));
  }


  void
  HDF5File::write_rows(const unsigned int  table,
                       const void         *values,
                       const std::uint64_t size)
  {
    const std::uint64_t bytes = row_size(tables[table]);
    AssertThrow(size == tables[table].rows * bytes,
                dealii::ExcMessage("The table '" + tables[table].name +
                                   "' does not have as many rows as said."));
    // Ranks without rows have no use for the file.
    if (size > 0 && file < 0 &&
        (file = ::open(temporary.c_str(), O_WRONLY | O_CLOEXEC)) < 0)
      fail(std::strerror(errno));
    const std::uint64_t begin   = begins[table] + first_rows[table] * bytes;
    std::uint64_t       written = 0;
    while (written < size)
      {
        const ssize_t n = ::pwrite(file,
                                   static_cast<const char *>(values) + written,
                                   size - written,
                                   begin + written);
        if (n < 0 && errno != EINTR)
          fail(std::strerror(errno));
        if (n > 0)
          written += n;
      }
  }


  void
  HDF5File::close()
  {
    // Some systems tell of a full disk only now.
    const int descriptor = file;
    file                 = -1;
    if (descriptor >= 0 && ::close(descriptor) != 0)
      fail(std::strerror(errno));
  }


  void
  HDF5File::publish()
  {
    if (std::rename(temporary.c_str(), file_name.c_str()) != 0)
      fail(std::strerror(errno));
    published = true;
  }
} // namespace Morsel::Output
