#include <morsel/measure/energy_ledger.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Measure
{
  double
  Energies::stored() const
  {
    return strain + hourglass + kinetic + contact + granular + plate_strain +
           plate_kinetic;
  }


  double
  Energies::dissipated() const
  {
    return dissipated_viscosity + dissipated_damage + dissipated_bonds +
           dissipated_friction + dissipated_granular_friction +
           dissipated_damping + dissipated_artificial_stress;
  }


  double
  Energies::largest_term() const
  {
    return std::max({std::abs(strain),
                     std::abs(hourglass),
                     std::abs(kinetic),
                     std::abs(contact),
                     std::abs(granular),
                     std::abs(plate_strain),
                     std::abs(plate_kinetic),
                     std::abs(external_work),
                     std::abs(dissipated_viscosity),
                     std::abs(dissipated_damage),
                     std::abs(dissipated_bonds),
                     std::abs(dissipated_friction),
                     std::abs(dissipated_granular_friction),
                     std::abs(dissipated_damping),
                     std::abs(dissipated_artificial_stress)});
  }


  EnergyLedger::EnergyLedger(const Energies &initial)
      : initial(initial.stored())
      , largest(initial.largest_term())
      , last_sample(initial)
  {}


  double
  EnergyLedger::record(const Energies &energies, const double force)
  {
    last_sample          = energies;
    largest              = largest_term(energies);
    const double gap_now = gap(energies);
    error_last           = largest > 0. ? gap_now / largest : 0.;
    worst_gap            = std::max(worst_gap, gap_now);
    if (force > peak_force)
      {
        peak_force  = force;
        error_peak  = error_last;
        peak_sample = energies;
      }
    return error_last;
  }


  double
  EnergyLedger::gap(const Energies &energies) const
  {
    return std::abs(energies.external_work + initial - energies.stored() -
                    energies.dissipated());
  }


  double
  EnergyLedger::largest_term(const Energies &energies) const
  {
    return std::max(largest, energies.largest_term());
  }


  double
  EnergyLedger::error_at_peak() const
  {
    return error_peak;
  }


  double
  EnergyLedger::error_at_end() const
  {
    return error_last;
  }


  double
  EnergyLedger::largest_error() const
  {
    return largest > 0. ? worst_gap / largest : 0.;
  }


  const Energies &
  EnergyLedger::last() const
  {
    return last_sample;
  }


  const Energies &
  EnergyLedger::at_peak() const
  {
    return peak_sample;
  }


  MomentumLedger::MomentumLedger(const dealii::Tensor<1, 2> &initial,
                                 const double masses_times_speeds)
      : initial(initial)
      , largest(masses_times_speeds)
  {}


  double
  MomentumLedger::record(const dealii::Tensor<1, 2> &momentum,
                         const double                masses_times_speeds,
                         const std::vector<dealii::Tensor<1, 2>> &impulses)
  {
    dealii::Tensor<1, 2> unexplained = momentum - initial;
    largest                          = std::max(largest, masses_times_speeds);
    for (const auto &impulse : impulses)
      {
        unexplained -= impulse;
        largest = std::max(largest, impulse.norm());
      }
    error_last = largest > 0. ? unexplained.norm() / largest : 0.;
    worst_gap  = std::max(worst_gap, unexplained.norm());
    return error_last;
  }


  double
  MomentumLedger::error() const
  {
    return error_last;
  }


  double
  MomentumLedger::largest_error() const
  {
    return largest > 0. ? worst_gap / largest : 0.;
  }
} // namespace Morsel::Measure
