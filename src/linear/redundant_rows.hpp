// redundant_rows.hpp: contacts that constrain the same motion redundantly, such as two feet or two sticking sliders of one
// body.
//
//   | M  F | | a |   | p |      H z = 0:  dependent constraints
//   | H' 0 | | f | = | b |      F y = 0:  forces without effect on the motion, so that f is not unique
//
// Columns of H: normals n of closed contacts and tangents t of sticking contacts. Columns of F: those of H, but n + r t for
// the normal of a contact at its static limit, where T = r N.
//
// If s z (D y)' replaces the zero block, the matrix is regular. If z.b = 0, the solution satisfies
//   H' a = b,   y.D f = 0          f.D f: sum of the squares of N and T
// So the motion is unchanged, and of all possible forces, f has the least sum of squares of N and T. The factor s > 0 has the
// magnitude of H' M^-1 H, so that it adds no rounding errors to motion or forces.
//
// Sliders are treated like this on ground at rest and on degrees of freedom with mass, together with other sliders and with
// rigid contacts.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/law.hpp"
#include "linear/system_matrices.hpp"

namespace signorini::linear {

/// The block s Z (D Y)' of contacts that constrain the same motion redundantly. Columns of Z and Y: all vectors z and y.
/// Rows are numbered like the forces (signorini/force_layout.hpp).
struct SharedForces {
  std::vector<std::size_t> rows;
  Eigen::MatrixXd
      entries;           ///< the block; entry (i, j) belongs to row rows[i] and column rows[j] of the matrix
  Eigen::MatrixXd null;  ///< Z, orthonormal: rows x redundantly constrained motions
};

/// Orthonormal vectors z with h z = 0 up to rounding, as columns; no columns: the columns of h are linearly independent.
[[nodiscard]] Eigen::MatrixXd null_of_columns(const Eigen::MatrixXd& h);

/// True if row i participates in one of the combinations `null` (orthonormal columns) by more than rounding.
[[nodiscard]] bool participates_in(const Eigen::MatrixXd& null, Eigen::Index i);

class RedundantRows {
 public:
  RedundantRows(const Model& model, const SystemMatrices& structure);

  /// Groups of two or more contacts, some of which may constrain the same motion.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& groups() const { return groups_; }
  /// True if the contact is in one of the groups().
  [[nodiscard]] bool may_share(std::size_t contact) const { return grouped_[contact]; }
  /// Shared forces in a contact state with these rows; empty: all constraint rows are independent.
  [[nodiscard]] std::vector<SharedForces> in_force(const std::vector<Rows>& rows) const;

 private:
  const Model& model_;
  std::vector<double> inverse_mass_;  // 1/mass by degree of freedom; 0: no mass
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<bool> grouped_;  // true if the contact is in a group, by contact

  [[nodiscard]] bool has_mass(const Combination& form) const;
  [[nodiscard]] std::vector<std::vector<std::size_t>> coupled_groups() const;
  /// Columns of H for these rows, restricted to the degrees of freedom on which the rows act. Each entry is divided by the
  /// square root of the mass of its degree of freedom.
  [[nodiscard]] Eigen::MatrixXd columns(const std::vector<std::size_t>& rows) const;
};

}  // namespace signorini::linear
