#include "model/modes/modes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "model/modes/constrained_structure.hpp"
#include "model/modes/frequencies.hpp"
#include "model/modes/lanczos.hpp"
#include "model/statics/mechanisms.hpp"
#include "model/statics/static_system.hpp"

namespace signorini::modes {
namespace {

constexpr double highest_frequency_tolerance =
    1e-4;  // relative error of the highest omega^2, which only scales steps

double frequency(double omega_squared) { return omega_squared > 0.0 ? std::sqrt(omega_squared) : 0.0; }

/// Lowest omega, rad per time; 0 if a motion has no stiffness; nullopt if no mass can move.
using Lowest = std::optional<double>;

Lowest lowest_dense(const SparseMatrix& mass, const SparseMatrix& k, const std::vector<Combination>& fixed) {
  Eigen::MatrixXd m(mass), stiff(k);
  if (!fixed.empty()) {
    const Eigen::MatrixXd free = base::orthogonal_complement(form_columns(fixed, static_cast<int>(k.rows())));
    m = (free.transpose() * m * free).eval();
    stiff = (free.transpose() * stiff * free).eval();
    if (free.cols() == 0) return std::nullopt;
  }
  if (statics::null_motions(stiff.sparseView()).cols() > 0) return 0.0;
  const Eigen::VectorXd mu = base::generalized_eigenvalues(m, stiff);
  if (mu.size() == 0 || !(mu[mu.size() - 1] > 0.0)) return std::nullopt;
  return 1.0 / std::sqrt(mu[mu.size() - 1]);
}

Lowest lowest_sparse(const SparseMatrix& mass, const SparseMatrix& k, const std::vector<Combination>& fixed) {
  if (statics::null_motions(with_constraint_springs(k, fixed)).cols() > 0) return 0.0;
  const Frequencies lowest =
      lowest_frequencies(mass, SparseMatrix(k.rows(), k.cols()), k, ContactConstraints{{}, fixed}, 1);
  return lowest.modes.empty() ? Lowest() : lowest.modes[0].omega;
}

Lowest lowest_of(const SparseMatrix& mass, const SparseMatrix& k, const std::vector<Combination>& fixed) {
  return mass.rows() <= dense_up_to ? lowest_dense(mass, k, fixed) : lowest_sparse(mass, k, fixed);
}

double highest_of(const SparseMatrix& mass, const SparseMatrix& k) {
  const SparseMatrix heavy = assembly::select_by_mass(mass, true),
                     light = assembly::select_by_mass(mass, false);
  const auto h = static_cast<int>(heavy.cols()), l = static_cast<int>(light.cols());
  if (h == 0) return 0.0;
  const SparseMatrix m = heavy.transpose() * mass * heavy;
  const SparseMatrix kdd = heavy.transpose() * k * heavy;
  const SparseMatrix kmm = light.transpose() * k * light;
  const SparseMatrix kmd = light.transpose() * k * heavy;
  // A massless motion without stiffness (dampers only) cannot be condensed; fixing it gives an upper bound.
  const bool condense = l > 0 && statics::null_motions(kmm).cols() == 0;
  const linear::SymmetricSolver massless(condense ? kmm : SparseMatrix(0, 0));
  auto condensed = [&](const Vector& x) -> Vector {
    Vector y = kdd * x;
    if (condense) y -= kmd.transpose() * massless.solve(kmd * x);
    return y;
  };
  if (h <= dense_up_to) {
    Eigen::MatrixXd kc(h, h);
    for (int j = 0; j < h; ++j) kc.col(j) = condensed(Vector::Unit(h, j));
    const Eigen::VectorXd values =
        base::generalized_eigenvalues(0.5 * (kc + kc.transpose()), Eigen::MatrixXd(m));
    return values.size() == 0 ? 0.0 : frequency(values[values.size() - 1]);
  }
  const linear::CholeskyFactor factor(m);
  if (!factor.ok()) return 0.0;
  auto apply = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return factor.solve_factor(condensed(factor.solve_transposed_factor(x)));
  };
  return frequency(largest_eigenvalue(h, apply, highest_frequency_tolerance));
}

double highest(const SparseMatrix& mass, const SparseMatrix& k) {
  if (mass.rows() <= dense_up_to) return highest_of(mass, k);
  double omega = 0.0;
  for (const assembly::Part& part : assembly::Parts({&mass, &k}))
    omega = std::max(omega, highest_of(part.matrix(mass), part.matrix(k)));
  return omega;
}

}  // namespace

void ContactConstraints::add_normal(const Contact& contact) {
  if (const auto kn = contact.normal_spring()) springs.push_back({contact.normal, *kn});
  if (contact.takes_impulses()) fixed.push_back(contact.normal);
}

ContactConstraints constrain_contacts(const std::vector<Contact>& contacts, const std::vector<bool>& closed) {
  ContactConstraints holding;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    if (!closed[k]) continue;
    holding.add_normal(c);
    if (c.tangential_stiffness && !c.tangent.terms.empty())
      holding.springs.push_back({c.tangent, *c.tangential_stiffness});
    else if ((!c.normal_spring() || c.sliding_point()) && !c.tangent.terms.empty())
      holding.fixed.push_back(c.tangent);
  }
  return holding;
}

double lowest_frequency(const SparseMatrix& mass, const SparseMatrix& stiffness,
                        const ContactConstraints& holding) {
  if (mass.rows() == 0) return 0.0;
  const SparseMatrix k = assembly::with_springs(stiffness, holding.springs);
  if (mass.rows() <= dense_up_to) return lowest_of(mass, k, holding.fixed).value_or(0.0);
  Lowest lowest;
  for (const assembly::Part& part : assembly::Parts({&mass, &k}, holding.fixed)) {
    const Lowest own = lowest_of(part.matrix(mass), part.matrix(k), part.forms(holding.fixed));
    if (own) lowest = std::min(*own, lowest.value_or(*own));
  }
  return lowest.value_or(0.0);
}

double highest_frequency(const Model& model) {
  const ContactConstraints holding =
      constrain_contacts(model.contacts, std::vector<bool>(model.contacts.size(), true));
  return highest(model.mass, assembly::with_springs(model.stiffness, holding.springs));
}

namespace {

constexpr double beside = 0.999;  // fraction of omega1^2: a shift at which K - s M is regular
constexpr int solves = 4;         // inverse iterations; each reduces the error by a factor of some hundred

}  // namespace

double rounding_floor(const Model& model) {
  if (!(model.omega1 > 0.0) || model.stiffness.nonZeros() == 0) return 0.0;
  const SparseMatrix k = assembly::with_springs(model.stiffness, assembly::contact_springs(model.contacts));
  const double shift = beside * model.omega1 * model.omega1;
  const linear::SymmetricSolver solver(SparseMatrix(k - shift * model.mass));
  if (!solver.ok()) return 0.0;
  Vector x = Vector::LinSpaced(model.size(), 1.0, 1.7);  // not orthogonal to any shape by symmetry
  for (int i = 0; i < solves; ++i) {
    x = solver.solve(model.mass * x);
    x /= x.cwiseAbs().maxCoeff();
  }
  const double energy = x.dot(k * x);
  if (!(energy > 0.0)) return 0.0;
  double squares = 0.0;
  for (int j = 0; j < k.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(k, j); it; ++it) {
      const double term = x[it.row()] * it.value() * x[j];
      squares += term * term;
    }
  return 0.25 * rounding::eps * std::sqrt(squares) / energy;
}

}  // namespace signorini::modes
