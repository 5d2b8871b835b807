#include <morsel/output/hdf5_file.h>

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

#include <cmath>
#include <sstream>
#include <utility>

namespace Morsel::Output
{
  using dealii::ArrayView;
  using dealii::Point;

  namespace
  {
    std::vector<std::string>
    component_names(const Field &field)
    {
      switch (field.kind)
        {
          case Field::Kind::scalar:
            return {field.name};
          case Field::Kind::vector:
            return {field.name};
          case Field::Kind::tensor:
            return {field.name + "_xx",
                    field.name + "_xy",
                    field.name + "_yx",
                    field.name + "_yy"};
        }
      Assert(false, dealii::ExcInternalError());
      return {};
    }


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


    /// Writing a file so that it survives takes as long as a thousand steps of
    /// a small scene.
    constexpr std::chrono::seconds between_series(1);


    /// The vertices of this rank's cells, in the order of XDMF.
    /// @param first of its points
    template <int dim>
    std::vector<unsigned int>
    cell_vertices(const unsigned int first, const unsigned int n_points)
    {
      constexpr unsigned int n_vertices =
          dealii::GeometryInfo<dim>::vertices_per_cell;
      std::vector<unsigned int> vertices(n_points);
      for (unsigned int k = 0; k < vertices.size(); ++k)
        vertices[k] = first + k;
      if (dim == 2) // around the cell, not row by row
        for (unsigned int k = 0; k < vertices.size(); k += n_vertices)
          std::swap(vertices[k + 2], vertices[k + 3]);
      return vertices;
    }


    /// @param n_points of this rank
    template <int dim>
    std::vector<HDF5File::Table>
    tables_of(const std::size_t n_points, const std::vector<Field> &fields)
    {
      using Number = HDF5File::Number;
      constexpr unsigned int n_vertices =
          dealii::GeometryInfo<dim>::vertices_per_cell;
      std::vector<HDF5File::Table> tables = {
          {"nodes", Number::real, 2, n_points},
          {"cells", Number::natural, n_vertices, n_points / n_vertices}};
      for (const auto &field : fields)
        for (const auto &component : component_names(field))
          tables.push_back({component,
                            Number::real,
                            field.kind == Field::Kind::vector ? 3u : 1u,
                            n_points});
      return tables;
    }


    /// This rank's rows, in the order of the tables.
    template <int dim>
    void
    write_fields(HDF5File                        &file,
                 const ArrayView<const Point<2>> &points,
                 const std::vector<Field>        &fields)
    {
      unsigned int        table = 0;
      std::vector<double> values;
      const auto write = [&](const unsigned int columns, const auto &value) {
        values.resize(points.size() * columns);
        for (std::size_t p = 0; p < points.size(); ++p)
          for (unsigned int c = 0; c < columns; ++c)
            values[columns * p + c] = value(p, c);
        file.write(table++, values);
      };

      write(2, [&](const std::size_t p, const unsigned int c) {
        return points[p][c];
      });
      // As many points are before this rank's.
      const std::uint64_t first = file.first_row(0);
      file.write(table++, cell_vertices<dim>(first, points.size()));
      for (const auto &field : fields)
        {
          const unsigned int n = field.n_components();
          if (field.kind == Field::Kind::vector)
            write(3, [&](const std::size_t p, const unsigned int c) {
              return c < 2 ? field.values[2 * p + c] : 0.;
            });
          else
            for (unsigned int k = 0; k < n; ++k)
              write(1, [&](const std::size_t p, const unsigned int) {
                return field.values[n * p + k];
              });
        }
      file.close();
    }
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
    run_on_all_ranks(communicator, [&] { create_folder(folder); });
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
    HDF5File file(folder + "/" + h5_name,
                  tables_of<dim>(points.size(), fields),
                  communicator);
    run_on_all_ranks(communicator,
                     [&] { write_fields<dim>(file, points, fields); });

    dealii::XDMFEntry entry(
        h5_name, h5_name, time, n_points, n_points / n_vertices, dim, 2);
    for (const auto &field : fields)
      for (const auto &component : component_names(field))
        entry.add_attribute(component,
                            field.kind == Field::Kind::vector ? 3 : 1);
    entries.push_back(entry);
    run_on_all_ranks(communicator, [&] {
      if (rank() != 0)
        return;
      file.publish();
      if (entries.size() > 1 &&
          std::chrono::steady_clock::now() < series_written + between_series)
        series_is_old = true;
      else
        write_series();
    });
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
    run_on_all_ranks(communicator, [&] {
      if (rank() == 0)
        write_series();
    });
  }


  template <int dim>
  void
  Frames<dim>::finish()
  {
    run_on_all_ranks(communicator, [&] {
      if (series_is_old)
        write_series();
    });
  }


  template <int dim>
  void
  Frames<dim>::write_series()
  {
    series_is_old  = false;
    series_written = std::chrono::steady_clock::now();
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
