// module.cpp: the library for Python: the part of the package `signorini` that is compiled.
//
//   check(text, file, settings)                 -> JSON of `signorini check`
//   run(text, file, settings, directory, force, stop)
//                                               -> a Run: tables as arrays, summary.json as text; stop: a Stop, or None
//   compare(reference, other)                   -> differences of two directories of runs
//   sensitivity(text, file, paths, settings, losses, discrete)
//                                               -> derivatives of events, columns and figures by keys
//   find_orbit(text, file, settings, options)   -> orbit.json as text, a Run of one period or None
//   follow(text, file, settings, options, branch)
//                                               -> columns of branch.csv, branch.json as text
//
// settings: [(path, value as TOML)]. The interpreter is free while a run is computed; it is asked now and then whether somebody
// wants to interrupt. Errors of the library are signorini.Error, with the exit code of the program.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "base/version.hpp"
#include "result/run_directory.hpp"
#include "result/run_tables.hpp"
#include "result/summary.hpp"
#include "scene/schema.hpp"
#include "signorini/certify.hpp"
#include "signorini/orbit.hpp"
#include "signorini/sensitivity.hpp"
#include "study/check/check.hpp"
#include "study/compare/comparison.hpp"
#include "study/orbit/branch_files.hpp"
#include "study/orbit/orbit_files.hpp"

namespace py = pybind11;

namespace signorini {

namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

std::vector<Override> overrides(const Settings& settings) {
  std::vector<Override> list;
  for (const auto& [path, value] : settings) list.push_back({path, value});
  return list;
}

/// Ends the runs that have it, from another thread: Python tells interrupts to its main thread only.
struct Stop {
  std::atomic<bool> asked = false;
};

/// Keeps the rows, hands them to a directory where there is one, and asks Python for interrupts.
class Kept : public Result {
 public:
  Kept(result::RunDirectory* directory, const Stop* stop) : directory_(directory), stop_(stop) {}
  void event(const Event& event) override {
    Result::event(event);
    if (directory_) directory_->event(event);
  }
  void sample(const Sample& sample) override {
    Result::sample(sample);
    if (directory_) directory_->sample(sample);
  }
  void frame(const Sample& sample) override {
    if (directory_) directory_->frame(sample);
  }
  [[nodiscard]] bool wants_motion() const override { return directory_ != nullptr; }
  void motion(int contact, const std::vector<MotionRow>& list) override {
    if (directory_) directory_->motion(contact, list);
  }
  void curves(const Curves& curves) override {
    if (directory_) directory_->curves(curves);
  }
  void response(double t, const std::vector<double>& values) override {
    Result::response(t, values);
    if (directory_) directory_->response(t, values);
  }
  bool progress(double t) override {
    if (directory_) directory_->progress(t);
    return go_on();
  }
  /// Asked often; Python is asked twenty times a second.
  bool go_on() {
    if (stop_ && stop_->asked) interrupted_ = true;
    const auto now = std::chrono::steady_clock::now();
    if (interrupted_ || now - asked_ < std::chrono::milliseconds(50)) return !interrupted_;
    asked_ = now;
    const py::gil_scoped_acquire held;
    interrupted_ = PyErr_CheckSignals() != 0;
    return !interrupted_;
  }
  [[nodiscard]] bool interrupted() const { return interrupted_; }

