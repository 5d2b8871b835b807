#include <morsel/calibrate/problem.h>
#include <morsel/core/errors.h>
#include <morsel/core/parameters.h>
#include <morsel/core/suggestions.h>
#include <morsel/fracture_run.h>
#include <morsel/scene/read.h>
#include <morsel/study/record.h>
#include <morsel/study/study.h>

#include <filesystem>

namespace Morsel::Calibrate
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Material and damage of a body as overrides for a body of another scene.
    std::vector<std::string>
    same_solid(const std::string              &file,
               const std::vector<std::string> &overrides,
               const std::string              &body,
               const std::string              &other_body)
    {
      std::vector<std::string> result;
      for (const auto &[path, value] : Study::scene_values(file, overrides))
        for (const char *part : {"/Material/", "/Damage/"})
          if (const std::string section = "Body " + body + part;
              path.rfind(section, 0) == 0)
            result.push_back("Body " + other_body + part +
                             path.substr(section.size()) + "=" + value);
      return result;
    }


    /// The scene, if it is one that something can be calibrated in.
    Scene::Scene
    read_breaking_scene(const std::string              &file,
                        const std::vector<std::string> &overrides)
    {
      if (Study::has_section(file, "Study") ||
          Study::has_section(file, "Collection"))
        throw InputError("--calibrate: '" + file +
                         "' is a study; give a scene.");
      if (is_fracture_scene(file, overrides))
        throw InputError("--calibrate: '" + file +
                         "' is a cracked plate, which has no damage to "
                         "calibrate; give a scene with a particle body that "
                         "can fail.");
      const Scene::Scene scene = Scene::read_scene(file, overrides);
      const auto        &body  = scene.particle_bodies.front();
      if (!body.damage.enabled)
        throw InputError("--calibrate: '" + file +
                         "' has nothing to calibrate, since 'Body " +
                         body.name + "/Damage/Enabled' is false; set it true.");
      return scene;
    }


    Target
    compression_target(const Problem                  &problem,
                       const Scene::Scene             &scene,
                       const std::vector<std::string> &overrides)
    {
      const CalibrationParameters &p = problem.parameters;
      if (scene.plate_bodies.empty() &&
          p.compression_result == CalibrationParameters().compression_result)
        throw InputError("--calibrate: '" + problem.file +
                         "' has no plates, so nothing measures its "
                         "compressive strength; put the body between two "
                         "rigid bodies, or name another result in "
                         "'Calibration/Compression result'.");
      Target target;
      target.name      = "compressive strength";
      target.value     = p.compressive_strength > 0.
                             ? p.compressive_strength
                             : problem.material.compressive_strength;
      target.scene     = problem.file;
      target.body      = problem.body;
      target.result    = p.compression_result;
      target.overrides = overrides;
      return target;
    }


    Target
    tension_target(const Problem                  &problem,
                   const std::vector<std::string> &overrides)
    {
      const CalibrationParameters &p = problem.parameters;
      const std::string begin        = "--calibrate: '" + problem.file + "': ";
      if (!(p.tensile_strength > 0.))
        throw InputError(begin + "'Calibration/Tension scene' is given, but no "
                                 "'Calibration/Tensile strength' above 0 that "
                                 "it shall reach.");
      if (p.tension_scene.empty())
        throw InputError(begin + "'Calibration/Tensile strength' needs "
                                 "'Calibration/Tension scene', the scene that "
                                 "measures it.");
      Target target;
      target.name  = "tensile strength";
      target.value = p.tensile_strength;
      target.scene = (fs::path(problem.file).parent_path() / p.tension_scene)
                         .lexically_normal()
                         .string();
      target.result = p.tension_result;
      std::error_code error;
      if (!fs::is_regular_file(target.scene, error))
        throw InputError(
            begin + "'Calibration/Tension scene' = '" + p.tension_scene +
            "': There is no file '" + target.scene + "'." +
            did_you_mean(target.scene, files_beside(target.scene)));
      // Which body takes the solid is known once the scene has been read.
      target.body =
          Scene::read_scene(target.scene).particle_bodies.front().name;
      target.overrides =
          same_solid(problem.file, overrides, problem.body, target.body);
      read_breaking_scene(target.scene, target.overrides);
      return target;
    }
  } // namespace


  Problem
  read_problem(const CommandLine &command_line)
  {
    Problem                  problem;
    std::vector<std::string> overrides = command_line.overrides;
    problem.file                       = command_line.scene_file;
    Scene::Scene scene = read_breaking_scene(problem.file, overrides);
    problem.parameters = Scene::read_calibration(problem.file, overrides);
    problem.body       = scene.particle_bodies.front().name;
    if (problem.parameters.particles_across > 0)
      {
        overrides.push_back(
            "Body " + problem.body + "/Particles/Particles across=" +
            std::to_string(problem.parameters.particles_across));
        scene = Scene::read_scene(problem.file, overrides);
      }
    const Scene::ParticleBody &body = scene.particle_bodies.front();
    problem.name                    = scene.name;
    problem.particles_across        = body.particles_across;
    problem.first_seed              = scene.seed;
    problem.material                = body.material;
    problem.damage                  = body.damage;
    problem.targets.push_back(compression_target(problem, scene, overrides));
    if (problem.parameters.tensile_strength > 0. ||
        !problem.parameters.tension_scene.empty())
      problem.targets.push_back(tension_target(problem, overrides));
    return problem;
  }
} // namespace Morsel::Calibrate
