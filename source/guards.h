#ifndef morsel_source_guards_h
#define morsel_source_guards_h

#include <morsel/measure/energy_ledger.h>
#include <morsel/sph/deformable_body.h>

#include <mpi.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace Morsel
{
  /// A body of particles as the guards see it.
  struct GuardedBody
  {
    std::string                name;
    const SPH::DeformableBody *body;
  };


  /// A contact as the guards see it.
  struct GuardedContact
  {
    std::string first, second; ///< names of the bodies
    /// How deep they are in each other, at the last evaluation [m].
    std::function<double()> penetration;
    double                  deepest; ///< that the contact's law can hold [m]
  };


  /// A mechanical system as the guards see it.
  struct GuardedSystem
  {
    std::vector<GuardedBody>    bodies;
    std::vector<GuardedContact> contacts;
    /// The fastest of what the scene prescribes and throws [m/s].
    double   given_speed = 0.;
    double   end_time    = 0.; ///< [s]
    MPI_Comm communicator;
  };


  /// When something is checked.
  struct Moment
  {
    double             time;           ///< [s]
    unsigned long long step;           ///< number of steps done
    double             time_step;      ///< [s]
    double             safe_time_step; ///< the largest that should do [s]
  };


  /// What a guard says.
  struct Finding
  {
    enum class Kind
    {
      not_finite,
      inverted,
      too_fast,
      too_deep,
      energy,
      step,
      solver
    };

    Kind        kind;
    std::string what;   ///< which quantity, body, particle, place
    std::string cause;  ///< unless the step is too large; empty: see what
    std::string remedy; ///< in that case

    /// Whether a smaller step may help.
    bool
    may_be_the_step() const
    {
      return kind != Kind::step;
    }
  };


  /// What became of a finding that stops the run.
  struct Verdict
  {
    /// Steps with which it was tried again [s], and in vain.
    std::vector<double> tried;
    std::string         kept; ///< which good state is kept and where
  };


  /// One sentence: what, where, when, why, what to change.
  std::string
  sentence(const Finding &finding,
           const Moment  &moment,
           const Verdict &verdict);


  /// Watches over a run's numbers, always, for less than a hundredth of its
  /// time: what no sound simulation does stops it. All ranks get the same
  /// answer; checks are collective.
  class Guards
  {
  public:
    explicit Guards(const GuardedSystem &system);

    /// Whether the step leads anywhere: before the first one and after each
    /// change.
    std::optional<Finding>
    check_step(const Moment &moment) const;

    /// Whether particles are finite, not inside out and not too fast.
    std::optional<Finding>
    check_particles() const;

    /// Whether bodies are not too deep in each other.
    std::optional<Finding>
    check_contacts() const;

    /// Whether the ledger is open by no more than a tenth of what stops a run:
    /// then the state is one to go back to.
    bool
    closes_well(const Measure::Energies     &energies,
                const Measure::EnergyLedger &ledger) const;

    /// Whether energy comes from nowhere.
    /// @param ledger that knows what there was at first
    std::optional<Finding>
    check_energy(const Measure::Energies     &energies,
                 const Measure::EnergyLedger &ledger) const;

    /// Speed [m/s] beyond which a particle runs away.
    double
    fastest_speed() const
    {
      return fastest;
    }

    /// Energy [J] below which a ledger may be open.
    double
    noticeable_energy() const
    {
      return noticeable;
    }

  private:
    /// Of this rank.
    std::optional<Finding>
    check_body(const GuardedBody &guarded) const;

    std::optional<Finding>
    check_contact(const GuardedContact &guarded) const;

    const GuardedSystem system;
    double              fastest    = 0.;
    double              noticeable = 0.;
  };
} // namespace Morsel

#endif
