#include "model/slip_growth.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/eigen_dense.hpp"
#include "contact/friction.hpp"
#include "model/assembly/springs.hpp"
#include "model/statics/static_system.hpp"

namespace signorini::model {

double diagonal_decay(const Vector& mass, const Vector& damping, const Vector& stiffness) {
  double rate = 0.0;
  for (Eigen::Index i = 0; i < mass.size(); ++i) {
    if (mass[i] > 0.0)
      rate = std::max(rate, damping[i] / mass[i]);
    else if (damping[i] > 0.0)
      rate = std::max(rate, stiffness[i] / damping[i]);
  }
  return rate;
}

double fastest_decay(const Model& model) {
  Vector c = model.damping.diagonal(), k = model.stiffness.diagonal();
  for (const Contact& contact : model.contacts) {
    for (const auto& [dof, n] : contact.normal.terms) {
      c[dof] += n * n * contact.normal_damping;
      k[dof] += n * n * contact.normal_stiffness;
    }
    for (const auto& [dof, t] : contact.tangent.terms)
      k[dof] += t * t * contact.tangential_stiffness.value_or(0.0);
  }
  const double rayleigh = model.alpha + model.beta * model.omega_max * model.omega_max;
  return std::max(rayleigh, diagonal_decay(model.mass.diagonal(), c, k));
}

double min_damping_ratio(const Model& model) {
  if (!(model.omega_max > 0.0)) return 0.0;
  double beta = model.beta;
  for (const Contact& contact : model.contacts)
    if (contact.normal_stiffness > 0.0 || contact.tangential_stiffness) beta = 0.0;
  // (alpha / omega + beta omega) / 2 is least at sqrt(alpha / beta).
  const double alpha = model.alpha, omega_max = model.omega_max;
  if (alpha < beta * omega_max * omega_max) return std::sqrt(alpha * beta);
  return 0.5 * (alpha / omega_max + beta * omega_max);
}

namespace {

constexpr int all_up_to = 100,
              most = 400;  // limits of the number of degrees of freedom; chosen for a few 0.1 s
// Results are valid up to this fraction of the highest frequency; above, truncated modes would contribute.
constexpr double of_window = 0.5;
constexpr double rigid = 1e4;  // stiffness of rigid contacts / stiffness of the structure along the normal
// Smallest growth, relative to |lambda| or sigma: rounding splits a double eigenvalue by sqrt(eps) = 1.5e-8.
constexpr double no_growth = 1e-6;

/// A slipping contact. push = n - s f t: direction of the sum of its normal and friction force.
struct SlippingContact {
  Vector normal, push;
  double stiffness, damping;
};

struct Slipping {
  SparseMatrix stiffness;  ///< of the structure and of contacts that do not slip; symmetric
  std::vector<SlippingContact> drives;
  std::vector<std::size_t> contacts;
};

Slipping slipping(const Model& model, const std::vector<State>& states) {
  Slipping result;
  std::vector<assembly::LineSpring> springs;
  const auto spring = [&](const Combination& form, std::optional<double> k) {
    return assembly::LineSpring{form, k ? *k : rigid * statics::structural_stiffness(model.stiffness, form)};
  };
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (is_open(states[k])) continue;
    const int s = slip_sign(states[k]);
    if (s == 0 && c.has_friction()) springs.push_back(spring(c.tangent, c.tangential_stiffness));
    if (c.normal_force_given()) continue;
    const assembly::LineSpring normal = spring(c.normal, c.normal_spring());
    if (s == 0) {
      springs.push_back(normal);
      continue;
    }
    const Vector n = assembly::dense_vector(c.normal, model.size());
    const double f = c.friction.is_load_dependent()
                         ? contact::friction_limit_slope(c.friction, -c.normal_stiffness * c.gap_at(model.u0))
                         : contact::kinetic_friction(c);
    const Vector push = n - s * f * assembly::dense_vector(c.tangent, model.size());
    result.drives.push_back({n, push, normal.stiffness, c.normal_damping});
    result.contacts.push_back(k);
  }
  result.stiffness = assembly::with_springs(model.stiffness, springs);
  return result;
}

/// Shapes (n x m) on which the equations are projected, and the |lambda| up to which the results are valid.
struct Window {
  Eigen::MatrixXd shapes;
  double end = std::numeric_limits<double>::infinity();
};

Window window(const Model& model, const Slipping& slip, double sigma) {
  const Eigen::Index n = model.size();
  if (n <= all_up_to) return {Eigen::MatrixXd::Identity(n, n)};
  Eigen::MatrixXd k = slip.stiffness;
  for (const SlippingContact& drive : slip.drives)
    k += drive.stiffness * drive.normal * drive.normal.transpose();
  // Eigenvalues 1 / (omega^2 + sigma^2), ascending: the last ones belong to the lowest frequencies.
  const base::EigenPairs pairs =
      base::generalized_eigen(model.mass, k + sigma * sigma * Eigen::MatrixXd(model.mass));
  if (pairs.values.size() < n) return {Eigen::MatrixXd(n, 0)};
  const double last = pairs.values[n - all_up_to];
  const double square = last > 0.0 ? 1.0 / last - sigma * sigma : 0.0;
  return {pairs.vectors.rightCols(all_up_to), of_window * std::sqrt(std::max(0.0, square))};
}

/// Returns all finite lambda of M x'' + C x' + K x = 0.
std::vector<std::complex<double>> exponents(const Eigen::MatrixXd& m, const Eigen::MatrixXd& c,
                                            const Eigen::MatrixXd& k, double sigma) {
  const Eigen::Index n = m.rows();
  Eigen::MatrixXd right(n, 2 * n);
  right << c + 2.0 * sigma * m, m;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRows(n) = -base::solve_dense(k + sigma * c + sigma * sigma * m, right);
  a.bottomLeftCorner(n, n).setIdentity();
  // Scaled by sigma, so that the two halves of z have equal size.
  a.topRightCorner(n, n) *= sigma;
  a.bottomLeftCorner(n, n) /= sigma;
  std::vector<std::complex<double>> found;
  for (const std::complex<double> nu : base::general_eigenvalues(sigma * a))
    if (std::abs(nu) > no_growth) found.push_back(sigma * (1.0 + 1.0 / nu));
  return found;
}

}  // namespace