 private:
  result::RunDirectory* directory_;
  const Stop* stop_;
  std::chrono::steady_clock::time_point asked_ = std::chrono::steady_clock::now();
  bool interrupted_ = false;
};

py::array_t<double> array(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// A value of each row, as an array.
template <class Rows, class Value>
py::array_t<double> column(const Rows& rows, const Value& value) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(value(row));
  return array(values);
}

using Names = std::vector<std::string>;

Names contact_names(const Model& model) {
  Names names;
  for (const Contact& contact : model.contacts) names.push_back(contact.name);
  return names;
}

py::list event_cells(const Names& contacts, const std::vector<Event>& events, EventColumn::Field field) {
  py::list list;
  for (const Event& event : events)
    list.append(std::visit(
        [&](auto member) -> py::object {
          const auto& value = event.*member;
          using Value = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<Value, int>) {
            return py::str(value < 0 ? "" : contacts[static_cast<std::size_t>(value)]);
          } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
            return py::float_(value.value_or(std::numeric_limits<double>::quiet_NaN()));
          } else if constexpr (std::is_same_v<Value, double>) {
            return py::float_(value);
          } else if constexpr (std::is_same_v<Value, State>) {
            return py::str(event.contact < 0 ? "" : to_string(value));
          } else {
            return py::str(to_string(value));
          }
        },
        field));
  return list;
}

py::dict event_table(const Names& contacts, const std::vector<Event>& events) {
  py::dict table;
  for (const EventColumn& c : event_columns) table[c.name] = event_cells(contacts, events, c.field);
  return table;
}

py::dict history_table(const Model& model, const std::vector<Result::Row>& rows) {
  py::dict table;
  table["t"] = column(rows, [](const auto& row) { return row.t; });
  for (const Column& c : model.columns)
    table[c.name.c_str()] = column(rows, [&](const auto& row) { return c.value(row.u, row.v); });
  return table;
}

py::dict contact_tables(const Model& model, const std::vector<Result::Row>& rows) {
  py::dict tables;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const auto of = [&](double ContactSample::*member) {
      return column(rows, [&](const auto& row) { return row.contacts[k].*member; });
    };
    py::dict table;
    table["t"] = column(rows, [](const auto& row) { return row.t; });
    py::list states;
    for (const Result::Row& row : rows) states.append(to_string(row.contacts[k].state));
    table["state"] = states;
    table["gap"] = of(&ContactSample::gap);
    table["ut"] = of(&ContactSample::ut);
    table["vt"] = of(&ContactSample::vt);
    table["slip"] = of(&ContactSample::slip);
    table["N"] = of(&ContactSample::N);
    table["T"] = of(&ContactSample::T);
    table["ratio"] = column(rows, [&](const auto& row) {
      return result::friction_ratio(model.contacts[k], row.contacts[k])
          .value_or(std::numeric_limits<double>::quiet_NaN());
    });
    tables[model.contacts[k].name.c_str()] = table;
  }
  return tables;
}

py::dict energy_table(const std::vector<Result::Row>& rows) {
  py::dict table;
  table["t"] = column(rows, [](const auto& row) { return row.t; });
  for (const EnergyColumn& c : energy_columns)
    table[c.name] = column(rows, [&](const auto& row) { return row.energy.*c.value; });
  table[balance_column] = column(rows, [](const auto& row) { return row.energy.balance(); });
  return table;
}

/// The outputs of the scene; none: no column but t.
py::dict response_table(const Model& model, const std::vector<Result::Response>& rows) {
  py::dict table;
  table["t"] = column(rows, [](const auto& row) { return row.t; });
  for (std::size_t i = 0; i < model.outputs.size(); ++i)
    table[model.outputs[i].name.c_str()] = column(rows, [&](const auto& row) { return row.values[i]; });
  return table;
}

py::dict response_units(const Model& model) {
  py::dict units;
  units["t"] = model.units.time;
  for (const Output& output : model.outputs) units[output.name.c_str()] = unit_text(output.unit, model.units);
  return units;
}

/// Units of the columns of history, by name.
py::dict history_units(const Model& model) {
  py::dict units;
  units["t"] = model.units.time;
  for (const Column& c : model.columns) units[c.name.c_str()] = model.unit_of(c);
  return units;
}

