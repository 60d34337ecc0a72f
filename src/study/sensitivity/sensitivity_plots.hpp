// sensitivity_plots.hpp: gnuplot scripts that draw sensitivities.
//
//   DIR/plots/tornado.gp   effect of each parameter on a figure, the largest on top, one panel per figure:
//                          elasticities, or with sigmas the effect of each sigma
//   DIR/plots/times-1.gp   event times over the first parameter, ..., with their tangents
//   DIR/plots/sequence.gp  the smallest change of each parameter at which, to first order, the sequence changes
//   DIR/plots/*.csv        data of the pictures
#pragma once

#include <filesystem>

#include "result/picture_files.hpp"
#include "study/sensitivity/sensitivity_files.hpp"

namespace signorini::sensitivity_study {

/// Pictures of the sensitivities; empty if there are neither events nor figures.
[[nodiscard]] result::PictureFiles sensitivity_pictures(const Sensitivities& s, const Sigmas& sigmas,
                                                        const result::PictureStyle& look = {});

/// Removes the files of these pictures and scripts from DIR/plots. Errors: FileError.
void remove_sensitivity_plots(const std::filesystem::path& directory);

}  // namespace signorini::sensitivity_study
