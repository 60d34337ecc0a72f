#include "study/sweep/sweep_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "study/optional_values.hpp"

namespace signorini::sweep {
namespace {

constexpr std::size_t min_values = 3;

std::vector<double> values_of(const ParameterRange& vary) {
  std::vector<double> values;
  for (const std::string& text : vary.values) values.push_back(*base::parse_number(text));
  std::sort(values.begin(), values.end());
  return values;
}

// Ratio of the largest to the smallest value from which an axis is logarithmic.
constexpr double decades = 50.0;
constexpr std::size_t max_ticks = 8;  // with more values gnuplot chooses the ticks

bool logarithmic(const std::vector<double>& values) {
  return values.front() > 0.0 && values.back() >= decades * values.front();
}

/// Limits of the cell around `at`: half-way to both neighbours. A cell at an end extends equally to both sides.
std::pair<double, double> cell(const std::vector<double>& values, double at) {
  const bool log = logarithmic(values);
  const auto scale = [&](double x) { return log ? std::log(x) : x; };
  const auto back = [&](double x) { return log ? std::exp(x) : x; };
  const auto here = std::lower_bound(values.begin(), values.end(), at);
  const bool first = here == values.begin(), last = here + 1 == values.end();
  const double x = scale(at);
  const double before = first ? x - (scale(*(here + 1)) - x) : scale(*(here - 1));
  const double after = last ? x + (x - scale(*(here - 1))) : scale(*(here + 1));
  return {back(0.5 * (before + x)), back(0.5 * (x + after))};
}

/// Range, scale and ticks of axis "x" or "y".
std::string axis(const char* name, const std::vector<double>& values) {
  std::string s = fmt::format(
      "set {}range [{}:{}]\n{} logscale {}\n", name, base::format_number(cell(values, values.front()).first),
      base::format_number(cell(values, values.back()).second), logarithmic(values) ? "set" : "unset", name);
  if (values.size() > max_ticks) return s + fmt::format("set {}tics autofreq\n", name);
  s += fmt::format("set {}tics (", name);
  for (std::size_t i = 0; i < values.size(); ++i) s += (i > 0 ? ", " : "") + base::format_number(values[i]);
  return s + ")\n";
}

}  // namespace

std::optional<MapAxes> map_axes(const SweepSpec& spec) {
  std::vector<std::size_t> several;
  for (std::size_t i = 0; i < spec.vary.size(); ++i) {
    const std::vector<std::string>& values = spec.vary[i].values;
    if (values.size() < 2) continue;
    if (spec.vary[i].sampled || spec.vary[i].group != 0) return std::nullopt;
    const bool numbers = std::all_of(values.begin(), values.end(), [](const std::string& text) {
      return base::parse_number(text).has_value();
    });
    if (!numbers || values.size() < min_values) return std::nullopt;
    const std::vector<double> sorted = values_of(spec.vary[i]);
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return std::nullopt;
    several.push_back(i);
  }
  if (several.size() != 2) return std::nullopt;
  return MapAxes{several[0], several[1]};
}

result::CsvTable<MapCell> map_table(const SweepSpec& spec) {
  using C = MapCell;
  result::CsvTable<C> table = {
      {"x0", &C::x0}, {"x1", &C::x1}, {"y0", &C::y0}, {"y1", &C::y1}, {"events", [](const C& c) {
                                                                         return c.row.changes();
                                                                       }}};
  for (const SweepFigure& figure : sweep_figures)
    table.add(figure.name, [&figure](const C& c) { return c.greatest.*figure.value; });
  for (std::size_t i = 0; i < spec.responses.size(); ++i)
    table.add(spec.responses[i], [i](const C& c) { return c.row.response(i); });
  return table;
}

std::vector<MapCell> map_cells(const SweepSpec& spec, const MapAxes& axes, const SweepRows& rows) {
  const std::vector<double> x = values_of(spec.vary[axes.x]), y = values_of(spec.vary[axes.y]);
  std::vector<MapCell> cells;
  for (const auto& [index, row] : rows) {
    if (!row.ran()) continue;
    const auto [x0, x1] = cell(x, *base::parse_number(row.values[axes.x]));
    const auto [y0, y1] = cell(y, *base::parse_number(row.values[axes.y]));
    SweepRow::Contact greatest;
    for (const SweepRow::Contact& c : row.contacts)
      for (const SweepFigure& figure : sweep_figures)
        greatest.*figure.value = std::max(greatest.*figure.value, c.*figure.value);
    cells.push_back({x0, x1, y0, y1, row, greatest});
  }
  return cells;
}

const result::CsvTable<Border>& border_table() {
  static const result::CsvTable<Border> table = {
      {"x0", &Border::x0}, {"y0", &Border::y0}, {"x1", &Border::x1}, {"y1", &Border::y1}};
  return table;
}

Borders borders_of(const SweepSpec& spec, const MapAxes& axes, const SweepRows& rows) {
  const std::vector<double> x = values_of(spec.vary[axes.x]), y = values_of(spec.vary[axes.y]);
  std::map<std::pair<double, double>, const std::string*> sequences;
  for (const auto& [index, row] : rows)
    if (row.ran())
      sequences[{*base::parse_number(row.values[axes.x]), *base::parse_number(row.values[axes.y])}] =
          &row.sequence;
  Borders borders;
  const auto differ = [&](double xa, double ya, double xb, double yb) {
    const auto a = sequences.find({xa, ya}), b = sequences.find({xb, yb});
    if (a == sequences.end() || b == sequences.end()) return false;
    ++borders.neighbours;
    return *a->second != *b->second;
  };
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < y.size(); ++j) {
      const auto [x0, x1] = cell(x, x[i]);
      const auto [y0, y1] = cell(y, y[j]);
      if (i + 1 < x.size() && differ(x[i], y[j], x[i + 1], y[j])) borders.sides.push_back({x1, y0, x1, y1});
      if (j + 1 < y.size() && differ(x[i], y[j], x[i], y[j + 1])) borders.sides.push_back({x0, y1, x1, y1});
    }
  return borders;
}

