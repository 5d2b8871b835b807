#include "guards.h"

#include <morsel/core/parallel.h>
#include <morsel/core/suggestions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <sstream>

namespace Morsel
{
  namespace
  {
    /// A jump of the velocity by c is a strain of 1, and a free surface doubles
    /// it: beyond twice the speed of sound there is no solid.
    constexpr double speeds_of_sound = 2.;

    /// Of the ledger's largest term. The worst of the gallery is at 0.033.
    constexpr double largest_gap = 0.1;

    /// Below the energy of this strain everywhere a ledger may be open without
    /// harm: first touches of contact are rough, but small.
    constexpr double noticeable_strain_energy = 1e-7; ///< over E [1]

    /// Years of computing.
    constexpr double most_steps = 1e12;


    std::string
    particle_text(const SPH::Particles &p, const unsigned int i)
    {
      std::ostringstream text;
      text << "particle " << p.id[i] << ", at first at (" << p.reference[i]
           << ") m";
      return text.str();
    }


    bool
    is_finite(const Motion &m)
    {
      return std::isfinite(m.u_x + m.u_y + m.v_x + m.v_y);
    }


    /// The more serious one of two.
    void
    take_worse(std::optional<Finding> &worst, std::optional<Finding> &&found)
    {
      if (found && (!worst || found->kind < worst->kind))
        worst = std::move(found);
    }


    /// Whether a particle is not finite or faster than @p fastest [m/s].
    bool
    has_outlier(const SPH::Particles &p, const double fastest)
    {
      const double      most  = std::numeric_limits<double>::max();
      std::atomic<bool> found = false;
      parallel_for(
          p.n_owned,
          [&](const unsigned int begin, const unsigned int end) {
            // No comparison with what is no number holds.
            bool sound = true;
            for (unsigned int i = begin; i < end; ++i)
              {
                const Motion &m = p.motion[i];
                sound &= std::abs(m.u_x) + std::abs(m.u_y) <= most;
                sound &= m.v_x * m.v_x + m.v_y * m.v_y <= fastest * fastest;
              }
            if (!sound)
              found = true;
          },
          2048);
      return found;
    }


    /// The finding of the rank that has the most serious one, on all ranks.
    std::optional<Finding>
    agree(const std::optional<Finding> &mine, const MPI_Comm communicator)
    {
      namespace MPI      = dealii::Utilities::MPI;
      const int n_ranks  = MPI::n_mpi_processes(communicator);
      const int rank     = MPI::this_mpi_process(communicator);
      const int severity = mine ? 100 - static_cast<int>(mine->kind) : 0;
      const int worst =
          MPI::max(mine ? severity * n_ranks + rank : 0, communicator);
      if (worst == 0)
        return {};
      const unsigned int       speaker = worst % n_ranks;
      std::vector<std::string> texts;
      if (mine)
        texts = {mine->what, mine->cause, mine->remedy};
      texts = MPI::broadcast(communicator, texts, speaker);
      return Finding{static_cast<Finding::Kind>(100 - worst / n_ranks),
                     texts[0],
                     texts[1],
                     texts[2]};
    }


    const char *const hard_load =
        "a load, an impact or a closure that the material's law does not bear";
    const char *const softer_load =
        "lower loads and velocities, or let the body break ('Damage/Enabled')";
  } // namespace


  std::string
  sentence(const Finding &finding, const Moment &moment, const Verdict &verdict)
  {
    std::ostringstream text;
    text << finding.what << ", at time " << moment.time << " s, step "
         << moment.step;
    const bool large = moment.time_step > (1. + 1e-9) * moment.safe_time_step;
    if (!finding.may_be_the_step())
      text << ": the likely cause is " << finding.cause << "; "
           << finding.remedy;
    else if (large)
      text << ": the likely cause is the time step of " << moment.time_step
           << " s, " << moment.time_step / moment.safe_time_step
           << " times the largest that is safe; leave 'Time/Time step' at 0 "
              "and 'Solid/CFL factor' at 1 or less, or take at most "
           << moment.safe_time_step << " s";
    else if (finding.cause.empty() && !verdict.tried.empty())
      text << "; steps down to " << verdict.tried.back() << " s ended alike";
    else if (!finding.cause.empty() && !verdict.tried.empty())
      text << ": steps down to " << verdict.tried.back()
           << " s ended alike, so that the likely cause is " << finding.cause
           << ", not the step; " << finding.remedy;
    else if (!finding.cause.empty())
      text << ": the likely cause is " << finding.cause << ", or the step of "
           << moment.time_step << " s; " << finding.remedy
           << ", or take a smaller 'Time/Time step'";
    if (!verdict.kept.empty())
      text << "; " << verdict.kept;
    text << '.';
    return text.str();
  }


  Guards::Guards(const GuardedSystem &system)
      : system(system)
  {
    for (const GuardedBody &guarded : system.bodies)
      {
        const auto &p        = guarded.body->get_particles();
        const auto &material = guarded.body->get_material();
        fastest              = std::max(fastest, material.wave_speed);
        double area          = 0.;
        for (unsigned int i = 0; i < p.n_owned; ++i)
          area += p.area[i];
        noticeable += noticeable_strain_energy * material.youngs_modulus *
                      p.depth *
                      dealii::Utilities::MPI::sum(area, system.communicator);
      }
    fastest = speeds_of_sound * fastest + system.given_speed;
  }


