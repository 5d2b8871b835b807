#include <morsel/core/atomic_file.h>
#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/state_archive.h>
#include <morsel/output/frames.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/base/utilities.h>

#include <deal.II/grid/reference_cell.h>

#include <boost/archive/text_iarchive.hpp>
#include <boost/archive/text_oarchive.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/vector.hpp>

#include <hdf5.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <tuple>

namespace Morsel::Output
{
  using dealii::ArrayView;
  using dealii::Point;

  namespace
  {
    using Range = std::tuple<
        unsigned int,
        unsigned int,
        std::string,
        dealii::DataComponentInterpretation::DataComponentInterpretation>;


    std::vector<std::string>
    component_names(const Field &field)
    {
      switch (field.kind)
        {
          case Field::Kind::scalar:
            return {field.name};
          case Field::Kind::vector:
            return {field.name, field.name};
          case Field::Kind::tensor:
            return {field.name + "_xx",
                    field.name + "_xy",
                    field.name + "_yx",
                    field.name + "_yy"};
        }
      Assert(false, dealii::ExcInternalError());
      return {};
    }


    /// Hands the arrays to deal.II's writers as patches of one cell each.
    template <int dim>
    class Patches : public dealii::DataOutInterface<dim, 2>
    {
    public:
      Patches(const ArrayView<const Point<2>> points,
              const std::vector<Field>       &fields)
      {
        constexpr unsigned int n_vertices =
            dealii::GeometryInfo<dim>::vertices_per_cell;
        for (const auto &field : fields)
          {
            const auto components = component_names(field);
            if (field.kind == Field::Kind::vector)
              ranges.emplace_back(names.size(),
                                  names.size() + 1,
                                  field.name,
                                  dealii::DataComponentInterpretation::
                                      component_is_part_of_vector);
            names.insert(names.end(), components.begin(), components.end());
          }

        patches.resize(points.size() / n_vertices);
        for (std::size_t c = 0; c < patches.size(); ++c)
          {
            patches[c].patch_index = c;
            if constexpr (dim > 0) // left invalid by the constructor
              patches[c].reference_cell =
                  dealii::ReferenceCells::get_hypercube<dim>();
            patches[c].data.reinit(names.size(), n_vertices);
            for (unsigned int v = 0; v < n_vertices; ++v)
              {
                const std::size_t p    = c * n_vertices + v;
                patches[c].vertices[v] = points[p];
                unsigned int row       = 0;
                for (const auto &field : fields)
                  for (unsigned int d = 0; d < field.n_components(); ++d)
                    patches[c].data(row++, v) =
                        field.values[p * field.n_components() + d];
              }
          }
      }

      const std::vector<dealii::DataOutBase::Patch<dim, 2>> &
      get_patches() const override
      {
        return patches;
      }

      std::vector<std::string>
      get_dataset_names() const override
      {
        return names;
      }

      std::vector<Range>
      get_nonscalar_data_ranges() const override
      {
        return ranges;
      }

    private:
      std::vector<dealii::DataOutBase::Patch<dim, 2>> patches;
      std::vector<std::string>                        names;
      std::vector<Range>                              ranges;
    };


    void
    check_field(const Field &field, const std::size_t n_points)
    {
      AssertThrow(field.values.size() == n_points * field.n_components(),
                  dealii::ExcMessage("The field '" + field.name +
                                     "' does not fit the points."));
    }


    std::string
    xdmf_document(const std::vector<dealii::XDMFEntry> &entries,
                  const dealii::ReferenceCell          &cell)
    {
      std::string document = "<?xml version=\"1.0\" ?>\n"
                             "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
                             "<Xdmf Version=\"2.0\">\n"
                             "  <Domain>\n"
                             "    <Grid Name=\"CellTime\" "
                             "GridType=\"Collection\" "
                             "CollectionType=\"Temporal\">\n";
      for (const auto &entry : entries)
        document += entry.get_xdmf_content(3, cell);
      return document + "    </Grid>\n  </Domain>\n</Xdmf>\n";
    }


    /// With less room [B] on the disk, that is why a file cannot be written.
    constexpr std::uintmax_t smallest_space = 1 << 16;


    /// HDF5 prints what its caller is going to tell in a sentence.
    class QuietHDF5
    {
    public:
      QuietHDF5()
      {
        H5Eget_auto2(H5E_DEFAULT, &function, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      }

      ~QuietHDF5()
      {
        H5Eset_auto2(H5E_DEFAULT, function, data);
      }

      QuietHDF5(const QuietHDF5 &) = delete;
      QuietHDF5 &
      operator=(const QuietHDF5 &) = delete;

    private:
      H5E_auto2_t function = nullptr;
      void       *data     = nullptr;
    };


    /// The ranks that hold something: writing no rows makes HDF5 abort.
    class WritingRanks
    {
    public:
      WritingRanks(const bool holds_data, const MPI_Comm &all)
      {
        const int ierr =
            MPI_Comm_split(all,
                           holds_data ? 0 : MPI_UNDEFINED,
                           dealii::Utilities::MPI::this_mpi_process(all),
                           &communicator);
        AssertThrowMPI(ierr);
      }

      WritingRanks(const WritingRanks &) = delete;
      WritingRanks &
      operator=(const WritingRanks &) = delete;

      ~WritingRanks()
      {
        if (communicator != MPI_COMM_NULL)
          MPI_Comm_free(&communicator);
      }

      MPI_Comm communicator = MPI_COMM_NULL;
    };
  } // namespace


