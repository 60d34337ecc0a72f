#include "study/speed/work_files.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/json.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "result/picture_files.hpp"
#include "result/plot_parts.hpp"
#include "result/summary_parts.hpp"
#include "result/table.hpp"
#include "study/compare/limits.hpp"
#include "study/optional_values.hpp"
#include "study/speed/pareto_front.hpp"

namespace signorini::speed {
namespace {

/// Quantities that study.md shows; study.csv and study.json have all quantities.
constexpr const char* shown[] = {"event_time", "displacement", "force_away", "energy"};

std::string unit_of(const WorkReport& report, const std::string& quantity) {
  for (const WorkRow& row : report.rows)
    if (const WorkError* error = row.error(quantity)) return error->unit;
  return "";
}

/// Names "response:NAME" of the compared outputs, in the order of the scene.
std::vector<std::string> response_names(const WorkReport& report) {
  std::vector<std::string> list;
  for (const WorkRow& row : report.rows)
    for (const WorkError& error : row.errors)
      if (error.quantity.starts_with("response:") &&
          std::find(list.begin(), list.end(), error.quantity) == list.end())
        list.push_back(error.quantity);
  return list;
}

std::vector<std::string> shown_quantities(const WorkReport& report) {
  std::vector<std::string> list;
  for (const char* name : shown)
    if (!unit_of(report, name).empty()) list.emplace_back(name);
  const std::vector<std::string> outputs = response_names(report);
  list.insert(list.end(), outputs.begin(), outputs.end());
  return list;
}

std::string heading(const std::string& quantity, const std::string& unit) {
  std::string name = quantity == "force_away" ? "force away" : quantity;
  if (!name.starts_with("response:")) std::replace(name.begin(), name.end(), '_', ' ');
  return name + " [" + unit + "]";
}

std::string sequence(const WorkRow& row) {
  if (!row.events_of_reference) return "";
  if (row.split.empty() && static_cast<long>(row.matched_events) == *row.events_of_reference)
    return fmt::format("all {}", row.matched_events);
  const long more = *row.events - static_cast<long>(row.matched_events);
  if (more > 0 && static_cast<long>(row.matched_events) == *row.events_of_reference)
    return fmt::format("{} and {} more", row.matched_events, more);
  return fmt::format("{} of {}", row.matched_events, *row.events_of_reference);
}

ErrorRange range_of(const WorkReport& report, const std::string& quantity) {
  const auto found = report.range.find(quantity);
  return found == report.range.end() ? ErrorRange() : found->second;
}

/// Text of study.csv.
std::string study_csv(const WorkReport& report) {
  using R = WorkRow;
  const auto error_of = [](const std::string& quantity, double WorkError::*value) {
    return [quantity, value](const R& r) {
      const WorkError* error = r.error(quantity);
      return error ? std::optional(error->*value) : std::nullopt;
    };
  };
  result::CsvTable<R> table = {
      {"run", [](const R& r) { return r.point.name(); }},
      {"engine", [](const R& r) { return r.point.engine; }},
      {"setting", [](const R& r) { return r.point.setting(); }},
      {"line", [](const R& r) { return r.point.line(); }},
      {"reference", [](const R& r) { return r.reference ? "true" : "false"; }},
      {"outcome", &R::outcome},
      {"reason", &R::reason},
      {"t", &R::t},
      {"events", &R::events},
      {"events_of_reference", &R::events_of_reference},
      {"alike", [](const R& r) { return r.t ? std::optional(r.matched_events) : std::nullopt; }},
      {"complete", [](const R& r) { return r.complete() ? "true" : "false"; }},
      {"t_split", &R::t_split},
      {"split", &R::split}};
  std::vector<std::string> names = compare::quantity_names();
  for (std::string& name : response_names(report)) names.push_back(std::move(name));
  for (const std::string& name : names) table.add(name, error_of(name, &WorkError::value));
  table.add("displacement_whole_run", error_of("displacement", &WorkError::whole));
  table.add("wall_time", &R::wall_time);
  table.add("wall_time_max", [](const R& r) {
    const auto greatest = std::max_element(r.wall_times.begin(), r.wall_times.end());
    return greatest == r.wall_times.end() ? std::nullopt : std::optional(*greatest);
  });
  table.add("repeats", [](const R& r) { return r.wall_times.size(); });
  table.add("steps", &R::steps);
  table.add("factorisations", &R::factorisations);
  table.add("solves", &R::solves);
  table.add("restarts", &R::restarts);
  table.add("energy_balance", &R::balance);
  return table.text(report.rows);
}

base::Json row_json(const WorkRow& row) {
  base::Json errors = base::Json::object();
  for (const WorkError& error : row.errors)
    errors[error.quantity] = {{"value", error.value},
                              {"unit", error.unit},
                              {"t", error.t},
                              {"where", error.where},
                              {"whole_run", error.whole}};
  base::Json json = {{"run", row.point.name()},
                     {"engine", row.point.engine},
                     {"setting", row.point.setting()},
                     {"directory", row.directory.string()},
                     {"outcome", row.outcome},
                     {"reason", row.reason},
                     {"t", study::json_of(row.t)},
                     {"reference", row.reference},
                     {"events", study::json_of(row.events)},
                     {"alike", row.matched_events},
                     {"complete", row.complete()}};
  json["split"] = row.t_split ? base::Json{{"t", *row.t_split}, {"how", row.split}} : base::Json();
  json["errors"] = std::move(errors);
  json["wall_times"] = row.wall_times;
  json["steps"] = study::json_of(row.steps);
  json["factorisations"] = study::json_of(row.factorisations);
  json["solves"] = study::json_of(row.solves);
  json["restarts"] = study::json_of(row.restarts);
  json["energy_balance"] = study::json_of(row.balance);
  return json;
}

/// Escapes characters that are markup in Markdown.
std::string plain_markdown(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("|*_<`\\[]").find(c) != std::string_view::npos) result += '\\';
    result += c == '\n' || c == '\r' ? ' ' : c;
  }
  return result;
}

