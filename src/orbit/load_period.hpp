// load_period.hpp: common period of all excitations of a scene.
//
//   f(t + T) = f(t) for all t >= settled        loads, motions of supports and of the base, compressions, surfaces
//
// A load of amplitude zero drives nothing and is ignored, unless it is declared to drive elsewhere: a branch over the
// amplitude keeps its period where the load vanishes.
//
// Several periods have a smallest common multiple if there is one up to a hundred times the longest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

struct LoadPeriod {
  std::optional<double> period;  ///< nullopt: everything is constant from `settled` on
  double settled = 0.0;          ///< end of the part that is not periodic
  bool surfaces_move = false;    ///< there is a belt
};

/// Loads that count even with amplitude zero, one entry per load; empty: none.
using SilentLoads = std::vector<bool>;

/// Loads with nonzero amplitude; all of them if there are none.
[[nodiscard]] SilentLoads driving_loads(const Scene& scene);

/// Errors: SceneError at a history that has no period in common with the others.
[[nodiscard]] LoadPeriod load_period(const Scene& scene, const SilentLoads& count = {});

/// Errors: SceneError at a history without this period.
[[nodiscard]] LoadPeriod check_period(const Scene& scene, double period, const SilentLoads& count = {});

/// Overrides by which all excitations act earlier by `time`. Histories made in code are ignored.
[[nodiscard]] std::vector<Override> driven_earlier(const Scene& scene, double time);

}  // namespace signorini
