#include "model/statics/residual.hpp"

namespace signorini::statics {

long double exact_dot(const Combination& form, const Vector& u) {
  long double sum = 0.0L;
  for (const auto& [dof, factor] : form.terms) sum += static_cast<long double>(factor) * u[dof];
  return sum;
}

Residual::Residual(const Vector& load) : sums_(load.begin(), load.end()) {}

void Residual::subtract(const SparseMatrix& k, const Vector& u) {
  for (int column = 0; column < k.outerSize(); ++column) {
    const auto factor = static_cast<long double>(u[column]);
    for (SparseMatrix::InnerIterator entry(k, column); entry; ++entry)
      sums_[static_cast<std::size_t>(entry.row())] -= entry.value() * factor;
  }
}

void Residual::subtract(const Combination& form, long double force) {
  for (const auto& [dof, factor] : form.terms) sums_[static_cast<std::size_t>(dof)] -= factor * force;
}

Vector Residual::rounded() const {
  Vector result(static_cast<Eigen::Index>(sums_.size()));
  for (std::size_t i = 0; i < sums_.size(); ++i)
    result[static_cast<Eigen::Index>(i)] = static_cast<double>(sums_[i]);
  return result;
}

}  // namespace signorini::statics
