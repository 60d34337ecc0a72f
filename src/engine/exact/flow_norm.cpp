#include "engine/exact/flow_norm.hpp"

#include <algorithm>
#include <cmath>

#include "model/assembly/springs.hpp"

namespace signorini {
FlowNorm::FlowNorm(const Model& model) : product_(Vector::Zero(model.size())) {
  const double w = model.omega_max > 0.0 ? model.omega_max : 1.0;
  const int n = model.size();
  const SparseMatrix damping = 0.5 * (model.damping + SparseMatrix(model.damping.transpose()));
  g_ = model.mass + damping / w + with_springs(model.stiffness, contact_springs(model.contacts)) / (w * w);
  SymmetricSolver solver(g_);
  if (!solver.ok() || !(solver.smallest_pivot() > 0.0)) {
    // If a stiffness or damping is not positive, the magnitudes of the diagonal form a norm as well.
    std::vector<Eigen::Triplet<double>> diagonal;
    for (int i = 0; i < n; ++i) diagonal.emplace_back(i, i, std::max(std::abs(g_.coeff(i, i)), 1e-300));
    g_.setZero();
    g_.setFromTriplets(diagonal.begin(), diagonal.end());
    solver = SymmetricSolver(g_);
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

double FlowNorm::of(const Eigen::Ref<const Vector>& x) {
  const double size = x.cwiseAbs().maxCoeff();  // squares must not overflow
  if (!(size > 0.0) || !std::isfinite(size)) return size;
  product_.noalias() = g_ * (x / size);
  return size * std::sqrt(std::max(0.0, x.dot(product_) / size));
}

}  // namespace signorini
