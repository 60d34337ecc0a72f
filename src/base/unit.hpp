// unit.hpp: units of mechanical quantities, as powers of force, length and time.
//
//   [x] = force^a length^b time^c,      mass = force time^2 / length
#pragma once

#include "signorini/scene.hpp"

namespace signorini::unit {

inline constexpr Unit plain{}, force{1, 0, 0}, length{0, 1, 0}, time{0, 0, 1}, rate{0, 0, -1};
inline constexpr Unit velocity{0, 1, -1}, acceleration{0, 1, -2}, mass{1, -1, 2}, inertia{1, 1, 2};
inline constexpr Unit stiffness{1, -1, 0}, damping{1, -1, 1}, impulse{1, 0, 1}, energy{1, 1, 0},
    power{1, 1, -1};

}  // namespace signorini::unit
