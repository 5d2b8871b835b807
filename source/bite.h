#ifndef morsel_source_bite_h
#define morsel_source_bite_h

#include "guards.h"
#include "run_state.h"

#include <morsel/contact/plate_contact.h>
#include <morsel/core/log.h>
#include <morsel/core/state_archive_fwd.h>
#include <morsel/core/step_clock.h>
#include <morsel/jaw/plate.h>
#include <morsel/measure/energy_ledger.h>
#include <morsel/scene/scene.h>
#include <morsel/sph/applied_conditions.h>
#include <morsel/sph/body_contact.h>
#include <morsel/sph/solid.h>

#include <memory>
#include <vector>

namespace Morsel
{
  /// The mechanical system of a scene: particle bodies, plates and the
  /// contacts between them, and one step of it.
  class Bite
  {
  public:
    /// @param partition of the particle bodies, see ParticleHost
    Bite(const Scene::Scene &scene,
         MPI_Comm            communicator,
         RunLog             &log,
         const Partition    &partition = {});

    /// Forces, contact and accounts at the present positions.
    void
    evaluate();

    /// Damage growth, then everything moves on to the next time.
    void
    advance();

    double
    time() const
    {
      return clock.time();
    }

    double
    time_step() const
    {
      return clock.time_step();
    }

    unsigned long long
    step() const
    {
      return clock.step();
    }

    /// The largest that should do, whatever the scene says [s].
    double
    safe_time_step() const;

    /// As the forces themselves say, see SPH::Solid [s]; plates count by
    /// their rules. Before the first evaluate(); collective.
    double
    measured_stable_step();

    /// The steps from now on [s]; before evaluate().
    void
    change_time_step(double time_step);

    /// What the guards look at; as long as this object lives.
    GuardedSystem
    guarded() const;

    /// How far the plates have approached each other along the closing
    /// direction [m].
    double
    closure() const;

    /// 1 for plates that close along the closing axis, -1 for those against.
    double
    towards_food(const unsigned int plate) const
    {
      return ways_to_food[plate];
    }

    /// Force of the food on a plate along the closing direction, positive in
    /// compression, and across it [N]; the same on all ranks.
    double
    normal_force(const unsigned int plate) const
    {
      return plate_forces[2 * plate];
    }

    double
    tangential_force(const unsigned int plate) const
    {
      return std::abs(plate_forces[2 * plate + 1]);
    }

    /// Everything in joules at the last evaluate().
    Measure::Energies
    energies() const;

    dealii::Tensor<1, 2>
    momentum() const;

    /// Sum over all that momentum() is of [kg m/s].
    double
    masses_times_speeds() const;

    /// Impulses of the plates [N s].
    std::vector<dealii::Tensor<1, 2>>
    impulses() const;

    double
    deepest_penetration() const;

    const SPH::Solid &
    food() const
    {
      return *solids.front();
    }

    /// Those that the ranks share.
    std::vector<const SPH::Solid *>
    shared_bodies() const;

    const std::vector<std::unique_ptr<SPH::Solid>> &
    get_solids() const
    {
      return solids;
    }

    const std::vector<Jaw::Plate> &
    get_plates() const
    {
      return plates;
    }

    /// rigid, quasi-static or dynamic.
    const std::string &
    response(const unsigned int plate) const
    {
      return responses[plate];
    }

    /// Drives that answer the food, each once, with the name of what they
    /// move.
    std::vector<std::pair<std::string, const Jaw::InertialDrive *>>
    inertial_drives() const;

    /// What plates that such a drive moves have given to the food so far [J];
    /// the same on all ranks.
    double
    work_on_food(const Jaw::InertialDrive &drive) const;

    /// 0 = x, 1 = y: along which the plates close.
    unsigned int
    closing_axis() const
    {
      return axis;
    }

    /// Total of the bodies' particles over all ranks.
    unsigned long long
    particle_count() const;

    /// Saves or loads everything that changes, between advance() and the next
    /// evaluate().
    void
    exchange_state(StateArchive &state);

  private:
    struct Pair
    {
      unsigned int                           solid, plate;
      std::unique_ptr<Contact::PlateContact> contact;
    };

