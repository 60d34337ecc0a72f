// shared_rows.hpp: contacts that hold one motion several times, as two feet or two sliders of one body that stick.
//
//   | M  F | | a |   | p |      H z = 0:  rows that say the same
//   | H' 0 | | f | = | b |      F y = 0:  forces that move nothing, so that f is not unique
//
// H has the normals of what is closed and the tangents of what sticks; F the same, but n - s fs t for the normal of a contact
// that bears its static limit at rest (T = -s fs N). With s z (D y)' in place of 0 the matrix is regular, and where z.b = 0
// its solution has H' a = b and y.D f = 0: the motion is the same, and of all forces that go with it those are taken whose sum
// of squares of N and T, f.D f, is least. s > 0 is of the size of H' M^-1 H, which changes no digit of either. Sliders share among themselves, on ground that stands and where
// there is mass; beside rigid contacts they are refused.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/law.hpp"
#include "linear/structure.hpp"

namespace signorini {

/// s Z (D Y)' on rows of forces, numbered as the forces are (signorini/force_layout.hpp).
struct SharedForces {
  std::vector<std::size_t> rows;
  Eigen::MatrixXd entries;  ///< one a pair of rows
  Eigen::MatrixXd null;     ///< Z, orthonormal: rows x motions that are held too often
};

/// Orthonormal z with H z = 0: combinations of columns that vanish, but for a rounding.
[[nodiscard]] Eigen::MatrixXd null_of_columns(const Eigen::MatrixXd& h);

/// Does row i take part in one of these combinations (orthonormal columns)? What rounding has left of it does not count.
[[nodiscard]] bool has_share(const Eigen::MatrixXd& null, Eigen::Index i);

class SharedRows {
 public:
  SharedRows(const Model& model, const Structure& structure);

  /// Contacts of which some may hold one motion together; lists of two at least.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& groups() const { return groups_; }
  /// Is it one of those?
  [[nodiscard]] bool may_share(std::size_t contact) const { return grouped_[contact]; }
  /// Shared forces of the rows in force; empty: all rows are independent.
  [[nodiscard]] std::vector<SharedForces> in_force(const std::vector<Rows>& rows) const;

 private:
  const Model& model_;
  std::vector<double> lightness_;  // a degree of freedom: 1/mass; 0 without
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<bool> grouped_;  // one a contact

  [[nodiscard]] bool has_mass(const Combination& form) const;
  [[nodiscard]] std::vector<std::vector<std::size_t>> together() const;
  /// H on the degrees of freedom that it touches, each over the square root of its mass.
  [[nodiscard]] Eigen::MatrixXd columns(const std::vector<std::size_t>& rows) const;
};

}  // namespace signorini
