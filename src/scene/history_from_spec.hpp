// history_from_spec.hpp: the history types of a scene, as closed-form pieces.
//
//   f(t) = offset + amplitude * shape(t),   shape = 0 outside [start, end)
//
//   constant     1                          without `start`: at all times
//   step         1 from start on
//   rectangle    1 on [start, end)
//   triangle     0 at start and end, 1 in the middle
//   half_sine    sin(pi (t - start) / (end - start))
//   harmonic     sin(omega (t - start) + phase)
//   polynomial   sum_j c_j (t - start)^j
//   table        linear between (times, values), or Steffen's monotone cubic; a repeated time is a jump;
//                zero before the first and, without `hold`, from the last time on (start and end are not
//                used)
//
// With a period, the shape restarts after each period. The first period begins at `start`, or at the first time of a
// table. A shift delays the whole history.
//
// Steffen: Astron. Astrophys. 239 (1990) 443-450, as implemented by GSL.
#pragma once

#include <string>

#include "signorini/history.hpp"
#include "signorini/scene.hpp"

namespace signorini::scene {

/// The history that a spec describes. Errors: SceneError at the spec's place under `key` ("loads.1.history").
[[nodiscard]] History make_history(const HistorySpec& spec, const std::string& key);
/// Integral of the history from 0 to t, as a history. Errors: as make_history(); SceneError for a user-defined function.
[[nodiscard]] History make_integral(const HistorySpec& spec, const std::string& key);

}  // namespace signorini::scene
