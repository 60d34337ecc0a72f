// least_share.hpp: how far each contact goes where motions that nothing resists leave it open.
//
//   rates + Z c,   K_held Z = 0: held by the rows that may not move;   the least of all slips and openings
//
// Forces stay as they are (least_motion.hpp).
#pragma once

#include "model/assembly/dofs.hpp"
#include "model/statics/held_rows.hpp"

namespace signorini {

/// An unknown of the complementarity problem: displaces `row` by sign z; its condition is of rates.
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
  const std::vector<double>& conditions;  ///< one an unknown, to which it is complementary; force
  Eigen::VectorXd z;                      ///< one an unknown; force
  double greatest_force;                  ///< of the rates of forces in the rows
};

struct LeastShare {
  std::vector<bool> moves;  ///< one an unknown
  /// Contacts at their limits whose slips the data leave open, in the order of their rows; empty: none.
  std::vector<std::size_t> undetermined;
  Vector motion;  ///< that nothing resists; n
};

/// Adds to rates (n) what the least takes of those motions.
[[nodiscard]] LeastShare least_share(const SharedOut& given, Vector& rates);

}  // namespace signorini
