#include "study/compare/limits.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/text.hpp"
#include "signorini/error.hpp"

namespace signorini::compare {

namespace {

constexpr const char* sequence = "sequence";
const std::string response = "response:";  // followed by the name of an [[output]]

std::vector<std::string> limit_names() {
  std::vector<std::string> names = quantity_names();
  names.emplace_back(sequence);
  return names;
}

struct TableRows {
  const char* file;
  const RowCount* rows;
};
std::vector<TableRows> tables_of(const Comparison& c) {
  return {{"history.csv", &c.rows.history},
          {"contacts.csv", &c.rows.contacts},
          {"energy.csv", &c.rows.energy},
          {"response.csv", &c.rows.response}};
}

/// Text about rows of the quantity's table that were not compared; empty if all were compared. Tables have a
/// row at each time of history.csv, and contacts.csv has a row per time and contact. response.csv also has
/// rows at events, whose times differ from run to run.
std::string uncompared_rows_text(const std::string& quantity, const RunFigures& reference,
                                 const RunFigures& other, const Comparison& c) {
  const auto sentence = [&](const char* file, const RowCount& rows) {
    return fmt::format("only {} of {} {} compared; {} has {}, and {} has {}",
                       base::count_text(rows.compared, "row"), file, rows.compared == 1 ? "was" : "were",
                       reference.name, base::count_text(rows.reference, "row"), other.name,
                       base::count_text(rows.other, "row"));
  };
  const auto fewer = [](const char* file, const std::string& name, std::size_t rows, std::size_t expected) {
    return fmt::format("{} of {} has {}, expected {} at the times of its history.csv", file, name,
                       base::count_text(rows, "row"), expected);
  };
  const RowCount& history = c.rows.history;
  if (!history.all()) return sentence("history.csv", history);
  if (quantity.starts_with(response))
    return c.rows.response.compared < history.compared ? sentence("response.csv", c.rows.response) : "";
  const bool force = quantity.starts_with("force"), energy = quantity == "energy";
  if (!force && !energy) return "";
  const RowCount& rows = force ? c.rows.contacts : c.rows.energy;
  const char* file = force ? "contacts.csv" : "energy.csv";
  const std::size_t each_a = force ? reference.facts.contacts.size() : 1,
                    each_b = force ? other.facts.contacts.size() : 1;
  if (rows.reference != each_a * history.reference)
    return fewer(file, reference.name, rows.reference, each_a * history.reference);
  if (rows.other != each_b * history.other)
    return fewer(file, other.name, rows.other, each_b * history.other);
  return rows.all() ? "" : sentence(file, rows);
}

/// List of names, "A.ux, B.ux"; only the first three if there are more.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i > 0 ? ", " : "") + names[i];
  return names.size() > most ? fmt::format("{} and {} more", text, names.size() - most) : text;
}

/// "1 event has", "3 events have": the beginning of a statement about events without a matching event.
std::string unmatched_events(std::size_t count) {
  return base::count_text(count, "event") + (count == 1 ? " has" : " have");
}

/// Text about columns or contacts of the quantity that only one run has. Empty if the quantity has at least
/// one column or contact, and both runs have all of them.
std::string unmatched_columns_text(const Quantity& quantity, const Comparison& c) {
  const std::vector<std::string>& alone = quantity.deviation->unmatched;
  if (quantity.deviation->count > 0 && alone.empty()) return "";
  std::vector<std::string> common;
  for (const auto& [name, deviation] : c.columns) common.push_back(name);
  const std::string both = common.empty() ? "none" : listed(common);
  if (!alone.empty())
    return fmt::format("only one of the two runs has {}; columns in both runs: {}", listed(alone), both);
  if (quantity.name == "force_away" && c.force.count > 0)
    return "no common output time is far enough from events";
  return "neither run has such a column; columns in both runs: " + both;
}

/// Reason why a limit on the quantity cannot be applied to both runs; empty if it can be applied.
std::string reason_not_comparable(const Quantity& quantity, const RunFigures& reference,
                                  const RunFigures& other, const Comparison& c) {
  if (quantity.name == "event_time") return "";  // exceeded() also checks events without a partner
  if (c.common_times < 2) return "the two runs have fewer than two common output times";
  if (std::string why = unmatched_columns_text(quantity, c); !why.empty()) return why;
  return uncompared_rows_text(quantity.name, reference, other, c);
}

}  // namespace

std::string rows_compared(const Comparison& comparison) {
  std::string text;
  for (const TableRows& table : tables_of(comparison)) {
    const RowCount& rows = *table.rows;
    if (rows.reference + rows.other == 0) continue;
    text += fmt::format(
        "{}{} {}", text.empty() ? "" : ", ", table.file,
        rows.all() ? std::to_string(rows.compared)
                   : fmt::format("{} (reference {}, run {})", rows.compared, rows.reference, rows.other));
  }
  return text;
}

