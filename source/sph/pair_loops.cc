#include <morsel/sph/pair_loops.h>

#include <algorithm>
#include <cmath>

namespace Morsel::SPH
{
  using Materials::Tensor2;

  BondedArrays
  bonded_arrays(Particles &p, const Bonds &bonds)
  {
    const PackedBonds &b = bonds.packed;
    return {b.slot_begin.data(),   b.slot_end.data(),
            b.weight.data(),       b.dx.data(),
            b.dy.data(),           b.average.data(),
            b.index.data(),        p.n_owned,
            p.motion.data(),       p.shape.data(),
            p.hourglass.data(),    p.damage.data(),
            p.near_face.data(),    p.gradient.data(),
            p.pair_stress.data(),  p.effective.data(),
            p.acceleration.data(), p.viscous_heat.data(),
            p.driver.data(),       p.crushed.data(),
            p.strongest.data(),    p.fit.data()};
  }


  namespace
  {
    /// sum_j a_ij u_ij (x) X_ij [1].
    Tensor2
    displacement_moment(const Particles   &p,
                        const Bonds       &bonds,
                        const unsigned int i)
    {
      const double u_x = p.motion[i].u_x, u_y = p.motion[i].u_y;
      Tensor2      m{0., 0., 0., 0.};
      for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
           ++k)
        {
          const Motion &j    = p.motion[bonds.list.index[k]];
          const double  ax   = bonds.weight[k] * bonds.dx[k];
          const double  ay   = bonds.weight[k] * bonds.dy[k];
          const double  du_x = j.u_x - u_x, du_y = j.u_y - u_y;
          m.xx += du_x * ax;
          m.xy += du_x * ay;
          m.yx += du_y * ax;
          m.yy += du_y * ay;
        }
      return m;
    }
  } // namespace


  Tensor2
  displacement_gradient(const Particles   &p,
                        const Bonds       &bonds,
                        const unsigned int i)
  {
    return product(displacement_moment(p, bonds, i), p.shape[i]);
  }


  namespace
  {

    Tensor2
    deformation_gradient(const Tensor2 &H)
    {
      return {1. + H.xx, H.xy, H.yx, 1. + H.yy};
    }
  } // namespace


  Materials::ElasticResponse
  response_at(const Particles             &p,
              const Materials::Elasticity &material,
              const bool                   linear_law,
              const unsigned int           i)
  {
    const Tensor2 F = deformation_gradient(p.gradient[i]);
    return linear_law ? Materials::linear_elastic(material, F)
                      : Materials::neo_hookean(material, F);
  }


  double
  fit_residual(const Particles &p, const Bonds &bonds, const unsigned int i)
  {
    const Tensor2 H   = p.fit.empty()
                            ? p.gradient[i]
                            : product(displacement_moment(p, bonds, i), p.fit[i]);
    double        sum = 0.;
    for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1]; ++k)
      {
        const Motion &j = p.motion[bonds.list.index[k]];
        const double  X = bonds.dx[k], Y = bonds.dy[k];
        const double  e_x = j.u_x - p.motion[i].u_x - H.xx * X - H.xy * Y;
        const double  e_y = j.u_y - p.motion[i].u_y - H.yx * X - H.yy * Y;
        sum += bonds.weight[k] * (e_x * e_x + e_y * e_y);
      }
    return 0.25 * p.volume * sum;
  }
} // namespace Morsel::SPH
