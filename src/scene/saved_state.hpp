// saved_state.hpp: the states that a run kept, states.csv: everything that a motion goes on from.
//
//   t,A.ux,A.uy,...,A.vx,A.vy,...,first.T,first.state
//   1.2,0.0103,...
//
// Displacements, velocities, "support B.uy" and "support B.vy" of supports that move, shears and states of contacts with friction. A column "x.state" that has numbers is
// of a degree of freedom that is called so.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

struct SavedStates {
  std::optional<SavedState> wanted;
  std::vector<std::string> times;  ///< of all of them, as the file has them
};

/// The state at t, or the last one. Errors: SceneError at the line of the file; `key` stands in front.
[[nodiscard]] SavedStates read_saved_states(std::istream& in, const std::string& file, const std::string& key,
                                            std::optional<double> t);

}  // namespace signorini
