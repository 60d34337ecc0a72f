// sweep_table.hpp: the rows of a sweep as one table, and its stroboscopic points.
//
//   sweep.csv  row,PATH,...,outcome,t,reason,events,slip,stick,reversal,separation,contact,impact,time,
//              QUERY,...,NAME.peak_t,NAME.peak_n,NAME.peak_N,NAME.peak_T,NAME.friction_work,...,
//              wall_time,steps,energy_balance,warnings
//
// Each contact has a group of columns, in the order of the model; cells are empty if no run began.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "result/picture_files.hpp"
#include "study/sweep/sweep_directory.hpp"

namespace signorini::sweep {

using SweepRows = std::map<std::size_t, SweepRow>;

/// Names of the contacts in all rows, in the order of their first occurrence.
[[nodiscard]] std::vector<std::string> contact_names(const SweepRows& rows);
/// The contact with this name in a row; null if the row has no such contact.
[[nodiscard]] const SweepRow::Contact* contact_of(const SweepRow& row, const std::string& name);

/// Texts of sweep.csv and results.json.
[[nodiscard]] std::string sweep_csv(const SweepSpec& spec, const SweepRows& rows);
[[nodiscard]] std::string sweep_json(const SweepSpec& spec, const SweepRows& rows);

// The points of a stroboscopic sweep as a table, and as bifurcation diagrams.
//
//   strobe.csv       row,PATH,...,way,t,COLUMN,...     way: there, or back for rows in the opposite order
//   plots/strobe.gp  one panel per value, points over the last swept key

[[nodiscard]] std::string strobe_csv(const SweepSpec& spec, const SweepRows& rows);
/// Adds the picture of outputs, or of displacements if the scene has no outputs; at most six panels.
void add_strobe_picture(const SweepSpec& spec, const SweepRows& rows, const result::PlottedRun& run,
                        result::PictureFiles& files);

}  // namespace signorini::sweep
