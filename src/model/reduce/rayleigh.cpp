#include "model/reduce/rayleigh.hpp"

#include <cmath>

namespace signorini {
namespace {

constexpr double ten_digits = 1e-9;

double inner(const SparseMatrix& a, const SparseMatrix& b) { return a.cwiseProduct(b).sum(); }

/// Least-squares fit over all entries, M and K scaled to one.
RayleighFactors fitted(const SparseMatrix& damping, const SparseMatrix& mass, const SparseMatrix& stiffness) {
  const double m = mass.norm(), k = stiffness.norm();
  const double cm = m > 0.0 ? inner(damping, mass) / m : 0.0,
               ck = k > 0.0 ? inner(damping, stiffness) / k : 0.0;
  const double mk = m > 0.0 && k > 0.0 ? inner(mass, stiffness) / (m * k) : 0.0;
  const double det = 1.0 - mk * mk;
  if (!(det > ten_digits)) return {m > 0.0 ? cm / m : 0.0, 0.0};  // M and K are proportional
  return {m > 0.0 ? (cm - mk * ck) / (det * m) : 0.0, k > 0.0 ? (ck - mk * cm) / (det * k) : 0.0};
}

bool is_sum(const SparseMatrix& damping, const SparseMatrix& mass, const SparseMatrix& stiffness,
            const RayleighFactors& f) {
  const SparseMatrix rest = damping - SparseMatrix(f.alpha * mass + f.beta * stiffness);
  const SparseMatrix size =
      SparseMatrix(damping.cwiseAbs()) +
      SparseMatrix(f.alpha * SparseMatrix(mass.cwiseAbs()) + f.beta * SparseMatrix(stiffness.cwiseAbs()));
  for (int j = 0; j < rest.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(rest, j); it; ++it)
      if (!(std::abs(it.value()) <= ten_digits * size.coeff(it.row(), it.col()))) return false;
  return true;
}

}  // namespace

std::optional<RayleighFactors> rayleigh_factors(const SparseMatrix& damping, const SparseMatrix& mass,
                                                const SparseMatrix& stiffness) {
  const double size = damping.norm();
  if (!(size > 0.0)) return std::nullopt;
  RayleighFactors f = fitted(damping, mass, stiffness);
  if (std::abs(f.alpha) * mass.norm() <= ten_digits * size) f.alpha = 0.0;
  if (std::abs(f.beta) * stiffness.norm() <= ten_digits * size) f.beta = 0.0;
  if (f.alpha < 0.0 || f.beta < 0.0 || !is_sum(damping, mass, stiffness, f)) return std::nullopt;
  return f;
}

}  // namespace signorini
