#include "result/plotted_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/files.hpp"
#include "base/text.hpp"
#include "result/picture_style.hpp"
#include "scene/components.hpp"
#include "signorini/error.hpp"

namespace signorini::result {

namespace {

// Limit of the number of bands per contact. If there are more, bands shorter than 1/5000 of the run are merged, because a
// picture cannot show them.
constexpr std::size_t max_bands = 5000;
constexpr double max_marks = 3000;                // limit of the number of marks per contact and event type
constexpr const char* events_suffix = "-events";  // suffix for pictures from the first event to the last

std::vector<std::string> make_slugs(const std::vector<RunFacts::Contact>& contacts) {
  std::vector<std::string> slugs;
  std::set<std::string> taken;
  for (const auto& contact : contacts) {
    const std::string slug = base::file_name(contact.name, 80, "-_", '_');
    std::string unique = slug;
    const auto is_taken = [&] { return taken.contains(unique) || taken.contains(unique + events_suffix); };
    for (int n = 2; is_taken(); ++n) unique = slug + "-" + std::to_string(n);
    taken.insert({unique, unique + events_suffix});
    slugs.push_back(unique);
  }
  return slugs;
}

using ContactNumbers = std::map<std::string, std::size_t>;

ContactNumbers contact_numbers(const RunFacts& facts) {
  ContactNumbers numbers;
  for (std::size_t k = 0; k < facts.contacts.size(); ++k) numbers[facts.contacts[k].name] = k;
  return numbers;
}

std::size_t number_of(const ContactNumbers& numbers, const std::string& contact, const CsvReader& table) {
  const auto found = numbers.find(contact);
  if (found == numbers.end())
    table.refuse("has a contact that is not in summary.json: '" + contact.substr(0, 80) + "'");
  return found->second;
}

bool shows(const PlottedRun& run, double t) { return t >= run.from && t <= run.to; }

/// Extends `rows`, the rows of one name, by `row`; refuses the table if the row is not the next row after `rows`.
void count(PlottedRun::Rows& rows, std::size_t row, const CsvReader& table, const char* of) {
  if (rows.count == 0) rows.first = row;
  if (row != rows.first + rows.count)
    table.refuse(std::string("has rows of ") + of + " that are not in order");
  ++rows.count;
}

/// Reads columns and output times from history.csv; returns the number of output times in the window.
std::size_t read_times(const TableFolder& tables, const PlotWindow& window, PlottedRun& run) {
  std::size_t shown = 0;
  CsvReader history = tables.open("history.csv");
  run.columns = history.header();
  while (history.next()) {
    run.t_last = history.t();
    if (run.times++ == 0) run.t_first = run.t_last;
    shown += run.t_last >= window.from.value_or(run.t_last) && run.t_last <= window.to.value_or(run.t_last);
  }
  return shown;
}

/// Reads the states at the first output time, and the greatest compressions. Returns the number of rows of contacts.csv.
std::size_t read_states(const TableFolder& tables, const ContactNumbers& index, PlottedRun& run) {
  CsvReader contacts = tables.open("contacts.csv");
  const std::size_t name = contacts.column("contact"), state = contacts.column("state");
  const std::size_t force = contacts.column("N");
  std::size_t rows = 0;
  for (; contacts.next(); ++rows) {
    const std::size_t k = number_of(index, contacts.cell(name), contacts);
    if (rows < index.size()) run.bands[k].push_back({run.t_first, run.t_first, contacts.cell(state)});
    run.greatest_compression[k] = std::max(run.greatest_compression[k], -contacts.number(force));
  }
  return rows;
}

void read_motion(const TableFolder& tables, const ContactNumbers& numbers, PlottedRun& run) {
  run.motion.clear();
  if (!tables.has("motion.csv")) return;
  run.motion.resize(numbers.size());
  CsvReader motion = tables.open("motion.csv");
  const std::size_t name = motion.column("contact"), n = motion.column("N"), t = motion.column("T");
  for (std::size_t row = 0; motion.next(); ++row) {
    const std::size_t k = number_of(numbers, motion.cell(name), motion);
    count(run.motion[k], row, motion, "contacts");
    const double force = motion.number(n);
    run.greatest_compression[k] = std::max(run.greatest_compression[k], -force);
    run.greatest_force = std::max(run.greatest_force, std::hypot(force, motion.number(t)));
  }
}

/// Reads the events; the bands of states begin and end at exact event times.
void read_events(const TableFolder& tables, const ContactNumbers& index, PlottedRun& run) {
  CsvReader events = tables.open("events.csv");
  const std::size_t contact_column = events.column("contact"), to = events.column("to");
  const std::size_t normal = events.column("N"), type = events.column("event");
  const double shortest_band = (run.t_last - run.t_first) / static_cast<double>(max_bands);
  while (events.next()) {
    const double t = events.t();
    if (std::find(run.event_types.begin(), run.event_types.end(), events.cell(type)) == run.event_types.end())
      run.event_types.push_back(events.cell(type));
    if (events.cell(contact_column).empty()) continue;
    const std::size_t k = number_of(index, events.cell(contact_column), events);
    if (t <= run.t_first || t > run.t_last) continue;
    run.occurring.emplace(k, events.cell(type));
    run.greatest_compression[k] = std::max(run.greatest_compression[k], -events.number(normal));
    auto& bands = run.bands[k];
    if (bands.empty() || bands.back().state == events.cell(to)) continue;
    bands.back().to = t;
    if (bands.size() >= max_bands && t - bands.back().from < shortest_band) {
      bands.back().state = events.cell(to);
    } else {
      bands.push_back({t, t, events.cell(to)});
    }
  }
  for (auto& bands : run.bands)
    if (!bands.empty()) bands.back().to = run.t_last;
}

void read_curves(const TableFolder& tables, PlottedRun& run) {
  if (!tables.has("curves.csv")) return;
  CsvReader curves = tables.open("curves.csv");
  const std::size_t name = curves.column("curve"), value = curves.column("value");
  for (std::size_t row = 0; curves.next(); ++row) {
    count(run.curves[curves.cell(name)], row, curves, "curves");
    if (curves.number(value) != 0.0)
      run.energies.used.insert(curves.cell(name));  // also displacements, which no energy picture uses
  }
}

void read_energies(const TableFolder& tables, PlottedRun& run) {
  CsvReader energy = tables.open("energy.csv");
  for (; energy.next(); ++run.energies.times) {
    for (const EnergyColumn& column : energy_columns)
      if (energy.number(energy.column(column.name)) != 0.0) run.energies.used.insert(column.name);
    if (run.energies.times == 0) run.energies.start = energy.number(energy.column(balance_column));
  }
}

void read_contact_ranges(const TableFolder& tables, PlottedRun& run) {
  run.ranges.assign(run.facts.contacts.size(), {});
  if (run.ranges.empty()) return;
  const ContactNumbers numbers = contact_numbers(run.facts);
  CsvReader reader = tables.open(tables.has("motion.csv") ? "motion.csv" : "contacts.csv");
  const std::size_t name = reader.column("contact"), gap = reader.column("gap"), ut = reader.column("ut"),
                    slip = reader.column("slip"), n = reader.column("N"), t = reader.column("T");
  while (reader.next()) {
    if (!shows(run, reader.t())) continue;
    ContactRanges& ranges = run.ranges[number_of(numbers, reader.cell(name), reader)];
    if (!reader.cell(gap).empty()) ranges.gap.take(reader.number(gap));
    ranges.ut.take(reader.number(ut));
    ranges.slip.take(reader.number(slip));
    ranges.N.take(reader.number(n));
    ranges.T.take(reader.number(t));
  }
}

/// Reads the ranges of displacements from curves.csv, or from history.csv if the run has no curves.csv.
void read_displacement_ranges(const TableFolder& tables, PlottedRun& run) {
  run.moves.clear();
  const bool record = tables.has("curves.csv");
  CsvReader reader = tables.open(record ? "curves.csv" : "history.csv");
  const std::size_t name = record ? reader.column("curve") : 0, value = record ? reader.column("value") : 0;
  std::vector<std::pair<std::size_t, Range*>> columns;
  for (std::size_t i = 1; !record && i < reader.header().size(); ++i)
    if (scene::is_displacement(reader.header()[i])) columns.emplace_back(i, &run.moves[reader.header()[i]]);
  while (reader.next()) {
    if (record && !scene::is_displacement(reader.cell(name))) continue;
    if (!shows(run, reader.t())) continue;
    if (record) run.moves[reader.cell(name)].take(reader.number(value));
    for (const auto& [i, range] : columns) range->take(reader.number(i));
  }
}

void read_marks(const TableFolder& tables, PlottedRun& run) {
  run.marks.clear();
  const ContactNumbers rows = contact_numbers(run.facts);
  CsvReader events = tables.open("events.csv");
  const std::size_t contact_column = events.column("contact"), type = events.column("event");
  const std::size_t n = events.column("N"), friction = events.column("T");
  const double least = (run.to - run.from) / max_marks;
  std::map<std::pair<std::string, std::string>, double> last;
  while (events.next()) {
    const double t = events.t();
    if (!shows(run, t)) continue;
    const auto [place, first] = last.try_emplace({events.cell(contact_column), events.cell(type)}, t);
    if (!first && t - place->second < least) continue;
    place->second = t;
    // The time event of a load has no contact; its mark has the row -1.
    if (events.cell(contact_column).empty())
      run.marks.push_back({-1, t, events.cell(type), 0.0, 0.0});
    else
      run.marks.push_back({static_cast<int>(rows.at(events.cell(contact_column))), t, events.cell(type),
                           events.number(n), events.number(friction)});
  }
  std::stable_sort(run.marks.begin(), run.marks.end(), [](const Mark& a, const Mark& b) {
    return std::tie(a.event, a.row) < std::tie(b.event, b.row);
  });
}

/// Reads everything that depends on the time window.
void read_time_window(const TableFolder& tables, PlottedRun& run) {
  read_contact_ranges(tables, run);
  read_displacement_ranges(tables, run);
  if (!run.facts.contacts.empty()) read_marks(tables, run);
}

void read_headers(const TableFolder& tables, PlottedRun& run) {
  if (tables.has("loads.csv")) run.loads = tables.open("loads.csv").header();
  if (!tables.has("response.csv")) return;
  const CsvReader response = tables.open("response.csv");
  run.responses.push_back(response.column("t") + 1);
  for (const RunFacts::Response& column : run.facts.response)
    run.responses.push_back(response.column(column.name) + 1);
}

/// Refuses a time window without data, for which gnuplot would fail. Called before earlier files are removed.
void check_window(const PlotWindow& window, std::size_t shown, const PlottedRun& run) {
  const auto check = [&](const char* option, const std::optional<double>& t, bool shows) {
    if (!t || (std::isfinite(*t) && shows)) return;
    throw UsageError(fmt::format("{} {}: nothing to draw, because the run covers t = {} to {}", option,
                                 base::format_number(*t), base::format_number(run.t_first),
                                 base::format_number(run.t_last)));
  };
  check("--from", window.from, window.from < run.t_last);
  check("--to", window.to, window.to > run.t_first);
  if (shown == 0)
    throw UsageError(
        fmt::format("--from {} --to {}: nothing to draw, because no output time lies between these times",
                    base::format_number(window.from.value_or(run.t_first)),
                    base::format_number(window.to.value_or(run.t_last))));
}

}  // namespace

PlottedRun::Rows marks_of(const PlottedRun& run, const std::string& type, std::optional<int> row) {
  const auto meant = [&](const Mark& mark) {
    return mark.event == type && mark.row == row.value_or(mark.row);
  };
  const auto begin = std::find_if(run.marks.begin(), run.marks.end(), meant);
  const auto end = std::find_if_not(begin, run.marks.end(), meant);
  return {static_cast<std::size_t>(begin - run.marks.begin()), static_cast<std::size_t>(end - begin)};
}

PlottedRun empty_plotted_run(const std::string& title, const Units& units, const PictureStyle& look) {
  PlottedRun run;
  run.look = look;
  run.facts.title = title;
  run.facts.outcome = "done";
  run.facts.units = units;
  return run;
}

PlottedRun read_plotted_run(const TableFolder& tables, const RunFacts& facts, const PlotWindow& window) {
  PlottedRun run;
  run.facts = facts;
  const std::size_t shown = read_times(tables, window, run);
  if (run.times < 2) return run;
  check_window(window, shown, run);
  run.slugs = make_slugs(run.facts.contacts);
  const ContactNumbers index = contact_numbers(run.facts);
  run.bands.resize(index.size());
  run.greatest_compression.assign(index.size(), 0.0);
  const std::size_t rows = read_states(tables, index, run);
  // contacts.csv has fewer times than history.csv if the run was killed between the two writes.
  if (!index.empty()) run.times = std::min(run.times, rows / index.size());
  read_motion(tables, index, run);
  read_events(tables, index, run);
  read_curves(tables, run);
  read_energies(tables, run);
  read_headers(tables, run);
  run.from = window.from.value_or(run.t_first);
  run.to = window.to.value_or(run.t_last);
  read_time_window(tables, run);
  run.frames = read_frames(tables, run.from, run.to);
  return run;
}

std::optional<PlottedRun> event_window(const TableFolder& tables, const PlottedRun& run) {
  constexpr std::size_t most_contacts = 6;  // limit, because more contacts would need too many pictures
  double first = run.t_last, last = run.t_first;
  std::size_t changes = 0;
  for (const auto& bands : run.bands) {
    if (bands.size() < 2) continue;
    changes += bands.size() - 1;
    first = std::min(first, bands[1].from);
    last = std::max(last, bands.back().from);
  }
  const double air = 0.05 * std::max(last - first, 0.0);
  PlottedRun zoomed = run;
  zoomed.from = std::max(first - air, run.t_first);
  zoomed.to = std::min(last + air, run.t_last);
  zoomed.suffix = events_suffix;
  const double part = (zoomed.to - zoomed.from) / (run.t_last - run.t_first);
  if (changes < 4 || !(part > 0.0) || part >= 0.6 || run.bands.size() > most_contacts) return std::nullopt;
  read_time_window(tables, zoomed);
  return zoomed;
}

PlottedRun read_compared(const TableFolder& tables, const RunFacts& facts, double t_end) {
  PlottedRun run;
  run.facts = facts;
  read_times(tables, {}, run);
  // If the run was killed, its last output time may be incomplete in contacts.csv.
  if (run.times > 0 && run.facts.outcome == "running") --run.times;
  run.from = run.t_first;
  run.to = std::max(run.t_last, t_end);
  run.greatest_compression.assign(run.facts.contacts.size(), 0.0);
  read_motion(tables, contact_numbers(run.facts), run);
  read_contact_ranges(tables, run);
  read_displacement_ranges(tables, run);
  return run;
}

void Range::take(double value) {
  if (!std::isfinite(value)) return;
  least = std::min(least, value);
  greatest = std::max(greatest, value);
}

void Range::take(const Range& other) {
  least = std::min(least, other.least);
  greatest = std::max(greatest, other.greatest);
}

double Range::size() const { return empty() ? 0.0 : std::max(std::abs(least), std::abs(greatest)); }

std::string translate(const PlottedRun& run, std::string_view english) {
  return translate(run.look.language, english);
}

}  // namespace signorini::result
