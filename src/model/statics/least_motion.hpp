// least_motion.hpp: the smallest of all possible motions.
//
//   r = g + B c,   s_i r_i >= 0 where only the direction s_i is admissible;   least |r - a|, a = B b
//
//   r = a + (I - P)(g - a) + P S z,   P: onto the columns of B,   0 <= z  _|_  S r >= 0
//
// r: slips and openings of contacts (lengths or rates), so the result is independent of the scene's orientation,
// reflection and numbering. The solution is one linear complementarity problem, P S being symmetric and semidefinite.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace signorini {

/// Admissible directions of one of several contacts along its row.
enum class Way : signed char { back = -1, both = 0, forth = 1 };

/// Returns r; b: rows x motions, columns independent; g: one possible r; about: motions, one entry per column of b.
[[nodiscard]] Eigen::VectorXd least_motion(const Eigen::MatrixXd& b, const Eigen::VectorXd& g,
                                           const std::vector<Way>& ways, const Eigen::VectorXd& about);

/// True if there are others than r.
[[nodiscard]] bool is_one_of_many(const Eigen::MatrixXd& b, const Eigen::VectorXd& r,
                                  const std::vector<Way>& ways);

}  // namespace signorini
