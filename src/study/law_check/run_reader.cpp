#include "study/law_check/run_reader.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/json.hpp"
#include "base/text.hpp"
#include "result/csv.hpp"
#include "signorini/error.hpp"

namespace signorini::directory_check {
namespace {

constexpr const char* heading[] = {"t", "contact", "state", "gap", "ut", "vt", "slip", "N", "T", "ratio"};

constexpr std::size_t columns = std::size(heading), ratio_column = columns - 1;

}  // namespace

RecordedRowReader::RecordedRowReader(const std::filesystem::path& file, const Model& model)
    : file_(file), names_(model), reader_(file) {
  const std::vector<std::string>& found = reader_.header();
  ratios_ = found.size() == columns;
  if ((!ratios_ && found.size() != ratio_column) ||
      !std::equal(found.begin(), found.end(), std::begin(heading)))
    throw FileError(file.string(), "line 1: expected t,contact,state,gap,ut,vt,slip,N,T,ratio");
}

double RecordedRowReader::number(std::size_t column) const {
  const std::optional<double> value = base::parse_number(reader_.cell(column));
  if (!value || !std::isfinite(*value))
    throw FileError(file_.string(),
                    fmt::format("line {}: {}: found \"{}\", expected a number", reader_.line(),
                                heading[column], base::excerpt(reader_.cell(column))));
  return *value;
}

std::optional<RecordedRow> RecordedRowReader::next() {
  if (!reader_.next()) return std::nullopt;
  RecordedRow row;
  row.t = number(0);
  row.contact = static_cast<std::size_t>(names_.at(reader_.cell(1), file_, reader_.line()));
  row.state = reader_.cell(2);
  if (!reader_.cell(3).empty()) row.gap = number(3);
  double* const numbers[] = {&row.ut, &row.vt, &row.slip, &row.N, &row.T};
  for (std::size_t i = 0; i < std::size(numbers); ++i) *numbers[i] = number(4 + i);
  if (ratios_ && !reader_.cell(ratio_column).empty()) row.ratio = number(ratio_column);
  return row;
}

void RecordedRowReader::refuse_truncated(const std::string& lacks) const {
  throw FileError(file_.string(), truncation_message(reader_, lacks));
}

namespace {

constexpr State built_in[] = {State::open, State::closed, State::stick, State::slip_plus, State::slip_minus};

/// Converts the cells of a row to the members of an event.
class EventCells {
 public:
  EventCells(const std::filesystem::path& file, const Model& model)
      : file_(file), names_(model), reader_(file) {
    for (const EventColumn& column : event_columns) at_.push_back(reader_.column(column.name));
  }

