#include "study/compare/run_figures.hpp"

#include <algorithm>
#include <fstream>
#include "base/json.hpp"

#include "base/text.hpp"
#include "result/csv.hpp"
#include "signorini/error.hpp"

namespace signorini::compare {

namespace {

template <class Value>
std::optional<Value> optional_value(const base::Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || found->is_null()) return std::nullopt;
  return found->get<Value>();
}

double last_output_time(const result::TableFolder& tables) {
  double t = 0.0;
  result::CsvReader history = tables.open("history.csv");
  while (history.next()) t = history.t();
  return t;
}

void read_counters(const base::Json& json, RunFigures& run) {
  if (!json.contains("counters")) return;
  const base::Json& counters = json["counters"];
  run.steps = optional_value<long>(counters, "steps");
  run.factorisations = optional_value<long>(counters, "factorisations");
  const auto again = optional_value<long>(counters, "refactorisations");
  if (run.factorisations && again) *run.factorisations += *again;
  run.solves = optional_value<long>(counters, "solves");
  run.restarts = optional_value<long>(counters, "restarts");
}

void read_energy(const base::Json& json, RunFigures& run) {
  for (const base::Json& contact : json.at("contacts"))
    if (const auto work = optional_value<double>(contact, "friction_work"))
      run.friction_work[contact.at("name")] = *work;
  if (!json.contains("energy")) return;
  const base::Json& last = json["energy"].at("final");
  run.friction = optional_value<double>(last, "friction");
  run.damping = optional_value<double>(last, "damping");
}

}  // namespace

RunFigures read_run_figures(const std::filesystem::path& directory) {
  RunFigures run;
  run.facts = result::read_run_facts(directory);
  run.directory = directory;
  const std::filesystem::path path = directory / "summary.json";
  std::ifstream file(path, std::ios::binary);
  try {
    const base::Json json = base::parse_json(file);
    const base::Json& outcome = json.at("outcome");
    run.engine = json.value("engine", "");
    run.reason = outcome.value("reason", "");
    run.wall_time = optional_value<double>(json, "wall_time");
    read_counters(json, run);
    read_energy(json, run);
    if (json.contains("events"))
      run.events_by_type = json["events"].at("by_type").get<std::map<std::string, long>>();
    if (json.contains("audit"))
      for (const auto& [name, extreme] : json["audit"].items())
        if (const auto relative = optional_value<double>(extreme, "relative")) run.audit[name] = *relative;
    const auto t = optional_value<double>(outcome, "t");
    run.t = t ? *t : last_output_time(result::TableFolder(directory));
  } catch (const base::Json::exception& error) {
    throw FileError(path.string(), std::string("is not the summary of a run: ") + error.what());
  }
  return run;
}

std::vector<LoggedEvent> read_events(const std::filesystem::path& directory) {
  std::vector<LoggedEvent> events;
  result::CsvReader reader(directory / "events.csv");
  const auto at = [&](auto field) { return reader.column(event_column(field)); };
  const std::size_t t = at(&Event::t), contact = at(&Event::contact), type = at(&Event::type);
  const std::size_t from = at(&Event::from), to = at(&Event::to);
  const auto& header = reader.header();  // tables of other programs may lack uncertainties
  const auto uncertainty = static_cast<std::size_t>(
      std::find(header.begin(), header.end(), event_column(&Event::t_uncertainty)) - header.begin());
  while (reader.next()) {
    LoggedEvent event;
    event.t = reader.number(t);
    event.contact = reader.cell(contact);
    event.type = reader.cell(type);
    event.from = reader.cell(from);
    event.to = reader.cell(to);
    if (uncertainty < header.size() && !reader.cell(uncertainty).empty())
      event.uncertainty = reader.number(uncertainty);
    events.push_back(std::move(event));
  }
  return events;
}

}  // namespace signorini::compare
