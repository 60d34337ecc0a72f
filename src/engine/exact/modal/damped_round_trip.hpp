// damped_round_trip.hpp: whether modes give back the motions that they are made of.
//
//   | Re X y - q |,  | Re X L y - q' |   of   y = Y_q q + Y_r q',   beside a motion of size 1
#pragma once

#include "engine/exact/modal/damped_pencil.hpp"

namespace signorini {

/// Gives back a motion, each mode of which has an energy of about 1, within the constraints: sets round_trip, and
/// failure where too much of it is lost or the modes are nearly dependent. Modes and pencil both turned.
void test_round_trip(const DampedPencil& pencil, DampedModes& modes);

}  // namespace signorini
