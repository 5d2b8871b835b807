#include "particle_plate_run.h"
#include "xfem_plan.h"
#include "xfem_run.h"

#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/parameters.h>
#include <morsel/fracture_run.h>

#include <deal.II/base/multithread_info.h>

#include <filesystem>

namespace Morsel
{
  using dealii::ParameterHandler;

  namespace
  {
    std::vector<ParameterEntry>
    read_entries(const std::string              &scene_file,
                 const std::vector<std::string> &overrides)
    {
      std::vector<ParameterEntry> entries = read_parameter_file(scene_file);
      for (const std::string &text : overrides)
        entries.push_back(read_override(text));
      return entries;
    }


    /// A plate with every method's section; only that of its own method is
    /// used.
    struct AnyPlate
    {
      FE::PlateParameters      xfem; ///< the scene, too
      SPH::PlateDiscretisation particles;

      void
      declare(ParameterHandler &prm)
      {
        xfem.declare(prm);
        particles.declare(prm);
      }

      bool
      by_particles() const
      {
        return xfem.method == "SPH";
      }

      SPH::PlateParameters
      as_particles() const
      {
        return {xfem, particles};
      }
    };


    /// Sets the plate's members by way of its entries.
    void
    read_plate(AnyPlate                       &plate,
               ParameterHandler               &prm,
               const std::string              &scene_file,
               const std::vector<std::string> &overrides)
    {
      plate.declare(prm);
      set_parameters(prm, read_entries(scene_file, overrides));
      if (plate.xfem.name.empty())
        prm.set("Name", std::filesystem::path(scene_file).stem().string());
    }


    /// UMFPACK is serial.
    void
    check_ranks(const FE::PlateParameters &plate)
    {
      if (plate.solver == "umfpack" &&
          dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        throw InputError("'XFEM/Solver' is 'umfpack', which works on one rank "
                         "only: choose 'multifrontal' or 'iterative'.");
    }


    void
    check_plate(const AnyPlate &plate)
    {
      if (plate.by_particles())
        {
          check(plate.as_particles());
          return;
        }
      check(plate.xfem);
      check_memory(plate.xfem);
      check_ranks(plate.xfem);
    }


    std::string
    printed(const ParameterHandler &prm, const std::string &format)
    {
      return format == "json" ? parameters_as_json(prm)
             : format == "md" ? parameters_as_markdown(prm)
                              : parameters_as_prm(prm, true);
    }
  } // namespace


  bool
  is_fracture_scene(const std::string              &scene_file,
                    const std::vector<std::string> &overrides)
  {
    if (scene_file.empty())
      return false;
    const std::string method =
        last_value(read_entries(scene_file, overrides), "Method", "");
    return method == "XFEM" || method == "SPH";
  }


  std::string
  fracture_parameters(const CommandLine &command_line)
  {
    AnyPlate         plate;
    ParameterHandler prm;
    read_plate(plate, prm, command_line.scene_file, command_line.overrides);
    return printed(prm, command_line.print_parameters);
  }


  std::string
  default_fracture_parameters(const std::string &format)
  {
    AnyPlate         plate;
    ParameterHandler prm;
    plate.declare(prm);
    return printed(prm, format);
  }


  Fracture::PlateScene
  read_plate_scene(const std::string              &scene_file,
                   const std::vector<std::string> &overrides)
  {
    AnyPlate         plate;
    ParameterHandler prm;
    read_plate(plate, prm, scene_file, overrides);
    return plate.xfem;
  }


  Prediction
  predict_fracture_scene(const std::string              &scene_file,
                         const std::vector<std::string> &overrides)
  {
    AnyPlate         plate;
    ParameterHandler prm;
    read_plate(plate, prm, scene_file, overrides);
    check_plate(plate);
    return plate.by_particles()
               ? predict_particle_plate(plate.as_particles())
               : predict_xfem(plate.xfem, make_cracks(plate.xfem));
  }


  void
  run_fracture_scene(const CommandLine &command_line)
  {
    AnyPlate         plate;
    ParameterHandler prm;
    read_plate(plate, prm, command_line.scene_file, command_line.overrides);
    RunOptions options = command_line.run;
    if (options.threads > 0)
      dealii::MultithreadInfo::set_thread_limit(options.threads);
    const FirstRank first_rank;
    check_plate(plate);
    if (options.output_directory.empty())
      options.output_directory = "output/" + plate.xfem.name;
    const std::string used = parameters_as_prm(prm, false);
    if (plate.by_particles())
      {
        run_particle_plate(plate.as_particles(), options, used);
        return;
      }
    // Mistakes that only the mesh shows come before anything is written.
    first_rank.run([&] {
      dealii::Triangulation<2> mesh(
          dealii::Triangulation<2>::limit_level_difference_at_vertices);
      FE::PlateProblem(plate.xfem, make_cracks(plate.xfem), mesh).set_up();
      prepare_output_directory(options.output_directory);
    });
    run_xfem(plate.xfem, options, used);
  }
} // namespace Morsel
