// branch_pictures.hpp: picture of a branch of orbits: a frequency response, or amplitudes over another key.
//
//   plots/branch.gp     one panel per output (its least and largest value in a period), the largest multiplier, the
// number
//                       of the sequence of events; stable parts solid, unstable ones dashed, located points marked
//   plots/branch.csv    the curves: x, stable 1 or 0, sequence, special, multiplier, amplitude, outputs
#pragma once

#include "result/picture_files.hpp"
#include "signorini/orbit.hpp"

namespace signorini {

/// outputs: names with units, in the order of BranchPoint::minima; at most six panels of them.
[[nodiscard]] PictureFiles branch_pictures(const std::string& title, const Units& units,
                                           const BranchOptions& options,
                                           const std::vector<std::string>& outputs, const Branch& branch,
                                           const PictureLook& look = {});

[[nodiscard]] bool is_picture_of_branch(const std::filesystem::path& file);

}  // namespace signorini
