// picture.hpp: a picture as data, and its conversion to a gnuplot script.
//
//   picture -script_of-> text of NAME.gp, which draws once for each format
//
//   Picture p{"energy", "Stored energy, work, losses and balance", canvas_of(look, 768.0, true)};
//   p.panels.push_back({"energy [J]", {{"'../energy.csv' skip 1", "1:4", "with lines", "kinetic"}}});
//   script_of(run, p)
//
// Panels are stacked and share one horizontal axis, unless they specify another position. Rows, columns and looks of
// curves are gnuplot expressions; column numbers come from tables by name (result/table.hpp).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "result/picture_style.hpp"
#include "result/plotted_run.hpp"

namespace signorini::result {

/// Pixels of a canvas above the panels, for title and subtitle, and below them, for the axis and its label.
inline constexpr double margin_above = 62.0, margin_below = 70.0;

/// A curve, points, bands or an entry of the legend.
struct Curve {
  std::string rows;     ///< "'marks.csv' skip 1"; or a function of x, or "keyentry"
  std::string columns;  ///< "1:5"; empty: for a function or a legend entry
  std::string look;     ///< "with lines linecolor '#1a1a1a'"
  std::optional<std::string> name = std::nullopt;  ///< name in the legend
};

/// Lower and upper edge of a panel, as fractions of the picture's height.
struct PanelEdges {
  double bottom = 0.0, top = 1.0;
};

struct Panel {
  std::string label;  ///< label of the vertical axis
  std::vector<Curve> curves;
  std::string axes = "";   ///< gnuplot lines for axes that differ from the usual ones
  double weight = 1.0;     ///< relative height of the panel
  std::string after = "";  ///< gnuplot lines that undo permanent settings of `axes`
  bool own_axis = false;   ///< numbers and label at the horizontal axis even if panels follow
  /// gnuplot lines for the panel's position and axes; empty: the panels are stacked.
  std::string margins = "";
};

struct Picture {
  std::string name;      ///< base name of the picture's files
  std::string subtitle;  ///< line below the run's title
  Canvas canvas;
  bool over_time = true;
  std::vector<Panel> panels = {};
  double space = 22.0;     ///< pixels between panels
  std::string setup = "";  ///< gnuplot lines for all panels
};
/// Text of the gnuplot script that draws the picture.
[[nodiscard]] std::string script_of(const PlottedRun& run, const Picture& picture);

/// Width in pixels of a legend with these names after legend_name().
[[nodiscard]] double legend_width(const std::vector<std::string>& names);
/// The name; if it is too long for a legend, "..." replaces its middle.
[[nodiscard]] std::string legend_name(const std::string& name);

/// The text in single quotes for gnuplot, which expands nothing in it. A leading apostrophe becomes a
/// typographic one.
[[nodiscard]] std::string quoted(const std::string& text);
/// gnuplot command for named tics of the axis 'x' or 'y': "set xtics ('A' 0, ...)". % is doubled, because gnuplot reads
/// the names as formats.
[[nodiscard]] std::string named_tics(char axis,
                                     const std::vector<std::pair<std::string, std::size_t>>& names);

/// Edges of stacked panels with these relative heights, from top to bottom. space: pixels between two panels.
[[nodiscard]] std::vector<PanelEdges> panel_edges(const std::vector<double>& weights, const Canvas& canvas,
                                                  double space);
/// gnuplot command for the range of the axis 'x' or 'y': "set xrange [a:b]".
[[nodiscard]] std::string range_of(char axis, double from, double to);
/// gnuplot command for a vertical line across the panel at x; number: that of the gnuplot arrow; look: line style.
[[nodiscard]] std::string vertical_line(std::size_t number, double x, const std::string& look);

}  // namespace signorini::result
