// flows.hpp: random scenes through both flows of engine `exact`.
//
//   scene with linear laws -> run.flow = "taylor" and "modal": the same events, as far as the scene's data are known
//   (metamorphic.hpp)
#pragma once

#include <optional>

#include "differential/transform.hpp"

namespace signorini::differential {

/// Times what one rounding of all data does: an event in modes has passed through the rounding of open modes,
/// of a state's and of both ways between them. Chosen; what exceeds it was a defect each time.
inline constexpr double roundings_of_modes = 100.0;

/// The drawn scene without Stribeck's law and shear elements, which modes do not follow. Where they refuse it
/// still: with C = alpha M, springs for rigid contacts and jumps for histories that change. Its flow: the
/// series. Nothing where modes refuse that, too.
[[nodiscard]] std::optional<Scene> for_both_flows(Scene scene);

/// The same, followed in modes.
[[nodiscard]] Transformed in_modes(const Scene& scene);

}  // namespace signorini::differential
