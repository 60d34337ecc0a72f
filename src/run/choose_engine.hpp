// choose_engine.hpp: chooses the engine of a scene with engine = "auto".
//
//   exact   if the laws are linear and every decay is slow relative to the fastest oscillation:
//           alpha + beta omega_max^2, C_ii / M_ii and, without mass, K_ii / C_ii are at most
//           0.2 max(omega_max, 1 / t_end)
//   ida     otherwise
//
// Reason: validation/work-precision. A series takes a step for every 5 radians of the fastest motion, even after that
// motion has decayed; an implicit method takes longer steps then. Without decay the series costs least except at low
// accuracy. The costs are equal at 0.1 (slow loads, few events) to 0.5 (many events); 0.2 is a compromise.
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

struct EngineChoice {
  Engine engine = Engine::automatic;
  bool automatic = false;
  std::string reason;  ///< one sentence
};

/// Returns run.engine with the reason "as given" unless it is automatic; never Engine::automatic.
[[nodiscard]] EngineChoice choose_engine(const Model& model, const RunSpec& run);

}  // namespace signorini
