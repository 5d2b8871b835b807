#include "recorder.h"

namespace Morsel
{
  void
  Recorder::write_frame()
  {
    using Field = Output::Field;

    const auto timer = log.section("output");
    find_fragments();
    last_frame_time = bite.time();

    const auto                   &solid = bite.food();
    const auto                   &p     = solid.get_particles();
    const unsigned int            n     = p.n_owned;
    std::vector<dealii::Point<2>> points(n);
    std::vector<double> displacement, velocity, damage(n, 0.), failed(n, 0.),
        fragment(n), density(n), mises(n), s_xx(n), s_yy(n), pressure(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        const Motion &m = p.motion[i];
        const auto    s = solid.stress(i);
        points[i]       = p.position(i);
        displacement.insert(displacement.end(), {m.u_x, m.u_y});
        velocity.insert(velocity.end(), {m.v_x, m.v_y});
        if (!p.damage.empty())
          {
            damage[i] = p.damage[i];
            failed[i] = p.failed[i];
          }
        fragment[i] = fragments.label[i];
        density[i]  = solid.density_ratio(i) *
                     scene.particle_bodies.front().material.density;
        mises[i]    = Materials::von_mises(s);
        s_xx[i]     = s.xx;
        s_yy[i]     = s.yy;
        pressure[i] = -(s.xx + s.yy + s.zz) / 3.;
      }
    std::vector<Field> fields = {
        {"displacement", Field::Kind::vector, displacement},
        {"velocity", Field::Kind::vector, velocity},
        {"damage", Field::Kind::scalar, damage},
        {"failed", Field::Kind::scalar, failed},
        {"fragment", Field::Kind::scalar, fragment},
        {"density", Field::Kind::scalar, density},
        {"von_mises", Field::Kind::scalar, mises},
        {"stress_xx", Field::Kind::scalar, s_xx},
        {"stress_yy", Field::Kind::scalar, s_yy},
        {"pressure", Field::Kind::scalar, pressure}};
    const std::vector<double> modulus = solid.youngs_moduli();
    if (!modulus.empty())
      fields.push_back({"youngs_modulus", Field::Kind::scalar, modulus});
    if (scene.particle_bodies.front().grains.scatter_strength() &&
        !p.threshold.empty())
      fields.push_back(
          {"threshold",
           Field::Kind::scalar,
           dealii::ArrayView<const double>(p.threshold.data(), n)});
    particle_frames->write(bite.time(), points, fields);

    if (!plate_frames)
      return;
    std::vector<Output::PlateState> plates;
    for (const auto &plate : bite.get_plates())
      {
        plates.push_back(
            {plate.body.shape.cell_corners(), plate.velocity(), plate.force()});
        for (auto &corner : plates.back().corners)
          corner = plate.frame().place(corner);
      }
    Output::write_plates(*plate_frames, bite.time(), plates);
    write_surfaces();
    if (elastic_frames)
      write_elastic_plates();
  }


  void
  Recorder::write_fragments()
  {
    // Of the food alone; with other bodies there is no table.
    if (!first_rank ||
        bite.food().get_host().n_global() != bite.particle_count())
      return;
    std::vector<std::vector<double>> rows;
    for (unsigned int f = 0; f < fragments.pieces.size(); ++f)
      {
        const auto &piece = fragments.pieces[f];
        rows.push_back({static_cast<double>(f),
                        piece.share,
                        1e6 * piece.area,
                        1e3 * piece.perimeter,
                        static_cast<double>(piece.n_particles)});
      }
    Output::write_table(options.output_directory + "/fragments.csv",
                        {"fragment [1]",
                         "mass_share [1]",
                         "area [mm^2]",
                         "perimeter [mm]",
                         "particles [1]"},
                        rows);
  }
} // namespace Morsel
