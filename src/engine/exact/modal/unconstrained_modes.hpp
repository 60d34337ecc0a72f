// unconstrained_modes.hpp: all vibration modes of a structure whose contacts are open.
//
//   K phi = omega^2 M phi,   Phi^T M Phi = 1
//
// Frequencies are bracketed by counting negative pivots of K - s M (damped_pencil.hpp). Shapes are computed by inverse
// iteration and the Rayleigh quotient in extended precision. The shapes are made orthonormal from low to high frequencies: a
// symmetric correction would add forces of high modes to low modes. Free motions have omega = 0 exactly.
// Sources: Bathe, Finite Element Procedures, section 11.4 (Sturm); Parlett, The Symmetric Eigenvalue Problem,
// chapter 4 (Rayleigh quotient iteration).
#pragma once

#include <string>

#include "engine/exact/modal/small_matrices.hpp"
#include "signorini/model.hpp"

namespace signorini::modal {

struct UnconstrainedModes {
  Vector omega_squared;    ///< omega^2, ascending; 0 for free motions
  Eigen::MatrixXd shapes;  ///< n x n, columns M-orthonormal
  int free = 0;            ///< number of motions without stiffness
  std::string failure;     ///< reason why the modes could not be computed; empty: no failure

  [[nodiscard]] bool found() const { return failure.empty(); }
};

/// True if the band of both matrices is so narrow that band matrices save time in the computation of modes.
[[nodiscard]] bool has_narrow_band(const SparseMatrix& mass, const SparseMatrix& stiffness);

/// Computes all modes. mass, stiffness: symmetric, mass positive definite. Takes about n^2 (10 + band^2) operations, and 3 n^3
/// for matrix products. If `failure` is set, the other members are empty.
[[nodiscard]] UnconstrainedModes unconstrained_modes(const SparseMatrix& mass, const SparseMatrix& stiffness);

// A structure, its contacts and its loads in its unconstrained modes.
//
//   u = Phi q,   q = Phi^T M u,   form . u = (Phi^T form) . q

/// True if the matrix is symmetric up to rounding.
[[nodiscard]] bool is_symmetric(const SparseMatrix& a);
/// True if all loads, given normal forces and surface motions are piecewise constant.
[[nodiscard]] bool has_constant_excitation(const Model& model);

class UnconstrainedBasis {
 public:
  explicit UnconstrainedBasis(const Model& model);

  /// Reason why the modes could not be computed; empty: no failure.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// omega^2, ascending.
  [[nodiscard]] const Vector& omega_squared() const { return omega_squared_; }
  /// Phi^T times the normal form of a contact. tangent(): Phi^T times the tangential form; load(): Phi^T times the load's
  /// direction.
  [[nodiscard]] const Vector& normal(std::size_t contact) const { return normal_[contact]; }
  [[nodiscard]] const Vector& tangent(std::size_t contact) const { return tangent_[contact]; }
  [[nodiscard]] const Vector& load(std::size_t load) const { return load_[load]; }
  [[nodiscard]] const std::vector<Vector>& normals() const { return normal_; }
  [[nodiscard]] const std::vector<Vector>& tangents() const { return tangent_; }
  [[nodiscard]] const std::vector<Vector>& loads() const { return load_; }

  /// Phi, stored by rows.
  [[nodiscard]] const RowMatrix& shapes() const { return shapes_; }
  /// Phi^T M, the matrix of q = Phi^T M u.
  [[nodiscard]] const Eigen::MatrixXd& projection() const { return projection_; }
  [[nodiscard]] Vector amplitudes(const Vector& u) const { return projection_ * u; }
  /// Phi^T form: coefficients of a form, or of a force direction, in the modes.
  [[nodiscard]] Vector amplitudes_of_form(const Vector& form) const { return shapes_.transpose() * form; }
  [[nodiscard]] Vector amplitudes_of(const Combination& form) const {
    Vector q = Vector::Zero(shapes_.cols());
    for (const auto& [dof, factor] : form.terms) q += factor * shapes_.row(dof).transpose();
    return q;
  }
  /// Computes u := Phi q for several q at once.
  void motions(const std::vector<const Vector*>& q, const std::vector<Vector*>& u) const {
    thin_product(shapes_, q, u);
  }

 private:
  std::string failure_;
  Vector omega_squared_;
  RowMatrix shapes_;            // Phi
  Eigen::MatrixXd projection_;  // Phi^T M
  std::vector<Vector> normal_, tangent_, load_;
};

}  // namespace signorini::modal
