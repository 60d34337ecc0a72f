// load_period.hpp: the period after which everything that drives a scene repeats itself.
//
//   f(t + T) = f(t) for all t >= settled        loads, motions of supports and of the base, compressions, surfaces
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

/// Errors: SceneError where there is no common period, at the history that has none.
[[nodiscard]] LoadPeriod load_period(const Scene& scene);

/// Errors: SceneError at the history that does not repeat itself with this period.
[[nodiscard]] LoadPeriod check_period(const Scene& scene, double period);

/// The changes after which all that drives the scene acts earlier by `time`. Histories in code are left out.
[[nodiscard]] std::vector<Override> driven_earlier(const Scene& scene, double time);

}  // namespace signorini
