#include "study/speed/work_plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/number.hpp"
#include "result/plot_folder.hpp"
#include "result/plot_parts.hpp"
#include "result/table.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 8> colours = {"#1f77b4", "#d95f02", "#1a1a1a", "#1b9e77",
                                                "#7b3294", "#e7298a", "#a6761d", "#666666"};
constexpr std::array<const char*, 4> drawn = {"event_time", "displacement", "force_away", "energy"};
constexpr std::array<int, 6> symbols = {7, 5, 9, 11, 13, 15};  // filled; the hollow one is the number before
constexpr int panel_height = 330;

/// Runs of one engine, the accurate ones last.
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

/// line-N.csv.
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
  double floor = 0.0;  ///< where an error of exactly zero is drawn
};

/// Nothing where no run has such an error above zero.
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

std::string script(const WorkReport& report, const std::vector<Line>& lines,
                   const std::vector<std::pair<std::size_t, Axis>>& axes) {
  PlottedRun run;
  run.facts.title = report.title.empty() ? report.scene : report.title;
  run.facts.outcome = "done";
  run.facts.units = report.units;
  std::vector<std::string> labels;
  for (const Line& line : lines) labels.push_back(line.label);
  run.legend = room_for(labels);
  const int count = static_cast<int>(axes.size());
  const Canvas canvas = canvas_of(run.look, 90 + panel_height * count, false);
  std::string s = begin_script(run, {"work-precision",
                                     "Time of a run over its error, reference " + report.reference +
                                         "; hollow: not all events, or not to the end",
                                     canvas, false});
  s += "set logscale xy\n";
  for (int i = 0; i < count; ++i) {
    const auto& [quantity, axis] = axes[static_cast<std::size_t>(i)];
    s += panel(run, canvas, stacked(static_cast<std::size_t>(i), axes.size(), canvas, 80.0), "wall time [s]",
               true);
    s += "set format y '%.0e'\nset format x '%.0e'\nset xlabel " + quoted(axis.label) + "\n";
    s += "set yrange [*:*]\nset xrange [*:*]\nset offsets graph 0.02,graph 0.02,graph 0.06,graph 0.06\n";
    std::vector<std::string> elements;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const CsvTable<const WorkRow*>& table = line_table();
      const std::string data = fmt::format("'line-{}.csv' skip 1 using (", k + 1);
      const std::string x = fmt::format("strlen(strcol({0})) ? (${0} > 0 ? ${0} : {1}) : NaN",
                                        table.number(drawn[quantity]), shortest(axis.floor));
      const std::string complete = table.value("complete");
      const std::size_t time = table.number("wall_time");
      const std::string colour = colours[k % colours.size()];
      elements.push_back(
          data + fmt::format("{} == 1 ? ({}) : NaN):{} with linespoints linewidth 2 pointtype {} "
                             "pointsize 0.9 linecolor '{}' title {}",
                             complete, x, time, symbols[k % symbols.size()], colour, quoted(lines[k].label)));
      elements.push_back(data + fmt::format("{} == 0 ? ({}) : NaN):{} with points pointtype {} pointsize 1.4 "
                                            "linewidth 1.1 linecolor '{}' notitle",
                                            complete, x, time, symbols[k % symbols.size()] - 1, colour));
    }
    s += plot_command(elements);
  }
  return s + end_script();
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
  std::vector<std::pair<std::size_t, Axis>> axes;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    if (const auto axis = axis_of(lines, drawn[i])) axes.emplace_back(i, *axis);
  const fs::path folder = directory / "plots";
  begin_plot_folder(folder, is_picture_of_work);
  if (axes.empty()) return {};
  for (std::size_t k = 0; k < lines.size(); ++k)
    write_file(folder / fmt::format("line-{}.csv", k + 1), line_table().text(lines[k].rows));
  write_file(folder / "work-precision.gp", script(report, lines, axes));
  return {folder / "work-precision.gp"};
}

void remove_work_plots(const fs::path& directory) {
  clear_plot_folder(directory / "plots", is_picture_of_work);
}

}  // namespace signorini
