#include "study/compare/comparison_files.hpp"

#include <fmt/core.h>

#include "base/json.hpp"

#include "result/csv.hpp"
#include "result/units_json.hpp"
#include "study/figures.hpp"

namespace signorini {

namespace {

std::string runs_csv(const ComparisonReport& report) {
  CsvBlock block;
  for (const char* name : {"run", "engine", "directory", "outcome", "t", "reason", "events", "wall_time",
                           "steps", "factorisations", "solves", "restarts", "friction", "damping"})
    block.text(name);
  const auto& audit = report.runs.front().figures.audit;
  for (const auto& [name, value] : audit) block.text("audit_" + name);
  block.end_row();
  for (const ComparedRun& compared : report.runs) {
    const RunFigures& run = compared.figures;
    block.text(run.name).text(run.engine).text(run.directory.string()).text(run.facts.outcome);
    block.number(run.t).text(run.reason).number(static_cast<double>(changes_in(run.events_by_type)));
    block.number(run.wall_time).number(number_of(run.steps)).number(number_of(run.factorisations));
    block.number(number_of(run.solves)).number(number_of(run.restarts));
    block.number(run.friction).number(run.damping);
    for (const auto& [name, value] : audit) {
      const auto found = run.audit.find(name);
      block.number(found == run.audit.end() ? std::nullopt : std::optional<double>(found->second));
    }
    block.end_row();
  }
  for (const auto& [name, reason] : report.refused) {
    block.text(name).text(name).empty().text("refused").empty().text(reason);
    for (std::size_t i = 0; i < 8 + audit.size(); ++i) block.empty();
    block.end_row();
  }
  return block.str();
}

std::string differences_csv(const ComparisonReport& report) {
  CsvBlock block;
  for (const char* name : {"run", "quantity", "unit", "value", "t", "where", "value_until_split",
                           "t_until_split", "where_until_split"})
    block.text(name);
  block.end_row();
  for (const Comparison& c : report.comparisons) {
    for (const Quantity& q : quantities(c, report.runs.front().figures.facts.units)) {
      if (q.deviation->count == 0) continue;
      const Greatest &whole = q.deviation->whole, &until = q.deviation->until_split;
      block.text(c.name).text(q.name).text(q.unit).number(whole.value).number(whole.t).text(whole.where);
      block.number(until.value).number(until.t).text(until.where).end_row();
    }
  }
  return block.str();
}

std::string columns_csv(const ComparisonReport& report) {
  CsvBlock block;
  for (const char* name : {"run", "column", "value", "t", "value_until_split", "t_until_split"})
    block.text(name);
  block.end_row();
  for (const Comparison& c : report.comparisons) {
    for (const auto& [name, deviation] : c.columns) {
      block.text(c.name).text(name).number(deviation.whole.value).number(deviation.whole.t);
      block.number(deviation.until_split.value).number(deviation.until_split.t).end_row();
    }
  }
  return block.str();
}

std::string events_csv(const ComparisonReport& report) {
  CsvBlock block;
  for (const char* name :
       {"run", "t_reference", "t", "difference", "contact", "event", "from", "to", "swapped"})
    block.text(name);
  block.end_row();
  const auto& reference = report.runs.front().events;
  for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
    const Comparison& c = report.comparisons[i];
    for (const AlignedPair& pair : c.alignment.pairs) {
      const LoggedEvent& event = reference[pair.reference];
      const double t = report.runs[i + 1].events[pair.other].t;
      block.text(c.name).number(event.t).number(t).number(t - event.t).text(event.contact);
      block.text(event.type).text(event.from).text(event.to).text(pair.swapped ? "true" : "false").end_row();
    }
  }
  return block.str();
}

Json event_json(const LoggedEvent& event) {
  return {{"t", event.t},
          {"contact", event.contact},
          {"event", event.type},
          {"from", event.from},
          {"to", event.to}};
}

Json greatest_json(const Greatest& greatest) {
  Json json = {{"value", greatest.value}, {"t", greatest.t}};
  if (!greatest.where.empty()) json["where"] = greatest.where;
  return json;
}

Json run_json(const RunFigures& run) {
  return {{"name", run.name},
          {"engine", run.engine},
          {"directory", run.directory.string()},
          {"outcome", run.facts.outcome},
          {"t", run.t},
          {"reason", run.reason},
          {"events", {{"total", changes_in(run.events_by_type)}, {"by_type", run.events_by_type}}},
          {"wall_time", json_of(run.wall_time)},
          {"steps", json_of(run.steps)},
          {"factorisations", json_of(run.factorisations)},
          {"solves", json_of(run.solves)},
          {"restarts", json_of(run.restarts)},
          {"friction", json_of(run.friction)},
          {"damping", json_of(run.damping)},
          {"friction_work", run.friction_work},
          {"audit", run.audit}};
}

Json rows_json(const Comparison::Rows& rows) {
  Json json = Json::object();
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

Json comparison_json_of(const ComparisonReport& report, std::size_t i) {
  const Comparison& c = report.comparisons[i];
  const auto &reference = report.runs.front().events, &other = report.runs[i + 1].events;
  Json json = {{"run", c.name},
               {"t_end", c.t_end},
               {"common_times", c.common_times},
               {"rows", rows_json(c.rows)},
               {"aligned", c.alignment.pairs.size()},
               {"swapped", c.alignment.swapped},
               {"first_difference", Json()}};
  if (const auto& split = c.alignment.split) {
    json["first_difference"] = {
        {"t", split->t},
        {"reference", split->reference ? event_json(reference[*split->reference]) : Json()},
        {"run", split->other ? event_json(other[*split->other]) : Json()},
        {"unaligned", split->unaligned}};
  }
  json["differences"] = Json::object();
  for (const Quantity& q : quantities(c, report.runs.front().figures.facts.units)) {
    if (q.deviation->count == 0) continue;
    json["differences"][q.name] = greatest_json(q.deviation->whole);
    json["differences"][q.name]["unit"] = q.unit;
    if (c.alignment.split)
      json["differences"][q.name]["until_first_difference"] = greatest_json(q.deviation->until_split);
  }
  json["columns"] = Json::object();
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
  const RunFacts& facts = report.runs.front().figures.facts;
  Json json = {{"title", facts.title},
               {"units", units_json(facts.units)},
               {"reference", report.runs.front().figures.name}};
  json["runs"] = Json::array();
  for (const ComparedRun& run : report.runs) json["runs"].push_back(run_json(run.figures));
  for (const auto& [name, reason] : report.refused)
    json["runs"].push_back({{"name", name}, {"outcome", "refused"}, {"reason", reason}});
  json["comparisons"] = Json::array();
  for (std::size_t i = 0; i < report.comparisons.size(); ++i)
    json["comparisons"].push_back(comparison_json_of(report, i));
  json["limits"] = Json::object();
  for (const Limit& limit : report.limits) json["limits"][limit.name] = limit.value;
  json["exceeded"] = report.exceeded;
  return json_text(json);
}

void write_comparison(const std::filesystem::path& directory, const ComparisonReport& report) {
  write_file(directory / "runs.csv", runs_csv(report));
  write_file(directory / "differences.csv", differences_csv(report));
  write_file(directory / "columns.csv", columns_csv(report));
  write_file(directory / "events.csv", events_csv(report));
  write_file(directory / "compare.json", comparison_json(report));
}

}  // namespace signorini
