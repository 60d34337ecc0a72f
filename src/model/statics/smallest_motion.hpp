// smallest_motion.hpp: the smallest of all possible motions.
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
enum class AdmissibleDirection : signed char { negative = -1, both = 0, positive = 1 };

/// Returns r; b: rows x motions, columns independent; g: one possible r; about: motions, one entry per column of b.
[[nodiscard]] Eigen::VectorXd smallest_motion(const Eigen::MatrixXd& b, const Eigen::VectorXd& g,
                                              const std::vector<AdmissibleDirection>& ways,
                                              const Eigen::VectorXd& about);

/// True if there are others than r.
[[nodiscard]] bool has_other_motions(const Eigen::MatrixXd& b, const Eigen::VectorXd& r,
                                     const std::vector<AdmissibleDirection>& ways);

// Slips and openings that motions without resistance leave undetermined.
//
//   rates + Z c,   K_held Z = 0: fixed by the rows that may not move;   the smallest of all slips and openings
//
// Forces do not change (smallest_motion.hpp).

/// An unknown of the complementarity problem: moves `row` by sign z; its condition is in terms of rates.
struct Unknown {
  std::size_t contact;
  int row;
  int sign;
  enum class Kind : unsigned char { opening, slip } kind;
};

struct SlipDistribution {
  const SparseMatrix& stiffness;
  const assembly::DofMap& map;
  const std::vector<ConstraintRow>& rows;
  const std::vector<Unknown>& unknowns;
  const std::vector<double>& conditions;  ///< one per unknown, complementary to it; force
  Eigen::VectorXd z;                      ///< one per unknown; force
  double greatest_force;                  ///< largest rate of a force in the rows
};

struct SmallestSlips {
  std::vector<bool> moves;  ///< one per unknown
  /// Contacts at their limits whose slips the data do not determine, in the order of their rows; empty: none.
  std::vector<std::size_t> undetermined;
  Vector motion;  ///< a motion without resistance; n
};

/// Adds the smallest such motion to the rates (n).
[[nodiscard]] SmallestSlips smallest_slips(const SlipDistribution& given, Vector& rates);

}  // namespace signorini::statics
