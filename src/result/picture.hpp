// picture.hpp: a picture as data, and the one place where it becomes a script for gnuplot.
//
//   picture -script_of-> text of NAME.gp, which draws once for each format
//
//   Picture p{"energy", "Where the energy is", canvas_of(look, 768.0, true)};
//   p.panels.push_back({"energy [J]", {{"'../energy.csv' skip 1", "1:4", "with lines", "kinetic"}}});
//   script_of(run, p)
//
// Panels stand above each other and share one horizontal axis, unless they say otherwise. Rows, columns and looks of curves
// are gnuplot's words; their columns are asked of tables by name (result/table.hpp).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "result/picture_look.hpp"
#include "result/plotted_run.hpp"

namespace signorini {

/// Pixels of a canvas above the panels, for title and subtitle, and below them, for the axis and its name.
inline constexpr double room_above = 62.0, room_below = 70.0;

/// A curve, marks, bands or an entry of the legend.
struct Curve {
  std::string rows;     ///< "'marks.csv' skip 1"; or a function of x, or "keyentry"
  std::string columns;  ///< "1:5"; empty: of such a function or entry
  std::string look;     ///< "with lines linecolor '#1a1a1a'"
  std::optional<std::string> name = std::nullopt;  ///< in the legend
};

/// Lower and upper edge of a panel, as fractions of the picture's height.
struct PanelEdges {
  double bottom = 0.0, top = 1.0;
};

struct Panel {
  std::string label;  ///< of the vertical axis
  std::vector<Curve> curves;
  std::string axes = "";   ///< what differs from the usual axes, in gnuplot's lines
  double weight = 1.0;     ///< its height beside that of the others
  std::string after = "";  ///< takes back what `axes` has set for good
  bool own_axis = false;   ///< has figures and a name at its horizontal axis, whatever comes below
  std::string margins =
      "";  ///< where it stands, in gnuplot's lines, and all of its axes; empty: above each other
};

struct Picture {
  std::string name;      ///< of its files
  std::string subtitle;  ///< below the run's title
  Canvas canvas;
  bool over_time = true;
  std::vector<Panel> panels = {};
  double space = 22.0;     ///< pixels between panels
  std::string setup = "";  ///< of all panels, in gnuplot's lines
};
[[nodiscard]] std::string script_of(const PlottedRun& run, const Picture& picture);

/// Pixels of a legend with these names, no longer than legend_name() makes them.
[[nodiscard]] double room_for(const std::vector<std::string>& names);
/// A name that is too long for a legend without its middle.
[[nodiscard]] std::string legend_name(const std::string& name);

/// 'text' for gnuplot: nothing in it is expanded. An apostrophe at its beginning becomes a typographic one.
[[nodiscard]] std::string quoted(const std::string& text);
/// Names at places of the axis "x" or "y": "set xtics ('A' 0, ...)", where gnuplot reads % as the beginning of a format.
[[nodiscard]] std::string named_tics(char axis,
                                     const std::vector<std::pair<std::string, std::size_t>>& names);

/// Edges of panels above each other, as high as these weights are to each other; `space` between them in pixels.
[[nodiscard]] std::vector<PanelEdges> stacked(const std::vector<double>& weights, const Canvas& canvas,
                                              double space);
/// "set xrange [a:b]".
[[nodiscard]] std::string range_of(char axis, double from, double to);
/// A line across the panel at x.
[[nodiscard]] std::string upright(std::size_t number, double x, const std::string& look);

}  // namespace signorini
