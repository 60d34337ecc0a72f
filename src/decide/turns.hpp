// turns.hpp: order of the hits of rigid contacts at one instant.
//
//   turn 1, 2, ...   closing contacts meet after g / |g'|; the first of them are hit, with contacts that touch at rest
//
// A leaving contact, g' > 0, takes no impulse: it does not rest because its neighbour is hit, and an impulse on it
// would add energy. If a later turn throws it back, it is hit again, as it would be a moment later. Contacts that meet
// at the same time are hit together (decide/impact.hpp).
#pragma once

#include <cstddef>
#include <vector>

namespace signorini {

/// A rigid contact at an instant with hits.
struct Approach {
  std::size_t contact = 0;
  double gap = 0.0;   ///< nonnegative; zero: it touches
  double rate = 0.0;  ///< g'
  double rest = 0.0;  ///< g' up to this speed does not count as leaving
  double hit = 0.0;   ///< closing faster than this is a hit
  bool open = false;  ///< false: it does not close, it presses

  [[nodiscard]] bool closes() const { return open && rate < -hit; }
};

/// Advances all contacts to the next meeting. Returns the contacts hit there; empty: none closes.
[[nodiscard]] std::vector<std::size_t> next_turn(std::vector<Approach>& all);

}  // namespace signorini
