// saved_state.hpp: the states that a run kept, states.csv: everything that a motion goes on from.
//
//   t,A.ux,A.uy,...,A.vx,A.vy,...,first.T,first.state
//   1.2,0.0103,...
//
// Displacements, velocities, "support B.uy" and "support B.vy" of supports that move, "c.slip" of shear elements,
// "c.surface" of surfaces that move, "c.T" and "c.state" of contacts with friction, "c.own" and "c.memory" of laws of
// one's own. A column "x.state" that has numbers is of a degree of freedom that is called so.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

/// In SavedState::motions: Rayleigh factor of the mass that was in force, 1/time. alpha_over_omega1 means omega1 with
/// the contacts that were closed at the very start.
inline constexpr const char* saved_alpha = "alpha";

/// What SavedState::motions has under this name.
[[nodiscard]] std::optional<double> saved_motion(const SavedState& state, const std::string& name);

struct SavedStates {
  std::optional<SavedState> wanted;
  std::vector<std::string> times;  ///< of all of them, as the file has them
};

/// The state at t, or the last one. Errors: SceneError at the line of the file; `key` stands in front.
[[nodiscard]] SavedStates read_saved_states(std::istream& in, const std::string& file, const std::string& key,
                                            std::optional<double> t);

}  // namespace signorini
