// least_motion.hpp: the shortest of the motions that are all possible.
//
//   r = g + B c,   s_i r_i >= 0 where only the way s_i is open;   least |r - a|, a = B b
//
//   r = a + (I - P)(g - a) + P S z,   P: onto the columns of B,   0 <= z  _|_  S r >= 0
//
// r: slips and openings of contacts, lengths (or rates of them), so that the answer is the same however a
// scene is turned, mirrored or numbered. One linear complementarity problem, P S symmetric and semidefinite.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace signorini {

/// What one of several contacts may do along its row.
enum class Way : signed char { back = -1, both = 0, forth = 1 };

/// r; b: rows x motions, columns independent; g: one possible r; about: motions, length of b's columns.
[[nodiscard]] Eigen::VectorXd least_motion(const Eigen::MatrixXd& b, const Eigen::VectorXd& g,
                                           const std::vector<Way>& ways, const Eigen::VectorXd& about);

/// Whether there is another one than r.
[[nodiscard]] bool is_one_of_many(const Eigen::MatrixXd& b, const Eigen::VectorXd& r,
                                  const std::vector<Way>& ways);

}  // namespace signorini
