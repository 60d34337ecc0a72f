#include "study/compare/comparison.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "base/run_files.hpp"
#include "base/text.hpp"
#include "scene/components.hpp"
#include "study/compare/alignment.hpp"
#include "study/compare/comparison_files.hpp"

namespace signorini::compare {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The quantity to which a column of history.csv belongs.
Deviation& quantity(Comparison& c, const std::string& column) {
  const scene::NamedMotion motion = scene::motion_named(column);
  if (motion.rotation) return motion.rate ? c.angular_velocity : c.rotation;
  return motion.rate ? c.velocity : c.displacement;
}

struct CommonColumn {
  std::string name;
  std::size_t a, b;
  Deviation* quantity;
};

std::vector<CommonColumn> common_columns(const result::CsvReader& a, const result::CsvReader& b,
                                         Comparison& c, const char* table) {
  std::vector<CommonColumn> columns;
  std::vector<std::string> alone;
  for (std::size_t i = 1; i < a.header().size(); ++i) {
    const std::string& name = a.header()[i];
    const auto found = std::find(b.header().begin(), b.header().end(), name);
    if (found == b.header().end()) {
      alone.push_back(name);
      quantity(c, name).unmatched.push_back(name);
    } else {
      columns.push_back({name, i, static_cast<std::size_t>(found - b.header().begin()), &quantity(c, name)});
    }
  }
  for (std::size_t i = 1; i < b.header().size(); ++i)
    if (std::find(a.header().begin(), a.header().end(), b.header()[i]) == a.header().end()) {
      alone.push_back(b.header()[i]);
      quantity(c, b.header()[i]).unmatched.push_back(b.header()[i]);
    }
  if (!alone.empty()) {
    c.notes.push_back(
        fmt::format("{}: {} in only one of the two runs{} \"{}\"", table,
                    base::count_text(alone.size(), "column") + (alone.size() == 1 ? " occurs" : " occur"),
                    alone.size() == 1 ? ":" : "; the first is", alone[0]));
  }
  return columns;
}

/// Output file for a table of differences over time, if requested.
template <class Row>
std::optional<result::TableFile<Row>> series_of(const ComparisonSettings& settings, const char* kind,
                                                const result::CsvTable<Row>& table) {
  if (settings.folder.empty()) return std::nullopt;
  return std::optional<result::TableFile<Row>>(std::in_place,
                                               settings.folder / (kind + settings.slug + ".csv"), table);
}

void compare_motion(const ComparedRun& a, const ComparedRun& b, const ComparisonSettings& settings,
                    double split, Comparison& c) {
  TimeJoin join(a.figures.directory / "history.csv", b.figures.directory / "history.csv", c.t_end);
  const std::vector<CommonColumn> columns = common_columns(join.a(), join.b(), c, "history.csv");
  for (const CommonColumn& column : columns) c.columns.emplace_back(column.name, Deviation());
  auto series = series_of(settings, "motion-", motion_difference_table());
  while (join.next()) {
    double displacement = 0.0, velocity = 0.0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const CommonColumn& column = columns[i];
      const double difference = std::abs(join.a().number(column.a) - join.b().number(column.b));
      column.quantity->update(difference, join.t(), column.name, split);
      c.columns[i].second.update(difference, join.t(), column.name, split);
      if (column.quantity == &c.displacement) displacement = std::max(displacement, difference);
      if (column.quantity == &c.velocity) velocity = std::max(velocity, difference);
    }
    if (series) series->add({join.t(), displacement, velocity});
    ++c.common_times;
  }
  c.rows.history = join.rows();
  if (series) series->flush();
}