std::optional<SlipGrowth> slip_growth(const Model& model, const std::vector<State>& states) {
  const Slipping slip = slipping(model, states);
  if (slip.drives.empty() || !(model.omega_max > 0.0) || model.size() > most) return std::nullopt;
  const double sigma = model.omega1 > 0.0 ? model.omega1 : 1e-3 * model.omega_max;
  const auto [q, end] = window(model, slip, sigma);
  if (q.cols() == 0) return std::nullopt;
  Eigen::MatrixXd k = q.transpose() * (slip.stiffness * q), c = q.transpose() * (model.damping * q);
  for (const SlippingContact& drive : slip.drives) {
    const Eigen::MatrixXd way = (q.transpose() * drive.push) * (drive.normal.transpose() * q);
    k += drive.stiffness * way;
    c += drive.damping * way;
  }
  SlipGrowth fastest;
  for (const std::complex<double> lambda : exponents(q.transpose() * (model.mass * q), c, k, sigma)) {
    const double size = std::abs(lambda);
    if (size > end || !(lambda.real() > no_growth * std::max(size, sigma))) continue;
    if (lambda.real() <= fastest.rate) continue;
    const bool turns = std::abs(lambda.imag()) > no_growth * lambda.real();
    fastest = {lambda.real(), turns ? std::abs(lambda.imag()) : 0.0, slip.contacts};
  }
  return fastest.rate > 0.0 ? std::optional(fastest) : std::nullopt;
}

}  // namespace signorini::model
