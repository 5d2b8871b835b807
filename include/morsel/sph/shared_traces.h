#ifndef morsel_sph_shared_traces_h
#define morsel_sph_shared_traces_h

#include <morsel/sph/host.h>
#include <morsel/sph/local_numbers.h>
#include <morsel/sph/velocity_constraints.h>

#include <vector>

namespace Morsel::SPH
{
  /// A prescribed trace by the ids of its particles, whoever owns them.
  struct WholeTrace
  {
    unsigned long long              number; ///< unique in its condition
    std::vector<unsigned long long> id;
    std::vector<double>             weight; ///< [1]
  };


  /// The traces of one condition that a rank has to do with.
  struct TracesOfCondition
  {
    bool                    prescribes[2]; ///< x and y
    std::vector<WholeTrace> traces;
  };


  /// The traces that all ranks work on together, since their particles belong
  /// to several ranks, or since they are coupled with others: then whether
  /// their targets contradict each other has to be said by all ranks, and only
  /// where sides meet there are any. Every rank knows all of them.
  struct SharedTraces
  {
    /// By condition; their particles are places in mass.
    std::vector<std::vector<Prescribed>> prescribed;
    std::vector<unsigned long long>      id;   ///< of the particles
    std::vector<double>                  mass; ///< of the particles [kg]
  };


  /// Takes out what is shared, and the traces that are of no concern to this
  /// rank. Collective.
  /// @param conditions all ranks give the same ones; a trace is given by each
  ///   rank that owns some of its particles at least
  /// @param owned where this rank's particles stand
  SharedTraces
  take_shared_traces(std::vector<TracesOfCondition> &conditions,
                     const LocalNumbers             &owned,
                     const Particles                &particles,
                     const ParticleHost<2>          &ranks);


  /// The part of a trace that is of this rank's particles, by their places.
  /// @param id of the particles that the trace goes by
  Trace
  part_of_rank(const Trace                           &trace,
               const std::vector<unsigned long long> &id,
               const LocalNumbers                    &owned);
} // namespace Morsel::SPH

#endif
