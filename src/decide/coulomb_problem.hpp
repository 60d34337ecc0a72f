// coulomb_problem.hpp: decides which of several coupled contacts open, stick or slip.
//
//   r = b + W f,   r = (rn_1, rt_1, rn_2, ...),   f = (l_1, k_1, l_2, ...)
//   0 <= l  _|_  rn >= 0,      |k| <= f l,  k = -f l sign(rt) where rt is not 0        (frictional)
//
// l pushes along n, k along t: N = -l, T = -k. r may be velocities and f impulses, or accelerations and forces, or
// derivatives of both. Planar friction gives a linear complementarity problem: with k = a - b,
//   rn _|_ l,   rt + c _|_ a,   -rt + c _|_ b,   f l - a - b _|_ c                     all >= 0
// Stick is tested with the static coefficient, slip has the kinetic one.
// Source: Stewart, Trinkle 1996; Anitescu, Potra 1997; for one contact Glocker 2001.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

namespace signorini {

struct CoulombItem {
  enum class Kind : unsigned char {
    normal,      ///< no friction: l alone
    sliding,     ///< slides along sign already: k = -sign f l
    frictional,  ///< may stick, or begin to slip in either direction
    pressed,     ///< l is given: k alone
    limit,       ///< slides along sign at its limit, as W assumes; k = +sign d, d >= 0, if it sticks
  } kind = Kind::normal;
  double static_friction = 0.0, kinetic_friction = 0.0;
  double pressing = 0.0;  ///< pressed: l
  int sign = 0;           ///< sliding, limit

  [[nodiscard]] double friction(bool slips) const { return slips ? kinetic_friction : static_friction; }
};

struct CoulombProblem {
  Eigen::MatrixXd W;  ///< 2m x 2m, symmetric positive semidefinite except for `limit`
  Eigen::VectorXd b;  ///< 2m
  std::vector<CoulombItem> items;
};

struct CoulombSolution {
  Eigen::VectorXd force, response;  ///< 2m each
  std::vector<bool> kinetic;        ///< items that have begun to slip: f is the kinetic coefficient
};

/// Solution by Lemke's method, then, for up to `most_enumerated` items, by trying all states. nullopt: no solution was
/// found.
[[nodiscard]] std::optional<CoulombSolution> solve(const CoulombProblem& problem);

inline constexpr std::size_t most_enumerated = 6;

/// Result of trying all states.
struct Enumerated {
  std::vector<CoulombSolution> solutions;  ///< solutions with different responses
  /// Largest violation of a condition by the best combination, in roundings of the problem's size; 0: there is a
  /// solution, NaN: there are too many items.
  double least_miss = std::numeric_limits<double>::quiet_NaN();
};

/// Tries all states of at most `most_enumerated` items.
[[nodiscard]] Enumerated all_solutions(const CoulombProblem& problem);

/// Condition number of W in units that make its diagonal one: largest over smallest singular value.
[[nodiscard]] double condition_of(const CoulombProblem& problem);

/// False if friction couples tangent to normal too weakly for more than one solution.
[[nodiscard]] bool may_have_many(const CoulombProblem& problem);

}  // namespace signorini
