// least_share.hpp: slips and openings that motions without resistance leave undetermined.
//
//   rates + Z c,   K_held Z = 0: fixed by the rows that may not move;   the smallest of all slips and openings
//
// Forces do not change (least_motion.hpp).
#pragma once

#include "model/assembly/dofs.hpp"
#include "model/statics/held_rows.hpp"

namespace signorini {

/// An unknown of the complementarity problem: moves `row` by sign z; its condition is in terms of rates.
struct Unknown {
  std::size_t contact;
  int row;
  int sign;
  enum class Kind : unsigned char { opening, slip } kind;
};

struct SharedOut {
  const SparseMatrix& stiffness;
  const DofMap& map;
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

}  // namespace signorini
