// sweep_plots.hpp: gnuplot scripts that draw a sweep over its first varied key.
//
//   DIR/plots/motion.gp   peaks along tangent and normal, a curve a contact and combination of the other keys
//   DIR/plots/forces.gp   peaks of |N| and |T|
//   DIR/plots/losses.gp   friction work, and events
//   DIR/plots/responses.gp the answers to the queries, a panel each
//   DIR/plots/exceedance.gp of a sampled sweep, instead of all others: probabilities of more
//   DIR/plots/curve-1.csv x, events, then the figures of every contact: one file a combination
//
// The first key with more than one value is the axis; where its values are no numbers, they stand evenly. Two
// keys with three numbers or more each are the axes of maps instead (sweep_map.hpp).
#pragma once

#include <filesystem>
#include <vector>

#include "result/picture_look.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini {

/// Writes the scripts and returns them; none with fewer than two rows that ran. Errors: FileError.
std::vector<std::filesystem::path> write_sweep_plots(const std::filesystem::path& directory,
                                                     const SweepSpec& spec, const SweepRows& rows,
                                                     const PictureLook& look = {});

/// Removes what write_sweep_plots and its scripts put there. Errors: FileError.
void remove_sweep_plots(const std::filesystem::path& directory);

}  // namespace signorini
