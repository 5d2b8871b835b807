// Particles in equilibrium: Voronoi cells, discrete gradients and their
// adjoint, patch tests, visibility about cracks, stress intensity.
#include <morsel/core/errors.h>
#include <morsel/sph/field_vectors.h>
#include <morsel/sph/plate_problem.h>
#include <morsel/sph/stiffness_elements.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <utility>

namespace
{
  using namespace Morsel;
  using namespace Morsel::SPH;
  using dealii::Point;
  using dealii::Tensor;
  using Fracture::Crack;

  /// A body of 3 x 2 m with everything that is built on it.
  struct Body
  {
    Body(const unsigned int        n,
         const double              scatter,
         const std::vector<Crack> &cracks     = {},
         const bool                matrix     = false,
         const bool                control_on = true)
        : cloud(fill_rectangle(filling(n, scatter), cracks))
        , visibility(cracks, TipHandling::visibility, 2.6 * cloud.spacing)
        , shape(cloud,
                Kernel(KernelKind::cubic_b_spline, 1.3 * cloud.spacing),
                visibility)
        , gradient(matrix ? normalised_gradient(shape,
                                                Normalisation::gradient_matrix)
                          : conforming_gradient(shape))
        , control(residual_control(shape, control_on ? 0.3 * E : 0.))
        , boundary(boundary_facets(shape))
    {}

    static Filling
    filling(const unsigned int n, const double scatter)
    {
      Filling filling;
      filling.upper   = Point<2>(3., 2.);
      filling.n_x     = 3 * n;
      filling.n_y     = 2 * n;
      filling.scatter = scatter;
      filling.seed    = 7;
      return filling;
    }

    StaticSolid
    solid() const
    {
      return StaticSolid(shape, gradient, control, boundary, material, E);
    }

    ShapeValues
    at(const Point<2> &p) const
    {
      ShapeValues values;
      shape.evaluate(p, p, values);
      return values;
    }

    /// u = H x at the particles.
    VectorField
    linear_field(const Tensor<2, 2> &H) const
    {
      VectorField u;
      for (const Point<2> &x : cloud.points)
        u.push_back(H * Tensor<1, 2>(x));
      return u;
    }

    static constexpr double E = 5.;

    Cloud                      cloud;
    Visibility                 visibility;
    ShapeFunctions             shape;
    DiscreteGradient           gradient;
    ResidualControl            control;
    std::vector<BoundaryFacet> boundary;
    Fracture::ElasticPlane     material{E, 0.3};
  };


  VectorField
  random_field(const unsigned int n)
  {
    std::mt19937 generator(3);
    VectorField  u(n);
    for (auto &v : u)
      v = Tensor<1, 2>({generator() / 4e9, generator() / 4e9});
    return u;
  }


  double
  product(const VectorField &a, const VectorField &b)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < a.size(); ++i)
      sum += a[i] * b[i];
    return sum;
  }


  /// Largest difference between the stress of the particles and one stress.
  double
  stress_error(const StaticSolid                   &solid,
               const VectorField                   &u,
               const dealii::SymmetricTensor<2, 2> &exact)
  {
    double error = 0.;
    for (unsigned int i = 0; i < u.size(); ++i)
      error = std::max(error, (solid.stress(i, u) - exact).norm());
    return error;
  }


  const Crack edge_crack({Point<2>(-0.1, 1.), Point<2>(1., 1.)}, false, true);


  PlateParameters
  edge_cracked_plate(const unsigned int n, const double length)
  {
    PlateParameters plate;
    plate.method      = "SPH";
    plate.paths       = "0, 0.005 > " + std::to_string(length) + ", 0.005";
    plate.support[2]  = "clamp";
    plate.traction[3] = "0, 1000";
    plate.particles_x = plate.particles_y = n;
    return plate;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(particle_plate)

BOOST_AUTO_TEST_CASE(elements_sum_up_to_the_forces_of_the_operators)
{
  for (const bool matrix : {false, true})
    {
      const Body        body(8, 0.3, {edge_crack}, matrix);
      const VectorField u = random_field(body.cloud.size());
      TensorField       stress(u.size());
      for (unsigned int i = 0; i < u.size(); ++i)
        stress[i] = body.material.stress(body.gradient.gradient(i, u));
      VectorField force(u.size());
      body.gradient.add_force(stress, force);
      body.control.add_force(u, force);
      const dealii::Vector<double> inner = to_vector(force), x = to_vector(u);

      const StiffnessElements elements(
          body.gradient, body.control, body.material);
      dealii::Vector<double> sum(x.size()), entries(x.size());
      elements.vmult(sum, x);

      const ElementNodes &nodes = elements.get_nodes();
      std::vector<double> m;
      for (unsigned int e = 0; e < nodes.n_elements(); ++e)
        {
          const unsigned int *node = &nodes.index[nodes.start[e]];
          const unsigned int  n    = 2 * (nodes.start[e + 1] - nodes.start[e]);
          const auto          row  = [&](const unsigned int k) {
            return 2 * node[k / 2] + k % 2;
          };
          m.resize(n * n);
          elements.matrix(e, m);
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int a = b; a < n; ++a)
              {
                entries(row(a)) += m[b * n + a] * x(row(b));
                if (a > b)
                  entries(row(b)) += m[b * n + a] * x(row(a));
              }
        }
      sum += inner;
      entries += inner;
      BOOST_TEST(sum.l2_norm() < 1e-13 * inner.l2_norm());
      BOOST_TEST(entries.l2_norm() < 1e-13 * inner.l2_norm());
    }
}


