// damped_round_trip.hpp: test that modes reproduce motions converted to them.
//
//   | Re X y - q |,  | Re X L y - q' |   for   y = Y_q q + Y_r q',   relative to a motion of size 1
#pragma once

#include "engine/exact/modal/damped_pencil.hpp"

namespace signorini {

/// Converts a motion within the constraints, each mode of which has an energy of about 1, to modes and back: sets
/// round_trip, and failure if the loss is too large or the modes are nearly dependent. Modes and pencil are both
/// rotated.
void test_round_trip(const DampedPencil& pencil, DampedModes& modes);

}  // namespace signorini
