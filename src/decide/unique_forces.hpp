// unique_forces.hpp: checks that the rows of a mode determine the forces of its rigid contacts.
//
//   A = H^T M^-1 (H - s f T),   H: normals of closed contacts, tangents of sticking ones;  A_ij / sqrt(A_ii A_jj)
//
// An elimination of dependent rows ends with a pivot of rounding size, and may not detect it: the computed forces then
// have any size and sign, with noise of the same size.
#pragma once

#include <vector>

#include "contact/motion.hpp"
#include "contact/transition.hpp"
#include "motion/mode_systems.hpp"

namespace signorini {

/// True if the noise of a rigid contact's force exceeds a thousandth of the largest force: the forces may then not be
/// unique.
[[nodiscard]] bool forces_are_noise(const Model& model, const std::vector<MotionJet>& jets);

/// False if the smallest singular value is the rounding of zero.
[[nodiscard]] bool forces_are_unique(ModeSystems& systems, const Mode& mode);

}  // namespace signorini