BOOST_AUTO_TEST_CASE(voronoi_cells_fill_the_rectangle)
{
  const Body   body(8, 0.35);
  double       area = 0.;
  Tensor<1, 2> moment;
  for (unsigned int i = 0; i < body.cloud.size(); ++i)
    {
      const VoronoiCell &cell = body.cloud.cells[i];
      area += cell.area;
      moment += cell.area * Tensor<1, 2>(cell.centroid);
      for (const CellFacet &facet : cell.facets)
        if (!facet.at_boundary())
          {
            // The neighbour has the same facet the other way round.
            const auto &others = body.cloud.cells[facet.neighbour].facets;
            bool        found  = false;
            for (const CellFacet &other : others)
              found = found || (other.neighbour == i &&
                                other.first.distance(facet.second) < 1e-12 &&
                                other.second.distance(facet.first) < 1e-12);
            BOOST_TEST(found);
          }
    }
  BOOST_TEST(std::abs(area - 6.) < 1e-12);
  BOOST_TEST((moment - Tensor<1, 2>({9., 6.})).norm() < 1e-11);
}

BOOST_AUTO_TEST_CASE(cells_of_a_lattice_are_squares)
{
  const Body body(4, 0.);
  for (const VoronoiCell &cell : body.cloud.cells)
    {
      BOOST_TEST(cell.facets.size() == 4u);
      BOOST_TEST(std::abs(cell.area - 1. / 16.) < 1e-14);
    }
}

BOOST_AUTO_TEST_CASE(linear_fields_are_differentiated_exactly)
{
  const Tensor<2, 2> H({{0.3, -0.2}, {0.7, 0.1}});
  for (const bool matrix : {false, true})
    for (const double scatter : {0., 0.3})
      {
        const Body        body(6, scatter, {edge_crack}, matrix);
        const VectorField u     = body.linear_field(H);
        double            error = 0.;
        for (unsigned int i = 0; i < u.size(); ++i)
          error = std::max(error, (body.gradient.gradient(i, u) - H).norm());
        BOOST_TEST(error < 1e-11);
        BOOST_TEST(body.control.energy(u) < 1e-24);
      }
}