std::string markdown_table(const WorkTable& table) {
  const auto line = [](const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& content : cells) text += " " + plain_markdown(content) + " |";
    return text + "\n";
  };
  std::string text = line(table.header) + "|";
  for (const bool right : table.right) text += right ? "---:|" : "---|";
  text += "\n";
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string study_markdown(const WorkReport& report, bool picture) {
  std::string text = "# " + plain_markdown(report.title.empty() ? report.scene : report.title) + "\n\n";
  text += fmt::format("`{}`: {}.\n{}.\n\n", report.scene, work_conditions(report), work_reference(report));
  for (const std::string& sentence : work_conclusions(report)) text += plain_markdown(sentence) + "\n";
  text += "\n" + markdown_table(work_table(report)) + "\n";
  if (picture) text += "![error and time](plots/work-precision.png)\n\n";
  for (const std::string& note : report.notes) text += "- " + plain_markdown(note) + "\n";
  for (const std::string& failure : work_failures(report)) text += "- " + plain_markdown(failure) + "\n";
  return text;
}

}  // namespace

WorkTable work_table(const WorkReport& report) {
  WorkTable table{{"engine", "setting", "outcome", "equal events"}, {false, false, false, true}, {}};
  const std::vector<std::string> columns = shown_quantities(report);
  for (const std::string& name : columns) table.header.push_back(heading(name, unit_of(report, name)));
  table.header.insert(table.header.end(), {"wall [s]", "steps", "us/step"});
  table.right.resize(table.header.size(), true);
  for (const WorkRow& row : report.rows) {
    std::vector<std::string> cells = {row.point.engine, row.point.setting(), row.outcome, sequence(row)};
    for (const std::string& name : columns) {
      const WorkError* error = row.error(name);
      cells.push_back(error ? fmt::format("{:.1e}", error->value) : "");
    }
    const auto wall = row.wall_time();
    cells.push_back(wall ? fmt::format("{:.3g}", *wall) : "");
    cells.push_back(row.steps ? std::to_string(*row.steps) : "");
    cells.push_back(wall && row.steps.value_or(0) > 0
                        ? fmt::format("{:.2f}", 1e6 * *wall / static_cast<double>(*row.steps))
                        : "");
    table.rows.push_back(std::move(cells));
  }
  return table;
}

std::vector<std::string> work_conclusions(const WorkReport& report) {
  std::vector<std::string> list;
  for (const char* name : {"event_time", "displacement"})
    if (!unit_of(report, name).empty())
      list.push_back(pareto_sentence(report.rows, name, range_of(report, name)));
  return list;
}

std::vector<std::string> work_failures(const WorkReport& report) {
  std::vector<std::string> list;
  for (const WorkRow& row : report.rows) {
    const std::string name = row.point.name();
    if (row.outcome == "refused") {
      const std::string sentence = fmt::format("{}: refused: {}", row.point.line(), row.reason);
      if (std::find(list.begin(), list.end(), sentence) == list.end()) list.push_back(sentence);
    } else if (row.outcome != "done") {
      list.push_back(
          fmt::format("{}: {} at t = {:.9g}: {}", name, row.outcome, row.t.value_or(0.0), row.reason));
    }
    if (!row.t_split) continue;
    list.push_back(fmt::format("{}: events differ from t = {:.9g} on: {}", name, *row.t_split, row.split));
    if (const WorkError* error = row.error("displacement"))
      list.back() += fmt::format("; displacement over the whole run: {:.1e}", error->whole);
  }
  return list;
}

std::string work_conditions(const WorkReport& report) {
  return fmt::format("{}, {}; {}, {}; Signorini {}, SUNDIALS {}, {}; wall time: least of {} without output",
                     base::count_text(report.unknowns, "dof"), base::count_text(report.contacts, "contact"),
                     report.machine.processor, base::count_text(report.machine.cores, "core"), version,
                     sundials_version, report.machine.compiler, base::count_text(report.repeats, "repeat"));
}

