// least_norm.hpp: the point of least norm in the intersection of an affine space and a product of convex sets.
//
//   min |x|^2 / 2   over   A x = r,   x in C = C_1 x C_2 x ...
//
// The dual problem has no constraints; its function is concave with a continuous derivative (P: projection onto C):
//
//   max g(y),   g(y) = r . y - (A' y) . x + |x|^2 / 2,   x = P(A' y),   g'(y) = r - A x
//
// A damped Newton method solves it, with a generalised derivative D of P: A D A' dy = r - A x. The method ends after finitely
// many steps if the sets are polyhedral (one tangent), and otherwise converges quadratically.
//
//   set    { (n, t) : |t| <= f n }    a second-order cone; without tangents t: the half-line n >= 0
//          { t : |t| <= F }           a disc
//          { c e : c >= 0 }           a ray along the unit vector e
//          { c e }, { 0 }, all        a line, the origin, the whole space
//          { x : e . x >= 0 }         a half-space
//
// If r changes with time, x moves by the point of least norm again, of A x' = r' within the critical cone of each set:
//
//   P(z + h z' + ...) = P(z) + h P'(z'),   P': projection onto  { x' tangent to C at P(z),  x' . (z - P(z)) = 0 }
//
// Sets of one tangent are polyhedral, so that this holds exactly, and for derivatives of any order in turn.
// Source: Facchinei, Pang, Finite-Dimensional Variational Inequalities, chapter 11 (projections); Moreau's decomposition.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace signorini::base {

/// A convex set for the force components of one contact, which are consecutive entries of x.
struct ConvexSet {
  enum class Kind : unsigned char { cone, disc, ray, line, origin, whole, half_space } kind = Kind::cone;
  Eigen::Index size = 1;  ///< number of entries; cone: 1 + tangents (the first entry is n); disc: tangents
  double friction = 0.0;  ///< cone: f >= 0
  double radius = 0.0;    ///< disc: F >= 0
  Eigen::VectorXd direction;  ///< ray, line, half-space: e
  /// Vector by which the set is moved; empty: not moved. A face that moves with time, such as the limit F(t) of a disc,
  /// moves its critical cone by its rate.
  Eigen::VectorXd offset = {};
};

/// Set within which the projection moves if its argument z begins to move. Distances up to `zero` from a face count as zero.
/// The result has no offset. Only for a cone or disc with at most one tangent.
[[nodiscard]] ConvexSet critical_cone(const ConvexSet& set, const Eigen::VectorXd& z, double zero);

/// The minimum x, and its multipliers A' y: x = P(multipliers).
struct LeastNorm {
  Eigen::VectorXd x, multipliers;
};

/// Returns the minimum; A x = r is satisfied within rounding::elimination |r| and the rounding error of A' y. nullopt: no x was
/// found, because there is none, or because of rounding errors. a: m x n with orthonormal rows, m <= n; r: length m; the sizes
/// of the sets add up to n.
[[nodiscard]] std::optional<LeastNorm> least_norm_point(const Eigen::MatrixXd& a, const Eigen::VectorXd& r,
                                                        const std::vector<ConvexSet>& sets);
/// Same, but returns x only.
[[nodiscard]] std::optional<Eigen::VectorXd> least_norm(const Eigen::MatrixXd& a, const Eigen::VectorXd& r,
                                                        const std::vector<ConvexSet>& sets);

}  // namespace signorini::base
