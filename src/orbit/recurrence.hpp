// recurrence.hpp: initial guess of the period of a self-excited motion, and a section away from events.
//
//   T = t_b - t_a       instants a < b with equal states, for which the motion is closest to repeating itself
//   section: the middle of the longest stretch between two instants of a period
#pragma once

#include "orbit/orbit_state.hpp"

namespace signorini {

struct Recurrence {
  double period = 0.0;    ///< 0: the motion did not return
  double section = 0.0;   ///< time of the section
  double distance = 0.0;  ///< between the two states, relative to the range of the motion
};

/// instants: of a run, in order of time.
[[nodiscard]] Recurrence recurrence(const Model& model, const std::vector<OrbitPoint>& instants);

/// Best position of the section in [0, T): 0, unless an instant is within a fiftieth of T.
[[nodiscard]] double section_away_from(const std::vector<OrbitPoint>& instants, double T);

}  // namespace signorini
