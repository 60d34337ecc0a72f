// recurrence.hpp: a first guess at the period of a motion that is driven by itself, and a section away from events.
//
//   T = t_b - t_a       instants a < b after which the states are the same and the motion is nearest to being so
//   section: the middle of the longest stretch between two instants of a period
#pragma once

#include "orbit/orbit_state.hpp"

namespace signorini {

struct Recurrence {
  double period = 0.0;    ///< 0: no instant came back
  double section = 0.0;   ///< time of the section
  double distance = 0.0;  ///< between the two states, over the range of the motion
};

/// instants: those of a run, in order of time.
[[nodiscard]] Recurrence recurrence(const Model& model, const std::vector<OrbitPoint>& instants);

/// Where in [0, T) the orbit is best cut: 0, unless an instant is nearer to it than a fiftieth of T.
[[nodiscard]] double section_away_from(const std::vector<OrbitPoint>& instants, double T);

}  // namespace signorini
