#ifndef morsel_sph_body_contact_h
#define morsel_sph_body_contact_h

#include <morsel/core/records.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/sph/member_exchange.h>
#include <morsel/sph/neighbours.h>
#include <morsel/sph/particles.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace Morsel::SPH
{
  /// Penalty contact between two particle bodies: particles closer than the
  /// mean of their spacings repel each other by a linear spring, with Coulomb
  /// friction of at most what stops the pair within a step, as surfaces do
  /// that breaking has laid bare. Pairs that began closer (bodies side by side
  /// whose particles do not face each other) begin from where they were, so
  /// that nothing is pushed at first.
  ///
  /// Of a pair across ranks both work out the force, from the same numbers, and
  /// each takes what acts on its own particle and half of the energies.
  class BodyContact
  {
  public:
    /// @param stiffness of the springs [N/m]
    /// @param communicator of the ranks that share the bodies. Collective.
    BodyContact(const Particles &first,
                const Particles &second,
                double           stiffness,
                double           friction,
                MPI_Comm         communicator);

    /// Forces at the present positions, for a step of length @p time_step [s].
    /// Collective.
    void
    compute(double time_step);

    /// On this rank's particles.
    const std::vector<ParticleForce> &
    forces_on_first() const
    {
      return sides[0].forces;
    }
    const std::vector<ParticleForce> &
    forces_on_second() const
    {
      return sides[1].forces;
    }

    /// At the last compute(), this rank's part [J].
    double
    stored_energy() const
    {
      return energy;
    }

    /// So far, this rank's part [J].
    double
    friction_heat() const
    {
      return heat;
    }

    /// Of the springs of this rank at the last compute() the most compressed
    /// [m].
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

    void
    exchange_state(StateArchive &state);

  private:
    /// Of a flat row against one that is shifted by half a spacing: two
    /// springs; in a corner three.
    static constexpr double springs_at_once = 3.;

    /// Particles of both bodies; those of other ranks follow this rank's.
    struct Pair
    {
      unsigned int i, j;
      double       distance; ///< where the spring begins [m]
    };

    /// What does not change of a particle of another rank between two searches.
    struct Foreign
    {
      unsigned long long id;
      dealii::Point<2>   place; ///< at the search [m]
      double             mass;  ///< [kg]
    };

    /// What a spring needs to know of a particle.
    struct State
    {
      dealii::Point<2>     x; ///< [m]
      dealii::Tensor<1, 2> v; ///< [m/s]
    };

    /// One of the two bodies.
    struct Side
    {
      explicit Side(const Particles &particles)
          : particles(particles)
      {}

      unsigned long long
      id(unsigned int i) const;

      State
      state(unsigned int i) const;

      double
      mass(unsigned int i) const;

      bool
      owns(const unsigned int i) const
      {
        return i < particles.n_owned;
      }

      bool
      has_moved(double distance) const;

      const Particles              &particles;
      std::vector<dealii::Point<2>> searched; ///< where the owned ones were
      CellGrid                      grid;     ///< of these
      /// Brings its particles to the ranks that have the other body's near
      /// them; null on one rank.
      std::unique_ptr<MemberExchange> exchange;
      std::vector<Foreign>            foreign;
      std::vector<State>              foreign_now;
      std::vector<ParticleForce>      forces;
    };

    /// On any rank.
    bool
    moved_far() const;

    void
    search();

    /// Of one body those near this rank's particles of the other.
    void
    find_foreign(Side &wanted, const Side &other);

    void
    push(const Pair &pair, double time_step);

    const MPI_Comm communicator;
    Side           sides[2];
    const double   k, friction;
    const double   reach;  ///< [m]
    const double   margin; ///< of the search [m]

    std::vector<Pair> pairs;
    /// Distances of pairs that began closer, by ids [m].
    std::map<std::pair<unsigned long long, unsigned long long>, double>
           closer_at_first;
    double energy = 0., heat = 0., penetration = 0.;
  };
} // namespace Morsel::SPH

#endif
