// sweep_map.hpp: maps of a sweep over two keys: a cell's colour is the result of its run.
//
//   map.csv      x0,x1,y0,y1,events,peak_t,peak_n,peak_N,peak_T,friction_work,QUERY,...
//   borders.csv  x0,y0,x1,y1: sides between cells with different sequences of events
//
// Peaks and friction work are the largest values of all contacts. A cell extends half-way to its neighbours. An axis is
// logarithmic if its values are positive and span a factor of 50 or more; there a cell extends to the geometric mean.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "result/picture.hpp"
#include "result/table.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini::sweep {

/// Indices into SweepSpec::vary of the two keys with several values.
struct MapAxes {
  std::size_t x = 0, y = 0;
};

/// The axes, if exactly two keys have several values and both have at least three different numbers; otherwise nullopt.
[[nodiscard]] std::optional<MapAxes> map_axes(const SweepSpec& spec);

/// Row of map.csv: a cell and the results of its run; cells without a run have no row.
struct MapCell {
  double x0, x1, y0, y1;
  const SweepRow& row;
  SweepRow::Contact greatest;  ///< largest figures of all contacts
};
/// Columns of map.csv.
[[nodiscard]] result::CsvTable<MapCell> map_table(const SweepSpec& spec);
/// Cells of all rows that ran.
[[nodiscard]] std::vector<MapCell> map_cells(const SweepSpec& spec, const MapAxes& axes,
                                             const SweepRows& rows);

/// A side between cells with different sequences of events; cells without a run have no sides.
struct Border {
  double x0, y0, x1, y1;
};
struct Borders {
  std::vector<Border> sides;
  std::size_t neighbours = 0;  ///< number of common sides of two cells with runs
};
/// Columns of borders.csv.
[[nodiscard]] const result::CsvTable<Border>& border_table();
/// Borders between cells with different sequences of events.
[[nodiscard]] Borders borders_of(const SweepSpec& spec, const MapAxes& axes, const SweepRows& rows);

/// A figure and its column in map.csv.
struct MapPanel {
  std::string label, column;
};
/// Picture with one map per panel. borders: true if borders.csv is drawn on the maps.
[[nodiscard]] result::Picture map_picture(const SweepSpec& spec, const MapAxes& axes, const std::string& name,
                                          const std::string& subtitle, const std::vector<MapPanel>& panels,
                                          bool borders, const result::PictureStyle& look);

}  // namespace signorini::sweep
