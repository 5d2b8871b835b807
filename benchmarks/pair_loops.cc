// Particle-steps per second of the two loops over bonded pairs and of the
// granular loops, on one core with the widest vectors of the machine.

#include <morsel/sph/bonds.h>
#include <morsel/sph/conforming_weights.h>
#include <morsel/sph/granular.h>
#include <morsel/sph/pair_kernels.h>
#include <morsel/sph/pair_loops.h>

#include <deal.II/base/multithread_info.h>

#include <benchmark/benchmark.h>

#include <cmath>

namespace
{
  using namespace Morsel;

  constexpr double spacing = 1e-4;

  /// A square lattice of @p across times @p across particles that is slightly
  /// deformed and moves, with everything allocated that an effect may need.
  struct Lattice
  {
    explicit Lattice(const unsigned int across,
                     const bool         conforming = false,
                     const bool         on_lattice = true)
        : kernel(KernelKind::cubic_b_spline, 1.3 * spacing)
        , material(2e7, 0.3, 1000.)
    {
      const unsigned int n = across * across;
      p.n_owned = p.n_local = n;
      p.spacing             = spacing;
      p.set_areas(std::vector<double>(n, spacing * spacing), 0.01, 1000.);
      for (unsigned int i = 0; i < n; ++i)
        {
          const double x = spacing * (i % across), y = spacing * (i / across);
          const double u = 1e-3 * spacing * std::sin(50. * x + 90. * y);
          p.id.push_back(p.reference.size());
          p.reference.emplace_back(x, y);
          p.motion.push_back({u, -u, 10. * u, 5. * u});
        }
      p.half_velocity.assign(n, {0., 0.});
      p.acceleration.assign(n, {0., 0.});
      p.gradient.assign(n, {0., 0., 0., 0.});
      p.pair_stress.assign(n, {0., 0., 0., 0.});
      p.hourglass.assign(n, 0.1 * material.youngs_modulus);
      p.viscous.assign(n, {0., 0.});
      p.viscous_heat.assign(n, 0.);
      p.damage.assign(n, 0.);
      p.failed.assign(n, 0);
      p.effective.assign(n, {0., 0., 0., 0.});
      p.driver.assign(n, 0.);
      p.near_face.assign(n, 0);
      p.crushed.assign(p.n_groups(), 0);
      p.strongest.assign(p.n_groups(), 0.);

      if (conforming)
        build_conforming(across);
      else
        bonds.build(p, kernel, {}, {on_lattice});
      bonds.make_breakable(p, kernel);
      for (unsigned int i = 0; i < n; ++i)
        if (conforming)
          SPH::renew_conforming(p, bonds, i);
        else
          p.shape.push_back(SPH::inverse(bonds.moment(p, i)));

      constants.mu                = material.mu;
      constants.bulk              = material.bulk;
      constants.density           = material.density;
      constants.uniform_hourglass = p.hourglass[0];
      constants.viscosity_alpha_c = 0.5 * material.wave_speed;
      constants.viscosity_beta    = 1.;
      constants.smoothing_length  = kernel.h;
      constants.tensile_strength  = 1e5;
      constants.von_mises_P       = 1e11;
      constants.von_mises_d       = 1e6;
    }

    void
    build_conforming(const unsigned int across)
    {
      SPH::Cloud cloud;
      cloud.lower   = {-0.5 * spacing, -0.5 * spacing};
      cloud.upper   = {(across - 0.5) * spacing, (across - 0.5) * spacing};
      cloud.spacing = spacing;
      cloud.points  = p.reference;
      cloud.cells   = SPH::voronoi_cells(
          cloud.points, cloud.lower, cloud.upper, cloud.spacing);
      p.fit_stress.assign(p.n_owned, {0., 0., 0., 0.});
      p.deficit.assign(p.n_owned, {0., 0., 0., 0.});
      p.fit.resize(p.n_owned);
      p.own_sum.resize(p.n_owned);
      bonds.build_conforming(p, {cloud, kernel}, kernel);
    }

