#include "study/speed/work_plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/number.hpp"
#include "result/picture_files.hpp"
#include "result/plot_folder.hpp"
#include "result/plot_parts.hpp"
#include "result/table.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 8> colours = {"#1f77b4", "#d95f02", "#1a1a1a", "#1b9e77",
                                                "#7b3294", "#e7298a", "#a6761d", "#666666"};
constexpr std::array<const char*, 4> drawn = {"event_time", "displacement", "force_away", "energy"};
constexpr std::array<int, 6> symbols = {7, 5, 9, 11, 13, 15};  // filled; the number before each is the hollow
                                                               // one
constexpr double panel_height = 330.0;

/// Runs of one engine, sorted by increasing accuracy.
struct Line {
  std::string name, label;
  std::vector<const WorkRow*> rows;
};

std::vector<Line> lines_of(const WorkReport& report) {
  std::vector<Line> lines;
  for (const WorkRow& row : report.rows) {
    if (!row.wall_time() || row.errors.empty()) continue;
    const std::string name = row.point.line();
    auto line = std::find_if(lines.begin(), lines.end(), [&](const Line& l) { return l.name == name; });
    if (line == lines.end()) line = lines.insert(lines.end(), Line{name, row.point.label(), {}});
    line->rows.push_back(&row);
  }
  return lines;
}

/// Columns of line-N.csv.
const CsvTable<const WorkRow*>& line_table() {
  using R = const WorkRow*;
  static const CsvTable<R> table = [] {
    CsvTable<R> t = {{"setting", [](R row) { return row->point.setting(); }},
                     {"complete", [](R row) { return row->complete() ? 1.0 : 0.0; }},
                     {"wall_time", [](R row) { return row->wall_time(); }}};
    for (const char* name : drawn)
      t.add(name, [name](R row) {
        const WorkError* error = row->error(name);
        const double value = error == nullptr ? NAN : row->complete() ? error->value : error->whole;
        return std::isfinite(value) ? std::optional(value) : std::nullopt;
      });
    return t;
  }();
  return table;
}

struct Axis {
  std::string label;
  double floor = 0.0;  ///< position of an error of exactly zero
};

/// nullopt if no run has a positive error of this quantity.
std::optional<Axis> axis_of(const std::vector<Line>& lines, const std::string& quantity) {
  double least = std::numeric_limits<double>::infinity();
  std::string unit;
  for (const Line& line : lines)
    for (const WorkRow* row : line.rows) {
      const WorkError* error = row->error(quantity);
      if (error == nullptr || !std::isfinite(error->value) || !(error->value > 0.0)) continue;
      unit = error->unit;
      least = std::min(least, error->value);
    }
  if (!std::isfinite(least)) return std::nullopt;
  std::string name = quantity == "force_away" ? "contact forces away from events" : quantity;
  std::replace(name.begin(), name.end(), '_', ' ');
  return Axis{"error of " + name + " [" + unit + "]", std::pow(10.0, std::floor(std::log10(least)))};
}

Panel panel_of(std::size_t quantity, const Axis& axis, const std::vector<Line>& lines) {
  const CsvTable<const WorkRow*>& table = line_table();
  Panel panel{"wall time [s]", {}};
  panel.axes =
      "set format y '%.0e'\nset format x '%.0e'\nset xlabel " + quoted(axis.label) +
      "\nset yrange [*:*]\nset xrange [*:*]\nset offsets graph 0.02,graph 0.02,graph 0.06,graph 0.06\n";
  panel.own_axis = true;
  const std::string x = fmt::format("strlen(strcol({0})) ? (${0} > 0 ? ${0} : {1}) : NaN",
                                    table.number(drawn[quantity]), shortest(axis.floor));
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string data = fmt::format("'line-{}.csv' skip 1", k + 1);
    const auto where = [&](int complete) {
      return fmt::format("({} == {} ? ({}) : NaN):{}", table.value("complete"), complete, x,
                         table.number("wall_time"));
    };
    const std::string colour = fmt::format("linecolor '{}'", colours[k % colours.size()]);
    const int symbol = symbols[k % symbols.size()];
    panel.curves.push_back(
        {data, where(1),
         fmt::format("with linespoints linewidth 2 pointtype {} pointsize 0.9 {}", symbol, colour),
         lines[k].label});
    panel.curves.push_back(
        {data, where(0),
         fmt::format("with points pointtype {} pointsize 1.4 linewidth 1.1 {}", symbol - 1, colour)});
  }
  return panel;
}

bool is_picture_of_work(const fs::path& file) {
  const std::string stem = file.stem().string();
  return (is_picture(file) && stem == "work-precision") ||
         (file.extension() == ".csv" && stem.starts_with("line-") && stem.size() > 5 &&
          stem.find_first_not_of("0123456789", 5) == std::string::npos);
}

}  // namespace

std::vector<fs::path> write_work_plots(const fs::path& directory, const WorkReport& report) {
  const std::vector<Line> lines = lines_of(report);
  PictureFiles files(is_picture_of_work);
  PlottedRun run = untold_run(report.title.empty() ? report.scene : report.title, report.units);
  std::vector<std::string> labels;
  for (const Line& line : lines) {
    labels.push_back(line.label);
    files.add_table(fmt::format("line-{}", labels.size()), line_table().text(line.rows));
  }
  run.legend = room_for(labels);
  Picture picture{"work-precision",
                  "Time of a run over its error, reference " + report.reference +
                      "; hollow: not all events, or not to the end",
                  {},
                  false};
  picture.space = 80.0;
  picture.setup = "set logscale xy\n";
  for (std::size_t i = 0; i < drawn.size(); ++i)
    if (const auto axis = axis_of(lines, drawn[i])) picture.panels.push_back(panel_of(i, *axis, lines));
  picture.canvas =
      canvas_of(run.look, 90.0 + panel_height * static_cast<double>(picture.panels.size()), false);
  files.add(run, picture);
  return files.write(directory);
}

void remove_work_plots(const fs::path& directory) {
  clear_plot_folder(directory / "plots", is_picture_of_work);
}

}  // namespace signorini
