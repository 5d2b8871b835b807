#include <morsel/core/errors.h>
#include <morsel/core/gather.h>
#include <morsel/core/state_archive.h>
#include <morsel/jaw/quasi_static_deformation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Morsel::Jaw
{
  namespace
  {
    /// Of the displacement: far below what the contact's energy shows.
    constexpr double tolerance = 1e-9;
    /// Of the coordinates, whose last digits gaps cannot know, times what the
    /// body makes of a gap.
    constexpr double       round_off            = 1e-14;
    constexpr unsigned int most_attempts        = 60;
    constexpr unsigned int attempts_before_half = 15;
    /// A matrix is kept while it reduces the residual by this.
    constexpr double fast_convergence = 0.1;


    /// A touch and how many shares it has.
    struct TouchRecord
    {
      dealii::Tensor<2, 2> stiffness; ///< [N/m]
      unsigned int         n_shares;
    };

    struct ShareRecord
    {
      unsigned int node;
      double       weight;
    };
  } // namespace


  QuasiStaticDeformation::QuasiStaticDeformation(
      std::unique_ptr<FE::ElasticBody> elastic_body,
      const MPI_Comm                   communicator)
      : Deformation(std::move(elastic_body))
      , communicator(communicator)
      , factors(body->factorise(1., 0.))
      , compliance(body->surface_nodes().size())
      , place(body->surface_nodes().size(), -1)
  {
    w = force = settled_last = rate =
        Eigen::VectorXd::Zero(2 * body->surface_nodes().size());
    for (const auto &node : body->surface_nodes())
      least_difference = std::max(least_difference, round_off * node.norm());
  }


  void
  QuasiStaticDeformation::add_to(Contact::Surface &surface) const
  {
    for (unsigned int k = 0; k < surface.nodes.size(); ++k)
      {
        surface.nodes[k] += turned(R, w, k);
        surface.velocity[k] += turned(R, rate, k);
      }
  }


  Contact::Touches
  QuasiStaticDeformation::touches_of_all_ranks(const TouchLists &touches) const
  {
    std::vector<TouchRecord> own;
    std::vector<ShareRecord> own_shares;
    for (const auto *const list : touches)
      for (const auto &touch : list->list)
        {
          own.push_back({touch.stiffness, touch.last - touch.first});
          for (unsigned int s = touch.first; s < touch.last; ++s)
            own_shares.push_back(
                {list->shares[s].first, list->shares[s].second});
        }
    Contact::Touches all;
    for (const auto &share : gather(own_shares, communicator))
      all.shares.emplace_back(share.node, share.weight);
    unsigned int first = 0;
    for (const auto &touch : gather(own, communicator))
      {
        all.list.push_back({touch.stiffness, first, first + touch.n_shares});
        first += touch.n_shares;
      }
    return all;
  }


  void
  QuasiStaticDeformation::make_columns(const unsigned int node)
  {
    for (unsigned int d = 0; d < 2; ++d)
      if (auto &column = compliance[node][d]; column.size() == 0)
        {
          const Eigen::VectorXd unit =
              Eigen::VectorXd::Unit(w.size(), 2 * node + d);
          column =
              body->trace() * factors.solve(body->trace().transpose() * unit);
        }
  }


  Eigen::VectorXd
  QuasiStaticDeformation::deflection(const Eigen::VectorXd &f) const
  {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(f.size());
    for (unsigned int k = 0; k < compliance.size(); ++k)
      for (unsigned int d = 0; d < 2; ++d)
        if (f[2 * k + d] != 0.)
          u += f[2 * k + d] * compliance[k][d];
    return u;
  }


  bool
  QuasiStaticDeformation::covers(const Contact::Touches &touches) const
  {
    return std::all_of(
        touches.shares.begin(),
        touches.shares.end(),
        [this](const auto &share) { return place[share.first] >= 0; });
  }


  void
  QuasiStaticDeformation::make_matrix(const Contact::Touches &touches)
  {
    for (const unsigned int node : touched)
      place[node] = -1;
    touched.clear();
    for (const auto &share : touches.shares)
      if (place[share.first] < 0)
        {
          place[share.first] = touched.size();
          touched.push_back(share.first);
          make_columns(share.first);
        }

    const unsigned int n = 2 * touched.size();
    contact_stiffness    = Eigen::MatrixXd::Zero(n, n);
    const auto &shares   = touches.shares;
    for (const auto &t : touches.list)
      {
        const auto stiffness = dealii::transpose(R) * t.stiffness * R;
        for (unsigned int i = t.first; i < t.last; ++i)
          for (unsigned int j = t.first; j < t.last; ++j)
            for (unsigned int c = 0; c < 2; ++c)
              for (unsigned int d = 0; d < 2; ++d)
                contact_stiffness(2 * place[shares[i].first] + c,
                                  2 * place[shares[j].first] + d) +=
                    shares[i].second * shares[j].second * stiffness[c][d];
      }
    factorise_matrix();
  }


  void
  QuasiStaticDeformation::factorise_matrix()
  {
    const unsigned int n = 2 * touched.size();
    Eigen::MatrixXd    C(n, n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        C(i, j) = compliance[touched[j / 2]][j % 2][2 * touched[i / 2] + i % 2];
    const Eigen::MatrixXd CK = C * contact_stiffness;
    amplification = n > 0 ? CK.cwiseAbs().rowwise().sum().maxCoeff() : 0.;
    matrix.compute(Eigen::MatrixXd::Identity(n, n) + CK);
  }


  bool
  QuasiStaticDeformation::settle(Contact::Surface &surface,
                                 const TouchLists &touches,
                                 const double      time_step)
  {
    ++evaluations;
    const Eigen::VectorXd f = nodal_forces(surface, R, communicator);
    for (unsigned int k = 0; k < compliance.size(); ++k)
      if (f[2 * k] != 0. || f[2 * k + 1] != 0.)
        make_columns(k);
    const Eigen::VectorXd answer   = deflection(f);
    const double          residual = (answer - w).lpNorm<Eigen::Infinity>();
    const double          scale =
        std::max(answer.lpNorm<Eigen::Infinity>(), w.lpNorm<Eigen::Infinity>());
    if (residual <=
        std::max(tolerance * scale, (1. + amplification) * least_difference))
      {
        force   = f;
        attempt = 0;
        return true;
      }
    if (++attempt > most_attempts)
      throw NumericalError(
          "The elastic body '" + surface.name +
          "' finds no equilibrium with the forces of contact and friction: "
          "take "
          "'Deformation/Response' = 'dynamic', which suits bodies as soft as "
          "the food.");

    Eigen::VectorXd        next = answer;
    const Contact::Touches all  = touches_of_all_ranks(touches);
    if (!covers(all) ||
        (attempt > 1 && residual > fast_convergence * last_residual))
      make_matrix(all);
    if (!touched.empty())
      {
        // w = C f(w), linearised: (I + C K) dw = C f - w, f' = f - K dw.
        Eigen::VectorXd dw(2 * touched.size());
        for (unsigned int i = 0; i < dw.size(); ++i)
          {
            const unsigned int row = 2 * touched[i / 2] + i % 2;
            dw[i]                  = answer[row] - w[row];
          }
        dw                           = matrix.solve(dw);
        const Eigen::VectorXd df     = -contact_stiffness * dw;
        Eigen::VectorXd       change = Eigen::VectorXd::Zero(f.size());
        for (unsigned int i = 0; i < df.size(); ++i)
          change[2 * touched[i / 2] + i % 2] = df[i];
        next += deflection(change);
      }
    if (attempt > attempts_before_half)
      next = 0.5 * (next + w);
    last_residual              = residual;
    const Eigen::VectorXd step = next - w;
    for (unsigned int k = 0; k < surface.nodes.size(); ++k)
      {
        const auto change = turned(R, step, k);
        surface.nodes[k] += change;
        surface.velocity[k] += change / time_step;
      }
    w = next;
    return false;
  }


  double
  QuasiStaticDeformation::strain_energy() const
  {
    return dealii::Utilities::MPI::this_mpi_process(communicator) == 0
               ? 0.5 * force.dot(w)
               : 0.;
  }


  dealii::Tensor<1, 2>
  QuasiStaticDeformation::account(const Contact::Surface &surface,
                                  const DriveKick &)
  {
    return -surface.total_force();
  }


  void
  QuasiStaticDeformation::exchange_state(StateArchive &state)
  {
    state.same(R, w, force, settled_last, rate);
    state.same(attempt, last_residual, evaluations, touched);
    Eigen::VectorXd entries = contact_stiffness.reshaped();
    state.same(entries);
    if (!state.loads())
      return;
    const unsigned int n = 2 * touched.size();
    contact_stiffness    = entries.reshaped(n, n);
    std::fill(place.begin(), place.end(), -1);
    for (unsigned int k = 0; k < touched.size(); ++k)
      {
        place[touched[k]] = k;
        make_columns(touched[k]);
      }
    factorise_matrix();
  }


  void
  QuasiStaticDeformation::advance(const double time_step)
  {
    rate         = (w - settled_last) / time_step;
    settled_last = w;
    w += time_step * rate;
  }


  Eigen::VectorXd
  QuasiStaticDeformation::displacement() const
  {
    return factors.solve(body->trace().transpose() * force);
  }
} // namespace Morsel::Jaw
