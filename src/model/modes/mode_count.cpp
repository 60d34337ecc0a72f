#include "model/modes/mode_count.hpp"

#include "model/assembly/springs.hpp"

namespace signorini {
namespace {

constexpr double nearest = 1e-9, farthest = 1e-5;  // relative, of omega^2: range of alternative shifts
constexpr double accurate = 1e-6;  // backward error of a factorisation whose pivot signs are reliable

/// Pivots are not chosen by size, so an unlucky shift may lose all digits; a trial solution detects this.
bool is_accurate(const SymmetricSolver& solver, const SparseMatrix& a) {
  if (!solver.ok()) return false;
  const Vector b = a.diagonal().cwiseAbs();
  const Vector x = solver.solve(b);
  if (!x.allFinite()) return false;
  const Vector size = a.cwiseAbs() * x.cwiseAbs() + b;
  return ((a * x - b).cwiseAbs().array() <= accurate * size.array()).all();
}

}  // namespace

int modes_below(const SparseMatrix& mass, const SparseMatrix& stiffness, double square) {
  for (double beyond = 0.0; beyond <= farthest; beyond = beyond > 0.0 ? 10.0 * beyond : nearest) {
    const SparseMatrix a = stiffness - (1.0 + beyond) * square * mass;
    const SymmetricSolver solver(a);
    if (is_accurate(solver, a)) return solver.negative_pivots();
  }
  return -1;
}

}  // namespace signorini
