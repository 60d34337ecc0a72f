// coulomb_problem.hpp: decides which of several coupled contacts open, stick or slip.
//
//   r = b + W f,   r = (rn_1, rt_1, rn_2, ...),   f = (l_1, k_1, l_2, ...)
//   0 <= l  _|_  rn >= 0,      |k| <= f l,  k = -f l sign(rt) where rt is not 0        (frictional)
//
// l acts on the body along n, k along t: N = -l, T = -k. r and f are velocities and impulses, or accelerations and forces, or
// time derivatives of accelerations and forces. With planar friction the problem is a linear complementarity problem;
// with k = a - b:
//   rn _|_ l,   rt + c _|_ a,   -rt + c _|_ b,   f l - a - b _|_ c                     all >= 0
// The coefficient f is the static one in stick and the kinetic one in slip.
// Source: Stewart, Trinkle 1996; Anitescu, Potra 1997; for one contact Glocker 2001.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "signorini/force_layout.hpp"

namespace signorini::decide {

// Indices of the entries l and k (or rn and rt) of contact i in the vectors of a list of contacts.
//
//   (n_1, t_1, n_2, t_2, ...)

template <class Integer>
[[nodiscard]] Eigen::Index normal_place(const ForceLayout& layout, Integer i) {
  return static_cast<Eigen::Index>(layout.normal(static_cast<std::size_t>(i)));
}
template <class Integer>
[[nodiscard]] Eigen::Index tangent_place(const ForceLayout& layout, Integer i) {
  return static_cast<Eigen::Index>(layout.tangent(static_cast<std::size_t>(i)));
}
/// Length of a vector with these places.
[[nodiscard]] inline Eigen::Index place_count(const ForceLayout& layout) {
  return static_cast<Eigen::Index>(layout.size());
}

struct CoulombItem {
  enum class Kind : unsigned char {
    normal,      ///< no friction: only l is unknown
    sliding,     ///< slides in direction `sign`: k = -sign f l
    frictional,  ///< may stick, or start to slip in either direction
    pressed,     ///< l is given: only k is unknown
    /// at its friction limit: W contains the effect of slip in direction `sign`; in stick k changes by sign d, d >= 0
    limit,
  } kind = Kind::normal;
  double static_friction = 0.0, kinetic_friction = 0.0;
  double applied_normal_force = 0.0;  ///< for `pressed`: the given l; force
  int sign = 0;                       ///< for `sliding` and `limit`: direction of slip, +1 or -1

  /// Coefficient of friction in slip or in stick.
  [[nodiscard]] double friction(bool slips) const { return slips ? kinetic_friction : static_friction; }
};

struct CoulombProblem {
  Eigen::MatrixXd
      W;  ///< places x places, symmetric positive semidefinite except for `limit`; unused places: zero
  Eigen::VectorXd b;  ///< one entry per place
  std::vector<CoulombItem> items;
  ForceLayout layout = {};  ///< layout of the items' forces

  [[nodiscard]] Eigen::Index normal(std::size_t i) const { return normal_place(layout, i); }
  [[nodiscard]] Eigen::Index tangent(std::size_t i) const { return tangent_place(layout, i); }
};

struct CoulombSolution {
  Eigen::VectorXd force, response;  ///< one entry per place
  /// One entry per item; true: the item slips, so its f is the kinetic coefficient.
  std::vector<bool> kinetic;
};

/// Solution by Lemke's method. If it fails for at most `max_enumerated` items, all combinations of their states are tried.
/// nullopt: no solution was found.
[[nodiscard]] std::optional<CoulombSolution> solve(const CoulombProblem& problem);

inline constexpr std::size_t max_enumerated = 6;

/// Solutions that were found by trying all combinations of states.
struct EnumerationResult {
  std::vector<CoulombSolution> solutions;  ///< solutions whose responses differ
  /// Largest violation of a condition in the best combination, as a multiple of eps times the magnitude of the problem's forces
  /// and responses. 0: there is a solution; NaN: there are too many items.
  double min_violation = std::numeric_limits<double>::quiet_NaN();
};

/// Tries all combinations of states of at most `max_enumerated` items.
[[nodiscard]] EnumerationResult all_solutions(const CoulombProblem& problem);

/// Condition number of W (largest / smallest singular value), in units in which the diagonal of W is one.
[[nodiscard]] double condition_number(const CoulombProblem& problem);

/// False if a second solution cannot exist, because friction couples tangent and normal only weakly.
[[nodiscard]] bool may_be_nonunique(const CoulombProblem& problem);

// Noise (error bounds) of the forces and responses in the solution of a Coulomb problem.
//
//   df = |A^-1| db,   dr = db + |W_A| df       A: rows and columns of W for the nonzero forces; |.| entrywise
//
// db: noise of the right-hand side. Each df is at least the noise db_i / W_ii of its own row, and at least the rounding error
// of the largest entry of b, in units in which the diagonal of W is one. Units: those of forces and responses.

class CoulombSignificance {
 public:
  /// Problem and solution must outlive the object. noise: noise of problem.b, >= 0.
  CoulombSignificance(const CoulombProblem& problem, const CoulombSolution& solution,
                      const Eigen::VectorXd& noise);

  [[nodiscard]] const CoulombItem& item(std::size_t i) const { return problem_.items[i]; }
  [[nodiscard]] Eigen::Index normal(std::size_t i) const { return problem_.normal(i); }
  [[nodiscard]] Eigen::Index tangent(std::size_t i) const { return problem_.tangent(i); }
  [[nodiscard]] double force(Eigen::Index row) const { return solution_.force[row]; }
  [[nodiscard]] double response(Eigen::Index row) const { return solution_.response[row]; }
  /// Compression l of item i in the solution.
  [[nodiscard]] double applied_normal_force(std::size_t i) const;
  /// Coefficient of friction of item i in the solution, static or kinetic.
  [[nodiscard]] double friction(std::size_t i) const;

  /// Magnitude up to which the force at this place is treated as zero.
  [[nodiscard]] double force_tolerance(Eigen::Index row) const;
  /// True if the response at this place is zero within its noise.
  [[nodiscard]] bool is_zero_response(Eigen::Index row) const;
  /// True if the force of item i lies inside its friction cone by more than its noise. The contact is then at rest, and a
  /// nonzero response is rounding.
  [[nodiscard]] bool is_inside_cone(std::size_t i) const;

 private:
  const CoulombProblem& problem_;
  const CoulombSolution& solution_;
  Eigen::VectorXd force_noise_, response_noise_;
};

}  // namespace signorini::decide
