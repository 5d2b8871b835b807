#ifndef morsel_output_frames_h
#define morsel_output_frames_h

#include <morsel/core/state_archive_fwd.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <chrono>
#include <string>
#include <vector>

namespace Morsel::Output
{
  /// A named field on points, as a view of a contiguous array.
  struct Field
  {
    enum class Kind
    {
      scalar, ///< one value per point
      vector, ///< x, y per point
      tensor  ///< xx, xy, yx, yy per point; written as scalars name_xx ...
    };

    std::string                     name;
    Kind                            kind = Kind::scalar;
    dealii::ArrayView<const double> values; ///< n_components per point

    unsigned int
    n_components() const;
  };


  /// The moments of one body over time: one HDF5 file each and an XDMF file
  /// that ParaView opens, rewritten at moments a second or more apart so that
  /// a run that is killed leaves a readable series.
  ///
  /// dim is that of the cells: 0 for particles, 1 for lines, 2 for plates. The
  /// datasets are "nodes" (n x 2), "cells", and one per field, of double
  /// precision and with vectors padded to three components.
  template <int dim>
  class Frames
  {
  public:
    /// @param folder is created where it is missing.
    /// @param name of the body; the files are name.xdmf, name_000000.h5, ...
    /// @throws FileError with the folder's name. Collective.
    Frames(const std::string &folder,
           const std::string &name,
           const MPI_Comm    &communicator);

    /// Appends a moment. Collective; ranks without cells may call it too.
    ///
    /// @param points the cells' vertices, one cell's after the other's, in
    ///   deal.II's order [m].
    /// @param fields the same ones in the same order on every rank and at
    ///   every moment, with values on this rank's points.
    /// @throws FileError with the file's name, NumericalError naming the field
    ///   that holds a value that is not finite.
    void
    write(double                                          time,
          const dealii::ArrayView<const dealii::Point<2>> points,
          const std::vector<Field>                       &fields);

    /// Completes the series: after the last moment. Collective.
    void
    finish();

    unsigned int
    n_frames() const;

    /// Which moments the series has; on loading later ones are forgotten and
    /// will be written over. Collective.
    void
    exchange_state(StateArchive &state);

    /// This process's rank among those that write the series.
    unsigned int
    rank() const;

  private:
    /// The file that ParaView opens: by rank 0.
    void
    write_series();

    const std::string                     folder;
    const std::string                     name;
    const MPI_Comm                        communicator;
    std::vector<dealii::XDMFEntry>        entries;
    bool                                  series_is_old = false; ///< on rank 0
    std::chrono::steady_clock::time_point series_written{};      ///< or never
  };


  /// The state of one plate as if it were rigid.
  struct PlateState
  {
    /// Of its cells now, four each in deal.II's order [m].
    std::vector<dealii::Point<2>> corners;
    dealii::Tensor<1, 2>          velocity; ///< [m/s]
    dealii::Tensor<1, 2>          force;    ///< on the plate [N]
  };


  /// Appends a moment of the plates, with the fields velocity, force and
  /// plate (their number). Every rank gives the same states; rank 0 writes.
  void
  write_plates(Frames<2>                     &frames,
               double                         time,
               const std::vector<PlateState> &plates);
} // namespace Morsel::Output

#endif