  [[nodiscard]] std::optional<Event> next() {
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

  /// Refuses a table whose last line has no line break.
  void refuse_if_cut() const {
    if (reader_.is_cut()) throw FileError(file_.string(), truncation_message(reader_, "a line break"));
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    throw FileError(file_.string(), fmt::format("line {}: {}: found \"{}\", expected {}", reader_.line(),
                                                name_, base::excerpt(*cell_), expected));
  }
  static bool optional(const EventColumn::Field& field) {
    return std::holds_alternative<std::optional<double> Event::*>(field);
  }
  void take(double& value) const {
    const std::optional<double> found = base::parse_number(*cell_);
    if (!found || !std::isfinite(*found)) fail("a number");
    value = *found;
  }
  void take(std::optional<double>& value) const { take(value.emplace()); }
  void take(int& contact) const { contact = names_.at(*cell_, file_, reader_.line()); }
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
  result::CsvReader reader_;
  std::vector<std::size_t> at_;
  const std::string* cell_ = nullptr;
  const char* name_ = "";
};

std::optional<Peak> peak_of(const base::Json& contact) {
  const auto peaks = contact.find("peaks");
  if (peaks == contact.end()) return std::nullopt;
  return Peak{peaks->at("tangential").get<double>(), peaks->at("normal").get<double>(),
              peaks->at("N").get<double>(), peaks->at("T").get<double>()};
}

std::optional<RecordedSummary::Load> load_of(const base::Json& contact) {
  const auto load = contact.find("load");
  if (load == contact.end()) return std::nullopt;
  const auto value = [&](const char* force, const char* which) {
    return load->at(force).at(which).at("value").get<double>();
  };
  return RecordedSummary::Load{value("N", "least"), value("N", "greatest"), value("T", "least"),
                               value("T", "greatest")};
}

/// Reads the results of a completed run.
void read_end(const base::Json& json, const Model& model, const std::string& file,
              RecordedSummary& recorded) {
  const auto refuse = [&](const std::string& why) { throw FileError(file, why); };
  const base::Json& outcome = json.at("outcome");
  recorded.t = outcome.at("t").get<double>();
  const std::string kind = outcome.value("kind", "");
  if (kind != "done" && kind != "stopped" && kind != "interrupted")
    refuse("outcome.kind: found \"" + base::excerpt(kind) + "\", expected done, stopped or interrupted");
  recorded.stopped = kind != "done";
  recorded.total = json.at("events").at("total").get<long>();
  recorded.events_by_type = json.at("events").at("by_type").get<std::map<std::string, long>>();
  const base::Json& contacts = json.at("contacts");
  if (contacts.size() != model.contacts.size())
    refuse(fmt::format("contacts: found {}, expected {} as in run.toml", contacts.size(),
                       model.contacts.size()));
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    if (const std::string name = contacts[k].value("name", ""); name != model.contacts[k].name)
      refuse("contacts: found \"" + base::excerpt(name) + "\", expected \"" + model.contacts[k].name + "\"");
    recorded.peaks.push_back(peak_of(contacts[k]));
    recorded.loads.push_back(load_of(contacts[k]));
  }
}

void check_units(const base::Json& json, const Model& model, const std::string& file) {
  const auto units = json.find("units");
  if (units == json.end()) return;
  for (const auto& [what, asked] :
       {std::pair("force", &model.units.force), std::pair("mass", &model.units.mass),
        std::pair("length", &model.units.length), std::pair("time", &model.units.time)})
    if (const std::string found = units->value(what, *asked); found != *asked)
      throw FileError(file, fmt::format("units.{}: found \"{}\", expected \"{}\" as in run.toml", what,
                                        base::excerpt(found), *asked));
}

}  // namespace

ContactNames::ContactNames(const Model& model) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    places_.emplace(model.contacts[k].name, static_cast<int>(k));
}

int ContactNames::at(const std::string& name, const std::filesystem::path& file, int line) const {
  const auto found = places_.find(name);
  if (found == places_.end())
    throw FileError(file.string(),
                    fmt::format("line {}: contact: found \"{}\", expected a contact of run.toml", line,
                                base::excerpt(name)));
  return found->second;
}

std::string truncation_message(const result::CsvReader& reader, const std::string& lacks) {
  return fmt::format("line {}: found {}, expected {}; the file is cut", reader.line(),
                     reader.is_cut() ? "no line break" : "the end of the file", lacks);
}

std::vector<Event> read_recorded_events(const std::filesystem::path& directory, const Model& model,
                                        bool ended) {
  EventCells cells(directory / "events.csv", model);
  std::vector<Event> events;
  while (auto event = cells.next()) events.push_back(std::move(*event));
  if (ended) cells.refuse_if_cut();
  return events;
}

RecordedSummary read_recorded_summary(const std::filesystem::path& directory, const Model& model) {
  const std::filesystem::path path = directory / "summary.json";
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw FileError(path.string(), "cannot be read; expected a directory that `signorini run` wrote");
  try {
    const base::Json json = base::parse_json(file);
    RecordedSummary recorded;
    static_cast<void>(json.at("outcome"));
    recorded.ended = json.contains("events");
    const std::string engine = json.value("engine", "");
    const std::optional<Engine> known = find_engine(engine);
    if (!known || *known == Engine::automatic) {
      if (recorded.ended)
        throw FileError(path.string(),
                        "engine: found \"" + base::excerpt(engine) + "\", expected the name of an engine");
      return recorded;
    }
    recorded.engine = *known;
    if (const auto settings = json.find("settings"); settings != json.end())
      recorded.flow = settings->value("flow", "");
    check_units(json, model, path.string());
    if (recorded.ended) read_end(json, model, path.string(), recorded);
    return recorded;
  } catch (const base::Json::exception& error) {
    throw FileError(path.string(), std::string("is not the summary of a run: ") + error.what());
  }
}

}  // namespace signorini::directory_check