void compare_response(const ComparedRun& a, const ComparedRun& b, double split, Comparison& c) {
  if (a.figures.facts.response.empty() || b.figures.facts.response.empty()) return;
  TimeJoin join(a.figures.directory / "response.csv", b.figures.directory / "response.csv", c.t_end);
  Comparison ignored;  // collects the notes about columns without a partner
  const std::vector<CommonColumn> columns = common_columns(join.a(), join.b(), ignored, "response.csv");
  c.notes.insert(c.notes.end(), ignored.notes.begin(), ignored.notes.end());
  for (const CommonColumn& column : columns)
    for (const auto& output : a.figures.facts.response)
      if (output.name == column.name) c.response.push_back({output.name, output.unit, {}});
  if (c.response.size() != columns.size()) {
    c.response.clear();
    c.notes.emplace_back("response.csv is not compared: its columns differ from the outputs in summary.json");
    return;
  }
  while (join.next())
    for (std::size_t i = 0; i < columns.size(); ++i)
      c.response[i].deviation.update(std::abs(join.a().number(columns[i].a) - join.b().number(columns[i].b)),
                                     join.t(), columns[i].name, split);
  c.rows.response = join.rows();
}

void compare_energy(const ComparedRun& a, const ComparedRun& b, double split, Comparison& c) {
  TimeJoin join(a.figures.directory / "energy.csv", b.figures.directory / "energy.csv", c.t_end);
  Comparison ignored;  // collects the columns without a partner
  std::vector<CommonColumn> columns = common_columns(join.a(), join.b(), ignored, "energy.csv");
  std::erase_if(columns, [](const CommonColumn& column) { return column.name == "balance"; });
  c.energy.unmatched = std::move(ignored.displacement.unmatched);
  while (join.next()) {
    for (const CommonColumn& column : columns)
      c.energy.update(std::abs(join.a().number(column.a) - join.b().number(column.b)), join.t(), column.name,
                      split);
  }
  c.rows.energy = join.rows();
}

/// any(from, to): true if an event of either run lies in [from, to]. Neither time may decrease from call to call.
class EventsBetween {
 public:
  EventsBetween(const ComparedRun& a, const ComparedRun& b) {
    for (const ComparedRun* run : {&a, &b})
      for (const LoggedEvent& event : run->events) times_.push_back(event.t);
    std::sort(times_.begin(), times_.end());
  }
  bool any(double from, double to) {
    while (at_ < times_.size() && times_[at_] < from) ++at_;
    return at_ < times_.size() && times_[at_] <= to;
  }

 private:
  std::vector<double> times_;
  std::size_t at_ = 0;
};

/// Moves the reader to its next time and counts the rows there. Returns false if there are no more rows up to `end`.
bool next_row(ContactRowReader& reader, double end, std::size_t& count) {
  if (!reader.next() || beyond(reader.t(), end)) return false;
  count += reader.forces().size();
  return true;
}

using ForcesByContact = std::map<std::string, std::pair<Deviation, Deviation>>;  // deviations of N and of T

void add_columns(const ForcesByContact& by_contact, const ComparedRun& reference, Comparison& c) {
  for (const auto& contact : reference.figures.facts.contacts) {
    const auto found = by_contact.find(contact.name);
    if (found == by_contact.end()) continue;
    c.columns.emplace_back(contact.name + ".N", found->second.first);
    c.columns.emplace_back(contact.name + ".T", found->second.second);
  }
}

