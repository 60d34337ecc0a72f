// scene_text.hpp: pieces of scene files from drawn numbers.
//
//   friction = { static = 0.4, kinetic = 0.3 }
//   history = { type = "harmonic", omega = 12.5, phase = 1.0 }
#pragma once

#include <string>
#include <vector>

#include "differential/keys.hpp"
#include "differential/random.hpp"

namespace signorini::differential {

/// "[1.0, 2.0]"
[[nodiscard]] std::string list(const std::vector<double>& values);
/// "[[1.0, 0.0], [0.0, 2.0]]"
[[nodiscard]] std::string rows(const std::vector<std::vector<double>>& matrix);
/// "{ d0 = 1.0, d2 = -0.5 }": what is not zero of a form on degrees of freedom.
[[nodiscard]] std::string form(const std::vector<double>& factors);

/// What a contact's laws are drawn for.
struct ContactKind {
  std::string law;             ///< "compliant", "rigid", "slider"
  double force = 10.0;         ///< typical compression
  double stiffness = 1e4;      ///< of contact elements, times 0.1 to 10
  bool may_have_rate = false;  ///< Stribeck's friction, where there is no tangential stiffness
};

/// Friction, stiffnesses, dashpots, restitution, compression, surface: all keys but name, place, direction
/// and gap.
[[nodiscard]] Keys contact_laws(Random& draw, const ContactKind& kind);
/// amplitude and history of a load within [0, t_end]; the amplitude is size times 0.3 to 1.
[[nodiscard]] Keys load_course(Random& draw, double size, double t_end);
/// "{ type = ..., amplitude = ... }": a motion of a surface or of the ground.
[[nodiscard]] std::string motion_history(Random& draw, double amplitude, double t_end);

}  // namespace signorini::differential
