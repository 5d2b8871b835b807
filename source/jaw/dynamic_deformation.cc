#include <morsel/jaw/dynamic_deformation.h>

#include <cmath>

namespace Morsel::Jaw
{
  namespace
  {
    constexpr unsigned int power_iterations = 30;
  }


  Eigen::VectorXd
  nodal_forces(const Contact::Surface     &surface,
               const dealii::Tensor<2, 2> &R,
               const MPI_Comm              communicator)
  {
    Eigen::VectorXd f(2 * surface.force.size());
    for (unsigned int k = 0; k < surface.force.size(); ++k)
      for (unsigned int d = 0; d < 2; ++d)
        f[2 * k + d] = (dealii::transpose(R) * surface.force[k])[d];
    dealii::Utilities::MPI::sum(
        dealii::ArrayView<const double>(f.data(), f.size()),
        communicator,
        dealii::ArrayView<double>(f.data(), f.size()));
    return f;
  }


  DynamicDeformation::DynamicDeformation(
      std::unique_ptr<FE::ElasticBody> elastic_body,
      const dealii::Tensor<1, 2>      &initial_velocity,
      const double                     beta,
      const double                     time_step,
      const MPI_Comm                   communicator)
      : Deformation(std::move(elastic_body))
      , communicator(communicator)
      , first_rank(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      , beta(beta)
      , dt(time_step)
      , factors(body->factorise(1., 1. / scale()))
  {
    w = half_velocity = acceleration = Eigen::VectorXd::Zero(body->n_dofs());
    for (unsigned int c = 0; c < 2; ++c)
      {
        ones[c]              = body->uniform(c);
        held_ones[c]         = ones[c].cwiseProduct(body->held());
        mass_of_ones[c]      = body->mass() * ones[c];
        mass_of_held[c]      = body->mass() * held_ones[c];
        stiffness_of_held[c] = body->stiffness() * held_ones[c];
        half_velocity += initial_velocity[c] * ones[c];
      }
    surface_velocity = body->trace() * half_velocity;
  }


  double
  contact_frequency(const FE::ElasticBody     &body,
                    const double               foundation,
                    const std::vector<double> &tributary,
                    const double               stiffness_share)
  {
    const FE::Multifrontal mass = body.factorise(stiffness_share, 1.);
    Eigen::VectorXd        springs(2 * tributary.size());
    for (unsigned int k = 0; k < tributary.size(); ++k)
      springs[2 * k] = springs[2 * k + 1] = foundation * tributary[k];
    // Power iteration from what is smooth nowhere.
    Eigen::VectorXd x(body.n_dofs());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = 1. + 0.5 * ((i * 7919) % 13);
    double largest = 0.;
    for (unsigned int k = 0; k < power_iterations; ++k)
      {
        x /= x.norm();
        x       = mass.solve(body.trace().transpose() *
                       springs.cwiseProduct(body.trace() * x).eval());
        largest = x.norm();
      }
    return largest;
  }


  void
  DynamicDeformation::add_to(Contact::Surface &surface) const
  {
    const Eigen::VectorXd shift = body->trace() * w;
    for (unsigned int k = 0; k < surface.nodes.size(); ++k)
      for (unsigned int d = 0; d < 2; ++d)
        {
          surface.nodes[k][d] += shift[2 * k + d];
          surface.velocity[k][d] += surface_velocity[2 * k + d];
        }
  }


  Eigen::VectorXd
  DynamicDeformation::inner_force() const
  {
    // A translation has none, but would be rounded.
    Eigen::VectorXd strained = w;
    for (const Eigen::VectorXd &one : ones)
      strained -= one.dot(w) / one.squaredNorm() * one;
    return body->stiffness() * strained;
  }


  dealii::Tensor<1, 2>
  DynamicDeformation::account(const Contact::Surface &surface,
                              const DriveKick        &drive)
  {
    outer_loads =
        body->trace().transpose() * nodal_forces(surface, R, communicator);
    const auto drive_acceleration =
        (drive.velocity_after - drive.velocity_before) / drive.kick;
    for (unsigned int c = 0; c < 2; ++c)
      outer_loads -= drive_acceleration[c] * mass_of_ones[c];
    const Eigen::VectorXd loads = outer_loads - inner_force();
    acceleration                = 1. / scale() * factors.solve(loads);
    last_drive                  = drive;

    // The rows of the held dofs say what holds them.
    dealii::Tensor<1, 2> push;
    for (unsigned int c = 0; c < 2 && first_rank; ++c)
      push[c] =
          (mass_of_held[c] + scale() * stiffness_of_held[c]).dot(acceleration) -
          held_ones[c].dot(loads);
    return push;
  }


  void
  DynamicDeformation::change_time_step(const double time_step)
  {
    if (time_step == dt)
      return;
    dt      = time_step;
    factors = body->factorise(1., 1. / scale());
  }


  void
  DynamicDeformation::advance(const double time_step)
  {
    half_velocity += last_drive.kick * acceleration;
    w += time_step * half_velocity;
    lag = 0.5 * time_step;
    // Friction needs the velocity of the whole step. Extrapolated with the
    // last acceleration it would turn what the step does not resolve, whose
    // velocity there is zero, into the largest of all, and feed it.
    const Eigen::VectorXd predicted =
        1. / scale() * factors.solve(outer_loads - inner_force());
    surface_velocity = body->trace() * (half_velocity + lag * predicted);
  }


  double
  DynamicDeformation::strain_energy() const
  {
    return first_rank ? 0.5 * w.dot(body->stiffness() * w) : 0.;
  }


  double
  DynamicDeformation::kinetic_energy() const
  {
    if (!first_rank)
      return 0.;
    const auto energy = [&](const Eigen::VectorXd      &rate,
                            const dealii::Tensor<1, 2> &of_drive) {
      const Eigen::VectorXd whole =
          rate + of_drive[0] * ones[0] + of_drive[1] * ones[1];
      return 0.5 * whole.dot(body->mass() * whole) +
             0.5 * scale() * rate.dot(body->stiffness() * rate);
    };
    const auto drive_acceleration =
        (last_drive.velocity_after - last_drive.velocity_before) /
        last_drive.kick;
    return energy(half_velocity + lag * acceleration,
                  last_drive.velocity_before + lag * drive_acceleration) -
           0.25 * dt * dt * energy(acceleration, drive_acceleration);
  }


  dealii::Tensor<1, 2>
  DynamicDeformation::momentum() const
  {
    dealii::Tensor<1, 2> p;
    for (unsigned int c = 0; c < 2 && first_rank; ++c)
      p[c] = mass_of_ones[c].dot(half_velocity) +
             mass_of_ones[c].dot(ones[c]) * last_drive.velocity_before[c];
    return p;
  }


  double
  DynamicDeformation::masses_times_speeds() const
  {
    if (!first_rank)
      return 0.;
    const Eigen::VectorXd v = half_velocity +
                              last_drive.velocity_before[0] * ones[0] +
                              last_drive.velocity_before[1] * ones[1];
    return std::sqrt(mass_of_ones[0].dot(ones[0]) * v.dot(body->mass() * v));
  }
} // namespace Morsel::Jaw
