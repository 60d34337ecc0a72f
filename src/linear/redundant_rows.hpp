// redundant_rows.hpp: contacts that constrain one motion redundantly, such as two feet or two sticking sliders of one
// body.
//
//   | M  F | | a |   | p |      H z = 0:  dependent constraints
//   | H' 0 | | f | = | b |      F y = 0:  forces without effect on the motion, so that f is not unique
//
// H has the normals of closed contacts and the tangents of sticking contacts as columns. F is the same, but
// has n - s fs t for the normal of a contact at its static limit (T = -s fs N).
//
// With s z (D y)' in place of 0 the matrix is regular. If z.b = 0, its solution satisfies
//   H' a = b,   y.D f = 0
// So the motion is the same, and f are the possible forces with the least sum of squares of N and T, f.D f.
// s > 0 has the size of H' M^-1 H, so that it adds no rounding error to motion or forces.
//
// Sliders share forces with sliders only, on ground at rest and where there is mass. A slider that shares
// with rigid contacts is refused.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/law.hpp"
#include "linear/system_matrices.hpp"

namespace signorini::linear {

/// The entries s Z (D Y)' of contacts that constrain one motion redundantly. Columns of Z and Y: all z and y.
/// Rows are numbered as the forces are (signorini/force_layout.hpp).
struct SharedForces {
  std::vector<std::size_t> rows;
  Eigen::MatrixXd entries;  ///< one for each pair of rows
  Eigen::MatrixXd null;     ///< Z, orthonormal: rows x redundantly constrained motions
};

/// Orthonormal z with H z = 0, as columns: combinations of the columns of h that vanish up to rounding.
[[nodiscard]] Eigen::MatrixXd null_of_columns(const Eigen::MatrixXd& h);

/// True if row i participates in one of these combinations (orthonormal columns) by more than rounding.
[[nodiscard]] bool has_share(const Eigen::MatrixXd& null, Eigen::Index i);

class RedundantRows {
 public:
  RedundantRows(const Model& model, const SystemMatrices& structure);

  /// Lists of two or more contacts, some of which may constrain one motion together.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& groups() const { return groups_; }
  /// True if the contact is in one of those lists.
  [[nodiscard]] bool may_share(std::size_t contact) const { return grouped_[contact]; }
  /// Shared forces of a contact state with these rows; empty: all rows are independent.
  [[nodiscard]] std::vector<SharedForces> in_force(const std::vector<Rows>& rows) const;

 private:
  const Model& model_;
  std::vector<double> inverse_mass_;  // by degree of freedom: 1/mass; 0 without mass
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<bool> grouped_;  // one for each contact

  [[nodiscard]] bool has_mass(const Combination& form) const;
  [[nodiscard]] std::vector<std::vector<std::size_t>> coupled_groups() const;
  /// H on the degrees of freedom on which the rows act, each divided by the square root of its mass.
  [[nodiscard]] Eigen::MatrixXd columns(const std::vector<std::size_t>& rows) const;
};

}  // namespace signorini::linear
