// turns.hpp: hits of rigid contacts at one instant, in the order in which they come.
//
//   turn 1, 2, ...   all that close meet after g / |g'|; the first of them are hit, with what touches at rest
//
// One that leaves, g' > 0, takes no impulse: it does not rest because its neighbour is hit, and an impulse on it would
// feed the motion. Where a later turn throws it back it is hit again, as it would be a moment later. Those that meet
// together are hit together (decide/impact.hpp).
#pragma once

#include <cstddef>
#include <vector>

namespace signorini {

/// A rigid contact that takes part in an instant at which some are hit.
struct Approach {
  std::size_t contact = 0;
  double gap = 0.0;   ///< not negative; zero: it touches
  double rate = 0.0;  ///< g'
  double rest = 0.0;  ///< g' up to this speed is no motion away
  double hit = 0.0;   ///< what closes faster than this is hit
  bool open = false;  ///< else it does not close, it presses

  [[nodiscard]] bool closes() const { return open && rate < -hit; }
};

/// Moves all to where the next of them meet. Returns those that are struck there; none: none closes.
[[nodiscard]] std::vector<std::size_t> next_turn(std::vector<Approach>& all);

}  // namespace signorini
