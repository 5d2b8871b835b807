#ifndef morsel_measure_energy_ledger_h
#define morsel_measure_energy_ledger_h

#include <morsel/core/state_archive_fwd.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace Morsel::Measure
{
  /// Where the energy is, or went [J]; the dissipated ones and the work are
  /// sums since the beginning.
  struct Energies
  {
    double strain    = 0.;
    double hourglass = 0.;
    double kinetic   = 0.;
    double contact   = 0.; ///< stored in the contact springs
    double granular  = 0.; ///< stored in the response of failed food

    double plate_strain  = 0.; ///< in plates that deform
    double plate_kinetic = 0.; ///< of plates that deform and have inertia

    double external_work = 0.; ///< done by the plates on what is simulated

    double dissipated_viscosity         = 0.;
    double dissipated_damage            = 0.;
    double dissipated_bonds             = 0.; ///< stored in bonds that broke
    double dissipated_friction          = 0.;
    double dissipated_granular_friction = 0.;
    double dissipated_damping           = 0.;
    double dissipated_artificial_stress = 0.; ///< may be negative

    double
    stored() const;

    double
    dissipated() const;

    /// The largest of all terms, by magnitude.
    double
    largest_term() const;
  };


  /// Keeps the account of energy: what was there at first and what the plates
  /// put in has to be stored or dissipated.
  ///
  /// The closing error is |work + initial - stored - dissipated| over the
  /// largest term that the ledger has seen so far; 0 while all terms are 0.
  class EnergyLedger
  {
  public:
    /// @param initial what is stored at the beginning.
    explicit EnergyLedger(const Energies &initial);

    /// @param force the measure of loading whose peak is looked for: the mean
    ///   of the plates' normal forces [N].
    /// @return the closing error now [1].
    double
    record(const Energies &energies, double force);

    /// |work + initial - stored - dissipated| [J], without recording it; not a
    /// number if a term is not.
    double
    gap(const Energies &energies) const;

    /// Seen so far or now [J].
    double
    largest_term(const Energies &energies) const;

    double
    error_at_peak() const;

    /// The closing error of the last sample.
    double
    error_at_end() const;

    /// The largest gap of all samples, over the largest term.
    double
    largest_error() const;

    /// The last sample.
    const Energies &
    last() const;

    /// The sample of the largest force.
    const Energies &
    at_peak() const;

    void
    exchange_state(StateArchive &state);

  private:
    double   initial;
    double   largest    = 0.;
    double   peak_force = 0.;
    double   error_peak = 0.;
    double   error_last = 0.;
    double   worst_gap  = 0.;
    Energies last_sample, peak_sample;
  };


  /// Keeps the account of linear momentum: it changes by the impulses that
  /// the plates (and other loads) give, and by nothing else.
  ///
  /// The error is |momentum - initial - sum of impulses| over the largest sum
  /// of masses times speeds or single impulse that was seen so far, so that it
  /// means the same where the parts of a body move against each other and the
  /// sum of their momenta is zero; 0 while all are 0.
  class MomentumLedger
  {
  public:
    MomentumLedger(const dealii::Tensor<1, 2> &initial,
                   double                      masses_times_speeds);

    /// @param momentum of what is simulated [kg m/s].
    /// @param masses_times_speeds of its parts, at least |momentum| [kg m/s].
    /// @param impulses given to it since the beginning, by each load [N s].
    /// @return the error now [1].
    double
    record(const dealii::Tensor<1, 2>              &momentum,
           double                                   masses_times_speeds,
           const std::vector<dealii::Tensor<1, 2>> &impulses);

    /// The error of the last sample.
    double
    error() const;

    /// The largest gap of all samples, over the largest term.
    double
    largest_error() const;

    void
    exchange_state(StateArchive &state);

  private:
    dealii::Tensor<1, 2> initial;
    double               largest;
    double               error_last = 0.;
    double               worst_gap  = 0.;
  };
} // namespace Morsel::Measure

#endif