std::vector<std::string> quantity_names() {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities({}, {})) names.push_back(quantity.name);
  return names;
}

std::vector<Limit> parse_limits(const std::vector<std::string>& texts) {
  const std::vector<std::string> names = limit_names();
  std::vector<Limit> limits;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw UsageError("--limit " + text + ": expected NAME=NUMBER, such as event_time=1e-4");
    const std::string name = text.substr(0, equals);
    const bool of_output = name.starts_with(response) && name != response;
    if (!of_output && std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError(
          fmt::format("--limit {}: no quantity \"{}\"{}", text, name, base::suggestion(name, names)));
    const std::optional<double> value = base::parse_number(text.substr(equals + 1));
    if (!value || !(*value >= 0.0))
      throw UsageError(
          fmt::format("--limit {}: found \"{}\", expected a number >= 0", text, text.substr(equals + 1)));
    if (std::any_of(limits.begin(), limits.end(), [&](const Limit& l) { return l.name == name; }))
      throw UsageError("--limit " + text + ": \"" + name + "\" has a limit already");
    limits.push_back({name, *value});
  }
  return limits;
}

std::vector<Quantity> quantities(const Comparison& c, const Units& units) {
  const std::string &length = units.length, &time = units.time, &force = units.force;
  std::vector<Quantity> list = {{"event_time", time, &c.event_time},
                                {"displacement", length, &c.displacement},
                                {"rotation", "rad", &c.rotation},
                                {"velocity", length + "/" + time, &c.velocity},
                                {"angular_velocity", "rad/" + time, &c.angular_velocity},
                                {"force", force, &c.force},
                                {"force_away", force, &c.force_away},
                                {"energy", force + " " + length, &c.energy}};
  for (const Comparison::Response& r : c.response) list.push_back({response + r.name, r.unit, &r.deviation});
  return list;
}

std::vector<std::string> exceeded(const std::vector<Limit>& limits, const RunFigures& reference,
                                  const RunFigures& other, const Comparison& comparison) {
  std::vector<std::string> list;
  if (limits.empty()) return list;
  for (const RunFigures* run : {&reference, &other}) {
    if (run->done()) continue;
    list.push_back(fmt::format("{}: {} at t = {:.9g}, so limits cannot be checked beyond that time",
                               run->name, run->facts.outcome, run->t));
  }
  const bool whole = reference.done() && other.done();
  if (whole && comparison.ends_differ)
    list.push_back(
        fmt::format("{0}: compared up to t = {1:.9g}, but {2} continues to {3:.9g}, so limits cannot be "
                    "checked after t = {1:.9g}",
                    other.name, comparison.t_end, (reference.t > other.t ? reference : other).name,
                    std::max(reference.t, other.t)));
  const auto& split = comparison.alignment.split;
  const bool sequence_limited =
      std::any_of(limits.begin(), limits.end(), [](const Limit& l) { return l.name == sequence; });
  for (const Limit& limit : limits) {
    if (limit.name == "event_time" && split && !sequence_limited)
      list.push_back(fmt::format(
          "{}: from t = {:.9g} on, {} no matching event, so the limit {} of event_time cannot be checked",
          other.name, split->t, unmatched_events(split->unaligned), base::format_number(limit.value)));
    if (limit.name == sequence) {
      const std::size_t unaligned = split ? split->unaligned : 0;
      if (static_cast<double>(unaligned) <= limit.value) continue;
      list.push_back(fmt::format(
          "{}: the sequence of events differs from t = {:.9g} on: {} no matching event, the limit is {}",
          other.name, split->t, unmatched_events(unaligned), base::format_number(limit.value)));
      continue;
    }
    const std::vector<Quantity> known = quantities(comparison, reference.facts.units);
    if (std::none_of(known.begin(), known.end(), [&](const Quantity& q) { return q.name == limit.name; }))
      list.push_back(
          fmt::format("{}: {} has a limit, but at least one run has no such output", other.name, limit.name));
    for (const Quantity& quantity : known) {
      if (quantity.name != limit.name) continue;
      const MaxDifference& greatest = quantity.deviation->whole;
      const std::string why = whole ? reason_not_comparable(quantity, reference, other, comparison) : "";
      if (!why.empty())
        list.push_back(fmt::format("{}: the limit of {} cannot be checked: {}", other.name, limit.name, why));
      if (!(greatest.value <= limit.value))
        list.push_back(fmt::format("{}: {} {:.6g} {} at t = {:.9g} ({}) exceeds the limit {}", other.name,
                                   limit.name, greatest.value, quantity.unit, greatest.t, greatest.where,
                                   base::format_number(limit.value)));
    }
  }
  return list;
}

}  // namespace signorini::compare
