// unique_forces.hpp: do the rows of a mode determine the forces of its rigid contacts?
//
//   A = H^T M^-1 (H - s f T),   H: normals of what is closed, tangents of what sticks;  A_ij / sqrt(A_ii A_jj)
//
// An elimination of dependent rows ends in a pivot that is rounding, and may not notice: what it yields then are
// forces of any size and sign, with a noise of the same size.
#pragma once

#include <vector>

#include "contact/motion.hpp"
#include "contact/transition.hpp"
#include "motion/mode_systems.hpp"

namespace signorini {

/// The noise of a force of a rigid contact exceeds a thousandth of the greatest force: they may be.
[[nodiscard]] bool forces_are_noise(const Model& model, const std::vector<MotionJet>& jets);

/// False: the least singular value is what rounding leaves of zero.
[[nodiscard]] bool forces_are_unique(ModeSystems& systems, const Mode& mode);

}  // namespace signorini
