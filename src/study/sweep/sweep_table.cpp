#include "study/sweep/sweep_table.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "base/json.hpp"
#include "result/summary_parts.hpp"
#include "result/table.hpp"
#include "signorini/event.hpp"
#include "study/optional_values.hpp"
#include "study/sweep/sweep_plots.hpp"

namespace signorini::sweep {
namespace {

/// Columns of sweep.csv; figures of a row without a run are empty.
result::CsvTable<SweepRow> sweep_table(const SweepSpec& spec, const std::vector<std::string>& contacts) {
  using R = SweepRow;
  const auto if_ran = [](auto figure) {
    return [figure](const R& row) {
      return row.ran() ? std::optional(static_cast<double>(std::invoke(figure, row))) : std::nullopt;
    };
  };
  result::CsvTable<R> table = {{"row", [](const R& row) { return row.index + 1; }}};
  for (std::size_t i = 0; i < spec.vary.size(); ++i)
    table.add(spec.vary[i].path, [i](const R& row) { return std::string_view(row.values[i]); });
  table.add("outcome", &R::outcome);
  table.add("t", if_ran(&R::t));
  table.add("reason", &R::reason);
  table.add("events", if_ran(&R::changes));
  for (const EventTypeName& type : all_event_types)
    table.add(type.name, if_ran([&type](const R& row) {
                const auto found = row.events.find(type.name);
                return found == row.events.end() ? 0L : found->second;
              }));
  for (std::size_t i = 0; i < spec.responses.size(); ++i)
    table.add(spec.responses[i], [i](const R& row) { return row.response(i); });
  for (const std::string& name : contacts)
    for (const SweepFigure& figure : sweep_figures)
      table.add(name + "." + figure.name, [name, &figure](const R& row) {
        const SweepRow::Contact* contact = contact_of(row, name);
        return contact ? std::optional(contact->*figure.value) : std::nullopt;
      });
  table.add("wall_time", if_ran(&R::wall_time));
  table.add("steps", if_ran(&R::steps));
  table.add("energy_balance", if_ran(&R::balance));
  table.add("warnings", if_ran(&R::warnings));
  return table;
}

}  // namespace

std::vector<std::string> contact_names(const SweepRows& rows) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const auto& [index, row] : rows)
    for (const auto& contact : row.contacts)
      if (known.insert(contact.name).second) names.push_back(contact.name);
  return names;
}

const SweepRow::Contact* contact_of(const SweepRow& row, const std::string& name) {
  for (const auto& contact : row.contacts)
    if (contact.name == name) return &contact;
  return nullptr;
}

std::string sweep_csv(const SweepSpec& spec, const SweepRows& rows) {
  const result::CsvTable<SweepRow> table = sweep_table(spec, contact_names(rows));
  result::CsvBlock block;
  table.put_header(block);
  for (const auto& [index, row] : rows) table.put_row(block, row);
  return block.str();
}

std::string sweep_json(const SweepSpec& spec, const SweepRows& rows) {
  base::Json json = {
      {"title", spec.title},       {"scene", spec.scene},        {"units", result::units_json(spec.units)},
      {"settings", spec.settings}, {"share", spec.share.text()}, {"rows_in_all", points(spec.vary).size()}};
  json["vary"] = base::Json::array();
  for (const ParameterRange& vary : spec.vary) {
    json["vary"].push_back({{"path", vary.path}});
    if (vary.sampled)  // the values are in the rows
      json["vary"].back()["distribution"] = vary.text;
    else
      json["vary"].back()["values"] = vary.values;
  }
  if (!spec.sampling.empty()) json["sampling"] = spec.sampling;
  json["responses"] = base::Json::array();
  for (std::size_t i = 0; i < spec.responses.size(); ++i)
    json["responses"].push_back({{"name", spec.responses[i]}, {"unit", spec.response_units[i]}});
  json["rows"] = base::Json::array();
  for (const auto& [index, row] : rows) json["rows"].push_back(base::parse_json(row_json(row)));
  return base::json_text(json);
}

