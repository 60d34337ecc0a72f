#include "engine/exact/flow_growth.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "contact/friction.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/springs.hpp"
#include "model/slip_growth.hpp"

namespace signorini::exact {
namespace {

constexpr int probe_levels = 20;
// Limit of the bound's increase over W_0^2, relative to W_0^2; chosen: it makes steps at most 5 % shorter.
constexpr double max_bound_increase = 0.1;

}  // namespace

FlowGrowth::FlowGrowth(const Model& model, motion::Taylor& taylor, FlowNorm& norm,
                       const std::vector<double>& scales, double t_end)
    : model_(model),
      taylor_(taylor),
      norm_(norm),
      scales_(scales),
      fastest_(std::max({model.omega_max, 1.0 / t_end,
                         model::diagonal_decay(model.mass.diagonal(), model.damping.diagonal(),
                                               model.stiffness.diagonal())})) {}

double FlowGrowth::growth_rate(const motion::StateSystemPtr& system) {
  std::vector<State> states = contact::states_of(system->states());
  if (const double* known = known_.find(states)) return *known;
  if (const auto near = bound_from_near(*system)) return *near;
  near_rate_ = rate_from_series(system);
  known_.insert(states, near_rate_, states.size() * sizeof(State));
  near_states_ = std::move(states);
  return near_rate_;
}

/// Bound on the change of W^2 if contact c changes its state: term of this contact in the sum of flow_growth.hpp.
double FlowGrowth::stiffening(const motion::StateSystem& system, std::size_t c) {
  double& known = stiffenings_[c];
  if (known >= 0.0) return known;
  const Contact& contact = model_.contacts[c];
  Vector x(static_cast<Eigen::Index>(system.unknowns().size())), work(x.size());
  const auto effect = [&](const Combination& form) {
    x.setZero();
    form.add_to(x, 1.0);
    system.solve(x.data(), work.data());
    return norm_.norm(x.head(model_.size()));
  };
  const double n = effect(contact.normal), t = effect(contact.tangent);
  const double kn = contact.normal_stiffness, kt = contact.tangential_stiffness.value_or(0.0);
  const double friction = std::max(contact::static_friction(contact), contact::kinetic_friction(contact));
  return known = kn * (n + friction * t) * norm_.normal(c) + kt * t * norm_.tangent(c);
}

/// Upper bound of the growth rate, from the growth rate of near_states_, if few compliant contacts differ. nullopt: the states
/// differ too much.
std::optional<double> FlowGrowth::bound_from_near(const motion::StateSystem& system) {
  if (near_states_.empty() || !system.factorised().by_mass) return std::nullopt;
  stiffenings_.resize(near_states_.size(), -1.0);
  const double square = near_rate_ * near_rate_;
  double more = 0.0;
  for (std::size_t c = 0; c < near_states_.size(); ++c) {
    if (system.states()[c].state == near_states_[c]) continue;
    const Contact& contact = model_.contacts[c];
    // The bound does not include rigid rows, dashpots, and forces without constant stiffness.
    if (contact.normal_damping > 0.0 || !contact.has_constant_stiffness() || contact.takes_impulses() ||
        contact.sticks_rigidly() || contact.friction.is_rate_dependent())
      return std::nullopt;
    more += margin * margin * stiffening(system, c);
    if (!(more <= max_bound_increase * square)) return std::nullopt;
  }
  return std::sqrt(square + more);
}

/// Growth rate from the ratios of Taylor coefficients |u_(k+2)| / |u_k| for large k, in a random motion that contains all
/// modes.
double FlowGrowth::rate_from_series(const motion::StateSystemPtr& system) {
  const Eigen::Index n = model_.size();
  Vector u(n), v(n);
  std::mt19937_64 random(1);  // fixed seed, so that the motion is the same in every run
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    u[i] = uniform(random) / scales_[static_cast<std::size_t>(i)];
    v[i] = fastest_ * uniform(random) / scales_[static_cast<std::size_t>(i)];
  }
  motion::Series series;
  taylor_.expand(system, motion::Forcing::none(model_), 0.0, u, v, probe_levels, 1.0 / fastest_, series);
  double greatest = 0.0;
  for (Eigen::Index k = probe_levels / 2; k + 2 <= probe_levels - 2; ++k) {
    const double a = norm_.norm(series.u.col(k)), b = norm_.norm(series.u.col(k + 2));
    if (a > 0.0)
      greatest = std::max(greatest, fastest_ * std::sqrt(static_cast<double>((k + 1) * (k + 2)) * b / a));
  }
  return margin * greatest;
}

FlowNorm::FlowNorm(const Model& model) : product_(Vector::Zero(model.size())) {
  const double w = model.omega_max > 0.0 ? model.omega_max : 1.0;
  const int n = model.size();
  const SparseMatrix damping = 0.5 * (model.damping + SparseMatrix(model.damping.transpose()));
  g_ = model.mass + damping / w +
       assembly::with_springs(model.stiffness, assembly::contact_springs(model.contacts)) / (w * w);
  linear::SymmetricSolver solver(g_);
  if (!solver.ok() || !(solver.smallest_pivot() > 0.0)) {
    // If stiffness or damping makes G indefinite, the magnitudes of its diagonal entries define the norm instead.
    std::vector<Eigen::Triplet<double>> diagonal;
    for (int i = 0; i < n; ++i) diagonal.emplace_back(i, i, std::max(std::abs(g_.coeff(i, i)), 1e-300));
    g_.setZero();
    g_.setFromTriplets(diagonal.begin(), diagonal.end());
    solver = linear::SymmetricSolver(g_);
  }
  const auto greatest = [&](const Combination& form) {
    Vector x = Vector::Zero(n);
    form.add_to(x, 1.0);
    return std::sqrt(std::max(0.0, x.dot(solver.solve(x))));
  };
  for (const Contact& c : model.contacts) {
    normal_.push_back(greatest(c.normal));
    tangent_.push_back(greatest(c.tangent));
  }
}

double FlowNorm::norm(const Eigen::Ref<const Vector>& x) {
  const double size = x.cwiseAbs().maxCoeff();  // x / size prevents an overflow of squares
  if (!(size > 0.0) || !std::isfinite(size)) return size;
  product_.noalias() = g_ * (x / size);
  return size * std::sqrt(std::max(0.0, x.dot(product_) / size));
}

}  // namespace signorini::exact
