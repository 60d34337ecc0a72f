#include "study/sweep/sweep_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/number.hpp"
#include "result/csv.hpp"
#include "result/plot_parts.hpp"

namespace signorini {
namespace {

constexpr std::size_t fewest_values = 3;

std::vector<double> values_of(const Vary& vary) {
  std::vector<double> values;
  for (const std::string& text : vary.values) values.push_back(*parse_number(text));
  std::sort(values.begin(), values.end());
  return values;
}

/// From halfway to the value before to halfway to the one after; as wide at the ends.
std::pair<double, double> cell(const std::vector<double>& values, double at) {
  const auto here = std::lower_bound(values.begin(), values.end(), at);
  const bool first = here == values.begin(), last = here + 1 == values.end();
  const double before = first ? at - (*(here + 1) - at) : *(here - 1);
  const double after = last ? at + (at - *(here - 1)) : *(here + 1);
  return {0.5 * (before + at), 0.5 * (at + after)};
}

std::string range_of(const std::vector<double>& values) {
  return fmt::format("[{}:{}]", shortest(cell(values, values.front()).first),
                     shortest(cell(values, values.back()).second));
}

}  // namespace

std::optional<MapAxes> map_axes(const SweepSpec& spec) {
  std::vector<std::size_t> several;
  for (std::size_t i = 0; i < spec.vary.size(); ++i) {
    const std::vector<std::string>& values = spec.vary[i].values;
    if (values.size() < 2) continue;
    if (spec.vary[i].sampled || spec.vary[i].group != 0) return std::nullopt;
    const bool numbers = std::all_of(values.begin(), values.end(),
                                     [](const std::string& text) { return parse_number(text).has_value(); });
    if (!numbers || values.size() < fewest_values) return std::nullopt;
    const std::vector<double> sorted = values_of(spec.vary[i]);
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return std::nullopt;
    several.push_back(i);
  }
  if (several.size() != 2) return std::nullopt;
  return MapAxes{several[0], several[1]};
}

std::string map_table(const SweepSpec& spec, const MapAxes& axes, const SweepRows& rows) {
  const std::vector<double> x = values_of(spec.vary[axes.x]), y = values_of(spec.vary[axes.y]);
  CsvBlock block;
  for (const char* name :
       {"x0", "x1", "y0", "y1", "events", "peak_t", "peak_n", "peak_N", "peak_T", "friction_work"})
    block.text(name);
  for (const std::string& response : spec.responses) block.text(response);
  block.end_row();
  for (const auto& [index, row] : rows) {
    if (!row.ran()) continue;
    const auto [x0, x1] = cell(x, *parse_number(row.values[axes.x]));
    const auto [y0, y1] = cell(y, *parse_number(row.values[axes.y]));
    SweepRow::Contact greatest;
    for (const SweepRow::Contact& c : row.contacts) {
      greatest.tangential = std::max(greatest.tangential, c.tangential);
      greatest.normal = std::max(greatest.normal, c.normal);
      greatest.N = std::max(greatest.N, c.N);
      greatest.T = std::max(greatest.T, c.T);
      greatest.friction = std::max(greatest.friction, c.friction);
    }
    block.number(x0).number(x1).number(y0).number(y1).number(static_cast<double>(row.changes()));
    block.number(greatest.tangential).number(greatest.normal).number(greatest.N).number(greatest.T);
    block.number(greatest.friction);
    for (std::size_t i = 0; i < spec.responses.size(); ++i) {
      const bool known = i < row.responses.size() && std::isfinite(row.responses[i]);
      block.number(known ? std::optional<double>(row.responses[i]) : std::nullopt);
    }
    block.end_row();
  }
  return block.str();
}

std::string border_table(const SweepSpec& spec, const MapAxes& axes, const SweepRows& rows) {
  const std::vector<double> x = values_of(spec.vary[axes.x]), y = values_of(spec.vary[axes.y]);
  std::map<std::pair<double, double>, const std::string*> sequences;
  for (const auto& [index, row] : rows)
    if (row.ran())
      sequences[{*parse_number(row.values[axes.x]), *parse_number(row.values[axes.y])}] = &row.sequence;
  CsvBlock block;
  for (const char* name : {"x0", "y0", "x1", "y1"}) block.text(name);
  block.end_row();
  const auto differ = [&](double xa, double ya, double xb, double yb) {
    const auto a = sequences.find({xa, ya}), b = sequences.find({xb, yb});
    return a != sequences.end() && b != sequences.end() && *a->second != *b->second;
  };
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < y.size(); ++j) {
      const auto [x0, x1] = cell(x, x[i]);
      const auto [y0, y1] = cell(y, y[j]);
      if (i + 1 < x.size() && differ(x[i], y[j], x[i + 1], y[j]))
        block.number(x1).number(y0).number(x1).number(y1).end_row();
      if (j + 1 < y.size() && differ(x[i], y[j], x[i], y[j + 1]))
        block.number(x0).number(y1).number(x1).number(y1).end_row();
    }
  return block.str();
}

std::string map_script(const SweepSpec& spec, const MapAxes& axes, const std::string& name,
                       const std::string& subtitle, const std::vector<MapPanel>& panels, bool borders) {
  PlottedRun run;
  run.facts.title = spec.title;
  run.facts.outcome = "done";
  run.facts.units = spec.units;
  const int count = static_cast<int>(panels.size()), height = 140 + 380 * count;
  const double line = 1.0 / height, bottom = 62.0 * line, top = 1.0 - 62.0 * line, space = 30.0 * line;
  const double each = (top - bottom - space * (count - 1)) / count;
  std::string s = begin_script(run, {name, subtitle, height, false});
  s += "set palette defined (0 '#f7fbff', 0.35 '#6baed6', 0.7 '#08519c', 1 '#08203f')\nset grid front\n";
  for (int i = 0; i < count; ++i) {
    const MapPanel& shown = panels[static_cast<std::size_t>(i)];
    const double upper = top - i * (each + space);
    s += panel(run, upper - each, upper, spec.vary[axes.y].path, i + 1 == count);
    if (i + 1 == count) s += "set xlabel " + quoted(spec.vary[axes.x].path) + "\n";
    s += "set xrange " + range_of(values_of(spec.vary[axes.x])) + "\n";
    s += "set yrange " + range_of(values_of(spec.vary[axes.y])) + "\n";
    s += fmt::format(
        "set colorbox user origin screen {:.4f}, screen {:.4f} size screen 0.018, screen {:.4f}\n",
        panel_right + 0.02, upper - each, each);
    s += "set cblabel " + quoted(shown.label) + "\n";
    std::vector<std::string> elements{
        fmt::format("'map.csv' skip 1 using (0.5*($1+$2)):(0.5*($3+$4)):1:2:3:4:{} with boxxyerror "
                    "fillstyle solid 1.0 noborder fillcolor palette notitle",
                    shown.column)};
    if (borders)
      elements.emplace_back(
          "'borders.csv' skip 1 using 1:2:($3-$1):($4-$2) with vectors nohead linewidth 1.6 linecolor "
          "'#d95f02' notitle");
    s += plot_command(elements);
  }
  return s + end_script();
}

}  // namespace signorini