/// A run that is over. Its tables become arrays when somebody asks for them: most callers of a thousand runs want one.
class Run {
 public:
  Run(Scene scene, const std::optional<std::string>& path, bool force, const Stop* stop)
      : scene_(std::move(scene)), model_(build_model(scene_)) {
    std::optional<result::RunDirectory> directory;
    if (path) directory.emplace(*path, scene_, model_, result::RunDirectoryOptions{force, {"python"}});
    Kept kept(directory ? &*directory : nullptr, stop);
    report_ = simulate_certified(model_, scene_.run, kept, {{}, [&] { return kept.go_on(); }});
    if (directory) summary_ = directory->finish(report_);
    interrupted_ = kept.interrupted();
    rows_ = std::move(static_cast<Result&>(kept));
  }
  [[nodiscard]] bool interrupted() const { return interrupted_; }

  [[nodiscard]] py::dict events() const {
    py::dict table = event_table(contact_names(model_), rows_.events);
    if (report_.certificate) {
      const auto& errors = report_.certificate->t_errors;
      table["t_error"] = array({errors.begin(), errors.end()});
    }
    return table;
  }
  [[nodiscard]] py::dict history() const { return history_table(model_, rows_.rows); }
  [[nodiscard]] py::dict contacts() const { return contact_tables(model_, rows_.rows); }
  [[nodiscard]] py::dict energy() const { return energy_table(rows_.rows); }
  [[nodiscard]] py::dict response() const { return response_table(model_, rows_.responses); }
  [[nodiscard]] py::dict units() const {
    py::dict units = response_units(model_);
    units.attr("update")(history_units(model_));
    return units;
  }
  [[nodiscard]] std::string summary() const {
    return summary_.empty() ? result::summary_json(scene_, model_, report_, {"python"}) : summary_;
  }
  [[nodiscard]] const std::string& toml() const { return scene_.resolved; }

 private:
  Scene scene_;
  Model model_;
  CertifiedReport report_;
  std::string summary_;  // of the directory
  bool interrupted_ = false;
  Result rows_;
};

std::unique_ptr<Run> run_scene(const std::string& text, const std::string& file, const Settings& settings,
                               const std::optional<std::string>& path, bool force, const Stop* stop) {
  std::unique_ptr<Run> ran;
  {
    const py::gil_scoped_release free;
    ran = std::make_unique<Run>(parse_scene(text, file, overrides(settings)), path, force, stop);
  }
  if (!ran->interrupted()) return ran;
  if (PyErr_Occurred() == nullptr) PyErr_SetString(PyExc_KeyboardInterrupt, "");
  throw py::error_already_set();
}

/// Derivatives of landings by one parameter.
py::dict landing_rates(const Sensitivities& s, std::size_t p) {
  py::dict table;
  for (const auto& [name, rate] :
       {std::pair{"dstart_dp", &LandingRates::start}, std::pair{"dend_dp", &LandingRates::end},
        std::pair{"dimpulse_dp", &LandingRates::impulse},
        std::pair{"dpeak_force_dp", &LandingRates::peak_force}})
    table[name] = column(s.landings, [&, rate = rate](const MovingLanding& l) { return l.rates[p].*rate; });
  return table;
}

/// Stays of contacts on their ground.
py::dict landings_of(const Sensitivities& s) {
  py::dict table;
  py::list contacts;
  for (const MovingLanding& l : s.landings) contacts.append(s.contacts[static_cast<std::size_t>(l.contact)]);
  table["contact"] = contacts;
  for (const auto& [name, value] :
       {std::pair{"start", &Landing::start}, std::pair{"end", &Landing::end},
        std::pair{"impulse", &Landing::impulse}, std::pair{"peak_force", &Landing::peak_force}})
    table[name] = column(s.landings, [&, value = value](const MovingLanding& l) { return l.value.*value; });
  return table;
}

