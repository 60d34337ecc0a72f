#include "study/witness/told_run.hpp"

#include <fmt/core.h>

#include <cmath>
#include <fstream>

#include "base/excerpt.hpp"
#include "base/json.hpp"
#include "base/number.hpp"
#include "result/csv_read.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

constexpr State built_in[] = {State::open, State::closed, State::stick, State::slip_plus, State::slip_minus};

/// Turns cells of one row into the members of an event.
class EventCells {
 public:
  EventCells(const std::filesystem::path& file, const Model& model)
      : file_(file), names_(model), reader_(file) {
    for (const EventColumn& column : event_columns) at_.push_back(reader_.column(column.name));
  }

  [[nodiscard]] std::optional<Event> next() {
    ++line_;
    if (!reader_.next()) return std::nullopt;
    Event event;
    for (std::size_t i = 0; i < event_columns.size(); ++i) {
      cell_ = &reader_.cell(at_[i]);
      name_ = event_columns[i].name;
      if (cell_->empty()) {
        if (event.contact < 0 || optional(event_columns[i].field)) continue;
        fail("a value");
      }
      std::visit([&](const auto field) { take(event.*field); }, event_columns[i].field);
    }
    return event;
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    throw FileError(file_.string(), fmt::format("line {}: {}: found \"{}\", expected {}", line_, name_,
                                                excerpt(*cell_), expected));
  }
  static bool optional(const EventColumn::Field& field) {
    return std::holds_alternative<std::optional<double> Event::*>(field);
  }
  void take(double& value) const {
    const std::optional<double> found = parse_number(*cell_);
    if (!found || !std::isfinite(*found)) fail("a number");
    value = *found;
  }
  void take(std::optional<double>& value) const { take(value.emplace()); }
  void take(int& contact) const { contact = names_.at(*cell_, file_, line_); }
  void take(EventType& type) const {
    for (const EventTypeName& known : all_event_types)
      if (*cell_ == known.name) {
        type = known.type;
        return;
      }
    fail("a type of event");
  }
  void take(State& state) const {
    for (const State known : built_in)
      if (*cell_ == to_string(known)) {
        state = known;
        return;
      }
    fail("a state");
  }

  std::filesystem::path file_;
  ContactNames names_;
  CsvReader reader_;
  std::vector<std::size_t> at_;
  const std::string* cell_ = nullptr;
  const char* name_ = "";
  int line_ = 1;
};

std::optional<Peak> peak_of(const Json& contact) {
  const auto peaks = contact.find("peaks");
  if (peaks == contact.end()) return std::nullopt;
  return Peak{peaks->at("tangential").get<double>(), peaks->at("normal").get<double>(),
              peaks->at("N").get<double>(), peaks->at("T").get<double>()};
}

}  // namespace

ContactNames::ContactNames(const Model& model) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    places_.emplace(model.contacts[k].name, static_cast<int>(k));
}

int ContactNames::at(const std::string& name, const std::filesystem::path& file, int line) const {
  const auto found = places_.find(name);
  if (found == places_.end())
    throw FileError(
        file.string(),
        fmt::format("line {}: contact: found \"{}\", expected a contact of run.toml", line, excerpt(name)));
  return found->second;
}

std::vector<Event> told_events(const std::filesystem::path& directory, const Model& model) {
  EventCells cells(directory / "events.csv", model);
  std::vector<Event> events;
  while (auto event = cells.next()) events.push_back(std::move(*event));
  return events;
}

ToldSummary told_summary(const std::filesystem::path& directory, const Model& model) {
  const std::filesystem::path path = directory / "summary.json";
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw FileError(path.string(), "cannot be read; expected a directory that `signorini run` wrote");
  try {
    const Json json = parse_json(file);
    ToldSummary told;
    const Json& outcome = json.at("outcome");
    told.ended = json.contains("events");
    const std::string engine = json.value("engine", "");
    const std::optional<Engine> known = engine_called(engine);
    if (!known || *known == Engine::automatic) {
      if (told.ended)
        throw FileError(path.string(), "engine: found \"" + excerpt(engine) + "\", expected an engine");
      return told;
    }
    told.engine = *known;
    if (const auto settings = json.find("settings"); settings != json.end())
      told.flow = settings->value("flow", "");
    if (!told.ended) return told;
    told.t = outcome.at("t").get<double>();
    told.stopped = outcome.value("kind", "") != "done";
    told.events_by_type = json["events"].at("by_type").get<std::map<std::string, long>>();
    told.peaks.resize(model.contacts.size());
    const Json& contacts = json.at("contacts");
    for (std::size_t k = 0; k < model.contacts.size() && k < contacts.size(); ++k)
      told.peaks[k] = peak_of(contacts[k]);
    return told;
  } catch (const Json::exception& error) {
    throw FileError(path.string(), std::string("is not the summary of a run: ") + error.what());
  }
}

}  // namespace signorini
