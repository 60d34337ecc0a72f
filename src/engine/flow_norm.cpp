#include "engine/flow_norm.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

void add_square(const Combination& form, double value, std::vector<Eigen::Triplet<double>>& entries) {
  for (const auto& [i, a] : form.terms)
    for (const auto& [j, b] : form.terms) entries.emplace_back(i, j, value * a * b);
}

}  // namespace

FlowNorm::FlowNorm(const Model& model) : product_(Vector::Zero(model.size())) {
  const double w = model.omega_max > 0.0 ? model.omega_max : 1.0;
  const int n = model.size();
  std::vector<Eigen::Triplet<double>> springs;
  for (const Contact& c : model.contacts) {
    if (c.law == Law::compliant) add_square(c.normal, c.normal_stiffness, springs);
    if (c.tangential_stiffness) add_square(c.tangent, *c.tangential_stiffness, springs);
  }
  SparseMatrix contact(n, n);
  contact.setFromTriplets(springs.begin(), springs.end());
  const SparseMatrix damping = 0.5 * (model.damping + SparseMatrix(model.damping.transpose()));
  g_ = model.mass + damping / w + (model.stiffness + contact) / (w * w);
  Eigen::SimplicialLDLT<SparseMatrix> solver(g_);
  if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 0.0)) {
    // A stiffness or damping that is not positive: the diagonal's magnitudes make a norm all the same.
    std::vector<Eigen::Triplet<double>> diagonal;
    for (int i = 0; i < n; ++i) diagonal.emplace_back(i, i, std::max(std::abs(g_.coeff(i, i)), 1e-300));
    g_.setZero();
    g_.setFromTriplets(diagonal.begin(), diagonal.end());
    solver.compute(g_);
  }
  const auto greatest = [&](const Combination& form) {
    Vector x = Vector::Zero(n);
    form.add_to(x, 1.0);
    return std::sqrt(std::max(0.0, x.dot(Vector(solver.solve(x)))));
  };
  for (const Contact& c : model.contacts) {
    normal_.push_back(greatest(c.normal));
    tangent_.push_back(greatest(c.tangent));
  }
}

double FlowNorm::of(const Eigen::Ref<const Vector>& x) const {
  product_.noalias() = g_ * x;
  return std::sqrt(std::max(0.0, x.dot(product_)));
}

}  // namespace signorini
