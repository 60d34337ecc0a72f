// sweep_map.hpp: a sweep over two keys as maps: the colour of a cell is the figure of its run.
//
//   map.csv      x0,x1,y0,y1,events,peak_t,peak_n,peak_N,peak_T,friction_work,QUERY,...
//   borders.csv  x0,y0,x1,y1: sides between cells whose events come in another sequence
//
// Greatest of all contacts; a cell reaches halfway to its neighbours: on an axis of positive values that span a factor of
// 50 or more, which is logarithmic, to the geometric mean.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "result/picture_look.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini {

/// The two keys that have several values.
struct MapAxes {
  std::size_t x = 0, y = 0;
};

/// Nothing unless two keys, and no more, have several values, three or more each, and all of them numbers.
[[nodiscard]] std::optional<MapAxes> map_axes(const SweepSpec& spec);

/// Cells without a run have no row.
[[nodiscard]] std::string map_table(const SweepSpec& spec, const MapAxes& axes, const SweepRows& rows);

/// The sides that part regions of equal sequences of events; of cells without a run none.
struct Borders {
  std::string table;
  std::size_t count = 0, neighbours = 0;  ///< sides in the table; sides between cells that ran
};
[[nodiscard]] Borders border_table(const SweepSpec& spec, const MapAxes& axes, const SweepRows& rows);

/// A figure and its column in map.csv, from 1.
struct MapPanel {
  std::string label;
  int column = 0;
};
[[nodiscard]] std::string map_script(const SweepSpec& spec, const MapAxes& axes, const std::string& name,
                                     const std::string& subtitle, const std::vector<MapPanel>& panels,
                                     bool borders, const PictureLook& look);

}  // namespace signorini