    SPH::Particles        p;
    SPH::Bonds            bonds;
    SPH::BondedConstants  constants{};
    Kernel                kernel;
    Materials::Elasticity material;
  };


  void
  count_particles(benchmark::State &state, const SPH::Particles &p)
  {
    state.SetItemsProcessed(state.iterations() * p.n_owned);
    state.SetLabel(SPH::pair_kernels().name);
  }


  /// Strain and force loops of a solid with or without viscosity, damage and
  /// grains of different stiffness.
  void
  bonded(benchmark::State &state,
         const bool        viscosity,
         const bool        damage,
         const bool        conforming,
         const bool        grains = false)
  {
    Lattice lattice(state.range(0), conforming);
    if (grains)
      lattice.p.modulus.assign(lattice.p.n_owned, 1.);
    const auto &kernels = SPH::pair_kernels();
    const auto  strain =
        (conforming ? kernels.strain_conforming : kernels.strain)[0][damage];
    const auto force =
        (conforming ? kernels.force_conforming
                    : kernels.force)[viscosity][damage || grains];
    const auto         driver  = kernels.own_driver[2];
    const auto         arrays  = SPH::bonded_arrays(lattice.p, lattice.bonds);
    const unsigned int n       = lattice.p.n_groups();
    const auto         columns = kernels.columns[viscosity];
    for (auto _ : state)
      {
        if (arrays.lattice.use)
          columns(arrays, lattice.constants, 0, n);
        strain(arrays, lattice.constants, 0, n);
        if (damage)
          driver(arrays, lattice.constants, 0, n);
        force(arrays, lattice.constants, 0, n);
        benchmark::ClobberMemory();
      }
    count_particles(state, lattice.p);
  }


  /// Every particle has failed and none has moved far: the loops without the
  /// search.
  void
  granular(benchmark::State &state)
  {
    Lattice                   lattice(state.range(0));
    const unsigned int        n = lattice.p.n_owned;
    const std::vector<char>   exposed(n, 1);
    const std::vector<double> diameters(n, spacing);
    std::vector<unsigned int> failed;
    lattice.p.failed.assign(n, 1);
    for (unsigned int i = 0; i < n; ++i)
      failed.push_back(i);
    SPH::Granular grains(lattice.p,
                         lattice.bonds,
                         lattice.kernel,
                         lattice.material,
                         {0.5, 0.5, 1., 1e5},
                         exposed,
                         diameters);
    grains.take_over(failed, {});
    grains.advance(1e-9);
    for (auto _ : state)
      {
        grains.add_forces(1e-9);
        grains.advance(1e-9);
        benchmark::ClobberMemory();
      }
    count_particles(state, lattice.p);
  }


  // Squares of 10,000, 102,400 and 1,000,000 particles.
  void
  sizes(benchmark::internal::Benchmark *const b)
  {
    b->Arg(100)->Arg(320)->Arg(1000)->Unit(benchmark::kMillisecond);
  }
} // namespace


BENCHMARK_CAPTURE(bonded, elastic, false, false, false)->Apply(sizes);
BENCHMARK_CAPTURE(bonded, elastic_grains, false, false, false, true)
    ->Apply(sizes);
BENCHMARK_CAPTURE(bonded, viscosity, true, false, false)->Apply(sizes);
BENCHMARK_CAPTURE(bonded, damage_and_viscosity, true, true, false)
    ->Apply(sizes);
BENCHMARK_CAPTURE(bonded, damage_and_viscosity_grains, true, true, false, true)
    ->Apply(sizes);
BENCHMARK_CAPTURE(bonded, conforming, false, false, true)->Apply(sizes);
BENCHMARK_CAPTURE(bonded, conforming_damage_and_viscosity, true, true, true)
    ->Apply(sizes);
BENCHMARK(granular)->Apply(sizes);


int
main(int argc, char **argv)
{
  dealii::MultithreadInfo::set_thread_limit(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
