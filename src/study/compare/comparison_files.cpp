#include "study/compare/comparison_files.hpp"

#include <fmt/core.h>

#include "base/json.hpp"
#include "result/summary_parts.hpp"
#include "study/optional_values.hpp"

namespace signorini::compare {
namespace {

using Audit = std::map<std::string, double>;

/// Table of runs. Its audit columns are the entries of `audit`, the audit of the reference run.
result::CsvTable<RunFigures> run_table(const Audit& audit) {
  using R = RunFigures;
  result::CsvTable<R> table = {{"run", &R::name},
                               {"engine", &R::engine},
                               {"directory", [](const R& r) { return r.directory.string(); }},
                               {"outcome", [](const R& r) { return r.facts.outcome; }},
                               {"t", &R::t},
                               {"reason", &R::reason},
                               {"events", [](const R& r) { return count_state_changes(r.events_by_type); }},
                               {"wall_time", &R::wall_time},
                               {"steps", &R::steps},
                               {"factorisations", &R::factorisations},
                               {"solves", &R::solves},
                               {"restarts", &R::restarts},
                               {"friction", &R::friction},
                               {"damping", &R::damping}};
  for (const auto& [name, value] : audit)
    table.add("audit_" + name, [name = name](const R& r) {
      const auto found = r.audit.find(name);
      return found == r.audit.end() ? std::nullopt : std::optional(found->second);
    });
  return table;
}

std::string runs_csv(const ComparisonReport& report) {
  const result::CsvTable<RunFigures> table = run_table(report.runs.front().figures.audit);
  result::CsvBlock block;
  table.put_header(block);
  for (const ComparedRun& run : report.runs) table.put_row(block, run.figures);
  for (const auto& [name, reason] : report.refused) {
    // An engine that refused the scene has only a name and a reason.
    const std::map<std::string, std::string> cells = {
        {"run", name}, {"engine", name}, {"outcome", "refused"}, {"reason", reason}};
    for (const auto& column : table.columns()) {
      const auto found = cells.find(column.name);
      result::put_cell(block, found == cells.end() ? std::nullopt : std::optional(found->second));
    }
    block.end_row();
  }
  return block.str();
}

/// Difference of a quantity between one run and the reference.
struct Difference {
  const std::string& run;
  Quantity quantity;
  [[nodiscard]] const MaxDifference& whole() const { return quantity.deviation->whole; }
  [[nodiscard]] const MaxDifference& until_split() const { return quantity.deviation->until_split; }
};

std::string differences_csv(const ComparisonReport& report) {
  using D = Difference;
  const result::CsvTable<D> table = {{"run", [](const D& d) { return std::string_view(d.run); }},
                                     {"quantity", [](const D& d) { return d.quantity.name; }},
                                     {"unit", [](const D& d) { return d.quantity.unit; }},
                                     {"value", [](const D& d) { return d.whole().value; }},
                                     {"t", [](const D& d) { return d.whole().t; }},
                                     {"where", [](const D& d) { return d.whole().where; }},
                                     {"value_until_split", [](const D& d) { return d.until_split().value; }},
                                     {"t_until_split", [](const D& d) { return d.until_split().t; }},
                                     {"where_until_split", [](const D& d) { return d.until_split().where; }}};
  std::vector<D> rows;
  for (const Comparison& c : report.comparisons)
    for (const Quantity& q : quantities(c, report.runs.front().figures.facts.units))
      if (q.deviation->count > 0) rows.push_back({c.name, q});
  return table.text(rows);
}

/// Difference of a column between one run and the reference.
struct ColumnDifference {
  const std::string &run, &column;
  const Deviation& deviation;
};

std::string columns_csv(const ComparisonReport& report) {
  using D = ColumnDifference;
  const result::CsvTable<D> table = {
      {"run", [](const D& d) { return std::string_view(d.run); }},
      {"column", [](const D& d) { return std::string_view(d.column); }},
      {"value", [](const D& d) { return d.deviation.whole.value; }},
      {"t", [](const D& d) { return d.deviation.whole.t; }},
      {"value_until_split", [](const D& d) { return d.deviation.until_split.value; }},
      {"t_until_split", [](const D& d) { return d.deviation.until_split.t; }}};
  std::vector<D> rows;
  for (const Comparison& c : report.comparisons)
    for (const auto& [name, deviation] : c.columns) rows.push_back({c.name, name, deviation});
  return table.text(rows);
}

std::string events_csv(const ComparisonReport& report) {
  const auto& reference = report.runs.front().events;
  std::vector<EventPair> rows;
  for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
    const Comparison& c = report.comparisons[i];
    for (const AlignedPair& pair : c.alignment.pairs)
      rows.push_back(
          {c.name, reference[pair.reference], report.runs[i + 1].events[pair.other].t, pair.swapped});
  }
  return event_pair_table().text(rows);
}

base::Json event_json(const LoggedEvent& event) {
  return {{"t", event.t},
          {"contact", event.contact},
          {"event", event.type},
          {"from", event.from},
          {"to", event.to}};
}

base::Json greatest_json(const MaxDifference& greatest) {
  base::Json json = {{"value", greatest.value}, {"t", greatest.t}};
  if (!greatest.where.empty()) json["where"] = greatest.where;
  return json;
}

base::Json run_json(const RunFigures& run) {
  return {{"name", run.name},
          {"engine", run.engine},
          {"directory", run.directory.string()},
          {"outcome", run.facts.outcome},
          {"t", run.t},
          {"reason", run.reason},
          {"events", {{"total", count_state_changes(run.events_by_type)}, {"by_type", run.events_by_type}}},
          {"wall_time", study::json_of(run.wall_time)},
          {"steps", study::json_of(run.steps)},
          {"factorisations", study::json_of(run.factorisations)},
          {"solves", study::json_of(run.solves)},
          {"restarts", study::json_of(run.restarts)},
          {"friction", study::json_of(run.friction)},
          {"damping", study::json_of(run.damping)},
          {"friction_work", run.friction_work},
          {"audit", run.audit}};
}

base::Json rows_json(const Comparison::Rows& rows) {
  base::Json json = base::Json::object();
  const auto add = [&](const char* file, const RowCount& count) {
    if (count.reference + count.other > 0)
      json[file] = {{"compared", count.compared}, {"reference", count.reference}, {"run", count.other}};
  };
  add("history.csv", rows.history);
  add("contacts.csv", rows.contacts);
  add("energy.csv", rows.energy);
  add("response.csv", rows.response);
  return json;
}

base::Json comparison_json_of(const ComparisonReport& report, std::size_t i) {
  const Comparison& c = report.comparisons[i];
  const auto &reference = report.runs.front().events, &other = report.runs[i + 1].events;
  base::Json json = {{"run", c.name},
                     {"t_end", c.t_end},
                     {"common_times", c.common_times},
                     {"rows", rows_json(c.rows)},
                     {"aligned", c.alignment.pairs.size()},
                     {"swapped", c.alignment.swapped},
                     {"first_difference", base::Json()}};
  if (const auto& split = c.alignment.split) {
    json["first_difference"] = {
        {"t", split->t},
        {"reference", split->reference ? event_json(reference[*split->reference]) : base::Json()},
        {"run", split->other ? event_json(other[*split->other]) : base::Json()},
        {"unaligned", split->unaligned}};
  }
  json["differences"] = base::Json::object();
  for (const Quantity& q : quantities(c, report.runs.front().figures.facts.units)) {
    if (q.deviation->count == 0) continue;
    json["differences"][q.name] = greatest_json(q.deviation->whole);
    json["differences"][q.name]["unit"] = q.unit;
    if (c.alignment.split)
      json["differences"][q.name]["until_first_difference"] = greatest_json(q.deviation->until_split);
  }
  json["columns"] = base::Json::object();
  for (const auto& [name, deviation] : c.columns) json["columns"][name] = greatest_json(deviation.whole);
  json["notes"] = c.notes;
  return json;
}

}  // namespace

