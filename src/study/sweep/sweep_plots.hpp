// sweep_plots.hpp: gnuplot scripts that draw a sweep over its first varied key.
//
//   DIR/plots/motion.gp   peaks along tangent and normal, a curve a contact and combination of the other keys
//   DIR/plots/forces.gp   peaks of |N| and |T|
//   DIR/plots/losses.gp   friction work, and events
//   DIR/plots/responses.gp the answers to the queries, a panel each
//   DIR/plots/exceedance.gp of a sampled sweep, instead of all others: probabilities of more
//   DIR/plots/strobe.gp   of a stroboscopic sweep: bifurcation diagrams (strobe_files.hpp)
//   DIR/plots/curve-1.csv x, events, then the figures of every contact: one file a combination
//
// The first key with more than one value is the axis; where its values are no numbers, they stand evenly. Two
// keys with three numbers or more each are the axes of maps instead (sweep_map.hpp).
#pragma once

#include <filesystem>

#include "result/picture_files.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini {

/// None with fewer than two rows that ran.
[[nodiscard]] PictureFiles sweep_pictures(const SweepSpec& spec, const SweepRows& rows,
                                          const PictureLook& look = {});

/// Removes what they and their scripts put into DIR/plots. Errors: FileError.
void remove_sweep_plots(const std::filesystem::path& directory);

}  // namespace signorini
