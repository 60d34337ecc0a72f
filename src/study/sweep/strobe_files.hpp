// strobe_files.hpp: the points of a stroboscopic sweep as a table, and as bifurcation diagrams.
//
//   strobe.csv       row,PATH,...,way,t,COLUMN,...     way: there, or back for rows in the opposite order
//   plots/strobe.gp  one panel per value, points over the last swept key
#pragma once

#include <string>

#include "result/picture_files.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini {

[[nodiscard]] std::string strobe_csv(const SweepSpec& spec, const SweepRows& rows);
/// Outputs, or displacements if the scene has no outputs; at most six panels.
void add_strobe_picture(const SweepSpec& spec, const SweepRows& rows, const PlottedRun& run,
                        PictureFiles& files);

}  // namespace signorini