std::string split_text(const ComparedRun& reference, const ComparedRun& other,
                       const Alignment::Split& split) {
  const auto side = [&](const ComparedRun& run, const std::optional<std::size_t>& index) {
    if (!index) return run.figures.name + " has no more events";
    const LoggedEvent& event = run.events[*index];
    return fmt::format("{} has {} at t = {:.12g}", run.figures.name, event.name(), event.t);
  };
  return fmt::format("{}; {}", side(reference, split.reference), side(other, split.other));
}

std::string comparison_json(const ComparisonReport& report) {
  const result::RunFacts& facts = report.runs.front().figures.facts;
  base::Json json = {{"title", facts.title},
                     {"units", result::units_json(facts.units)},
                     {"reference", report.runs.front().figures.name}};
  json["runs"] = base::Json::array();
  for (const ComparedRun& run : report.runs) json["runs"].push_back(run_json(run.figures));
  for (const auto& [name, reason] : report.refused)
    json["runs"].push_back({{"name", name}, {"outcome", "refused"}, {"reason", reason}});
  json["comparisons"] = base::Json::array();
  for (std::size_t i = 0; i < report.comparisons.size(); ++i)
    json["comparisons"].push_back(comparison_json_of(report, i));
  json["limits"] = base::Json::object();
  for (const Limit& limit : report.limits) json["limits"][limit.name] = limit.value;
  json["exceeded"] = report.exceeded;
  return base::json_text(json);
}

void write_comparison(const std::filesystem::path& directory, const ComparisonReport& report) {
  result::write_file(directory / "runs.csv", runs_csv(report));
  result::write_file(directory / "differences.csv", differences_csv(report));
  result::write_file(directory / "columns.csv", columns_csv(report));
  result::write_file(directory / "events.csv", events_csv(report));
  result::write_file(directory / "compare.json", comparison_json(report));
}

}  // namespace signorini::compare
