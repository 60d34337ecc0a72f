// smallest_motion.hpp: the smallest of all possible motions of contacts.
//
//   r = g + B c,   s_i r_i >= 0 where only the direction s_i is admissible;   least |r - a|, a = B b
//
//   r = a + (I - P)(g - a) + P S z,   P: projection onto the columns of B,   0 <= z  _|_  S r >= 0
//
// r: slips and openings of contacts (lengths or rates), so that the result is independent of the scene's
// orientation, reflection and numbering. S: columns for rows with one admissible direction, with entry s_i.
// This is one linear complementarity problem with a symmetric and semidefinite matrix S^T P S.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/assembly/dofs.hpp"
#include "model/statics/static_system.hpp"

namespace signorini::statics {

/// Admissible directions of a contact along one of its rows.
enum class AdmissibleDirection : signed char { negative = -1, both = 0, positive = 1 };

/// Returns r. b: B, rows x motions, columns independent; g: one possible r; ways: one entry per row; about:
/// vector b of the equation, one entry per motion.
[[nodiscard]] Eigen::VectorXd smallest_motion(const Eigen::MatrixXd& b, const Eigen::VectorXd& g,
                                              const std::vector<AdmissibleDirection>& ways,
                                              const Eigen::VectorXd& about);

/// True if other motions satisfy the same conditions as r.
[[nodiscard]] bool has_other_motions(const Eigen::MatrixXd& b, const Eigen::VectorXd& r,
                                     const std::vector<AdmissibleDirection>& ways);

// Slips and openings that are undetermined, because some motions have no resistance.
//
//   rates + Z c,   Z: motions without stiffness that move only rows of unknowns;   c: smallest slips and openings
//
// Forces do not depend on c.

/// An unknown z of the complementarity problem (quasi_static_rates.hpp): a rate that moves `row` by sign * z.
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
  const std::vector<double>& conditions;  ///< w, one per unknown, complementary to z; force
  Eigen::VectorXd z;                      ///< one per unknown; force
  double greatest_force;                  ///< largest rate of a force on the rows
};

struct SmallestSlips {
  std::vector<bool> moves;  ///< one per unknown: true if the contact moves in the direction of this unknown
  /// Contacts at their limits whose slips the data do not determine, in the order of their rows.
  std::vector<std::size_t> undetermined;
  Vector motion;  ///< a motion without resistance; length n
};

/// Adds the motion Z c with the smallest slips to the rates (n).
[[nodiscard]] SmallestSlips smallest_slips(const SlipDistribution& given, Vector& rates);

}  // namespace signorini::statics
