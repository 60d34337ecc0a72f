// open_basis.hpp: a structure, its contacts and its loads in its open modes.
//
//   u = Phi q,   q = Phi^T M u,   form . u = (Phi^T form) . q
#pragma once

#include "engine/exact/modal/open_modes.hpp"
#include "engine/exact/modal/thin_product.hpp"

namespace signorini {

/// True if the matrix is symmetric up to rounding.
[[nodiscard]] bool is_symmetric(const SparseMatrix& a);
/// True if all loads, compressions and surfaces are constant between their jumps.
[[nodiscard]] bool stands_still(const Model& model);

class OpenBasis {
 public:
  explicit OpenBasis(const Model& model);

  /// Reason why there are no modes; empty: there are.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// omega^2, ascending.
  [[nodiscard]] const Vector& square() const { return square_; }
  /// Forms of contacts and directions of loads, one entry for each mode.
  [[nodiscard]] const Vector& normal(std::size_t contact) const { return normal_[contact]; }
  [[nodiscard]] const Vector& tangent(std::size_t contact) const { return tangent_[contact]; }
  [[nodiscard]] const Vector& load(std::size_t load) const { return load_[load]; }
  [[nodiscard]] const std::vector<Vector>& normals() const { return normal_; }
  [[nodiscard]] const std::vector<Vector>& tangents() const { return tangent_; }
  [[nodiscard]] const std::vector<Vector>& loads() const { return load_; }

  /// Phi, by rows.
  [[nodiscard]] const RowMatrix& shapes() const { return shapes_; }
  /// Phi^T M
  [[nodiscard]] const Eigen::MatrixXd& projection() const { return projection_; }
  [[nodiscard]] Vector amplitudes(const Vector& u) const { return projection_ * u; }
  /// Modal coefficients of a form or a direction of the structure.
  [[nodiscard]] Vector amplitudes_of_form(const Vector& form) const { return shapes_.transpose() * form; }
  [[nodiscard]] Vector amplitudes_of(const Combination& form) const {
    Vector q = Vector::Zero(shapes_.cols());
    for (const auto& [dof, factor] : form.terms) q += factor * shapes_.row(dof).transpose();
    return q;
  }
  void motions(const std::vector<const Vector*>& q, const std::vector<Vector*>& u) const {
    thin_product(shapes_, q, u);
  }

 private:
  std::string failure_;
  Vector square_;
  RowMatrix shapes_;            // Phi
  Eigen::MatrixXd projection_;  // Phi^T M
  std::vector<Vector> normal_, tangent_, load_;
};

}  // namespace signorini
