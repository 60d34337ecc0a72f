#include "study/sweep/sweep_row.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/json.hpp"
#include "base/text.hpp"
#include "scene/saved_state.hpp"
#include "signorini/simulate.hpp"
#include "study/prepared_run.hpp"
#include "study/sweep/response_query.hpp"

namespace signorini::sweep {

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
  row.balance = audit.energy.value / audit.energy_reference();
  row.warnings = report.warnings.size();
}

/// Stores the last row of a run, from which another run continues.
class LastRow : public run::ForwardingRecorder {
 public:
  explicit LastRow(Recorder& next) : run::ForwardingRecorder(&next) {}
  void sample(const Sample& sample) override {
    run::ForwardingRecorder::sample(sample);
    last_.rows.clear();
    last_.sample(sample);
  }
  /// The final state without scales and damping, which the continuing run computes itself.
  [[nodiscard]] SavedState state(const Model& model) const {
    SavedState state = last_state(model, last_);
    state.scales.reset();
    std::erase_if(state.motions, [](const auto& motion) { return motion.first == scene::saved_alpha; });
    return state;
  }

 private:
  Result last_;
};

/// Computes the row by a run with output rows only at both ends and at stroboscopic points, which is fast. If the run is
/// kept, a separate run with all rows is stored, so that the row does not depend on --keep.
Report run(const RowTask& task, const study::PreparedRun& prepared, Recorder& heard, const RunSpec& spec) {
  if (!task.keep.empty()) {
    result::remove_run(task.keep);  // files of an interrupted sweep
    result::RunDirectory directory(task.keep, prepared.scene, prepared.model, {false, task.command_line});
    run::ForwardingRecorder all(&directory);
    prepared.run_to_disk(directory, all);
  }
  return simulate(prepared.model, spec, heard);
}

/// Removes outputs that no query needs, because they cost time; kept and stroboscopic runs have all outputs.
void drop_outputs(const RowTask& task, const std::vector<ResponseQuery>& queries, Model& model) {
  if (!task.keep.empty() || !task.strobe.empty() ||
      std::any_of(queries.begin(), queries.end(), [](const ResponseQuery& q) { return q.of_output(); }))
    return;
  model.outputs.clear();
  model.reaction_sums.clear();
}

double number_or_none(const base::Json& value) {  // row_json() writes NaN as null
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

double number(const base::Json& json, const char* key) { return number_or_none(json.at(key)); }

}  // namespace

long SweepRow::changes() const { return count_state_changes(events); }

std::optional<double> SweepRow::response(std::size_t i) const {
  const bool known = i < responses.size() && std::isfinite(responses[i]);
  return known ? std::optional(responses[i]) : std::nullopt;
}

namespace {

/// Prepares the run. If a file cannot be read, only this run is refused, so the FileError becomes an Error. A FileError
/// for a file that cannot be written ends the sweep.
study::PreparedRun prepared(const RowTask& task, const std::optional<SavedState>* carried) try {
  Scene scene = parse_scene(task.text, task.scene, task.changes);
  if (carried != nullptr && *carried) scene.initial = {.saved = **carried};
  return study::prepare_run(std::move(scene), std::nullopt);
} catch (const FileError& error) {
  throw Error(error.code(), error.what());
}

SweepRow computed(const RowTask& task, std::optional<SavedState>* carried) {
  SweepRow row;
  row.index = task.index;
  row.values = task.values;
  try {
    study::PreparedRun prepared = signorini::sweep::prepared(task, carried);
    Model& model = prepared.model;
    std::vector<ResponseQuery> queries;
    for (const std::string& text : task.responses) queries.push_back(parse_query(text, model));
    drop_outputs(task, queries, model);
    QueryRecorder answers(queries, model);
    LastRow last(answers);
    Recorder& heard = carried != nullptr ? static_cast<Recorder&>(last) : answers;
    Report report;
    if (task.strobe.empty()) {
      report = run(task, prepared, heard, study::without_rows(prepared.scene.run));
    } else {
      const StroboscopicMap strobe = parse_strobe(task.strobe, prepared.scene, model);
      StroboscopicRecorder points(strobe, task.settle.value_or(0.5 * prepared.scene.run.t_end), model, heard);
      report = run(task, prepared, points, with_strobe_rows(prepared.scene.run, strobe));
      row.points = points.points();
    }
    take_report(row, model, report);
    row.responses = answers.values(report);
    row.sequence = answers.sequence();
    if (carried != nullptr && row.outcome == "done") *carried = last.state(model);
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    row.outcome = "refused";
    row.reason = error.what();
  }
  return row;
}

}  // namespace

