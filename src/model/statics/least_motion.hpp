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

#include "model/assembly/dofs.hpp"
#include "model/statics/static_system.hpp"

namespace signorini::statics {

/// Admissible directions of one of several contacts along its row.
enum class Way : signed char { back = -1, both = 0, forth = 1 };

/// Returns r; b: rows x motions, columns independent; g: one possible r; about: motions, one entry per column of b.
[[nodiscard]] Eigen::VectorXd least_motion(const Eigen::MatrixXd& b, const Eigen::VectorXd& g,
                                           const std::vector<Way>& ways, const Eigen::VectorXd& about);

/// True if there are others than r.
[[nodiscard]] bool is_one_of_many(const Eigen::MatrixXd& b, const Eigen::VectorXd& r,
                                  const std::vector<Way>& ways);

// Slips and openings that motions without resistance leave undetermined.
//
//   rates + Z c,   K_held Z = 0: fixed by the rows that may not move;   the smallest of all slips and openings
//
// Forces do not change (least_motion.hpp).

/// An unknown of the complementarity problem: moves `row` by sign z; its condition is in terms of rates.
struct Unknown {
  std::size_t contact;
  int row;
  int sign;
  enum class Kind : unsigned char { opening, slip } kind;
};

struct SharedOut {
  const SparseMatrix& stiffness;
  const assembly::DofMap& map;
  const std::vector<HeldRow>& rows;
  const std::vector<Unknown>& unknowns;
  const std::vector<double>& conditions;  ///< one per unknown, complementary to it; force
  Eigen::VectorXd z;                      ///< one per unknown; force
  double greatest_force;                  ///< largest rate of a force in the rows
};

struct LeastShare {
  std::vector<bool> moves;  ///< one per unknown
  /// Contacts at their limits whose slips the data do not determine, in the order of their rows; empty: none.
  std::vector<std::size_t> undetermined;
  Vector motion;  ///< a motion without resistance; n
};

/// Adds the smallest such motion to the rates (n).
[[nodiscard]] LeastShare least_share(const SharedOut& given, Vector& rates);

}  // namespace signorini::statics
