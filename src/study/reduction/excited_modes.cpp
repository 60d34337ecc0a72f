#include "study/reduction/excited_modes.hpp"

#include <cmath>

#include "base/eigen_dense.hpp"
#include "model/assembly/springs.hpp"

namespace signorini::reduction {
namespace {

// Number of terms of the series for each force. Chosen value; tests/unit/study/reduction/excited_modes
// compares the result with all modes.
constexpr int terms = 4;
constexpr double dependent = 1e-10;  // a smaller part of a vector's energy outside the span is rounding
// Smallest 1/omega^2 of a vector, relative to the largest; below it the vector responds without inertia.
constexpr double needs_no_mass = 1e-12;

/// Vectors that are orthonormal with respect to the stiffness matrix K.
class Span {
 public:
  explicit Span(const SparseMatrix& k) : k_(k), vectors_(k.rows(), 0), forces_(k.rows(), 0) {}
  void add(Vector x) {
    const double before = x.dot(k_ * x);
    for (int round = 0; round < 2; ++round)
      x -= vectors_.leftCols(count_) * (forces_.leftCols(count_).transpose() * x);
    const Vector force = k_ * x;
    const double energy = x.dot(force);
    if (!(energy > dependent * before)) return;
    if (count_ == vectors_.cols()) {
      vectors_.conservativeResize(Eigen::NoChange, 2 * count_ + 16);
      forces_.conservativeResize(Eigen::NoChange, 2 * count_ + 16);
    }
    vectors_.col(count_) = x / std::sqrt(energy);
    forces_.col(count_++) = force / std::sqrt(energy);
  }
  [[nodiscard]] auto vectors() const { return vectors_.leftCols(count_); }

 private:
  const SparseMatrix& k_;
  Eigen::MatrixXd vectors_, forces_;  // forces_: K times each vector
  Eigen::Index count_ = 0;
};

}  // namespace

ExcitedModes excited_modes(const Model& structure, const reduce::KeptModes& kept) {
  const int n = structure.size();
  const reduce::ResidualFlexibility flexibility(structure.mass, structure.stiffness, kept);
  std::vector<Vector> answers;
  for (const Contact& contact : structure.contacts) {
    if (!contact.normal_force_given())
      answers.push_back(flexibility.response(assembly::dense_vector(contact.normal, n)));
    if (contact.has_friction())
      answers.push_back(flexibility.response(assembly::dense_vector(contact.tangent, n)));
  }
  for (const Load& load : structure.loads)
    answers.push_back(flexibility.response(assembly::dense_vector(load.direction, n)));
  for (const Vector& state : {structure.u0, structure.v0})
    answers.push_back(state - kept.shapes * (kept.shapes.transpose() * (structure.mass * state)));
  Span span(structure.stiffness);
  for (int term = 0; term < terms; ++term)
    for (Vector& answer : answers) {
      if (term > 0) answer = flexibility.response(structure.mass * answer);
      span.add(answer);
    }
  const Eigen::MatrixXd h = span.vectors();
  ExcitedModes result{Eigen::VectorXd(0), Eigen::MatrixXd(n, 0)};
  if (h.cols() == 0) return result;
  const base::EigenPairs ritz =
      base::symmetric_eigen(h.transpose() * (structure.mass * h));  // 1/omega^2, ascending
  const Eigen::Index all = ritz.values.size();
  if (all == 0 || !ritz.values.allFinite())
    throw reduce::NotReducible("the contribution of the truncated modes cannot be estimated");
  const Eigen::Index count = (ritz.values.array() > needs_no_mass * ritz.values[all - 1]).count();
  const Eigen::VectorXd inverse = ritz.values.tail(count).reverse();
  result.squares = inverse.cwiseInverse();
  result.shapes =
      h * ritz.vectors.rightCols(count).rowwise().reverse() * inverse.cwiseSqrt().cwiseInverse().asDiagonal();
  return result;
}

}  // namespace signorini::reduction
