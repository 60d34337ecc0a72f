#include "study/sweep/sweep_row.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "base/fingerprint.hpp"
#include "base/input_file.hpp"
#include "base/json.hpp"
#include "study/prepared_run.hpp"
#include "study/sweep/response_query.hpp"

namespace signorini {

namespace {

void take_report(SweepRow& row, const Model& model, const Report& report) {
  row.outcome = report.outcome.kind == Outcome::Kind::done ? "done" : "stopped";
  row.reason = report.outcome.reason;
  row.t = report.outcome.t;
  row.events = report.events_by_type;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    SweepRow::Contact contact{model.contacts[k].name};
    if (k < report.peaks.size()) {
      const Peak& peak = report.peaks[k];
      contact.tangential = peak.tangential;
      contact.normal = peak.normal;
      contact.N = peak.N;
      contact.T = peak.T;
    }
    if (k < report.audit.friction_work.size()) contact.friction = report.audit.friction_work[k];
    row.contacts.push_back(std::move(contact));
  }
  row.wall_time = report.wall_time;
  row.steps = report.counters.steps;
  const Audit& audit = report.audit;
  row.balance = audit.energy_scale > 0.0 ? audit.energy.value / audit.energy_scale : 0.0;
  row.warnings = report.warnings.size();
}

/// The row's own run has a row of output at both ends only, kept or not: so it is the same, and quicker.
Report run(const RowTask& task, const PreparedRun& prepared, Answers& answers) {
  if (!task.keep.empty()) {
    remove_run(task.keep);  // what an interrupted sweep left
    RunDirectory directory(task.keep, prepared.scene, prepared.model, {false, task.command_line});
    Relay all(&directory);
    prepared.keep(directory, all);
  }
  return prepared.ends(answers);
}

/// Outputs that no query asks for cost and tell nothing; a kept run has them all the same.
void drop_outputs(const RowTask& task, const std::vector<ResponseQuery>& queries, Model& model) {
  if (!task.keep.empty() ||
      std::any_of(queries.begin(), queries.end(), [](const ResponseQuery& q) { return q.of_output(); }))
    return;
  model.outputs.clear();
  model.reaction_sums.clear();
}

double number_or_none(const Json& value) {  // what is no number was written as null
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

double number(const Json& json, const char* key) { return number_or_none(json.at(key)); }

}  // namespace

long SweepRow::changes() const { return changes_in(events); }

std::optional<double> SweepRow::response(std::size_t i) const {
  const bool known = i < responses.size() && std::isfinite(responses[i]);
  return known ? std::optional(responses[i]) : std::nullopt;
}

SweepRow compute_row(const RowTask& task) {
  SweepRow row;
  row.index = task.index;
  row.values = task.values;
  try {
    PreparedRun prepared = prepare_run(task.scene, task.changes);
    Model& model = prepared.model;
    std::vector<ResponseQuery> queries;
    for (const std::string& text : task.responses) queries.push_back(parse_query(text, model));
    drop_outputs(task, queries, model);
    Answers answers(queries, model);
    const Report report = run(task, prepared, answers);
    take_report(row, model, report);
    row.responses = answers.values(report);
    row.sequence = answers.sequence();
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    row.outcome = "refused";
    row.reason = error.what();
  }
  return row;
}

namespace {

Json json_of(const SweepRow& row) {
  Json json = {{"row", row.index + 1},       {"values", row.values}, {"outcome", row.outcome},
               {"reason", row.reason},       {"t", row.t},           {"events", row.events},
               {"wall_time", row.wall_time}, {"steps", row.steps},   {"energy_balance", row.balance},
               {"warnings", row.warnings}};
  json["sequence"] = row.sequence;
  if (!row.responses.empty()) json["responses"] = row.responses;
  json["contacts"] = Json::array();
  for (const auto& contact : row.contacts)
    json["contacts"].push_back({{"name", contact.name},
                                {"tangential", contact.tangential},
                                {"normal", contact.normal},
                                {"N", contact.N},
                                {"T", contact.T},
                                {"friction_work", contact.friction}});
  return json;
}

SweepRow row_of(const Json& json) {
  SweepRow row;
  row.index = json.at("row").get<std::size_t>() - 1;
  row.values = json.at("values").get<std::vector<std::string>>();
  row.outcome = json.at("outcome");
  row.reason = json.at("reason");
  row.t = number(json, "t");
  row.events = json.at("events").get<std::map<std::string, long>>();
  row.wall_time = number(json, "wall_time");
  row.steps = json.at("steps");
  row.balance = number(json, "energy_balance");
  row.warnings = json.at("warnings");
  row.sequence = json.at("sequence");
  if (const auto found = json.find("responses"); found != json.end())
    for (const Json& value : *found) row.responses.push_back(number_or_none(value));
  for (const Json& contact : json.at("contacts"))
    row.contacts.push_back({contact.at("name"), number(contact, "tangential"), number(contact, "normal"),
                            number(contact, "N"), number(contact, "T"), number(contact, "friction_work")});
  return row;
}

}  // namespace

std::string row_json(const SweepRow& row) { return json_text(json_of(row)); }

std::string row_text(const SweepRow& row) {
  Json json = json_of(row);
  json["checksum"] = fingerprint_of(json_line(json));
  return json_text(json);
}

SweepRow parse_row(const std::string& text) { return row_of(parse_json(text)); }

bool same_result(const SweepRow& a, const SweepRow& b) {
  SweepRow other = b;
  other.wall_time = a.wall_time;
  return row_json(a) == row_json(other);
}

SweepRow read_row(const std::filesystem::path& file) {
  if (const std::string why = why_no_input_file(file); !why.empty())
    throw FileError(file.string(), why + ", expected a row of a sweep");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string(), "cannot be read");
  try {
    Json json = parse_json(stream);
    const std::string checksum = json.at("checksum");
    json.erase("checksum");
    if (checksum != fingerprint_of(json_line(json)))
      throw FileError(file.string(), "has been altered since it was written");
    return row_of(json);
  } catch (const Json::exception& error) {
    throw FileError(file.string(), std::string("is not a row of a sweep: ") + error.what());
  }
}

}  // namespace signorini
