#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "base/number.hpp"
#include "result/csv.hpp"
#include "result/csv_read.hpp"
#include "result/plot_parts.hpp"

namespace signorini {

namespace {

constexpr double most_marks = 3000;  // of one contact and type, over the picture's width

bool occurs(const PlottedRun& run, EventType type) {
  return std::find(run.event_types.begin(), run.event_types.end(), to_string(type)) != run.event_types.end();
}

/// Lanes of a row, from above.
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

std::vector<Mark> marks_of(const std::filesystem::path& directory, const PlottedRun& run) {
  std::map<std::string, int> rows;
  for (std::size_t k = 0; k < run.facts.contacts.size(); ++k)
    rows[run.facts.contacts[k].name] = static_cast<int>(k);
  CsvReader events(directory / "events.csv");
  const std::size_t who = events.column("contact"), type = events.column("event");
  const std::size_t n = events.column("N"), friction = events.column("T");
  const double least = (run.to - run.from) / most_marks;
  std::map<std::pair<std::string, std::string>, double> last;
  std::vector<Mark> marks;
  while (events.next()) {
    const double t = events.t();
    if (t < run.from || t > run.to) continue;
    const auto [place, first] = last.try_emplace({events.cell(who), events.cell(type)}, t);
    if (!first && t - place->second < least) continue;
    place->second = t;
    // A load's own time event belongs to no contact: row -1.
    const bool any = events.cell(who).empty();
    marks.push_back({any ? -1 : rows.at(events.cell(who)), t, events.cell(type), any ? 0.0 : events.number(n),
                     any ? 0.0 : events.number(friction)});
  }
  return marks;
}

std::string raster_script(const PlottedRun& run) {
  const std::vector<EventLook> lanes = lanes_of(run);
  if (lanes.empty()) return "";
  const std::size_t count = run.facts.contacts.size();
  const double row = row_height(count <= 2    ? 120.0
                                : count <= 6  ? 70.0
                                : count <= 40 ? 38.0
                                              : 12.0,
                                count, run.look);
  const Canvas canvas =
      canvas_of(run.look, room_above + room_below + 16.0 + row * static_cast<double>(count), true, true);
  std::string s =
      begin_script(run, {"raster" + run.suffix, say(run, "Events of the contacts, a mark each"), canvas});
  s += panel(run, canvas, stacked(0, 1, canvas), "", true);
  s += fmt::format("set yrange [{}.5:-0.5]\nset grid noxtics noytics\n", count - 1) +
       row_ticks(run.facts.contacts, row);
  for (std::size_t k = 1; k < count; ++k) {
    s += fmt::format(
        "set arrow from graph 0, first {0}.5 to graph 1, first {0}.5 nohead linecolor '#bbbbbb'\n", k - 1);
  }
  const std::string data = "'marks" + run.suffix + ".csv' skip 1 using ";
  const std::string row_of = mark_table().value("row"), at = mark_table().value("t");
  std::vector<std::string> elements;
  elements.push_back(
      data + fmt::format("({} < 0 ? {} : NaN):(-0.5):(0):({}) with vectors nohead linecolor '#aaaaaa' "
                         "dashtype 3 title {}",
                         row_of, at, count, quoted(say(run, "load changes"))));
  if (!occurs(run, EventType::time)) elements.clear();
  const double lane = 0.84 / static_cast<double>(lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const std::string look = fmt::format("linewidth 1.6 linecolor '{}'", lanes[i].colour);
    elements.push_back(data + "(" + mark_table().word("event") + " eq " + quoted(to_string(lanes[i].type)) +
                       fmt::format(" ? {} : NaN):({} + {:.4f}):(0):({:.4f}) with vectors nohead {} notitle",
                                   at, row_of, -0.42 + lane * static_cast<double>(i), 0.86 * lane, look));
  }
  for (const EventLook& look : lanes)
    elements.push_back(fmt::format("keyentry with lines linewidth 4 linecolor '{}' title {}", look.colour,
                                   quoted(say(run, to_string(look.type)))));
  s += plot_command(elements) + "unset arrow\n";
  return s + end_script();
}

}  // namespace signorini
