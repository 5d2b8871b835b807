#ifndef morsel_source_guarded_h
#define morsel_source_guarded_h

#include "guards.h"

#include <morsel/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <memory>

namespace Morsel
{
  /// The largest of the bodies' CFL factors, or 1.
  inline double
  largest_cfl_above_one(const Scene::Scene &scene)
  {
    double largest = 1.;
    for (const auto &body : scene.particle_bodies)
      largest = std::max(largest, body.solid.cfl);
    return largest;
  }


  /// The particle bodies of a scene with their first speeds; collective.
  template <typename Body>
  GuardedSystem
  guarded_bodies(const Scene::Scene                       &scene,
                 const std::vector<std::unique_ptr<Body>> &bodies,
                 const MPI_Comm                            communicator)
  {
    GuardedSystem system;
    system.end_time     = scene.time.end_time;
    system.communicator = communicator;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        system.bodies.push_back(
            {scene.particle_bodies[b].name, bodies[b].get()});
        const auto velocity =
            scene.particle_bodies[b].initial_velocity_function();
        const auto &p = bodies[b]->get_particles();
        for (unsigned int i = 0; i < p.n_owned; ++i)
          system.given_speed =
              std::max(system.given_speed, velocity(p.reference[i]).norm());
      }
    system.given_speed =
        dealii::Utilities::MPI::max(system.given_speed, communicator);
    return system;
  }
} // namespace Morsel

#endif
