// mass_factors.hpp: solver for contact states in which contact forces follow from displacements and velocities alone.
//
//   | M  H | | a |   | b |      f = B^-1 q   contact by contact, 2 x 2 each
//   | 0  B | | f | = | q |      a = M^-1 (b - H f)
//
// This is the matrix of linear/system_matrix.hpp if every degree of freedom has mass and no row of a contact contains an
// acceleration, as for compliant contacts and sliders. M is the same in all these states, so one factorisation of M is
// enough, and a change of state needs no factorisation.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "contact/law.hpp"
#include "linear/klu.hpp"
#include "linear/system_matrices.hpp"

namespace signorini::linear {

/// Factors of M; nullptr: M is singular to working precision.
[[nodiscard]] std::shared_ptr<const TriangularFactors> mass_factors(const SystemMatrices& structure);

/// B of one contact: coefficients of N and T in its normal row, then in its tangent row.
struct ContactForceBlock {
  double normal_N = 1.0, normal_T = 0.0, tangent_N = 0.0, tangent_T = 1.0;
};

/// B of each contact. Empty: a row of some contact contains an acceleration or does not determine the force.
[[nodiscard]] std::vector<ContactForceBlock> contact_force_blocks(const std::vector<Rows>& rows);

class MassSolver {
 public:
  /// The model must outlive the object.
  MassSolver(const Model& model, std::shared_ptr<const TriangularFactors> mass,
             std::vector<ContactForceBlock> forces)
      : model_(&model), mass_(std::move(mass)), forces_(std::move(forces)) {}

  /// x := A^-1 x. x: n degrees of freedom, then N and T of each contact; work: scratch for n numbers.
  void solve(double* x, double* work) const;
  /// Memory in bytes, without the shared factors of M.
  [[nodiscard]] std::size_t bytes() const { return forces_.size() * sizeof(ContactForceBlock); }

 private:
  const Model* model_;
  std::shared_ptr<const TriangularFactors> mass_;
  std::vector<ContactForceBlock> forces_;
};

// A matrix that differs from a factored matrix in few rows (Woodbury formula).
//
//   A = A_0 + sum e_r d_r'          d_r: difference between row r of A and that of A_0
//   A^-1 b = x - Y (1 + D Y)^-1 D x      x = A_0^-1 b,  columns of Y: A_0^-1 e_r,  rows of D: d_r'
//
// A column of Y costs one solve and is kept as long as A_0, so a row that changes again needs no further solve.

struct ChangedRow {
  std::size_t row = 0;
  std::vector<std::pair<std::size_t, double>> entries;  ///< d_r as pairs (column, value)
};

class WoodburyFactors {
 public:
  /// Largest number of changed rows; with more, a solve with Y costs more than factoring a band matrix.
  static constexpr std::size_t max_rows = 16;

  /// Sets A_0, which must be regular.
  void set_base(std::shared_ptr<const TriangularFactors> base);
  [[nodiscard]] const TriangularFactors* base() const { return base_.get(); }
  /// Sets the changed rows, which replace earlier ones. False: there are too many rows, or the inverse of 1 + D Y loses more
  /// digits than permitted; solve() must then not be called.
  [[nodiscard]] bool set(std::vector<ChangedRow> rows);
  /// b := A^-1 b; b and work have the length of A; work: scratch.
  void solve(double* b, double* work);
  /// Number of doubles that a solve reads in addition to the factors of A_0.
  [[nodiscard]] std::size_t numbers() const { return rows_.size() * (base_ ? base_->size() : 0); }
  /// Number of solves that columns of Y have needed so far.
  [[nodiscard]] long solves() const { return solves_; }

 private:
  const Eigen::VectorXd& column(std::size_t row);

  std::shared_ptr<const TriangularFactors> base_;
  std::map<std::size_t, Eigen::VectorXd> columns_;
  std::vector<ChangedRow> rows_;
  std::vector<const Eigen::VectorXd*> in_force_;  // columns of Y, one for each entry of rows_
  Eigen::MatrixXd inverse_;                       // inverse of 1 + D Y
  Eigen::VectorXd parts_, shares_, work_;         // parts_: D x; shares_: (1 + D Y)^-1 D x
  long solves_ = 0;
};

}  // namespace signorini::linear
