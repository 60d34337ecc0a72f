// open_modes.hpp: all modes of a structure whose contacts are open.
//
//   K phi = omega^2 M phi,   Phi^T M Phi = 1
//
// Frequencies are bracketed by counting negative pivots of K - s M (band_pencil.hpp). Shapes are computed by inverse
// iteration and the Rayleigh quotient in extended precision, and made orthonormal from low to high: a symmetric
// correction would bring the static forces of high modes into low ones. Free motions have omega = 0 exactly.
// Sources: Bathe, Finite Element Procedures, section 11.4 (Sturm); Parlett, The Symmetric Eigenvalue Problem,
// chapter 4 (Rayleigh quotient iteration).
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

struct OpenModes {
  Vector square;           ///< omega^2, ascending; 0 for free motions
  Eigen::MatrixXd shapes;  ///< n x n, columns M-orthonormal
  int free = 0;            ///< number of motions without stiffness
  std::string failure;     ///< reason why there are none; empty if there are

  [[nodiscard]] bool found() const { return failure.empty(); }
};

/// True if the band of both matrices is narrow enough to save time.
[[nodiscard]] bool has_narrow_band(const SparseMatrix& mass, const SparseMatrix& stiffness);

/// mass, stiffness: symmetric, mass positive definite. Costs about n^2 (10 + band^2) operations and 3 n^3 of matrix
/// products. On failure `failure` gives the reason, and the rest is empty.
[[nodiscard]] OpenModes open_modes(const SparseMatrix& mass, const SparseMatrix& stiffness);

}  // namespace signorini