BOOST_AUTO_TEST_CASE(forces_are_the_adjoint_of_the_gradient)
{
  const Body        body(6, 0.3, {edge_crack});
  const VectorField u = random_field(body.cloud.size());
  TensorField       stress;
  double            work = 0.;
  for (unsigned int i = 0; i < u.size(); ++i)
    {
      const Tensor<2, 2> H = body.gradient.gradient(i, u);
      stress.push_back(Tensor<2, 2>({{1. + H[0][0], 2.}, {H[0][1], 3.}}));
      work += body.gradient.volume[i] * scalar_product(stress[i], H);
    }
  VectorField force(u.size());
  body.gradient.add_force(stress, force);
  BOOST_TEST(std::abs(work + product(force, u)) < 1e-12 * std::abs(work));

  // Linear momentum; angular momentum with symmetric stresses.
  for (auto &s : stress)
    s = 0.5 * (s + transpose(s));
  force.assign(u.size(), Tensor<1, 2>());
  body.gradient.add_force(stress, force);
  body.control.add_force(u, force);
  Tensor<1, 2> sum;
  double       torque = 0., scale = 0.;
  for (unsigned int i = 0; i < u.size(); ++i)
    {
      const Point<2> &x = body.cloud.points[i];
      sum += force[i];
      torque += x[0] * force[i][1] - x[1] * force[i][0];
      scale += force[i].norm();
    }
  BOOST_TEST(sum.norm() < 1e-13 * scale);
  BOOST_TEST(std::abs(torque) < 1e-12 * scale);
}

BOOST_AUTO_TEST_CASE(residual_force_is_the_derivative_of_its_energy)
{
  const Body        body(5, 0.3, {edge_crack});
  const VectorField u = random_field(body.cloud.size());
  VectorField       force(u.size());
  body.control.add_force(u, force);
  // The energy is quadratic: E = -f.u/2.
  const double energy = body.control.energy(u);
  BOOST_TEST(energy > 0.);
  BOOST_TEST(std::abs(energy + 0.5 * product(force, u)) < 1e-12 * energy);
}

BOOST_AUTO_TEST_CASE(constant_stress_makes_no_force_inside)
{
  // sum_i V_i G_ij is the surface vector of j: that is what the gradient
  // matrix misses on scattered particles.
  for (const bool matrix : {false, true})
    {
      const Body   body(8, 0.3, {}, matrix);
      VectorField  force(body.cloud.size());
      Tensor<2, 2> one;
      one[0][0] = one[1][1] = 1.;
      body.gradient.add_force(TensorField(body.cloud.size(), one), force);
      double largest = 0.;
      for (unsigned int i = 0; i < force.size(); ++i)
        {
          const Point<2> &x = body.cloud.points[i];
          if (std::min({x[0], x[1], 3. - x[0], 2. - x[1]}) >
              6. * body.cloud.spacing)
            largest = std::max(largest, force[i].norm());
        }
      if (matrix)
        BOOST_TEST(largest > 1e-3 * body.cloud.spacing);
      else
        BOOST_TEST(largest < 1e-13);
    }
}

BOOST_AUTO_TEST_CASE(patch_test_in_tension)
{
  dealii::SymmetricTensor<2, 2> sigma;
  sigma[1][1] = 2.;
  for (const double scatter : {0., 0.2})
    {
      const Body  body(8, scatter);
      StaticSolid solid = body.solid();
      solid.hold(2, 1);
      solid.pin(body.at(Point<2>(3., 0.)), 0);
      solid.apply_traction(3, Tensor<1, 2>({0., 2.}));
      const VectorField u = solid.solve();
      BOOST_TEST(stress_error(solid, u, sigma) < 1e-9);
      // u_yy = (1 - nu^2)/E sigma in plane strain, u = 0 at the true edge.
      const double strain = (1. - 0.09) / Body::E * 2.;
      double       error  = 0.;
      for (unsigned int i = 0; i < u.size(); ++i)
        error = std::max(error,
                         std::abs(u[i][1] - strain * body.cloud.points[i][1]));
      BOOST_TEST(error < 1e-9);
      BOOST_TEST(std::abs(solid.strain_energy(u) - 0.5 * 2. * strain * 6.) <
                 1e-9);
      BOOST_TEST(solid.get_report().residual < 1e-11);
    }
}

