#ifndef morsel_core_kernel_h
#define morsel_core_kernel_h

#include <algorithm>
#include <string>

namespace Morsel
{
  enum class KernelKind
  {
    cubic_b_spline,
    wendland_c2
  };

  /// The kernel with a name of SPH::SolidParameters::kernel.
  inline KernelKind
  kernel_named(const std::string &name)
  {
    return name == "Wendland C2" ? KernelKind::wendland_c2
                                 : KernelKind::cubic_b_spline;
  }


  /// A smoothing kernel W(r, h) in two dimensions with support 2h.
  struct Kernel
  {
    KernelKind kind;
    double     h;             ///< smoothing length [m]
    double     normalisation; ///< so that W integrates to one [1/m^2]

    Kernel(const KernelKind kind, const double h)
        : kind(kind)
        , h(h)
        , normalisation((kind == KernelKind::cubic_b_spline ? 15. : 7. * 1.75) /
                        (7. * pi * h * h))
    {}

    double
    support() const
    {
      return 2. * h;
    }

    /// W(r) [1/m^2].
    double
    value(const double r) const
    {
      const double q = r / h;
      if (q >= 2.)
        return 0.;
      if (kind == KernelKind::wendland_c2)
        {
          const double t = 1. - 0.5 * q;
          return normalisation * t * t * t * t * (1. + 2. * q);
        }
      const double t = 2. - q;
      return normalisation *
             (q < 1. ? 2. / 3. + q * q * (0.5 * q - 1.) : t * t * t / 6.);
    }

    /// -W'(r)/r [1/m^4], finite at r = 0: the gradient of W at i is this
    /// times (x_j - x_i), and as a weight it makes the gradient matrix the
    /// weighted least-squares fit of a linear field.
    double
    gradient_weight(const double r) const
    {
      const double q     = r / h;
      const double scale = normalisation / (h * h);
      if (q >= 2.)
        return 0.;
      if (kind == KernelKind::wendland_c2)
        {
          const double t = 1. - 0.5 * q;
          return scale * 5. * t * t * t;
        }
      const double t = 2. - q;
      return scale * (q < 1. ? 2. - 1.5 * q : 0.5 * t * t / q);
    }

  private:
    static constexpr double pi = 3.14159265358979323846;
  };
} // namespace Morsel

#endif
