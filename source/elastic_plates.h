#ifndef morsel_source_elastic_plates_h
#define morsel_source_elastic_plates_h

#include <morsel/core/log.h>
#include <morsel/fe/elastic_body.h>
#include <morsel/scene/scene.h>

#include <memory>
#include <string>

namespace Morsel
{
  /// The finite elements of an elastic plate.
  std::unique_ptr<FE::ElasticBody>
  make_elastic_body(const Scene::Scene &scene, const Scene::PlateBody &plate);


  /// Makes those that have cracks for a trial, so that their mistakes are told
  /// before anything is written.
  /// @throws InputError
  void
  check_cracked_bodies(const Scene::Scene &scene);


  /// How a plate answers the food, and why.
  struct ResponseChoice
  {
    std::string response; ///< rigid, quasi-static or dynamic
    std::string reason;
  };


  /// The response that the scene names or, for 'auto', the simplest that does.
  /// Both judgements rest on one solution: the body under a uniform pressure
  /// where it faces the food. What it yields over what the food does under the
  /// same pressure (H/E') does not depend on the pressure; and this deflection
  /// gives its lowest frequency by Rayleigh's quotient u.K u/u.M u.
  ResponseChoice
  choose_response(const Scene::Scene     &scene,
                  const Scene::PlateBody &plate,
                  const FE::ElasticBody  &body);
} // namespace Morsel

#endif
