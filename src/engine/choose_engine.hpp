// choose_engine.hpp: what computes a scene with engine = "auto".
//
//   exact   where the laws are linear and nothing decays faster than it could oscillate:
//           max_i C_ii / M_ii <= omega_max, and K_ii / C_ii <= omega_max where there is no mass
//   ida     else
//
// Why: validation/work-precision. A series takes a step for every 5 radians of the fastest motion,
// oscillation or decay; an implicit method steps over a decay that is long over. Where decay is the slower
// one, the series is the cheapest at every error below 1e-5 and needs no tolerance; the two meet at C_ii /
// M_ii = 1 to 2 omega_max.
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

struct EngineChoice {
  Engine engine = Engine::ida;
  std::string reason;  ///< one sentence
};

/// What run.engine says, with the reason "as given"; never Engine::automatic.
[[nodiscard]] EngineChoice choose_engine(const Model& model, const RunSpec& run);

}  // namespace signorini
