// sensitivity_plots.hpp: gnuplot scripts that draw sensitivities.
//
//   DIR/plots/tornado.gp   what each parameter does to a figure, the greatest on top, a panel a figure:
//                          elasticities, or with sigmas what each sigma makes of it
//   DIR/plots/times-1.gp   event times over the first parameter, ..., with their tangents
//   DIR/plots/sequence.gp  the least change of each parameter at which, to first order, the sequence changes
//   DIR/plots/*.csv        what they draw
#pragma once

#include <filesystem>
#include <vector>

#include "result/picture_look.hpp"
#include "study/sensitivity/spread.hpp"

namespace signorini {

/// Writes the scripts and returns them; none without events and figures. Errors: FileError.
std::vector<std::filesystem::path> write_sensitivity_plots(const std::filesystem::path& directory,
                                                           const Sensitivities& s, const Sigmas& sigmas,
                                                           const PictureLook& look = {});

/// Removes what write_sensitivity_plots and its scripts put there. Errors: FileError.
void remove_sensitivity_plots(const std::filesystem::path& directory);

}  // namespace signorini
