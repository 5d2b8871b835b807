#ifndef morsel_core_records_h
#define morsel_core_records_h

namespace Morsel
{
  /// Displacement [m] and velocity [m/s] of one particle: the record that
  /// pair loops gather from neighbours and ranks exchange.
  struct alignas(32) Motion
  {
    double u_x, u_y, v_x, v_y;
  };


  struct Vector2
  {
    double x, y;
  };


  /// Symmetric 2x2 matrix.
  struct Symmetric2
  {
    double xx, yy, xy;
  };
} // namespace Morsel

#endif
