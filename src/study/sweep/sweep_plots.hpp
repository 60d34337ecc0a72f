// sweep_plots.hpp: gnuplot scripts that draw a sweep over its first varied key.
//
//   DIR/plots/motion.gp   peaks along tangent and normal, one curve per contact and combination of the other keys
//   DIR/plots/forces.gp   peaks of |N| and |T|
//   DIR/plots/losses.gp   friction work, and events
//   DIR/plots/responses.gp results of the queries, one panel each
//   DIR/plots/exceedance.gp for a sampled sweep, instead of all others: exceedance probabilities
//   DIR/plots/strobe.gp   for a stroboscopic sweep: bifurcation diagrams (strobe_files.hpp)
//   DIR/plots/curve-1.csv x, events, then the figures of every contact: one file per combination
//
// The first key with more than one value is the axis; if its values are not numbers, they are evenly spaced. Two keys
// with at least three numbers each are the axes of maps instead (sweep_map.hpp).
#pragma once

#include <filesystem>

#include "result/picture_files.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini {

/// Empty if fewer than two rows ran.
[[nodiscard]] PictureFiles sweep_pictures(const SweepSpec& spec, const SweepRows& rows,
                                          const PictureLook& look = {});

/// Removes the files of these pictures and scripts from DIR/plots. Errors: FileError.
void remove_sweep_plots(const std::filesystem::path& directory);

}  // namespace signorini
