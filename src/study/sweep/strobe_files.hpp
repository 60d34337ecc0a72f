// strobe_files.hpp: the points of a stroboscopic sweep as a table, and as bifurcation diagrams.
//
//   strobe.csv       row,PATH,...,way,t,COLUMN,...     way: there, or back where the sweep goes back
//   plots/strobe.gp  a panel a value, points over the last swept key
#pragma once

#include <string>

#include "result/picture_files.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini {

[[nodiscard]] std::string strobe_csv(const SweepSpec& spec, const SweepRows& rows);
/// Outputs, or displacements where the scene has none; six panels at most.
void add_strobe_picture(const SweepSpec& spec, const SweepRows& rows, const PlottedRun& run,
                        PictureFiles& files);

}  // namespace signorini