std::string work_reference(const WorkReport& report) {
  if (report.reference.empty()) return "no reference";
  std::string text = "errors against " + report.reference;
  if (report.compared_until < report.t_end)
    text += fmt::format(" up to t = {:.9g} of {:.9g}", report.compared_until, report.t_end);
  return text;
}

std::string work_json(const WorkReport& report) {
  base::Json json = {
      {"scene", report.scene},
      {"title", report.title},
      {"units", result::units_json(report.units)},
      {"t_end", report.t_end},
      {"degrees_of_freedom", report.unknowns},
      {"contacts", report.contacts},
      {"machine", {{"processor", report.machine.processor}, {"cores", report.machine.cores}}},
      {"versions",
       {{"signorini", version}, {"sundials", sundials_version}, {"compiler", report.machine.compiler}}},
      {"reference", report.reference},
      {"compared_until", report.compared_until},
      {"interrupted", report.interrupted},
      {"notes", report.notes}};
  json["known_to"] = base::Json::object();
  for (const auto& [name, range] : report.range) json["known_to"][name] = range.floor;
  json["rows"] = base::Json::array();
  for (const WorkRow& row : report.rows) json["rows"].push_back(row_json(row));
  json["frontier"] = base::Json::object();
  for (const std::string& name : shown_quantities(report)) {
    base::Json names = base::Json::array();
    for (const std::size_t i : pareto_front(report.rows, name, range_of(report, name)))
      names.push_back(report.rows[i].point.name());
    json["frontier"][name] = std::move(names);
  }
  json["conclusions"] = work_conclusions(report);
  return base::json_text(json);
}

void write_work(const std::filesystem::path& directory, const WorkReport& report) {
  result::write_file(directory / "study.csv", study_csv(report));
  result::write_file(directory / "study.json", work_json(report));
  result::write_file(
      directory / "study.md",
      study_markdown(report, std::filesystem::exists(directory / "plots" / "work-precision.png")));
}

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 8> colours = {"#1f77b4", "#d95f02", "#1a1a1a", "#1b9e77",
                                                "#7b3294", "#e7298a", "#a6761d", "#666666"};
constexpr std::array<const char*, 4> drawn = {"event_time", "displacement", "force_away", "energy"};
// gnuplot point types: type n is a filled symbol, and type n - 1 the same symbol, hollow.
constexpr std::array<int, 6> symbols = {7, 5, 9, 11, 13, 15};
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
const result::CsvTable<const WorkRow*>& line_table() {
  using R = const WorkRow*;
  static const result::CsvTable<R> table = [] {
    result::CsvTable<R> t = {{"setting", [](R row) { return row->point.setting(); }},
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
  double floor = 0.0;  ///< value at which an error of zero is drawn
};

/// Axis of a quantity's errors; nullopt if no run has a positive error of this quantity.
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

result::Panel panel_of(std::size_t quantity, const Axis& axis, const std::vector<Line>& lines) {
  const result::CsvTable<const WorkRow*>& table = line_table();
  result::Panel panel{"wall time [s]", {}};
  panel.axes =
      "set format y '%.0e'\nset format x '%.0e'\nset xlabel " + result::quoted(axis.label) +
      "\nset yrange [*:*]\nset xrange [*:*]\nset offsets graph 0.02,graph 0.02,graph 0.06,graph 0.06\n";
  panel.own_axis = true;
  const std::string x = fmt::format("strlen(strcol({0})) ? (${0} > 0 ? ${0} : {1}) : NaN",
                                    table.number(drawn[quantity]), base::format_number(axis.floor));
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
  return (result::is_picture(file) && stem == "work-precision") ||
         (file.extension() == ".csv" && stem.starts_with("line-") && stem.size() > 5 &&
          stem.find_first_not_of("0123456789", 5) == std::string::npos);
}

}  // namespace

std::vector<fs::path> write_work_plots(const fs::path& directory, const WorkReport& report) {
  const std::vector<Line> lines = lines_of(report);
  result::PictureFiles files(is_picture_of_work);
  result::PlottedRun run =
      result::empty_plotted_run(report.title.empty() ? report.scene : report.title, report.units);
  std::vector<std::string> labels;
  for (const Line& line : lines) {
    labels.push_back(line.label);
    files.add_table(fmt::format("line-{}", labels.size()), line_table().text(line.rows));
  }
  run.legend = result::legend_width(labels);
  result::Picture picture{"work-precision",
                          "Time of a run over its error, reference " + report.reference +
                              "; hollow: events differ, or the run ended early",
                          {},
                          false};
  picture.space = 80.0;
  picture.setup = "set logscale xy\n";
  for (std::size_t i = 0; i < drawn.size(); ++i)
    if (const auto axis = axis_of(lines, drawn[i])) picture.panels.push_back(panel_of(i, *axis, lines));
  picture.canvas =
      result::canvas_of(run.look, 90.0 + panel_height * static_cast<double>(picture.panels.size()), false);
  files.add(run, picture);
  return files.write(directory);
}

void remove_work_plots(const fs::path& directory) {
  result::clear_plot_folder(directory / "plots", is_picture_of_work);
}

}  // namespace signorini::speed