    /// The nodes of one plate on the surface of another.
    struct Meeting
    {
      unsigned int                           first, second;
      std::unique_ptr<Contact::PlateContact> contact;
      double                                 foundation; ///< springs [N/m^2]
      std::vector<dealii::Point<2>>          places;     ///< of nodes at first
      std::vector<Motion>                    motion;     ///< of nodes
    };

    /// Two particle bodies.
    struct Neighbours
    {
      unsigned int                      first, second;
      std::unique_ptr<SPH::BodyContact> contact;
    };

    void
    find_closing_axis();

    void
    find_ways_to_food();

    void
    make_plates(std::vector<std::unique_ptr<FE::ElasticBody>> &elastic);

    void
    make_pairs();

    void
    make_meetings();

    void
    make_neighbours();

    /// Limits the step by drives whose mass the food pushes.
    void
    limit_step_by_drives();

    void
    limit_step_by_meetings(
        const std::vector<std::unique_ptr<FE::ElasticBody>> &elastic);

    void
    meet(Meeting &meeting);

    /// Forces between food and plates, and between plates.
    void
    touch();

    /// Forces on the food, by plates, conditions and other food.
    void
    load_food();

    /// Chooses how elastic plates answer, and a step that suits it.
    void
    set_up_deformations(
        std::vector<std::unique_ptr<FE::ElasticBody>> &&elastic);

    void
    limit_step_by_plates(
        const std::vector<std::unique_ptr<FE::ElasticBody>> &elastic);

    /// Whether Newmark's beta of a plate is left to what suits the contact.
    bool
    chooses_beta(
        unsigned int                                         plate,
        const std::vector<std::unique_ptr<FE::ElasticBody>> &elastic) const;

    /// The same with Newmark's betas as they are.
    void
    limit_step_by_dynamic_plates(
        const std::vector<std::unique_ptr<FE::ElasticBody>> &elastic);

    /// Share of a plate's stiffness that carries springs of contact besides
    /// its mass, 4/dt^2 (M + share K) > K_contact [s^2].
    double
    carried_share(unsigned int plate) const;

    /// Tells those whose own integration knows the step.
    void
    adapt_to_time_step();

    /// Of particles that stick to plates with inertia.
    void
    set_slipping_masses();

    void
    press(Pair &pair);

    /// Brings a plate without inertia into equilibrium with the food.
    void
    settle(unsigned int plate);

    void
    mark_loaded_faces();

    /// @name All at once, over all ranks.
    ///@{
    void
    begin_sum_of_plate_forces();

    void
    finish_sum_of_plate_forces();
    ///@}

    double
    stable_time_step() const;

    /// Of the contacts that a particle of a body may be in at once [N/m].
    double
    contact_stiffness(unsigned int solid) const;

    /// Share of a particle's slip that friction on plates takes in each step.
    double
    stopped_slip() const;

    /// The step that the scene names, or the automatic one.
    void
    choose_time_step();

    const Scene::Scene &scene;
    const MPI_Comm      communicator;
    RunLog             &log;

    std::vector<std::unique_ptr<SPH::Solid>> solids;
    std::vector<Jaw::Plate>                  plates;
    std::vector<std::string>                 responses; ///< of the plates
    std::vector<double>                      betas;     ///< Newmark's, of them
    /// Along and across the closing direction, at the last evaluate() [N].
    std::vector<double> plate_forces;
    MPI_Request         plate_forces_travel = MPI_REQUEST_NULL;
    std::vector<std::shared_ptr<Jaw::Drive>> drives;  ///< each once
    std::vector<double>                 ways_to_food; ///< 1 or -1, by plate
    std::vector<Pair>                   pairs;
    std::vector<Meeting>                meetings;
    std::vector<Neighbours>             neighbours;
    std::vector<SPH::AppliedConditions> conditions; ///< none, or by solid

    /// Largest squares of frequencies of plates on contact springs [1/s^2].
    std::vector<double> plate_frequencies;
    bool                deforms = false; ///< whether any plate does

    unsigned int axis = 1;
    StepClock    clock;
    double       automatic_step = 0.; ///< [s]
  };
} // namespace Morsel

#endif
