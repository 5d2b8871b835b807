#ifndef morsel_sph_body_contact_h
#define morsel_sph_body_contact_h

#include <morsel/core/records.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/sph/neighbours.h>
#include <morsel/sph/particles.h>

#include <vector>

namespace Morsel::SPH
{
  /// Penalty contact between two particle bodies: particles closer than the
  /// mean of their spacings repel each other by a linear spring, with Coulomb
  /// friction of at most what stops the pair within a step, as surfaces do
  /// that breaking has laid bare. Pairs that began closer (bodies side by side
  /// whose particles do not face each other) begin from where they were, so
  /// that nothing is pushed at first. On one rank.
  class BodyContact
  {
  public:
    /// @param stiffness of the springs [N/m]
    BodyContact(const Particles &first,
                const Particles &second,
                double           stiffness,
                double           friction);

    /// Forces at the present positions, for a step of length @p time_step [s].
    void
    compute(double time_step);

    const std::vector<ParticleForce> &
    forces_on_first() const
    {
      return forces[0];
    }
    const std::vector<ParticleForce> &
    forces_on_second() const
    {
      return forces[1];
    }

    /// At the last compute() [J].
    double
    stored_energy() const
    {
      return energy;
    }

    /// So far [J].
    double
    friction_heat() const
    {
      return heat;
    }

    /// Of the springs at the last compute() the most compressed [m].
    double
    deepest_penetration() const
    {
      return penetration;
    }

    /// Distance of two particles at which their spring begins [m].
    double
    range() const
    {
      return reach;
    }

    /// By which a body's particle may be held: several springs at once
    /// [N/m].
    double
    stiffness() const
    {
      return springs_at_once * k;
    }

    std::size_t
    n_pairs() const
    {
      return pairs.size();
    }

    void
    exchange_state(StateArchive &state);

  private:
    /// Of a flat row against one that is shifted by half a spacing: two
    /// springs; in a corner three.
    static constexpr double springs_at_once = 3.;

    struct Pair
    {
      unsigned int i, j;
      double       distance; ///< where the spring begins [m]
    };

    bool
    moved_far() const;

    void
    search();

    void
    push(const Pair &pair, double time_step);

    const Particles &a, &b;
    const double     k, friction;
    const double     reach;  ///< [m]
    const double     margin; ///< of the search [m]

    std::vector<Pair>             pairs, closer_at_first;
    std::vector<dealii::Point<2>> searched_a, searched_b;
    CellGrid                      grid;
    std::vector<ParticleForce>    forces[2];
    double                        energy = 0., heat = 0., penetration = 0.;
  };
} // namespace Morsel::SPH

#endif
