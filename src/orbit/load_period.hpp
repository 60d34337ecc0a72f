// load_period.hpp: the period after which everything that drives a scene repeats itself.
//
//   f(t + T) = f(t) for all t >= settled        loads, motions of supports and of the base, compressions, surfaces
//
// A load whose amplitude is zero drives nothing, and has no say, unless it counts as one that drives elsewhere: a branch over
// the amplitude keeps its period where the load vanishes.
//
// Several periods have the smallest common multiple, if there is one up to a hundred times the longest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

struct LoadPeriod {
  std::optional<double> period;  ///< nothing: all of it is constant from `settled` on
  double settled = 0.0;          ///< what does not repeat itself is over
  bool surfaces_move = false;    ///< a belt
};

/// Loads that count although their amplitude is zero, one entry a load; empty: none.
using SilentLoads = std::vector<bool>;

/// Those that drive the scene; all of them where none does.
[[nodiscard]] SilentLoads driving_loads(const Scene& scene);

/// Errors: SceneError where there is no common period, at the history that has none.
[[nodiscard]] LoadPeriod load_period(const Scene& scene, const SilentLoads& count = {});

/// Errors: SceneError at the history that does not repeat itself with this period.
[[nodiscard]] LoadPeriod check_period(const Scene& scene, double period, const SilentLoads& count = {});

/// The changes after which all that drives the scene acts earlier by `time`. Histories in code are left out.
[[nodiscard]] std::vector<Override> driven_earlier(const Scene& scene, double time);

}  // namespace signorini
