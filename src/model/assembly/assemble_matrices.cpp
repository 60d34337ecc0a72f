#include <fmt/core.h>

#include <cmath>

#include "model/assembly/assembly.hpp"

namespace signorini {
namespace {

constexpr double printed_digits = 1e-9;  // relative to the largest entry: smaller differences count as
                                         // symmetric

double largest(const SparseMatrix& a) {
  double result = 0.0;
  for (int k = 0; k < a.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(a, k); it; ++it) result = std::max(result, std::abs(it.value()));
  return result;
}

SparseMatrix read(const MatrixSpec& spec, int n, const std::string& key) {
  SparseMatrix a(n, n);
  if (spec.size == 0 && spec.entries.empty()) return a;  // absent: zero
  if (spec.size != n)
    throw SceneError(
        spec.place, key,
        fmt::format("found {0} x {0}, expected {1} x {1} for {1} degrees of freedom", spec.size, n));
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& e : spec.entries)
    if (e.value != 0.0) entries.emplace_back(e.row, e.column, e.value);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

/// Other programs print symmetric matrices with rounded digits, so small differences are averaged.
SparseMatrix read_symmetric(const MatrixSpec& spec, int n, const std::string& key) {
  const SparseMatrix a = read(spec, n, key);
  const SparseMatrix transposed = a.transpose();
  const SparseMatrix difference = a - transposed;
  if (largest(difference) > printed_digits * largest(a))
    throw SceneError(spec.place, key, "the matrix is not symmetric");
  return 0.5 * (a + transposed);
}

}  // namespace

Assembly assemble_matrices(const Scene& scene, const DofMap& map) {
  const MatricesSpec& matrices = *scene.matrices;
  const auto n = static_cast<int>(matrices.dofs.size());
  Assembly a;
  a.mass = read_symmetric(matrices.mass, n, "matrices.mass");
  a.dampers = read(matrices.damping, n, "matrices.damping");
  a.stiffness = read_symmetric(matrices.stiffness, n, "matrices.stiffness");
  a.weight = Vector::Zero(n);
  for (const BaseMotionSpec& motion : scene.base_motion) {
    Vector r = Vector::Zero(n);
    combination(map, motion.direction, "base_motion.direction", false).add_to(r, 1.0);
    a.base.emplace_back(a.mass * r);
  }
  return a;
}

}  // namespace signorini