SweepRow compute_row(const RowTask& task) { return computed(task, nullptr); }

SweepRow compute_row(const RowTask& task, std::optional<SavedState>& carried) {
  return computed(task, &carried);
}

namespace {

base::Json json_of(const SweepRow& row) {
  base::Json json = {{"row", row.index + 1},       {"values", row.values}, {"outcome", row.outcome},
                     {"reason", row.reason},       {"t", row.t},           {"events", row.events},
                     {"wall_time", row.wall_time}, {"steps", row.steps},   {"energy_balance", row.balance},
                     {"warnings", row.warnings}};
  json["sequence"] = row.sequence;
  if (!row.responses.empty()) json["responses"] = row.responses;
  if (!row.points.empty()) {
    json["points"] = base::Json::array();
    for (const StroboscopicPoint& point : row.points) {
      base::Json values = base::Json::array({point.t});
      for (const double value : point.values) values.push_back(value);
      json["points"].push_back(std::move(values));
    }
  }
  json["contacts"] = base::Json::array();
  for (const auto& contact : row.contacts)
    json["contacts"].push_back({{"name", contact.name},
                                {"tangential", contact.tangential},
                                {"normal", contact.normal},
                                {"N", contact.N},
                                {"T", contact.T},
                                {"friction_work", contact.friction}});
  return json;
}

SweepRow row_of(const base::Json& json) {
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
    for (const base::Json& value : *found) row.responses.push_back(number_or_none(value));
  if (const auto found = json.find("points"); found != json.end())
    for (const base::Json& values : *found) {
      StroboscopicPoint point{values.at(0).get<double>(), {}};
      for (std::size_t i = 1; i < values.size(); ++i) point.values.push_back(number_or_none(values[i]));
      row.points.push_back(std::move(point));
    }
  for (const base::Json& contact : json.at("contacts"))
    row.contacts.push_back({contact.at("name"), number(contact, "tangential"), number(contact, "normal"),
                            number(contact, "N"), number(contact, "T"), number(contact, "friction_work")});
  return row;
}

}  // namespace

std::string row_json(const SweepRow& row) { return base::json_text(json_of(row)); }

namespace {

// The last key of a line. It is unique, because quotes within texts are escaped.
constexpr const char* checksum_key = ",\"checksum\":\"";

}  // namespace

std::string row_line(const SweepRow& row) {
  std::string line = base::json_line(json_of(row));
  const std::string checksum = base::fingerprint_of(line);
  line.pop_back();
  return line + checksum_key + checksum + "\"}\n";
}

bool is_unaltered(const std::string& line) {
  const std::size_t end = line.rfind(checksum_key);
  if (end == std::string::npos) return false;
  const std::string row = line.substr(0, end) + "}";
  return line.substr(end) == checksum_key + base::fingerprint_of(row) + "\"}";
}

SweepRow parse_row(const std::string& line) { return row_of(base::parse_json(line)); }

bool same_result(const SweepRow& a, const SweepRow& b) {
  SweepRow other = b;
  other.wall_time = a.wall_time;
  return row_json(a) == row_json(other);
}

}  // namespace signorini::sweep