  std::optional<Finding>
  Guards::check_step(const Moment &moment) const
  {
    const double dt = moment.time_step;
    if (dt > 0. && std::isfinite(dt) && moment.time + dt > moment.time &&
        (system.end_time - moment.time) / dt < most_steps)
      return {};
    std::ostringstream what;
    what << "The time step has become as small as " << dt
         << " s, which would take " << (system.end_time - moment.time) / dt
         << " steps to the end";
    return Finding{Finding::Kind::step,
                   what.str(),
                   "particles far smaller than the others, or a material far "
                   "too stiff or light",
                   "look at shapes, spacings, moduli and densities, or set "
                   "'Time/Time step'"};
  }


  std::optional<Finding>
  Guards::check_particles() const
  {
    std::optional<Finding> worst;
    for (const GuardedBody &guarded : system.bodies)
      take_worse(worst, check_body(guarded));
    return agree(worst, system.communicator);
  }


  std::optional<Finding>
  Guards::check_contacts() const
  {
    if (system.contacts.empty())
      return {};
    std::optional<Finding> worst;
    for (const GuardedContact &guarded : system.contacts)
      take_worse(worst, check_contact(guarded));
    return agree(worst, system.communicator);
  }


  std::optional<Finding>
  Guards::check_body(const GuardedBody &guarded) const
  {
    const SPH::Particles &p        = guarded.body->get_particles();
    const bool            outlier  = has_outlier(p, fastest);
    const long            inverted = guarded.body->first_inverted();
    if (!outlier && inverted < 0)
      return {};
    std::ostringstream what;
    const std::string  of_body = " of body '" + guarded.name + "' ";
    for (unsigned int i = 0; outlier && i < p.n_owned; ++i)
      if (!is_finite(p.motion[i]))
        {
          what << "The motion" << of_body << "is not finite any more ("
               << particle_text(p, i) << ")";
          return Finding{
              Finding::Kind::not_finite, what.str(), hard_load, softer_load};
        }
    if (inverted >= 0)
      {
        what << "A particle" << of_body << "has turned inside out ("
             << particle_text(p, inverted) << ", now at ("
             << p.position(inverted) << ") m)";
        return Finding{
            Finding::Kind::inverted, what.str(), hard_load, softer_load};
      }
    for (unsigned int i = 0; outlier && i < p.n_owned; ++i)
      if (const Motion &m = p.motion[i]; std::hypot(m.v_x, m.v_y) > fastest)
        {
          what << "A particle" << of_body << "runs away ("
               << particle_text(p, i) << ", moves with "
               << std::hypot(m.v_x, m.v_y) << " m/s, allowed are " << fastest
               << " m/s: twice the speed of sound over what the scene gives)";
          return Finding{
              Finding::Kind::too_fast,
              what.str(),
              "a load that accelerates the body without end, or an impact "
              "faster than sound",
              "lower loads and velocities or end the run earlier"};
        }
    return {};
  }


  std::optional<Finding>
  Guards::check_contact(const GuardedContact &guarded) const
  {
    const double depth = guarded.penetration();
    if (depth <= guarded.deepest)
      return {};
    std::ostringstream what;
    what << "Body '" << guarded.first << "' is " << depth << " m deep in '"
         << guarded.second << "', more than the contact can hold ("
         << guarded.deepest << " m)";
    return Finding{Finding::Kind::too_deep,
                   what.str(),
                   "a contact that is too soft for the load, or bodies that "
                   "begin in each other",
                   "raise 'Contact/Stiffness', lower loads and velocities or "
                   "move the bodies apart"};
  }


  bool
  Guards::closes_well(const Measure::Energies     &energies,
                      const Measure::EnergyLedger &ledger) const
  {
    // Also of energies too small to be noticed: in them noise begins.
    return ledger.gap(energies) <=
           0.1 * largest_gap * ledger.largest_term(energies);
  }


  std::optional<Finding>
  Guards::check_energy(const Measure::Energies     &energies,
                       const Measure::EnergyLedger &ledger) const
  {
    const double gap     = ledger.gap(energies);
    const double largest = ledger.largest_term(energies);
    if (std::isfinite(gap) &&
        (gap <= largest_gap * largest || largest <= noticeable))
      return {};
    std::ostringstream what;
    if (!std::isfinite(gap))
      return Finding{Finding::Kind::not_finite,
                     "The energy is not finite any more",
                     hard_load,
                     softer_load};
    what << "The energy ledger does not close any more (its gap is " << gap
         << " J, " << 100. * gap / largest
         << " % of its largest term; energy appears or vanishes)";
    return Finding{Finding::Kind::energy,
                   what.str(),
                   "a contact that is too stiff or a load that jumps",
                   "lower 'Solid/CFL factor' or 'Contact/Stiffness', or let "
                   "loads set in smoothly"};
  }
} // namespace Morsel
