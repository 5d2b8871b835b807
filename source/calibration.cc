#include <morsel/calibration.h>
#include <morsel/fe/plate_problem.h>
#include <morsel/sph/plate_problem.h>
#include <morsel/sph/solid.h>

#include <deal.II/base/multithread_info.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <functional>

#include <unistd.h>

namespace Morsel
{
  namespace
  {
    using Clock = std::chrono::steady_clock;


    double
    seconds_since(const Clock::time_point begin)
    {
      return std::chrono::duration<double>(Clock::now() - begin).count();
    }


    /// The edge crack M1 (a).
    template <typename Plate>
    Plate
    edge_crack()
    {
      Plate plate;
      plate.paths       = "0, 0.005 > 0.001, 0.005";
      plate.support[2]  = "clamp";
      plate.traction[3] = "0, 1000";
      return plate;
    }


    std::function<void()>
    finite_element_task()
    {
      auto plate               = edge_crack<FE::PlateParameters>();
      plate.cells_x            = 25;
      plate.cells_y            = 25;
      plate.degree             = 2;
      plate.tip_degree         = 2;
      plate.corner_refinements = 0;
      return [plate] {
        dealii::Triangulation<2> mesh(
            dealii::Triangulation<2>::limit_level_difference_at_vertices);
        FE::PlateProblem(plate, make_cracks(plate), mesh).run();
      };
    }


    std::function<void()>
    static_particle_task()
    {
      auto plate        = edge_crack<SPH::PlateParameters>();
      plate.particles_x = 30;
      plate.particles_y = 30;
      return [plate] { SPH::PlateProblem(plate, make_cracks(plate)).run(); };
    }


    /// Twenty steps of 60 x 60 particles.
    std::function<void()>
    explicit_particle_task()
    {
      const auto scene           = std::make_shared<Scene::Scene>();
      scene->domain.lower_corner = {-0.01, -0.01};
      scene->domain.upper_corner = {0.02, 0.02};
      Scene::ParticleBody body;
      body.name                    = "block";
      body.shape.upper_corner      = {0.01, 0.01};
      body.particles_across        = 60;
      body.spacing                 = 0.01 / 60.;
      body.material.density        = 1000.;
      body.material.youngs_modulus = 1e7;
      body.material.poissons_ratio = 0.3;
      scene->particle_bodies.push_back(body);
      const auto solid = std::make_shared<SPH::Solid>(
          scene->particle_bodies.front(), *scene, MPI_COMM_SELF);
      const double dt = solid->stable_time_step(0.);
      // The solid refers to the scene.
      return [scene, solid, dt] {
        for (unsigned int step = 0; step < 20; ++step)
          {
            solid->compute_accelerations(dt);
            solid->advance(dt);
          }
      };
    }


    double
    time_since_process_start()
    {
      // Field 22 of proc(5)'s stat, in ticks since the machine's start; the
      // second field is a name in parentheses, which may hold blanks.
      std::ifstream file("/proc/self/stat");
      std::string   text;
      std::getline(file, text);
      std::istringstream rest(text.substr(text.rfind(')') + 1));
      std::string        field;
      for (unsigned int k = 3; k <= 22; ++k)
        rest >> field;
      timespec now;
      if (!file || !rest || clock_gettime(CLOCK_BOOTTIME, &now) != 0)
        return 0.;
      return now.tv_sec + 1e-9 * now.tv_nsec -
             std::stod(field) / sysconf(_SC_CLK_TCK);
    }
  } // namespace


  const std::vector<Workload> &
  all_workloads()
  {
    static const std::vector<Workload> workloads = {
        Workload::finite_elements,
        Workload::static_particles,
        Workload::explicit_particles};
    return workloads;
  }


  std::string
  name_of(const Workload workload)
  {
    return workload == Workload::finite_elements    ? "finite elements"
           : workload == Workload::static_particles ? "static particles"
                                                    : "explicit particles";
  }


  Times
  time_of(const std::function<void()> &task)
  {
    const auto   begin  = Clock::now();
    const double before = processor_time();
    task();
    return {seconds_since(begin), processor_time() - before};
  }


  Times
  measure(const Workload workload)
  {
    const auto task =
        workload == Workload::finite_elements    ? finite_element_task()
        : workload == Workload::static_particles ? static_particle_task()
                                                 : explicit_particle_task();
    task();
    constexpr double duration = 1. / 3.; // [s]
    Times            sum;
    unsigned int     n = 0;
    for (; sum.wall < duration; ++n)
      {
        const Times time = time_of(task);
        sum.wall += time.wall;
        sum.processor += time.processor;
      }
    return {sum.wall / n, sum.processor / n};
  }


  Times
  start_time()
  {
    static const Times times = {time_since_process_start(), processor_time()};
    return times;
  }


  double
  processor_time()
  {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
  }


  nlohmann::ordered_json
  calibration_json()
  {
    nlohmann::ordered_json workloads = nlohmann::ordered_json::object();
    for (const Workload workload : all_workloads())
      {
        const Times time             = measure(workload);
        workloads[name_of(workload)] = {{"wall_time", time.wall},
                                        {"processor_time", time.processor}};
      }
    return {{"threads", dealii::MultithreadInfo::n_threads()},
            {"start_time", start_time().wall},
            {"workloads", workloads}};
  }
} // namespace Morsel