BOOST_AUTO_TEST_CASE(patch_test_between_clamps)
{
  // With nu = 0 a clamped body that is drawn out is under uniaxial tension.
  for (const double scatter : {0., 0.2})
    {
      Body                         body(8, scatter);
      const Fracture::ElasticPlane cork(Body::E, 0.);
      StaticSolid                  solid(body.shape,
                        body.gradient,
                        body.control,
                        body.boundary,
                        cork,
                        Body::E);
      for (const unsigned int component : {0u, 1u})
        {
          solid.hold(2, component);
          solid.hold(3, component, component == 1 ? 0.02 : 0.);
        }
      dealii::SymmetricTensor<2, 2> sigma;
      sigma[1][1] = Body::E * 0.01;
      BOOST_TEST(stress_error(solid, solid.solve(), sigma) < 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(patch_test_in_shear)
{
  dealii::SymmetricTensor<2, 2> sigma;
  sigma[0][1] = 2.;
  for (const double scatter : {0., 0.2})
    {
      const Body  body(8, scatter);
      StaticSolid solid = body.solid();
      solid.pin(body.at(Point<2>(3., 0.)), 0);
      solid.pin(body.at(Point<2>(3., 0.)), 1);
      solid.pin(body.at(Point<2>(3., 2.)), 0);
      solid.apply_traction(0, Tensor<1, 2>({0., -2.}));
      solid.apply_traction(1, Tensor<1, 2>({0., 2.}));
      solid.apply_traction(2, Tensor<1, 2>({-2., 0.}));
      solid.apply_traction(3, Tensor<1, 2>({2., 0.}));
      BOOST_TEST(stress_error(solid, solid.solve(), sigma) < 1e-8);
    }
}

BOOST_AUTO_TEST_CASE(a_moved_roller_draws_the_plate_out)
{
  PlateParameters plate;
  plate.particles_x = plate.particles_y = 12;
  plate.support[2] = plate.support[3] = "roller";
  plate.displacement[3]               = "0, 1e-6";
  plate.observed_points               = "B: 0.002, 0.008; C: 0, 0";
  check(plate);
  PlateProblem problem(plate, {});
  problem.run();
  const double exact  = 1e7 / 0.91 * 1e-4;
  const auto   points = Fracture::observed_points(plate);
  BOOST_REQUIRE(points.size() == 2);
  BOOST_TEST(points[0].name == "B");
  const auto s = problem.get_material().stress(
      problem.get_field().sample({points[0].place})[0].gradient);
  BOOST_TEST(std::abs(s[1][1] - exact) < 1e-8 * exact);
  BOOST_TEST(std::abs(s[0][0]) < 1e-8 * exact);
  BOOST_TEST(
      (Fracture::held_quantity(plate) == Fracture::HeldQuantity::displacement));
}

BOOST_AUTO_TEST_CASE(normalisations_of_the_kernel_gradient)
{
  // On a lattice: per axis is exact for axial strains but in the corners,
  // Shepard for nothing, and every one of them inside to a percent.
  const Body   body(8, 0.);
  Tensor<2, 2> H;
  H[0][0]                 = 1.;
  const VectorField u     = body.linear_field(H);
  const auto        error = [&](const Normalisation n, const Point<2> &at) {
    const DiscreteGradient G     = normalised_gradient(body.shape, n);
    unsigned int           i     = 0;
    const auto            &cloud = body.cloud;
    for (unsigned int j = 0; j < cloud.size(); ++j)
      if (cloud.points[j].distance(at) < cloud.points[i].distance(at))
        i = j;
    return (G.gradient(i, u) - H).norm();
  };
  const Point<2> middle(1.5, 1.), edge(3., 1.), corner(3., 2.);
  BOOST_TEST(error(Normalisation::none, middle) < 0.02);
  BOOST_TEST(error(Normalisation::none, edge) > 0.4);
  BOOST_TEST(error(Normalisation::shepard, edge) > 0.2);
  BOOST_TEST(error(Normalisation::per_axis, edge) < 1e-12);
  BOOST_TEST(error(Normalisation::per_axis, corner) > 0.1);
  BOOST_TEST(error(Normalisation::gradient_matrix, corner) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_body_that_nothing_holds_is_refused)
{
  const Body  body(4, 0.);
  StaticSolid solid = body.solid();
  solid.apply_traction(3, Tensor<1, 2>({0., 2.}));
  BOOST_CHECK_THROW(solid.solve(), NumericalError);
}

BOOST_AUTO_TEST_CASE(visibility_about_a_crack)
{
  const Visibility straight({edge_crack}, TipHandling::visibility, 0.5);
  const Point<2>   up(0.9, 1.1), down(0.9, 0.9), ahead(1.2, 0.95);
  BOOST_TEST(!straight.sees(up, down));
  BOOST_TEST(straight.sees(up, ahead));
  BOOST_TEST(straight.sees(Point<2>(1.1, 1.1), Point<2>(1.1, 0.9)));
  // A line through the tip is not cut.
  BOOST_TEST(straight.sees(Point<2>(0.9, 0.9), Point<2>(1.1, 1.1)));
  BOOST_TEST(straight.distance(up, up, down) == Visibility::hidden);
  BOOST_TEST(straight.distance(up, up, ahead) == up.distance(ahead));

  const Visibility bent({edge_crack}, TipHandling::diffraction, 0.5);
  BOOST_TEST(std::abs(bent.distance(up, up, down) - 2. * std::sqrt(0.02)) <
             1e-5);
  const Visibility veil({edge_crack}, TipHandling::transparency, 0.5);
  const double     near = veil.distance(
      Point<2>(0.98, 1.1), Point<2>(0.98, 1.1), Point<2>(0.98, 0.9));
  const double far = veil.distance(up, up, down);
  BOOST_TEST(near > 0.2);
  BOOST_TEST(far > near);
}

BOOST_AUTO_TEST_CASE(particles_stand_on_both_sides_of_any_crack)
{
  // The crack runs between two rows along it, whatever its direction.
  const Crack crack({Point<2>(1.03, 0.71), Point<2>(1.94, 1.33)}, true, true);
  const Cloud cloud   = fill_rectangle(Body::filling(10, 0.2), {crack});
  double      nearest = 1e9;
  for (const Point<2> &p : cloud.points)
    nearest = std::min(nearest, crack.distance(p));
  BOOST_TEST(nearest > 0.2 * cloud.spacing);
  BOOST_TEST(std::abs(cloud.size() - 600.) < 30.);

  Filling filling       = Body::filling(10, 0.);
  filling.n_y           = 21;
  filling.fit_to_cracks = false;
  BOOST_CHECK_THROW(fill_rectangle(filling, {edge_crack}), InputError);
}

BOOST_AUTO_TEST_CASE(stress_intensity_of_the_edge_crack)
{
  const PlateParameters plate = edge_cracked_plate(50, 0.001);
  PlateProblem          problem(plate, make_cracks(plate));
  const PlateResults   &results = problem.run();
  const auto           &k       = results.tips[0].statistics.mean;
  // The truth by a p-version FEM.
  BOOST_TEST(std::abs(k.mode_I / 64.4352 - 1.) < 0.01);
  BOOST_TEST(std::abs(k.mode_II + 1.0265) < 0.05);
  BOOST_TEST(std::abs(results.strain_energy / 4.615049e-6 - 1.) < 0.001);
  // Three ways to J, and the work against the energy.
  BOOST_TEST(std::abs(results.tips[0].energy_release[2] *
                          problem.get_material().effective_modulus /
                          (k.mode_I * k.mode_I + k.mode_II * k.mode_II) -
                      1.) < 0.01);
  BOOST_TEST(results.solve.residual < 1e-10);
  BOOST_TEST(results.solve.support_gap < 1e-11);
  BOOST_TEST(results.solve.condition_number < 100.);
}

BOOST_AUTO_TEST_CASE(stress_intensity_grows_without_steps)
{
  // Truths by extended finite elements, errors about 1e-6. A crack that
  // follows the edges of lattice cells makes the error a sawtooth from +2.4
  // to -3.4 %.
  double low = 1., high = -1.;
  for (const auto &[a, truth] : {std::make_pair(0.00106, 66.9291),
                                 std::make_pair(0.0011, 68.5929),
                                 std::make_pair(0.00112, 69.4257)})
    {
      const PlateParameters plate = edge_cracked_plate(50, a);
      PlateProblem          problem(plate, make_cracks(plate));
      const double          error =
          problem.run().tips[0].statistics.mean.mode_I / truth - 1.;
      low  = std::min(low, error);
      high = std::max(high, error);
    }
  BOOST_TEST(low > -0.012);
  BOOST_TEST(high < 0.012);
  BOOST_TEST(high - low < 0.012);
}

BOOST_AUTO_TEST_SUITE_END()
