#include <morsel/core/errors.h>
#include <morsel/core/suggestions.h>
#include <morsel/sph/body_cloud.h>
#include <morsel/sph/body_cracks.h>
#include <morsel/sph/conforming_weights.h>
#include <morsel/sph/highest_frequency.h>
#include <morsel/sph/solid.h>
#include <morsel/sph/stable_step.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Morsel::SPH
{
  namespace
  {
    /// See doc/performance.md; every rank makes the cells of all particles.
    double
    steps_to_make(const Cloud &cloud, const unsigned int n_ranks)
    {
      const double lattice = 200., cells = 100., relaxation = 15.;
      return cloud.size() == 0
                 ? lattice
                 : lattice +
                       n_ranks * (cells + relaxation * cloud.n_relaxations);
    }


    /// The boundary is that of the outermost particles' cells; the nearer edge
    /// at a corner.
    ParticleEdge
    edge_seen_from(const Cloud &cloud, const unsigned int particle)
    {
      double distance = cloud.spacing, width = 0.;
      for (const CellFacet &facet : cloud.cells[particle].facets)
        if (facet.at_boundary())
          {
            const double d =
                facet.normal() * (facet.first - cloud.points[particle]);
            if (d < distance)
              {
                distance = d;
                width    = facet.length();
              }
          }
      return width > 0. ? ParticleEdge{distance, width}
                        : ParticleEdge{0.5 * cloud.spacing, cloud.spacing};
    }


    Kernel
    kernel_of(const Scene::ParticleBody &body)
    {
      return {kernel_named(body.solid.kernel),
              body.solid.smoothing_ratio * body.spacing};
    }
  } // namespace


  struct Solid::Layout
  {
    Cloud cloud; ///< empty of a lattice that goes without cells
    std::unique_ptr<const ConformingWeights> conforming;
    double reach; ///< within which particles interact [m]

    Layout(const Scene::ParticleBody &body, const unsigned int seed)
        : reach(kernel_of(body).support())
    {
      const bool cells = normalisation_named(body.normalisation()) ==
                         Normalisation::conforming;
      if (!body.is_even_lattice() || cells)
        cloud = body_cloud(body, seed);
      if (!cells)
        return;
      conforming = std::make_unique<const ConformingWeights>(
          cloud, kernel_of(body), visibility_in(body, cloud.points, reach));
      reach = std::max(reach, conforming->reach);
    }
  };


  Solid::Solid(const Scene::ParticleBody &body,
               const Scene::Scene        &scene,
               const MPI_Comm             communicator,
               CellWork                   work)
      : Solid(body,
              scene,
              communicator,
              std::move(work),
              Layout(body, scene.seed))
  {}


  Solid::Solid(const Scene::ParticleBody &body,
               const Scene::Scene        &scene,
               const MPI_Comm             communicator,
               CellWork                   work,
               const Layout              &layout)
      : depth(scene.depth)
      , cfl(body.solid.cfl)
      , kernel(kernel_of(body))
      , material(body.material.youngs_modulus,
                 body.material.poissons_ratio,
                 scene.time.inertia_factor * body.material.density)
      , linear_law(body.material.law == "linear")
      , softening(body.damage.softening == "deviator"
                      ? Materials::Softening::deviator
                      : Materials::Softening::tensile_principal)
      , hourglass_stiffness(body.solid.hourglass * material.youngs_modulus)
      , normalisation(normalisation_named(body.normalisation()))
      , host(communicator,
             body.shape.lower_corner,
             body.shape.upper_corner,
             layout.reach,
             body.spacing,
             std::move(work))
      , viscosity(body.solid.viscosity == "on" ||
                  (body.solid.viscosity == "auto" && body.damage.enabled))
  {
    fill(body, layout, scene.seed);
    choose_loops(body);
    highest_frequency =
        normalisation == Normalisation::conforming
            ? measured_highest_frequency()
            // Where hourglass control is stiffer than stress, its own highest
            // frequency rules: 3.4 alpha E/(rho h^2) is the largest square of
            // it (measured over kernels and smoothing ratios).
            : largest_modulus_factor() *
                  std::max(square_of_highest_frequency(material.wave_speed,
                                                       kernel.h),
                           3.4 * hourglass_stiffness /
                               (material.density * kernel.h * kernel.h));
    set_up = steps_to_make(
        layout.cloud, dealii::Utilities::MPI::n_mpi_processes(communicator));
    if (body.damage.enabled)
      make_breakable(body, scene);
    arrays = bonded_arrays(particles, bonds);
  }


  void
  Solid::fill(const Scene::ParticleBody &body,
              const Layout              &layout,
              const unsigned int         seed)
  {
    const double dp   = body.spacing;
    const bool   even = body.is_even_lattice();
    if (layout.cloud.size() > 0)
      {
        std::vector<ParticleHost<2>::Index> ids(layout.cloud.size());
        std::iota(ids.begin(), ids.end(), ParticleHost<2>::Index(0));
        host.insert(layout.cloud.points, ids);
      }
    else
      host.insert_lattice(body.shape.lower_corner,
                          body.shape.upper_corner,
                          body.particles_across);
    particles.spacing   = dp;
    particles.n_owned   = host.n_owned();
    particles.n_local   = host.n_local();
    particles.reference = host.reference_positions();
    particles.id.assign(host.ids().begin(), host.ids().end());
    if (even)
      particles.set_areas(std::vector<double>(particles.n_local, dp * dp),
                          depth,
                          material.density);
    else
      take_cells(layout.cloud);
    scatter_modulus(body, seed);
    allocate(body);
    if (layout.conforming)
      bonds.build_conforming(particles, *layout.conforming, kernel);
    else
      bonds.build(particles,
                  kernel,
                  visibility_in(body, particles.reference, kernel.support()),
                  {normalisation == Normalisation::gradient_matrix,
                   body.damage.enabled,
                   host.n_boundary()});
    normalise(body);
  }


  void
  Solid::take_cells(const Cloud &cloud)
  {
    std::vector<double> areas;
    for (unsigned int i = 0; i < particles.n_local; ++i)
      {
        areas.push_back(cloud.cells[particles.id[i]].area);
        edges.of_particle.push_back(edge_seen_from(cloud, particles.id[i]));
      }
    for (unsigned int k = 0; k < cloud.size(); ++k)
      edges.enlarge(edge_seen_from(cloud, k));
    particles.set_areas(areas, depth, material.density);
  }


  void
  Solid::allocate(const Scene::ParticleBody &body)
  {
    const unsigned int n = particles.n_local;
    particles.set_velocity(body.initial_velocity_function());
    particles.acceleration.assign(n, {0., 0.});
    particles.gradient.assign(n, {0., 0., 0., 0.});
    particles.pair_stress.assign(n, {0., 0., 0., 0.});
    particles.hourglass.assign(n, hourglass_stiffness);
    for (unsigned int i = 0; i < particles.modulus.size(); ++i)
      particles.hourglass[i] *= particles.modulus[i];
    if (viscosity || body.damage.enabled)
      {
        particles.viscous.assign(n, {0., 0.});
        particles.viscous_heat.assign(n, 0.);
      }
    if (normalisation == Normalisation::conforming)
      {
        particles.fit_stress.assign(n, {0., 0., 0., 0.});
        particles.own_sum.assign(n, {0., 0.});
        if (body.damage.enabled)
          particles.deficit.assign(n, {0., 0., 0., 0.});
      }
  }


  void
  Solid::normalise(const Scene::ParticleBody &body)
  {
    const bool conforming = normalisation == Normalisation::conforming;
    const bool own_fit =
        conforming || (normalisation != Normalisation::gradient_matrix &&
                       hourglass_stiffness > 0.);
    if (!conforming)
      particles.shape.resize(particles.n_local);
    if (own_fit)
      particles.fit.resize(particles.n_local);
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const Symmetric2 m = bonds.moment(particles, i);
        if (smaller_eigenvalue(m) < 1e-3 * bonds.full_moment)
          throw InputError(
              "Body '" + body.name + "': the neighbours of the particle at (" +
              number_text(particles.reference[i][0]) + ", " +
              number_text(particles.reference[i][1]) +
              ") m do not span the plane (a single row or column, or cracks "
              "that cut it off), so that it has no strain; use at least two "
              "rows and columns, and keep cracks that far apart.");
        if (conforming)
          {
            renew_conforming(particles, bonds, i);
            continue;
          }
        particles.shape[i] = inverse(m);
        if (own_fit)
          particles.fit[i] = particles.shape[i];
        if (normalisation == Normalisation::gradient_matrix)
          continue;
        double sum = particles.area[i] * kernel.value(0.);
        for (unsigned int k = bonds.list.start[i]; k < bonds.list.start[i + 1];
             ++k)
          sum += particles.area[bonds.list.index[k]] *
                 kernel.value(std::sqrt(bonds.length_square(particles, i, k)));
        particles.shape[i] = gradient_correction(normalisation, {m, sum});
      }
  }


  void
  Solid::choose_loops(const Scene::ParticleBody &body)
  {
    constants         = {};
    constants.mu      = material.mu;
    constants.bulk    = material.bulk;
    constants.density = material.density;
    constants.uniform_hourglass =
        body.solid.hourglass * material.youngs_modulus;
    constants.viscosity_alpha_c =
        body.solid.viscosity_alpha * material.wave_speed;
    constants.viscosity_beta   = body.solid.viscosity_beta;
    constants.smoothing_length = kernel.h;

    // Nothing is decided inside the loops over pairs.
    const PairKernels &kernels    = pair_kernels();
    const unsigned int softened   = !body.damage.enabled ? 0
                                    : softening == Materials::Softening::deviator
                                        ? 1
                                        : 2;
    const bool         conforming = normalisation == Normalisation::conforming;
    column_loop                   = kernels.columns[viscosity];
    strain_loop = conforming ? kernels.strain_conforming[linear_law][softened]
                  : particles.fit.empty() ? kernels.strain[linear_law][softened]
                                          : kernels.strain_own_fit[linear_law];
    if (!conforming && particles.fit.empty() && softened < 2)
      {
        energy_loop = kernels.energy[linear_law][softened];
        particles.energy.resize(particles.n_groups());
      }
    const bool varying = body.damage.enabled || !particles.modulus.empty();
    force_loop         = (conforming ? kernels.force_conforming
                                     : kernels.force)[viscosity][varying];
  }


  double
  Solid::measured_highest_frequency()
  {
    const PairKernels        &kernels = pair_kernels();
    const BondedArrays        arrays  = bonded_arrays(particles, bonds);
    const unsigned int        n       = particles.n_owned;
    const std::vector<double> mass(particles.mass.begin(),
                                   particles.mass.begin() + n);
    // Small enough for the tangent, large enough for its round-off.
    const double size          = 1e-6 * particles.spacing;
    const auto   accelerations = [&](const std::vector<Vector2> &u,
                                   std::vector<Vector2>       &a) {
      double largest = 0.;
      for (const Vector2 &v : u)
        largest = std::max({largest, std::abs(v.x), std::abs(v.y)});
      const double scale = size / host.maximum(largest);
      for (unsigned int i = 0; i < n; ++i)
        {
          particles.motion[i].u_x = scale * u[i].x;
          particles.motion[i].u_y = scale * u[i].y;
        }
      const unsigned int groups = particles.n_groups();
      host.exchange(particles.motion);
      kernels.strain_conforming[linear_law][0](arrays, constants, 0, groups);
      host.exchange(particles.pair_stress, particles.fit_stress);
      kernels.force_conforming[false][!particles.modulus.empty()](
          arrays, constants, 0, groups);
      for (unsigned int i = 0; i < n; ++i)
        a[i] = {particles.acceleration[i].x / scale,
                particles.acceleration[i].y / scale};
    };
    const double result = square_of_highest_frequency(
        accelerations,
        random_field({particles.id.begin(), particles.id.begin() + n}),
        mass,
        2e-3,
        [this](const double mine) { return host.sum(mine); });
    for (Motion &m : particles.motion)
      m.u_x = m.u_y = 0.;
    particles.acceleration.assign(particles.n_local, {0., 0.});
    return result;
  }


  void
  Solid::make_breakable(const Scene::ParticleBody &body,
                        const Scene::Scene        &scene)
  {
    const Materials::DamageLaw law(
        body.damage,
        material,
        body.material.compressive_strength,
        {body.spacing * body.spacing * depth, body.spacing});
    fracture = std::make_unique<DamageEvolution>(
        particles,
        bonds,
        kernel,
        material,
        linear_law,
        law,
        constants,
        body.damage,
        scene.measures.friend_distance * particles.spacing,
        scene.seed,
        strength_of_grains(body, scene.seed),
        ranks());
    granular = std::make_unique<Granular>(
        particles,
        bonds,
        kernel,
        material,
        GranularConstants{body.damage.granular_friction,
                          body.solid.viscosity_alpha,
                          body.solid.viscosity_beta,
                          scene.contact.stiffness * material.p_wave_modulus *
                              depth},
        fracture->exposed_particles(),
        fracture->contact_diameters(),
        ranks());
  }
} // namespace Morsel::SPH