  unsigned int
  Field::n_components() const
  {
    return kind == Kind::scalar ? 1 : (kind == Kind::vector ? 2 : 4);
  }


  template <int dim>
  Frames<dim>::Frames(const std::string &folder,
                      const std::string &name,
                      const MPI_Comm    &communicator)
      : folder(folder)
      , name(name)
      , communicator(communicator)
  {
    create_folder(folder);
  }


  template <int dim>
  void
  Frames<dim>::write(const double                    time,
                     const ArrayView<const Point<2>> points,
                     const std::vector<Field>       &fields)
  {
    namespace MPI = dealii::Utilities::MPI;
    constexpr unsigned int n_vertices =
        dealii::GeometryInfo<dim>::vertices_per_cell;

    std::uint64_t bad_field = 0; // the first one, counted from one
    for (std::size_t f = 0; f < fields.size(); ++f)
      {
        check_field(fields[f], points.size());
        for (const double value : fields[f].values)
          if (!std::isfinite(value) && bad_field == 0)
            bad_field = f + 1;
      }
    // Every rank has to leave, or the others would wait for it.
    bad_field = MPI::max(bad_field, communicator);
    if (bad_field != 0)
      throw NumericalError(
          "The field '" + fields[bad_field - 1].name + "' of '" + name +
          "' is not finite at t = " + std::to_string(time) + " s.");

    const std::uint64_t n_points =
        MPI::sum(static_cast<std::uint64_t>(points.size()), communicator);
    if (n_points == 0)
      return;

    const std::string h5_name =
        name + "_" + dealii::Utilities::int_to_string(entries.size(), 6) +
        ".h5";
    const std::string  temporary = folder + "/" + h5_name + ".tmp";
    const WritingRanks writers(points.size() > 0, communicator);
    int                failed = 0;
    if (points.size() > 0)
      try
        {
          const Patches<dim>                 patches(points, fields);
          dealii::DataOutBase::DataOutFilter filter(
              dealii::DataOutBase::DataOutFilterFlags(false, true));
          patches.write_filtered_data(filter);
          const QuietHDF5 quiet;
          patches.write_hdf5_parallel(filter, temporary, writers.communicator);
        }
      catch (const dealii::ExceptionBase &)
        {
          failed = 1;
        }
    publish(MPI::max(failed, communicator) == 0, temporary, h5_name);

    dealii::XDMFEntry entry(
        h5_name, h5_name, time, n_points, n_points / n_vertices, dim, 2);
    for (const auto &field : fields)
      if (field.kind == Field::Kind::vector)
        entry.add_attribute(field.name, 3);
      else
        for (const auto &component : component_names(field))
          entry.add_attribute(component, 1);
    entries.push_back(entry);
    write_series();
  }


  template <int dim>
  void
  Frames<dim>::exchange_state(StateArchive &state)
  {
    std::string text;
    if (!state.loads())
      {
        std::ostringstream            stream;
        boost::archive::text_oarchive archive(stream);
        archive << entries;
        text = stream.str();
      }
    state.same(text);
    if (!state.loads())
      return;
    std::istringstream            stream(text);
    boost::archive::text_iarchive archive(stream);
    archive >> entries;
    write_series();
  }


  template <int dim>
  void
  Frames<dim>::publish(const bool         written,
                       const std::string &temporary,
                       const std::string &h5_name) const
  {
    namespace fs                 = std::filesystem;
    const std::string final_name = folder + "/" + h5_name;
    run_on_all_ranks(communicator, [&] {
      if (rank() != 0)
        return;
      std::error_code error;
      if (written)
        fs::rename(temporary, final_name, error);
      if (written && !error)
        return;
      // HDF5 does not say why.
      std::error_code      other;
      const fs::space_info space  = fs::space(folder, other);
      const std::string    reason = error   ? error.message()
                                    : other ? other.message()
                                    : space.available < smallest_space
                                        ? "No space left on device"
                                        : "HDF5 failed";
      fs::remove(temporary, other);
      throw FileError("Cannot write '" + final_name + "': " + reason + ".");
    });
  }


  template <int dim>
  void
  Frames<dim>::write_series() const
  {
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      write_atomically(
          folder + "/" + name + ".xdmf",
          xdmf_document(entries, dealii::ReferenceCells::get_hypercube<dim>()));
  }


  template <int dim>
  unsigned int
  Frames<dim>::n_frames() const
  {
    return entries.size();
  }


  template <int dim>
  unsigned int
  Frames<dim>::rank() const
  {
    return dealii::Utilities::MPI::this_mpi_process(communicator);
  }


  template class Frames<0>;
  template class Frames<1>;
  template class Frames<2>;


  void
  write_plates(Frames<2>                     &frames,
               const double                   time,
               const std::vector<PlateState> &plates)
  {
    std::vector<Point<2>> points;
    std::vector<double>   velocity, force, number;
    for (std::size_t p = 0; p < plates.size() && frames.rank() == 0; ++p)
      for (const Point<2> &corner : plates[p].corners)
        {
          points.push_back(corner);
          for (unsigned int d = 0; d < 2; ++d)
            {
              velocity.push_back(plates[p].velocity[d]);
              force.push_back(plates[p].force[d]);
            }
          number.push_back(p);
        }
    frames.write(time,
                 dealii::make_array_view(points),
                 {{"velocity", Field::Kind::vector, {velocity}},
                  {"force", Field::Kind::vector, {force}},
                  {"plate", Field::Kind::scalar, {number}}});
  }
} // namespace Morsel::Output
