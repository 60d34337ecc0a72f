// branch_pictures.hpp: a branch of orbits as a frequency response, or over whatever key it was followed.
//
//   plots/branch.gp     a panel an output (its least and greatest value in a period), the greatest multiplier, the number
//                       of the sequence of events; stable parts solid, unstable ones dashed, located points marked
//   plots/branch.csv    the curves: x, stable 1 or 0, sequence, special, multiplier, amplitude, outputs
#pragma once

#include "result/picture_files.hpp"
#include "signorini/orbit.hpp"

namespace signorini {

/// outputs: their names with units, in the order of BranchPoint::minima; six panels of them at most.
[[nodiscard]] PictureFiles branch_pictures(const std::string& title, const Units& units,
                                           const BranchOptions& options,
                                           const std::vector<std::string>& outputs, const Branch& branch,
                                           const PictureLook& look = {});

[[nodiscard]] bool is_picture_of_branch(const std::filesystem::path& file);

}  // namespace signorini