/// Derivatives of events and columns by one parameter.
py::dict rates_by(const Sensitivities& s, std::size_t p) {
  py::dict events, columns, figures, entry;
  for (const EventRateColumn& c : event_rate_columns)
    events[c.name] = column(s.event_rates, [&](const auto& rates) { return rates[p].*c.value; });
  for (std::size_t k = 0; k < s.columns.size(); ++k)
    columns[s.columns[k].c_str()] = column(s.value_rates[p], [&](const auto& row) { return row[k]; });
  for (const Response& r : s.responses)
    figures[py::make_tuple(r.contact < 0 ? "" : s.contacts[static_cast<std::size_t>(r.contact)], r.name)] =
        py::make_tuple(r.value, r.rates[p]);
  entry["value"] = s.parameters[p].value;
  entry["until"] = s.parameters[p].until;
  entry["reason"] = s.parameters[p].reason;
  entry["events"] = events;
  entry["columns"] = columns;
  entry["figures"] = figures;
  return entry;
}

SceneReader reader_of(const std::string& text, const std::string& file, const Settings& settings) {
  return [=](const std::vector<Override>& changes) {
    std::vector<Override> all = overrides(settings);
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, file, all);
  };
}

py::dict sensitivity(const std::string& text, const std::string& file, const std::vector<std::string>& paths,
                     const Settings& settings, bool losses, bool discrete) {
  const SceneReader read = reader_of(text, file, settings);
  Kept kept(nullptr, nullptr);
  std::optional<Sensitivities> s;
  {
    const py::gil_scoped_release free;
    s = sensitivities(read, paths, &kept, {losses, discrete});
  }
  if (kept.interrupted()) throw py::error_already_set();
  py::dict result, parameters, values;
  for (std::size_t p = 0; p < s->parameters.size(); ++p) {
    py::dict rates = rates_by(*s, p);
    if (losses) rates["landings"] = landing_rates(*s, p);
    parameters[s->parameters[p].path.c_str()] = rates;
  }
  for (std::size_t k = 0; k < s->columns.size(); ++k)
    values[s->columns[k].c_str()] = column(s->values, [&](const auto& row) { return row[k]; });
  result["events"] = event_table(s->contacts, s->events);
  result["t"] = array(s->times);
  result["columns"] = values;
  result["parameters"] = parameters;
  if (losses) result["landings"] = landings_of(*s);
  return result;
}

OrbitOptions orbit_options(const std::optional<double>& period, int times, int transient) {
  OrbitOptions options;
  options.period = period;
  options.times = times;
  options.transient = transient;
  return options;
}

py::tuple find_orbit_of(const std::string& text, const std::string& file, const Settings& settings,
                        const std::optional<double>& period, int times, int transient) {
  const SceneReader read = reader_of(text, file, settings);
  Kept kept(nullptr, nullptr);
  std::string json;
  std::unique_ptr<Run> once;
  {
    const py::gil_scoped_release free;
    const Orbit orbit = find_orbit(read, orbit_options(period, times, transient), &kept);
    if (!kept.interrupted()) json = orbit_study::orbit_json(build_model(read({})), orbit);
    if (orbit.found && !kept.interrupted())
      once = std::make_unique<Run>(orbit_scene(read, orbit), std::nullopt, false, nullptr);
  }
  if (kept.interrupted() || (once && once->interrupted())) throw py::error_already_set();
  return py::make_tuple(json, std::move(once));
}

/// Columns of branch.csv; `stable` is 1, 0, or nan where it is undecided.
py::dict branch_table(const std::vector<std::string>& outputs, const Branch& branch) {
  py::dict table;
  const auto add = [&](const std::string& name, const auto& value) {
    table[name.c_str()] = column(branch.points, value);
  };
  add("parameter", [](const BranchPoint& p) { return p.parameter; });
  add("period", [](const BranchPoint& p) { return p.period; });
  add("amplitude", [](const BranchPoint& p) { return p.amplitude; });
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    add(outputs[i] + " minimum", [i](const BranchPoint& p) { return p.minima[i]; });
    add(outputs[i] + " maximum", [i](const BranchPoint& p) { return p.maxima[i]; });
  }
  add("max_multiplier", [](const BranchPoint& p) { return p.max_multiplier; });
  add("multiplier_error", [](const BranchPoint& p) { return p.multiplier_error; });
  add("residual", [](const BranchPoint& p) { return p.residual; });
  add("stable", [](const BranchPoint& p) {
    return p.stable ? (*p.stable ? 1.0 : 0.0) : std::numeric_limits<double>::quiet_NaN();
  });
  add("sequence", [](const BranchPoint& p) { return p.sequence; });
  add("events", [](const BranchPoint& p) { return static_cast<double>(p.events); });
  add("branch", [](const BranchPoint& p) { return p.branch; });
  py::list losses, special;
  for (const BranchPoint& p : branch.points) {
    losses.append(to_string(p.loss));
    special.append(p.special);
  }
  table["loss"] = losses;
  table["special"] = special;
  return table;
}

