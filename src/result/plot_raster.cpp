#include <fmt/core.h>

#include <algorithm>

#include "result/plot_parts.hpp"

namespace signorini {

namespace {

bool occurs(const PlottedRun& run, EventType type) {
  return std::find(run.event_types.begin(), run.event_types.end(), to_string(type)) != run.event_types.end();
}

/// Lanes of a row, from the top.
std::vector<EventLook> lanes_of(const PlottedRun& run) {
  std::vector<EventLook> lanes;
  for (const EventLook& look : event_looks)
    if (occurs(run, look.type)) lanes.push_back(look);
  return lanes;
}

}  // namespace

const CsvTable<Mark>& mark_table() {
  static const CsvTable<Mark> table = {
      {"row", &Mark::row}, {"t", &Mark::t}, {"event", &Mark::event}, {"N", &Mark::N}, {"T", &Mark::T}};
  return table;
}

Picture raster_picture(const PlottedRun& run) {
  const std::vector<EventLook> lanes = lanes_of(run);
  if (lanes.empty()) return {};
  const std::size_t count = run.facts.contacts.size();
  const double row = row_height(count <= 2    ? 120.0
                                : count <= 6  ? 70.0
                                : count <= 40 ? 38.0
                                              : 12.0,
                                count, run.look);
  Panel panel{"", {}};
  panel.axes = fmt::format("set yrange [{}.5:-0.5]\nset grid noxtics noytics\n", count - 1) +
               row_tics(run.facts.contacts, row);
  for (std::size_t k = 1; k < count; ++k)
    panel.axes += fmt::format(
        "set arrow from graph 0, first {0}.5 to graph 1, first {0}.5 nohead linecolor '#bbbbbb'\n", k - 1);
  const std::size_t at = mark_table().number("t");
  const auto add = [&](EventType type, const std::string& columns, const std::string& look,
                       const std::optional<std::string>& name) {
    const PlottedRun::Rows rows = marks_of(run, to_string(type));
    if (rows.count > 0)
      panel.curves.push_back({recorded("'marks" + run.suffix + ".csv'", rows), columns, look, name});
  };
  add(EventType::time, fmt::format("{}:(-0.5):(0):({})", at, count),
      "with vectors nohead linecolor '#aaaaaa' dashtype 3", say(run, "load changes"));
  const double lane = 0.84 / static_cast<double>(lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i)
    add(lanes[i].type,
        fmt::format("{}:({} + {:.4f}):(0):({:.4f})", at, mark_table().value("row"),
                    -0.42 + lane * static_cast<double>(i), 0.86 * lane),
        fmt::format("with vectors nohead linewidth 1.6 linecolor '{}'", lanes[i].colour), std::nullopt);
  if (panel.curves.empty()) panel.curves.push_back({"NaN", "", "with lines"});  // gnuplot needs a plot
  for (const EventLook& look : lanes)
    panel.curves.push_back({"keyentry", "", fmt::format("with lines linewidth 4 linecolor '{}'", look.colour),
                            say(run, to_string(look.type))});
  panel.after = "unset arrow\n";
  return {"raster" + run.suffix,
          say(run, "Events of the contacts, a mark each"),
          canvas_of(run.look, room_above + room_below + 16.0 + row * static_cast<double>(count), true, true),
          true,
          {panel}};
}

}  // namespace signorini
