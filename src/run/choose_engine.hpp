// choose_engine.hpp: what computes a scene with engine = "auto".
//
//   exact   where the laws are linear and every decay is slow beside the fastest oscillation:
//           alpha + beta omega_max^2, C_ii / M_ii and, where there is no mass, K_ii / C_ii are at most
//           0.2 max(omega_max, 1 / t_end)
//   ida     else
//
// Why: validation/work-precision. A series takes a step for every 5 radians of the fastest motion, whether
// anything still moves like that or not; an implicit method steps over what has died out. Where nothing dies
// out the series is the cheapest for all but rough answers. The two meet at 0.1 (slow loads, few events)
// to 0.5 (many events); 0.2 is the choice that is least wrong.
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

struct EngineChoice {
  Engine engine = Engine::automatic;
  bool automatic = false;
  std::string reason;  ///< one sentence
};

/// The engine of run.engine, unless it is automatic, with the reason "as given"; never Engine::automatic.
[[nodiscard]] EngineChoice choose_engine(const Model& model, const RunSpec& run);

}  // namespace signorini
