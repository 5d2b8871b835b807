#ifndef morsel_tests_solid_scene_h
#define morsel_tests_solid_scene_h

#include <morsel/scene/scene.h>
#include <morsel/sph/solid.h>

#include <algorithm>

namespace Morsel::SPH
{
  /// A scene with one undamaged block of @p nx by @p ny particles and no
  /// plates, its lower corner in the origin.
  inline Scene::Scene
  scene_of_block(const unsigned int nx,
                 const unsigned int ny,
                 const double       spacing,
                 const double       poissons_ratio)
  {
    Scene::Scene        scene;
    Scene::ParticleBody body;
    scene.depth                        = 0.01;
    body.name                          = "block";
    body.shape.upper_corner            = {nx * spacing, ny * spacing};
    body.particles_across              = nx;
    body.spacing                       = spacing;
    body.material.density              = 1088.;
    body.material.youngs_modulus       = 23.9e6;
    body.material.poissons_ratio       = poissons_ratio;
    body.material.compressive_strength = 101.2e3;
    scene.particle_bodies.push_back(body);
    return scene;
  }


  inline Solid
  make_solid(const Scene::Scene &scene)
  {
    return Solid(scene.particle_bodies[0], scene, MPI_COMM_SELF);
  }


  /// For initial values that no scene can ask for.
  inline Particles &
  state_of(Solid &solid)
  {
    return const_cast<Particles &>(solid.get_particles());
  }


  inline void
  set_velocity(Solid &solid, const unsigned int i, const Vector2 &v)
  {
    Particles &p       = state_of(solid);
    p.half_velocity[i] = v;
    p.motion[i].v_x    = v.x;
    p.motion[i].v_y    = v.y;
  }


  inline double
  mechanical_energy(const Solid &solid, const double dt)
  {
    const auto e = solid.energies(dt);
    return e.strain + e.hourglass + e.kinetic;
  }
} // namespace Morsel::SPH

#endif
