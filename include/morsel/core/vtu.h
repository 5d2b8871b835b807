#ifndef morsel_core_vtu_h
#define morsel_core_vtu_h

#include <string>
#include <vector>

namespace Morsel
{
  /// An unstructured grid in the plane with fields on its points and cells,
  /// as the text of a ParaView file (vtu) whose arrays are in base64.
  class VtuGrid
  {
  public:
    /// VTK's numbers of the shapes.
    enum class Shape : unsigned char
    {
      vertex    = 1,
      poly_line = 4,
      polygon   = 7
    };

    /// A point [m]; its number.
    unsigned int
    add_point(const double x, const double y);

    /// A cell of the @p n points that were added last.
    void
    add_cell(const Shape shape, const unsigned int n);

    /// The values of a field on the points or the cells, to be appended in
    /// their order; made by the first call. References stay valid only until
    /// another field is made.
    /// @param n_components values of each point or cell
    std::vector<double> &
    point_field(const std::string &name, const unsigned int n_components);
    std::vector<double> &
    cell_field(const std::string &name, const unsigned int n_components);

    unsigned int
    n_points() const
    {
      return coordinates.size() / 3;
    }

    /// The file.
    /// @pre every field has its values on all points or cells
    std::string
    text() const;

  private:
    struct Field
    {
      std::string         name;
      unsigned int        n_components;
      std::vector<double> values;
    };

    static std::vector<double> &
    find_or_make(std::vector<Field> &fields,
                 const std::string  &name,
                 const unsigned int  n_components);

    std::vector<double>        coordinates;
    std::vector<int>           offsets;
    std::vector<unsigned char> shapes;
    std::vector<Field>         point_fields, cell_fields;
  };


  /// A ParaView collection (pvd) of files that belong to one picture, such as
  /// one of each rank.
  std::string
  pvd_text(const std::vector<std::string> &file_names);
} // namespace Morsel

#endif
