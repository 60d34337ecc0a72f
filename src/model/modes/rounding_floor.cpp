#include "model/modes/rounding_floor.hpp"

#include <cmath>

#include "base/rounding.hpp"
#include "model/assembly/springs.hpp"

namespace signorini {
namespace {

constexpr double beside = 0.999;  // of omega1^2: a shift at which K - s M is regular
constexpr int solves = 4;         // inverse iterations; each one gains a factor of some hundred

}  // namespace

double rounding_floor(const Model& model) {
  if (!(model.omega1 > 0.0) || model.stiffness.nonZeros() == 0) return 0.0;
  const SparseMatrix k = with_springs(model.stiffness, contact_springs(model.contacts));
  const double shift = beside * model.omega1 * model.omega1;
  const SymmetricSolver solver(SparseMatrix(k - shift * model.mass));
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

}  // namespace signorini