void compare_forces(const ComparedRun& a, const ComparedRun& b, const ComparisonSettings& settings,
                    double split, Comparison& c) {
  ContactRowReader rows_a(a.figures.directory / "contacts.csv"), rows_b(b.figures.directory / "contacts.csv");
  EventsBetween events(a, b);
  auto series = series_of(settings, "forces-", force_difference_table());
  ForcesByContact by_contact;

  // An output time is evaluated when the next output time is known: force_away requires that no event lies
  // between the two neighbouring output times.
  struct PendingRow {
    double t, before;
    MaxDifference greatest;
    bool any = false;
  };
  std::optional<PendingRow> waiting;
  const auto judge = [&](double next) {
    if (!waiting || !waiting->any || events.any(waiting->before, next)) return;
    c.force_away.update(waiting->greatest.value, waiting->t, waiting->greatest.where, split);
  };
  double before = 0.0;
  RowCount& rows = c.rows.contacts;
  const auto next_a = [&] { return next_row(rows_a, c.t_end, rows.reference); };
  const auto next_b = [&] { return next_row(rows_b, c.t_end, rows.other); };
  bool more_a = next_a(), more_b = next_b();
  while (more_a && more_b) {
    if (!same_time(rows_a.t(), rows_b.t())) {
      (rows_a.t() < rows_b.t() ? more_a : more_b) = rows_a.t() < rows_b.t() ? next_a() : next_b();
      continue;
    }
    const double t = rows_a.t();
    judge(t);
    waiting = PendingRow{t, before, {}, false};
    before = t;
    double N = 0.0, T = 0.0;
    for (const auto& [name, forces] : rows_a.forces()) {
      const auto found = rows_b.forces().find(name);
      if (found == rows_b.forces().end()) continue;
      ++rows.compared;
      const double dN = std::abs(forces.N - found->second.N), dT = std::abs(forces.T - found->second.T);
      by_contact[name].first.update(dN, t, name + ".N", split);
      by_contact[name].second.update(dT, t, name + ".T", split);
      for (const auto& [difference, what] : {std::pair(dN, ".N"), std::pair(dT, ".T")}) {
        c.force.update(difference, t, name + what, split);
        waiting->greatest.update(difference, t, name + what);
      }
      waiting->any = true;
      N = std::max(N, dN);
      T = std::max(T, dT);
    }
    if (series) series->add({t, N, T});
    more_a = next_a();
    more_b = next_b();
  }
  while (more_a) more_a = next_a();
  while (more_b) more_b = next_b();
  judge(before);
  if (series) series->flush();
  add_columns(by_contact, a, c);
}

void note_contacts(const ComparedRun& a, const ComparedRun& b, Comparison& c) {
  const auto has = [](const ComparedRun& run, const std::string& name) {
    const auto& list = run.figures.facts.contacts;
    return std::any_of(list.begin(), list.end(), [&](const auto& contact) { return contact.name == name; });
  };
  for (const auto& [one, two] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (const auto& contact : one->figures.facts.contacts)
      if (!has(*two, contact.name)) {
        c.notes.push_back(fmt::format("only {} has contact \"{}\"", one->figures.name, contact.name));
        c.force.unmatched.push_back(contact.name);
        c.force_away.unmatched.push_back(contact.name);
      }
}

}  // namespace

ComparedRun read_compared_run(const std::filesystem::path& directory, const std::string& name) {
  base::check_run_files(directory);
  ComparedRun run{read_run_figures(directory), read_events(directory)};
  run.figures.name = name;
  return run;
}

Comparison compare_runs(const ComparedRun& reference, const ComparedRun& other,
                        const ComparisonSettings& settings) {
  Comparison c;
  c.name = other.figures.name;
  c.t_end = std::min({reference.figures.t, other.figures.t, settings.t_end});
  c.ends_differ = !same_time(reference.figures.t, other.figures.t) && c.t_end < settings.t_end;
  if (reference.figures.t != other.figures.t && c.t_end < settings.t_end) {
    const bool reference_first = reference.figures.t < other.figures.t;
    const RunFigures& shorter = reference_first ? reference.figures : other.figures;
    const RunFigures& longer = reference_first ? other.figures : reference.figures;
    c.notes.push_back(fmt::format("compared up to t = {:.9g}, the end of {}; {} ends at {:.9g}", c.t_end,
                                  shorter.name, longer.name, longer.t));
  }
  note_contacts(reference, other, c);
  c.alignment = align(reference.events, other.events, {c.t_end, settings.instant});
  const double split = c.alignment.split ? c.alignment.split->t : never;
  for (const AlignedPair& pair : c.alignment.pairs) {
    const LoggedEvent& event = reference.events[pair.reference];
    c.event_time.update(std::abs(other.events[pair.other].t - event.t), event.t, event.name(), never);
  }
  compare_motion(reference, other, settings, split, c);
  compare_forces(reference, other, settings, split, c);
  compare_energy(reference, other, split, c);
  compare_response(reference, other, split, c);
  if (c.common_times < 2 && c.t_end > 0.0) {
    c.notes.push_back(
        fmt::format("the two runs have {} in common: give both runs the same output times (run.output_dt)",
                    base::count_text(c.common_times, "output time")));
  }
  return c;
}

}  // namespace signorini::compare
