#ifndef morsel_materials_grains_h
#define morsel_materials_grains_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <utility>

namespace Morsel::Materials
{
  /// Crystals or grains that differ in stiffness and strength, as in marble.
  struct GrainParameters
  {
    double size             = 0.; ///< mean diameter [m], 0 = no grains
    double modulus_scatter  = 0.; ///< coefficient of variation [1]
    double strength_scatter = 0.; ///< coefficient of variation [1]

    bool
    scatter_modulus() const
    {
      return size > 0. && modulus_scatter > 0.;
    }

    bool
    scatter_strength() const
    {
      return size > 0. && strength_scatter > 0.;
    }

    void
    declare(dealii::ParameterHandler &prm);
  };


  /// Exponent a of E_eff = <E_i> (1 + c^2)^-a, c the coefficient of variation:
  /// in plane strain the modulus of a medium whose isotropic stiffness E_i
  /// scatters at one Poisson's ratio, exact to second order in c.
  ///
  /// To second order C_eff = <C> - c^2 C Gamma C, Gamma averaged over all
  /// directions. Gamma C projects on the strains n (x) a: on two of the three
  /// plane strains, and with k = lambda + mu on the share k/(k + mu) of a
  /// volume change. What is left follows for the modulus 4 k mu/(k + mu).
  double
  homogenisation_exponent(double poissons_ratio);


  /// Grains as the Voronoi cells of random points, one in each square of a
  /// grid fixed to the origin (Voronoi cells on average as large as a square,
  /// and as a circle of the mean diameter). Which grain holds a place, and
  /// what the grain is like, is a function of the place and the seed alone:
  /// the same for all spacings and on any number of ranks. Factors are
  /// log-normal and independent of each other.
  class GrainField
  {
  public:
    /// @param parameters with a size above 0
    GrainField(const GrainParameters &parameters,
               double                 poissons_ratio,
               unsigned int           seed);

    /// The square whose point is nearest.
    std::pair<long, long>
    grain_at(const dealii::Point<2> &x) const;

    /// Elastic moduli over the body's [1], with the arithmetic mean
    /// (1 + c^2)^a by which a large body has the modulus of its material,
    /// see homogenisation_exponent().
    double
    modulus_factor(const dealii::Point<2> &x) const;

    /// Thresholds over those without grains [1], of mean 1.
    double
    strength_factor(const dealii::Point<2> &x) const;

  private:
    /// Log-normal: exp(location + scale z), z standard normal.
    struct LogNormal
    {
      double location, scale;
    };

    double
    factor(const dealii::Point<2> &x,
           const LogNormal        &distribution,
           unsigned int            stream) const;

    const double       side; ///< of a square [m]
    const unsigned int seed;
    const LogNormal    modulus, strength;
  };
} // namespace Morsel::Materials

#endif
