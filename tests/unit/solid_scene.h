#ifndef morsel_tests_solid_scene_h
#define morsel_tests_solid_scene_h

#include <morsel/scene/scene.h>
#include <morsel/sph/solid.h>
#include <morsel/sph/updated_lagrangian.h>

#include <algorithm>
#include <memory>
#include <string>

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


  /// A block between two plates that close on it along y.
  inline Scene::Scene
  scene_of_stroke(const unsigned int n, const double speed, const double ramp)
  {
    constexpr double h     = 0.01;
    Scene::Scene     scene = scene_of_block(n, n, h / n, 0.3);
    for (const bool upper : {false, true})
      {
        Scene::PlateBody body;
        body.name               = upper ? "upper" : "lower";
        body.shape.lower_corner = {-h, upper ? h : -0.1 * h};
        body.shape.upper_corner = {2. * h, upper ? 1.1 * h : 0.};
        body.motion.velocity    = {0., upper ? -speed : 0.};
        body.motion.ramp_time   = ramp;
        scene.plate_bodies.push_back(body);
        scene.contact_pairs.push_back({"block", body.name});
      }
    scene.contact.friction = 0.;
    return scene;
  }


  /// A scene with one block of linear elastic particles about the origin
  /// without viscosity, for bodies of any formulation.
  inline Scene::Scene
  scene_of_formulation(const std::string &formulation,
                       const unsigned int nx,
                       const unsigned int ny,
                       const double       spacing)
  {
    Scene::Scene               scene = scene_of_block(nx, ny, spacing, 0.3);
    auto                      &body  = scene.particle_bodies.front();
    const dealii::Tensor<1, 2> half  = 0.5 * body.shape.upper_corner;
    scene.depth                      = 1.;
    scene.domain.lower_corner        = {-1., -1.};
    scene.domain.upper_corner        = {1., 1.};
    body.shape.lower_corner -= half;
    body.shape.upper_corner -= half;
    body.material.density        = 1000.;
    body.material.youngs_modulus = 1e7;
    body.material.law            = "linear";
    body.solid.viscosity         = "off";
    body.solid.formulation       = formulation;
    return scene;
  }


  inline std::unique_ptr<DeformableBody>
  make_body(const Scene::Scene &scene)
  {
    const auto &body = scene.particle_bodies.front();
    if (body.solid.is_updated())
      return std::make_unique<UpdatedLagrangian>(body, scene);
    return std::make_unique<Solid>(body, scene, MPI_COMM_SELF);
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
  mechanical_energy(const Solid &solid)
  {
    const auto e = solid.energies();
    return e.strain + e.hourglass + e.kinetic;
  }
} // namespace Morsel::SPH

#endif
