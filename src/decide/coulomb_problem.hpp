// coulomb_problem.hpp: which of several contacts open, stick or slip, where each one's force moves all
// others.
//
//   r = b + W f,   r = (rn_1, rt_1, rn_2, ...),   f = (l_1, k_1, l_2, ...)
//   0 <= l  _|_  rn >= 0,      |k| <= f l,  k = -f l sign(rt) where rt is not 0        (frictional)
//
// l pushes along n, k along t: N = -l, T = -k. r may be velocities and f impulses, or accelerations and
// forces, or derivatives of both. Plane friction makes it a linear complementarity problem: with k = a - b,
//   rn _|_ l,   rt + c _|_ a,   -rt + c _|_ b,   f l - a - b _|_ c                     all >= 0
// Sticking is tested with the static coefficient, slipping has the kinetic one.
// Source: Stewart, Trinkle 1996; Anitescu, Potra 1997; for one contact Glocker 2001.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

namespace signorini {

struct CoulombItem {
  enum class Kind : unsigned char {
    normal,      ///< without friction: l alone
    sliding,     ///< it moves along sign already: k = -sign f l
    frictional,  ///< may stick, or begin to slip in either direction
    pressed,     ///< l is given: k alone
    limit,  ///< slides along sign at its limit, as the matrix W has it; k = +sign d, d >= 0, if it sticks
  } kind = Kind::normal;
  double static_friction = 0.0, kinetic_friction = 0.0;
  double pressing = 0.0;  ///< pressed: l
  int sign = 0;           ///< sliding, limit

  [[nodiscard]] double friction(bool slips) const { return slips ? kinetic_friction : static_friction; }
};

struct CoulombProblem {
  Eigen::MatrixXd W;  ///< 2m x 2m, symmetric positive semidefinite but for `limit`
  Eigen::VectorXd b;  ///< 2m
  std::vector<CoulombItem> items;
};

struct CoulombSolution {
  Eigen::VectorXd force, response;  ///< 2m each
  std::vector<bool> kinetic;        ///< items whose slipping has begun: f is the kinetic coefficient
};

/// A solution by Lemke's method, then, for up to `most_enumerated` items, by trying all states. Nothing:
/// none was found.
[[nodiscard]] std::optional<CoulombSolution> solve(const CoulombProblem& problem);

inline constexpr std::size_t most_enumerated = 6;

/// What trying all states yields.
struct Enumerated {
  std::vector<CoulombSolution> solutions;  ///< those that differ in their response
  /// By how many roundings of the problem's size the best combination misses a condition; 0: it holds, NaN:
  /// there were too many items.
  double least_miss = std::numeric_limits<double>::quiet_NaN();
};

/// At most `most_enumerated` items are tried.
[[nodiscard]] Enumerated all_solutions(const CoulombProblem& problem);

/// Of W, in units that make its diagonal one: greatest over least singular value.
[[nodiscard]] double condition_of(const CoulombProblem& problem);

/// False: friction couples tangent to normal too weakly for more than one solution.
[[nodiscard]] bool may_have_many(const CoulombProblem& problem);

}  // namespace signorini
