#ifndef morsel_core_kernel_h
#define morsel_core_kernel_h

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

namespace Morsel
{
  enum class KernelKind
  {
    cubic_b_spline, ///< T3-33
    quadratic,      ///< T3-34
    wendland_c2,
    quintic_spline ///< Morris 1996, support 3h
  };

  /// The names in parameter files, in the order of KernelKind, as a pattern
  /// of dealii::Patterns::Selection.
  constexpr const char *kernel_names =
      "cubic B-spline|quadratic|Wendland C2|quintic spline";

  /// The kernel with one of those names.
  inline KernelKind
  kernel_named(const std::string &name)
  {
    return name == "Wendland C2"      ? KernelKind::wendland_c2
           : name == "quadratic"      ? KernelKind::quadratic
           : name == "quintic spline" ? KernelKind::quintic_spline
                                      : KernelKind::cubic_b_spline;
  }


  /// The four shapes as functions of q = r/h, before normalisation; loops
  /// that are compiled for one kernel call these.
  namespace KernelShapes
  {
    constexpr double pi = 3.14159265358979323846;

    /// Support over h [1].
    constexpr double
    support(const KernelKind kind)
    {
      return kind == KernelKind::quintic_spline ? 3. : 2.;
    }

    /// Factor that makes the integral over the plane one, for h = 1.
    constexpr double
    normalisation(const KernelKind kind)
    {
      switch (kind)
        {
          case KernelKind::quadratic:
            return 1. / pi;
          case KernelKind::wendland_c2:
            return 7. / (4. * pi);
          case KernelKind::quintic_spline:
            return 7. / (478. * pi);
          default:
            return 15. / (7. * pi);
        }
    }

    inline double
    positive(const double x)
    {
      return std::max(x, 0.);
    }

    inline double
    fourth(const double x)
    {
      return x * x * x * x;
    }

    template <KernelKind kind>
    double
    value(const double q)
    {
      if (q >= support(kind))
        return 0.;
      if constexpr (kind == KernelKind::wendland_c2)
        return fourth(1. - 0.5 * q) * (1. + 2. * q);
      else if constexpr (kind == KernelKind::quadratic)
        return 0.375 * (2. - q) * (2. - q);
      else if constexpr (kind == KernelKind::quintic_spline)
        {
          const double a = 3. - q, b = positive(2. - q), c = positive(1. - q);
          return fourth(a) * a - 6. * fourth(b) * b + 15. * fourth(c) * c;
        }
      else
        {
          const double t = 2. - q;
          return q < 1. ? 2. / 3. + q * q * (0.5 * q - 1.) : t * t * t / 6.;
        }
    }

    /// -W'(q)/q. The quadratic kernel has a cone's tip at q = 0, where this
    /// has no limit; it is bounded there.
    template <KernelKind kind>
    double
    gradient_weight(const double q)
    {
      if (q >= support(kind))
        return 0.;
      if constexpr (kind == KernelKind::wendland_c2)
        {
          const double t = 1. - 0.5 * q;
          return 5. * t * t * t;
        }
      else if constexpr (kind == KernelKind::quadratic)
        return 0.75 * (2. - q) / std::max(q, 1e-6);
      else if constexpr (kind == KernelKind::quintic_spline)
        {
          if (q < 1.) // the same polynomial without the division by q
            return 120. + q * q * (-120. + 50. * q);
          return 5. * (fourth(3. - q) - 6. * fourth(positive(2. - q))) / q;
        }
      else
        {
          const double t = 2. - q;
          return q < 1. ? 2. - 1.5 * q : 0.5 * t * t / q;
        }
    }

    /// W''(q), of which Swegle's condition T3-32 speaks.
    template <KernelKind kind>
    double
    curvature(const double q)
    {
      if (q >= support(kind))
        return 0.;
      if constexpr (kind == KernelKind::wendland_c2)
        {
          const double t = 1. - 0.5 * q;
          return 5. * t * t * (2. * q - 1.);
        }
      else if constexpr (kind == KernelKind::quadratic)
        return 0.75;
      else if constexpr (kind == KernelKind::quintic_spline)
        {
          const auto cube = [](const double x) { return x * x * x; };
          return 20. * (cube(3. - q) - 6. * cube(positive(2. - q)) +
                        15. * cube(positive(1. - q)));
        }
      else
        return q < 1. ? 3. * q - 2. : 2. - q;
    }

    /// Calls f<kind>() for a kind that is known at run time only.
    template <typename Function>
    auto
    dispatch(const KernelKind kind, const Function &f)
    {
      using Kind = KernelKind;
      switch (kind)
        {
          case Kind::quadratic:
            return f(std::integral_constant<Kind, Kind::quadratic>());
          case Kind::wendland_c2:
            return f(std::integral_constant<Kind, Kind::wendland_c2>());
          case Kind::quintic_spline:
            return f(std::integral_constant<Kind, Kind::quintic_spline>());
          default:
            return f(std::integral_constant<Kind, Kind::cubic_b_spline>());
        }
    }
  } // namespace KernelShapes


  /// A smoothing kernel W(r, h) in two dimensions.
  struct Kernel
  {
    KernelKind kind;
    double     h;             ///< smoothing length [m]
    double     normalisation; ///< so that W integrates to one [1/m^2]

    Kernel(const KernelKind kind, const double h)
        : kind(kind)
        , h(h)
        , normalisation(KernelShapes::normalisation(kind) / (h * h))
    {}

    /// Radius beyond which W is zero [m].
    double
    support() const
    {
      return KernelShapes::support(kind) * h;
    }

    /// W(r) [1/m^2].
    double
    value(const double r) const
    {
      return KernelShapes::dispatch(kind, [&](const auto kind_constant) {
        return normalisation * KernelShapes::value<kind_constant()>(r / h);
      });
    }

    /// -W'(r)/r [1/m^4]: the gradient of W at i is this times (x_j - x_i),
    /// and as a weight it makes the gradient matrix the weighted
    /// least-squares fit of a linear field. Finite at r = 0 but for the
    /// quadratic kernel, where it is cut off.
    double
    gradient_weight(const double r) const
    {
      return KernelShapes::dispatch(kind, [&](const auto kind_constant) {
        return normalisation / (h * h) *
               KernelShapes::gradient_weight<kind_constant()>(r / h);
      });
    }

    /// W'(r) [1/m^3].
    double
    slope(const double r) const
    {
      return -r * gradient_weight(r);
    }

    /// W''(r) [1/m^4]; by Swegle, Hicks and Attaway (1995) a stress sigma is
    /// unstable where W'' sigma > 0 at the nearest neighbours (T3-32).
    double
    curvature(const double r) const
    {
      return KernelShapes::dispatch(kind, [&](const auto kind_constant) {
        return normalisation / (h * h) *
               KernelShapes::curvature<kind_constant()>(r / h);
      });
    }
  };
} // namespace Morsel

#endif