result::Picture map_picture(const SweepSpec& spec, const MapAxes& axes, const std::string& name,
                            const std::string& subtitle, const std::vector<MapPanel>& panels, bool borders,
                            const result::PictureStyle& look) {
  const result::CsvTable<MapCell> cells = map_table(spec);
  const result::CsvTable<Border>& sides = border_table();
  const std::size_t count = panels.size();
  result::Picture picture{name, subtitle,
                          result::canvas_of(look, 148.0 + 380.0 * static_cast<double>(count), false), false};
  picture.space = 30.0;
  picture.setup =
      "set palette defined (0 '#f7fbff', 0.35 '#6baed6', 0.7 '#08519c', 1 '#08203f')\nset grid front\n";
  const result::Canvas& canvas = picture.canvas;
  const std::vector<result::PanelEdges> edges =
      result::panel_edges(std::vector<double>(count, 1.0), canvas, picture.space);
  for (std::size_t i = 0; i < count; ++i) {
    result::Panel panel{study::key_with_unit(spec.vary[axes.y].path, spec.units), {}};
    if (i + 1 == count)
      panel.axes =
          "set xlabel " + result::quoted(study::key_with_unit(spec.vary[axes.x].path, spec.units)) + "\n";
    panel.axes += axis("x", values_of(spec.vary[axes.x])) + axis("y", values_of(spec.vary[axes.y]));
    panel.axes += fmt::format(
        "set colorbox user origin screen {:.4f}, screen {:.4f} size screen 0.018, screen {:.4f}\n",
        canvas.right() + 22.0 / canvas.width, edges[i].bottom, edges[i].top - edges[i].bottom);
    panel.axes += "set cblabel " + result::quoted(panels[i].label) + " offset character 1,0\n";
    panel.curves.push_back(
        {"'map.csv' skip 1",
         fmt::format("(0.5*({0}+{1})):(0.5*({2}+{3})):{4}:{5}:{6}:{7}:{8}", cells.value("x0"),
                     cells.value("x1"), cells.value("y0"), cells.value("y1"), cells.number("x0"),
                     cells.number("x1"), cells.number("y0"), cells.number("y1"),
                     cells.number(panels[i].column)),
         "with boxxyerror fillstyle solid 1.0 noborder fillcolor palette"});
    if (borders)
      panel.curves.push_back(
          {"'borders.csv' skip 1",
           fmt::format("{}:{}:({}-{}):({}-{})", sides.number("x0"), sides.number("y0"), sides.value("x1"),
                       sides.value("x0"), sides.value("y1"), sides.value("y0")),
           "with vectors nohead linewidth 1.6 linecolor '#d95f02'"});
    picture.panels.push_back(panel);
  }
  return picture;
}

}  // namespace signorini::sweep