namespace {

constexpr std::array<const char*, 6> point_colours = {"#1f77b4", "#d95f02", "#1b9e77",
                                                      "#7b3294", "#e7298a", "#666666"};
constexpr std::size_t most_values = 6;

struct RowPoint {
  const SweepRow* row;
  const StroboscopicPoint* point;
};

/// True if the row belongs to the second half of the last range, which has the opposite order (CarrySpec).
bool is_backward_row(const SweepSpec& spec, const SweepRow& row) {
  if (!spec.carry.back) return false;
  const std::size_t count = spec.vary.back().values.size();
  return row.index % count >= count / 2;
}

std::vector<RowPoint> points_of(const std::vector<const SweepRow*>& rows) {
  std::vector<RowPoint> list;
  for (const SweepRow* row : rows)
    for (const StroboscopicPoint& point : row->points) list.push_back({row, &point});
  return list;
}

/// Indices of the drawn columns: outputs, or columns of history.csv if there are no outputs.
std::vector<std::size_t> drawn(const std::vector<StroboscopicColumn>& columns) {
  std::vector<std::size_t> list;
  const bool outputs = std::any_of(columns.begin(), columns.end(), [](const auto& c) { return c.output; });
  for (std::size_t i = 0; i < columns.size() && list.size() < most_values; ++i)
    if (columns[i].output == outputs) list.push_back(i);
  return list;
}

void add_values(const SweepSpec& spec, result::CsvTable<RowPoint>& table) {
  for (std::size_t i = 0; i < spec.strobe.columns.size(); ++i)
    table.add(spec.strobe.columns[i].name, [i](const RowPoint& p) { return p.point->values[i]; });
}

result::CsvTable<RowPoint> point_table(const SweepSpec& spec, const SweepAxis& axis) {
  result::CsvTable<RowPoint> table = {{"x", [axis](const RowPoint& p) { return axis.x(*p.row); }}};
  add_values(spec, table);
  return table;
}

}  // namespace

std::string strobe_csv(const SweepSpec& spec, const SweepRows& rows) {
  result::CsvTable<RowPoint> table = {{"row", [](const RowPoint& p) { return p.row->index + 1; }}};
  for (std::size_t i = 0; i < spec.vary.size(); ++i)
    table.add(spec.vary[i].path, [i](const RowPoint& p) { return std::string_view(p.row->values[i]); });
  table.add("way", [&spec](const RowPoint& p) {
    return std::string_view(is_backward_row(spec, *p.row) ? "back" : "there");
  });
  table.add("t", [](const RowPoint& p) { return p.point->t; });
  add_values(spec, table);
  result::CsvBlock block;
  table.put_header(block);
  for (const auto& [index, row] : rows)
    for (const StroboscopicPoint& point : row.points) table.put_row(block, {&row, &point});
  return block.str();
}

void add_strobe_picture(const SweepSpec& spec, const SweepRows& rows, const result::PlottedRun& run,
                        result::PictureFiles& files) {
  const SweepAxis axis = axis_of(spec, true);
  const result::CsvTable<RowPoint> table = point_table(spec, axis);
  const std::vector<std::size_t> shown = drawn(spec.strobe.columns);
  result::Picture picture{
      "strobe",
      "States " + (spec.strobe.period > 0.0 ? "every " : std::string("after every ")) + spec.strobe.text +
          (spec.strobe.period > 0.0 ? " " + spec.units.time : "") + other_keys(spec, axis),
      result::canvas_of(run.look, 148.0 + 320.0 * static_cast<double>(shown.size()), false), false};
  picture.space = 26.0;
  picture.setup = "set offsets 0,0,graph 0.05,graph 0.05\n" + x_range(axis);
  std::vector<result::Curve> curves;  // each panel adds its column
  for (const SweepCurve& curve : swept_curves(spec, rows, axis))
    for (const bool back : {false, true}) {
      if (curves.size() == point_colours.size()) break;
      std::vector<const SweepRow*> part;
      std::copy_if(curve.rows.begin(), curve.rows.end(), std::back_inserter(part),
                   [&](const SweepRow* row) { return is_backward_row(spec, *row) == back; });
      const std::vector<RowPoint> points = points_of(part);
      if (points.empty()) continue;
      const std::string name = fmt::format("strobe-{}", curves.size() + 1);
      files.add_table(name, table.text(points));
      std::string title = curve.name;
      if (spec.carry.back) title += (title.empty() ? "" : ", ") + std::string(back ? "back" : "there");
      curves.push_back({"'" + name + ".csv' skip 1", "",
                        fmt::format("with points pointtype 7 pointsize {} linecolor '{}'", back ? 0.3 : 0.45,
                                    point_colours[curves.size()]),
                        title});
    }
  if (curves.empty()) return;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const StroboscopicColumn& column = spec.strobe.columns[shown[i]];
    result::Panel panel{column.name + (column.unit.empty() ? "" : " [" + column.unit + "]"), curves,
                        "set yrange [*:*]\n"};
    for (result::Curve& curve : panel.curves)
      curve.columns = fmt::format("{}:{}", table.number("x"), table.number(column.name));
    if (i + 1 == shown.size())
      panel.axes += "set xlabel " + result::quoted(study::key_with_unit(axis.vary->path, spec.units)) + "\n";
    picture.panels.push_back(panel);
  }
  files.add(run, picture);
}

}  // namespace signorini::sweep
