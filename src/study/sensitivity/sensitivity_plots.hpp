// sensitivity_plots.hpp: gnuplot scripts that draw sensitivities.
//
//   DIR/plots/tornado.gp   what each parameter does to a figure, the greatest on top, a panel a figure:
//                          elasticities, or with sigmas what each sigma makes of it
//   DIR/plots/times-1.gp   event times over the first parameter, ..., with their tangents
//   DIR/plots/sequence.gp  the least change of each parameter at which, to first order, the sequence changes
//   DIR/plots/*.csv        what they draw
#pragma once

#include <filesystem>

#include "result/picture_files.hpp"
#include "study/sensitivity/spread.hpp"

namespace signorini {

/// None without events and figures.
[[nodiscard]] PictureFiles sensitivity_pictures(const Sensitivities& s, const Sigmas& sigmas,
                                                const PictureLook& look = {});

/// Removes what they and their scripts put into DIR/plots. Errors: FileError.
void remove_sensitivity_plots(const std::filesystem::path& directory);

}  // namespace signorini
