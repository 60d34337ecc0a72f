// kept_modes.hpp: the modes of a structure up to a cutoff, and the static response of all other modes.
//
//   K phi = omega^2 M phi,   phi_i^T M phi_j = delta_ij,   omega <= cutoff
//   G_res f = sum over all other modes of phi (phi^T f)/omega^2,   massless modes included
//
// K and M symmetric, positive semidefinite; without contact constraints. With f_el = f - M Phi Phi^T f, which does no
// work on the kept modes (inertia relief if these include free motions), G_res f solves K u = f_el with Phi^T M u = 0.
// Source: MacNeal, Computers and Structures 1 (1971) 581; Craig and Kurdila, Fundamentals of Structural Dynamics,
// chapter 17.
//
// Dense up to 400 degrees of freedom with mass, and up to 5000 if a third of the modes or more is kept. Otherwise the
// modes below the cutoff are counted (model/modes/frequencies.hpp), and this number of modes is computed
// (model/modes/lanczos.hpp).
#pragma once

#include <optional>
#include <stdexcept>
#include <vector>

#include "linear/sparse_cholesky.hpp"
#include "model/assembly/springs.hpp"
#include "signorini/model.hpp"

namespace signorini::reduce {

/// Degrees of freedom with mass up to which all modes are computed, whatever the cutoff.
inline constexpr int all_modes_up_to = 400;

/// Thrown with the reason why a structure cannot be reduced with this cutoff.
struct NotReducible : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct KeptModes {
  Eigen::MatrixXd shapes;        ///< n x m, M-orthonormal; free motions first, then ascending
  Eigen::VectorXd squares;       ///< omega^2, m; exactly 0 for free motions
  int free = 0;                  ///< number of free motions among the kept modes
  int truncated_modes = 0;       ///< number of modes with mass above the cutoff
  double first_truncated = 0.0;  ///< frequency of the first truncated mode, rad per time; 0: none
  double shift = 0.0;            ///< makes K + shift M regular; far below omega^2 of truncated modes
};

/// All modes with omega <= cutoff. free: all null motions of K, n x f; each must have mass. K must be
/// positive semidefinite. Throws NotReducible if there are more modes than the limit, or if fewer modes are
/// found than counted.
[[nodiscard]] KeptModes modes_up_to(double cutoff, const SparseMatrix& mass, const SparseMatrix& stiffness,
                                    const Eigen::MatrixXd& free);

/// Phi^T f, length m; sums of rounding size are set to zero (weight excites no elastic mode of a free body).
[[nodiscard]] Vector modal_loads(const KeptModes& modes, const Vector& f);

class ResidualFlexibility {
 public:
  /// Mass and modes are kept by reference. Throws NotReducible if K is singular beyond the free motions.
  ResidualFlexibility(const SparseMatrix& mass, const SparseMatrix& stiffness, const KeptModes& modes);
  /// G_res f, of length n. Exactly 0 if no mode is truncated and all degrees of freedom have mass.
  [[nodiscard]] Vector response(const Vector& f) const;

 private:
  [[nodiscard]] Vector without_kept(const Vector& u) const;  ///< u - Phi Phi^T M u

  const SparseMatrix& mass_;
  const KeptModes& modes_;
  Eigen::MatrixXd inertia_, inertia_size_;  // M Phi, and its absolute values
  double shift_;                            // shift of omega^2; its effect is removed by iteration
  bool complete_;
  linear::SymmetricSolver solver_;
};

// Shapes for the static compliance of the truncated modes.
//
//   massive:   Ritz vectors of (K, M) in the span of G_res f_h,   psi^T M psi = 1,  psi^T K psi = omega_h^2
//   massless:  K-orthonormal, in the span of G_res f, K-orthogonal to the massive ones
//
// A direction gets no separate shape if earlier shapes represent its residual compliance up to 1e-12 of its
// compliance in all modes.

/// A direction along which a force acts.
struct ActingForce {
  ComplianceShare share;    ///< label: set by the caller; compliances: set by static_shapes()
  Vector force;             ///< length n
  bool needs_mass = false;  ///< true: the static shape of this direction must have mass
};

struct StaticShapes {
  Eigen::MatrixXd massive, massless;    ///< n x h, n x r
  Eigen::VectorXd massive_squares;      ///< omega_h^2, ascending
  std::vector<ComplianceShare> shares;  ///< one per force, in the order of the forces
  std::vector<Vector> responses;        ///< G_res f of every force
};

[[nodiscard]] StaticShapes static_shapes(const SparseMatrix& mass, const SparseMatrix& stiffness,
                                         const KeptModes& modes, const std::vector<ActingForce>& forces);

// Test whether a damping matrix from a file is alpha M + beta K.
//
//   | C - alpha M - beta K |_ij <= 1e-9 ( |C| + |alpha M| + |beta K| )_ij   for all ij,   alpha, beta >= 0
//
// 1e-9: programs write matrices with at least ten digits. If the test succeeds, a reduced model damps its modes by
// alpha and beta. Dampers from C itself would give the static shapes time constants far below those of the
// modes.

struct RayleighFactors {
  double alpha = 0.0;  ///< 1/time
  double beta = 0.0;   ///< time
};

/// alpha and beta of C; all matrices are symmetric and of one size. nullopt: C is zero, or not of the form alpha M + beta K.
[[nodiscard]] std::optional<RayleighFactors> rayleigh_factors(const SparseMatrix& damping,
                                                              const SparseMatrix& mass,
                                                              const SparseMatrix& stiffness);

}  // namespace signorini::reduce
