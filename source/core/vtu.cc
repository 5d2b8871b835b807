#include <morsel/core/vtu.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <sstream>

namespace Morsel
{
  namespace
  {
    /// Three bytes in four characters (RFC 4648). deal.II's does a bit at a
    /// time and took a tenth of a plate's run.
    std::string
    base64(const std::vector<unsigned char> &bytes)
    {
      constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrst"
                                "uvwxyz0123456789+/";
      std::string    text((bytes.size() + 2) / 3 * 4, '=');
      for (std::size_t i = 0, out = 0; i < bytes.size(); i += 3, out += 4)
        {
          const std::size_t   n = std::min<std::size_t>(3, bytes.size() - i);
          const std::uint32_t triple = bytes[i] << 16 |
                                       (n > 1 ? bytes[i + 1] << 8 : 0) |
                                       (n > 2 ? bytes[i + 2] : 0);
          for (std::size_t k = 0; k <= n; ++k)
            text[out + k] = digits[triple >> (18 - 6 * k) & 63];
        }
      return text;
    }


    /// One array: its length in bytes and its bytes, in base64.
    template <typename T>
    void
    write_array(std::ostream         &out,
                const char           *type,
                const std::string    &name,
                const unsigned int    n_components,
                const std::vector<T> &values)
    {
      const std::uint64_t        n_bytes = values.size() * sizeof(T);
      std::vector<unsigned char> bytes(sizeof(n_bytes) + n_bytes);
      const auto *header = reinterpret_cast<const unsigned char *>(&n_bytes);
      const auto *data = reinterpret_cast<const unsigned char *>(values.data());
      std::copy(header, header + sizeof(n_bytes), bytes.begin());
      std::copy(data, data + n_bytes, bytes.begin() + sizeof(n_bytes));
      out << "<DataArray type=\"" << type << "\" Name=\"" << name
          << "\" NumberOfComponents=\"" << n_components
          << "\" format=\"binary\">" << base64(bytes) << "</DataArray>\n";
    }
  } // namespace


  unsigned int
  VtuGrid::add_point(const double x, const double y)
  {
    coordinates.insert(coordinates.end(), {x, y, 0.});
    return n_points() - 1;
  }


  void
  VtuGrid::add_cell(const Shape shape, const unsigned int n)
  {
    offsets.push_back((offsets.empty() ? 0 : offsets.back()) + n);
    shapes.push_back(static_cast<unsigned char>(shape));
    AssertDimension(static_cast<unsigned int>(offsets.back()), n_points());
  }


  std::vector<double> &
  VtuGrid::find_or_make(std::vector<Field> &fields,
                        const std::string  &name,
                        const unsigned int  n_components)
  {
    for (Field &field : fields)
      if (field.name == name)
        return field.values;
    fields.push_back({name, n_components, {}});
    return fields.back().values;
  }


  std::vector<double> &
  VtuGrid::point_field(const std::string &name, const unsigned int n_components)
  {
    return find_or_make(point_fields, name, n_components);
  }


  std::vector<double> &
  VtuGrid::cell_field(const std::string &name, const unsigned int n_components)
  {
    return find_or_make(cell_fields, name, n_components);
  }


  std::string
  VtuGrid::text() const
  {
    std::ostringstream out;
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
           "version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\">\n<UnstructuredGrid>\n"
           "<Piece NumberOfPoints=\""
        << n_points() << "\" NumberOfCells=\"" << offsets.size()
        << "\">\n<Points>\n";
    write_array(out, "Float64", "points", 3, coordinates);
    // Every cell has points of its own, in the order of the cells.
    std::vector<int> connectivity(n_points());
    std::iota(connectivity.begin(), connectivity.end(), 0);
    out << "</Points>\n<Cells>\n";
    write_array(out, "Int32", "connectivity", 1, connectivity);
    write_array(out, "Int32", "offsets", 1, offsets);
    write_array(out, "UInt8", "types", 1, shapes);
    out << "</Cells>\n<PointData>\n";
    for (const Field &field : point_fields)
      {
        AssertDimension(field.values.size(), n_points() * field.n_components);
        write_array(
            out, "Float64", field.name, field.n_components, field.values);
      }
    out << "</PointData>\n<CellData>\n";
    for (const Field &field : cell_fields)
      {
        AssertDimension(field.values.size(),
                        offsets.size() * field.n_components);
        write_array(
            out, "Float64", field.name, field.n_components, field.values);
      }
    out << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    return out.str();
  }


  std::string
  pvd_text(const std::vector<std::string> &file_names)
  {
    std::ostringstream out;
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
           "version=\"0.1\">\n<Collection>\n";
    for (unsigned int part = 0; part < file_names.size(); ++part)
      out << "<DataSet timestep=\"0\" part=\"" << part << "\" file=\""
          << file_names[part] << "\"/>\n";
    out << "</Collection>\n</VTKFile>\n";
    return out.str();
  }
} // namespace Morsel