py::tuple follow_of(const std::string& text, const std::string& file, const Settings& settings,
                    const std::optional<double>& period, int times, int transient, const std::string& path,
                    double from, double to, double step, int most_points, int switches) {
  const SceneReader read = reader_of(text, file, settings);
  BranchOptions options{orbit_options(period, times, transient), path, from, to, step, most_points, switches};
  Kept kept(nullptr, nullptr);
  Branch branch;
  Scene first;
  {
    const py::gil_scoped_release free;
    first = read({});
    branch = continue_branch(read, options, &kept);
  }
  if (kept.interrupted()) throw py::error_already_set();
  std::vector<std::string> outputs;
  for (const OutputSpec& output : first.outputs) outputs.push_back(output.name);
  return py::make_tuple(branch_table(outputs, branch),
                        orbit_study::branch_json(options, first.units, branch));
}

std::string check_scene(const std::string& text, const std::string& file, const Settings& settings) {
  const Scene scene = parse_scene(text, file, overrides(settings));
  const py::gil_scoped_release free;
  const Model model = build_model(scene);
  return check::check_json(scene, model, check::check(scene, model));
}

py::dict compare_directories(const std::string& reference, const std::string& other) {
  compare::Comparison c;
  {
    const py::gil_scoped_release free;
    c = compare::compare_runs(compare::read_compared_run(reference, "reference"),
                              compare::read_compared_run(other, "other"));
  }
  py::dict result;
  result["t_end"] = c.t_end;
  result["events"] = c.alignment.pairs.size();
  result["parted"] = c.alignment.split.has_value();
  const auto add = [&](const char* name, const compare::Deviation& d) {
    py::dict entry;
    entry["value"] = d.whole.value;
    entry["t"] = d.whole.t;
    entry["where"] = d.whole.where;
    result[name] = entry;
  };
  add("event_time", c.event_time);
  add("displacement", c.displacement);
  add("rotation", c.rotation);
  add("velocity", c.velocity);
  add("angular_velocity", c.angular_velocity);
  add("force", c.force);
  add("force_away", c.force_away);
  add("energy", c.energy);
  return result;
}

}  // namespace

}  // namespace signorini

PYBIND11_MODULE(_signorini, module) {
  using namespace signorini;
  static py::exception<Error> failure(module, "Error");
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const Error& error) {
      py::object thrown = py::reinterpret_borrow<py::object>(failure)(error.what());
      thrown.attr("code") = static_cast<int>(error.code());
      PyErr_SetObject(failure.ptr(), thrown.ptr());
    }
  });
  py::class_<Stop>(module, "Stop").def(py::init<>()).def("ask", [](Stop& stop) { stop.asked = true; });
  module.attr("version") = version;
  py::class_<Run>(module, "Run")
      .def("events", &Run::events)
      .def("history", &Run::history)
      .def("contacts", &Run::contacts)
      .def("energy", &Run::energy)
      .def("response", &Run::response)
      .def("units", &Run::units)
      .def("summary", &Run::summary)
      .def("toml", &Run::toml);
  module.def("run", &run_scene);
  module.def("check", &check_scene);
  module.def("compare", &compare_directories);
  module.def("sensitivity", &sensitivity);
  module.def("find_orbit", &find_orbit_of);
  module.def("follow", &follow_of);
  module.def("schema", &scene::scene_schema);
}
