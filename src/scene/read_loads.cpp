// [[loads]]: forces, moments, forces per length; [base_motion].

#include <fmt/core.h>
#include <map>
#include <numbers>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "scene/data_file.hpp"
#include "scene/readers.hpp"

namespace signorini::scene {
namespace {

void read_force(Table& table, LoadSpec& load, const NameScope& space) {
  if (!space.matrices) table.require("node", "");
  const std::string node = space.matrices ? "" : read_node(table, "node", space);
  table.require("direction", "");
  load.direction = read_direction(table, "direction", space);
  load.direction.node = node;
  table.require("amplitude", "");
  load.amplitude = table.number("amplitude");
}

void read_moment(Table& table, LoadSpec& load, const NameScope& space) {
  load.type = LoadType::moment;
  table.require("node", " (required for a moment)");
  load.direction.node = read_node(table, "node", space);
  load.direction.place = table.place("node");
  load.amplitude = table.number("moment");
}

void read_distributed(Table& table, LoadSpec& load, const NameScope& space) {
  load.type = LoadType::distributed;
  table.require("nodes", " (required for a distributed load)");
  load.pieces = read_node_names(table, "nodes", space);
  if (load.pieces.size() < 2) table.wrong("nodes", "the names of two or more nodes");
  table.require("direction", "");
  load.direction = read_direction(table, "direction", space);
  load.member_axes = table.choice("axes") == "member";
  load.amplitude = table.number("distributed");
}

/// Reads a traction or a pressure on a boundary of a body.
void read_traction(Table& table, LoadSpec& load, const NameScope& space, const Scene& scene) {
  load.type = LoadType::traction;
  load.pressure = table.has("pressure");
  table.require("group", load.pressure ? " (required for a pressure)" : " (required for a traction)");
  load.group = table.text("group");
  static_cast<void>(find_boundary(table, "group", load.group, scene));
  if (!load.pressure) {
    table.require("direction", " (required for a traction)");
    load.direction = read_direction(table, "direction", space);
  }
  load.amplitude = table.number(load.pressure ? "pressure" : "traction");
}

BaseMotionSpec read_one_motion(Table& table, const Scene& scene) {
  BaseMotionSpec motion;
  motion.place = table.place();
  motion.direction = read_direction(table, "direction", name_scope(scene));
  table.require("acceleration", "");
  motion.acceleration = read_acceleration(table, "acceleration", scene);
  table.finish();
  return motion;
}

/// Adds the name that the user gave to a load; refuses names that stages use for all loads of a kind.
void take_name(const Table& table, const std::string& name, Names& names) {
  if (name.empty()) return;
  for (const char* kind : {"gravity", "temperature", "supports"})
    if (name == kind)
      table.fail(
          "name",
          fmt::format("found \"{}\", which in run.stages means all loads of this kind; expected another name",
                      name));
  if (!names.add(name))
    table.fail("name", fmt::format("found \"{}\" twice, expected each load to have its own name", name));
}

/// Refuses names that collide with generated ones: numbers of unnamed loads, and names of loads from other tables.
void refuse_given_names(const std::vector<Table>& tables, const std::vector<LoadSpec>& loads) {
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const std::string& name = loads[i].name;
    for (std::size_t k = 0; k < loads.size(); ++k)
      if (loads[k].name.empty() && name == fmt::format("load {}", k + 1))
        tables[i].fail("name", fmt::format("found \"{}\", which is generated as the name of load {} because "
                                           "that load has no `name`; expected "
                                           "another name",
                                           name, k + 1));
    for (const char* kind : {"base motion", "preload of spring ", "initial strain of member ",
                             "temperature of member ", "temperature of body "})
      if (name.starts_with(kind))
        tables[i].fail(
            "name",
            fmt::format(
                "found \"{}\", expected a name that does not begin with \"{}\", because generated names "
                "of loads begin so",
                name, kind));
  }
}

}  // namespace

void read_loads(Table& top, Scene& scene, ResolvedScene& record) {
  const NameScope space = name_scope(scene);
  Names names;
  std::vector<Table> tables = tables_of(top, "loads");
  for (Table& table : tables) {
    LoadSpec load;
    load.place = table.place();
    load.name = table.optional_text("name").value_or("");
    take_name(table, load.name, names);
    const bool moment = table.has("moment"), distributed = table.has("distributed");
    for (const char* other : {"amplitude", "distributed"})
      if (table.has(other) && (moment || (distributed && table.has("amplitude"))))
        table.fail(other, fmt::format("cannot be combined with {}; give only one of them",
                                      moment ? "moment" : "distributed"));
    const bool traction = table.has("traction") || table.has("pressure");
    for (const char* other : {"amplitude", "moment", "distributed", "traction"})
      if (traction && table.has(other) && (table.has("pressure") || std::string_view(other) != "traction"))
        table.fail(other, fmt::format("cannot be combined with {}; give only one of them",
                                      table.has("pressure") ? "pressure" : "traction"));
    if (!space.matrices && traction)
      read_traction(table, load, space, scene);
    else if (space.matrices || !(moment || distributed))
      read_force(table, load, space);
    else if (moment)
      read_moment(table, load, space);
    else
      read_distributed(table, load, space);
    load.history = read_load_history(table, "history", scene);
    table.finish(space.matrices ? "has no meaning with [matrices]"
                 : traction     ? "has no meaning for a load on a boundary"
                 : moment       ? "has no meaning for a moment"
                 : distributed  ? "has no meaning for a distributed load"
                                : "has no meaning for a force at a node");
    scene.loads.push_back(std::move(load));
    record.add("loads", "[[loads]]", table.record());
  }
  refuse_given_names(tables, scene.loads);
}

void read_base_motion(Table& top, Scene& scene, ResolvedScene& record) {
  const toml::node* node = top.raw("base_motion");
  if (!node) return;
  if (node->is_table()) {
    Table table = top.child("base_motion");
    scene.base_motion.push_back(read_one_motion(table, scene));
    record.add("base_motion", "[base_motion]", table.record());
    return;
  }
  const toml::array* array = node->as_array();
  if (!array) top.wrong("base_motion", describe_type(*find_key("", "base_motion")));
  for (const toml::node& item : *array) {
    const std::string path = fmt::format("base_motion.{}", scene.base_motion.size() + 1);
    if (!item.is_table()) refuse(place_of(item), path, "found " + describe(item) + ", expected a table");
    Table table(item.as_table(), "base_motion", path, place_of(item));
    scene.base_motion.push_back(read_one_motion(table, scene));
    record.add("base_motion", "[[base_motion]]", table.record());
  }
}

// Histories: offset + amplitude * shape(t); shape(t) is zero before start and from end on.

namespace {

HistoryType type_of(const std::string& name) {
  static const std::map<std::string, HistoryType> types = {
      {"constant", HistoryType::constant},     {"step", HistoryType::step},
      {"rectangle", HistoryType::rectangle},   {"triangle", HistoryType::triangle},
      {"half_sine", HistoryType::half_sine},   {"harmonic", HistoryType::harmonic},
      {"polynomial", HistoryType::polynomial}, {"table", HistoryType::table}};
  return types.at(name);
}

void read_half_sine_end(Table& table, HistorySpec& spec) {
  if (table.has("end")) {
    if (table.has("duration")) table.fail("end", "cannot be combined with duration; give only one of them");
    return;
  }
  table.require("duration", " (half_sine: give duration or end)");
  spec.end = spec.start + table.number("duration");
  if (!(spec.end > spec.start))
    table.fail("duration",
               "too short: by rounding the end time is equal to the start time; expected a longer duration");
}

void read_span(Table& table, HistorySpec& spec) {
  if (spec.type == HistoryType::table) return;  // the times of a table define its start and end
  // A constant without start acts at all times. Recording the default start = 0 would make it act from 0 on only.
  const bool writes_start = table.has("start") || spec.type != HistoryType::constant;
  if (writes_start) spec.start = table.number("start");
  spec.start_given = writes_start;

  if (spec.type == HistoryType::half_sine) read_half_sine_end(table, spec);
  if (spec.type == HistoryType::rectangle || spec.type == HistoryType::triangle) {
    table.require("end", " (required for a " +
                             std::string(spec.type == HistoryType::triangle ? "triangle" : "rectangle") +
                             ")");
  }
  if (const auto end = table.optional_number("end")) {
    spec.end = *end;
    if (spec.end <= spec.start) {
      table.fail("end", fmt::format("found the number {}, expected a time after the start at {}",
                                    base::format_number(spec.end), base::format_number(spec.start)));
    }
  }
}

void read_harmonic(Table& table, HistorySpec& spec) {
  if (table.has("omega") && table.has("frequency")) {
    table.fail("frequency", "cannot be combined with omega; give only one of them");
  }
  if (const auto frequency = table.optional_number("frequency")) {
    spec.omega = 2.0 * std::numbers::pi * *frequency;
  } else {
    table.require("omega", " (give omega or frequency)");
    spec.omega = table.number("omega");
  }
  spec.phase = table.number("phase");
}

/// One second in the scene's unit of time.
double second_in(const Units& units) { return units.time == "ms" ? 1000.0 : 1.0; }

/// One m/s^2 in the scene's units.
double metric_acceleration(const Units& units) {
  const double metre = units.length == "mm" ? 1000.0 : 1.0;
  return metre / (second_in(units) * second_in(units));
}

/// Use of a history. load: the amplitude is a key of the load, not of the history; acceleration: values may be in g.
enum class Role { load, standalone, acceleration };

/// Reads column and time_step, the layout of the file. The caller records these keys together with the file.
TableLayout read_layout(Table& table, const std::filesystem::path& path) {
  TableLayout layout;
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  layout.peer = extension == ".at2";
  for (const char* key : {"column", "time_step"})
    if (layout.peer && table.has(key))
      table.fail(key, "has no meaning for a PEER file, whose format defines it");
  if (table.has("column") && table.has("time_step"))
    table.fail("column", "cannot be combined with time_step; give only one of them");
  if (const toml::node* node = table.raw("column")) {
    constexpr int most_columns = 100;
    const auto* number = node->as_integer();
    if (!number || number->get() < 2 || number->get() > most_columns)
      table.wrong("column", fmt::format("an integer from 2 to {}", most_columns));
    layout.column = static_cast<int>(number->get());
  }
  if (const toml::node* node = table.raw("time_step")) {
    layout.time_step = finite_number(*node, table.path("time_step"), "a number > 0");
    if (!(layout.time_step > 0.0)) table.wrong("time_step", "a number > 0");
  }
  return layout;
}

/// Reads the file's values in the scene's units, or in g if the scene has `unit`.
void read_table_file(Table& table, HistorySpec& spec, Role role, const Scene& scene) {
  // Limit of the rows in run.toml; for a larger table run.toml names the file.
  constexpr std::size_t most_inline_rows = 10'000;
  for (const char* other : {"times", "values"}) {
    if (table.has(other)) table.fail(other, "cannot be combined with file; give only one of them");
  }
  const toml::node* node = table.raw("file");
  if (!node->is_string()) table.wrong("file", "the name of a file");
  const std::filesystem::path path = directory_of(scene) / node->as_string()->get();
  std::ifstream in = open_data_file(table, "file", path);
  TableLayout layout = read_layout(table, path);
  layout.unit_given = table.has("unit");
  layout.second = second_in(scene.units);
  TimeTable rows = read_time_table(in, path.string(), table.path("file"), layout);
  if (rows.unit && role != Role::acceleration)
    table.fail("file",
               "found a record of acceleration, which only an acceleration can use; expected a file of "
               "values in the scene's units");
  if (rows.unit && !rows.in_g && table.has("unit"))
    table.fail("unit", "found \"g\", expected no unit: the file gives its values in another unit");
  if (rows.unit && !table.has("unit")) {
    for (double& value : rows.values) value *= *rows.unit * metric_acceleration(scene.units);
  }
  spec.times = std::move(rows.times);
  spec.values = std::move(rows.values);
  if (spec.times.size() > most_inline_rows) {
    table.record("file", toml_string(std::filesystem::absolute(path).lexically_normal().string()));
    if (layout.column != 0) table.record("column", std::to_string(layout.column));
    if (layout.time_step > 0.0 && !layout.peer) table.record("time_step", toml_number(layout.time_step));
    return;
  }
  table.record("times", toml_numbers(spec.times));
  table.record("values", toml_numbers(spec.values));
}

void read_table(Table& table, HistorySpec& spec, Role role, const Scene& scene) {
  spec.steffen = table.choice("interpolation") == "steffen";
  if (table.has("hold")) spec.hold = table.flag("hold");
  if (table.has("file")) {
    read_table_file(table, spec, role, scene);
    return;
  }
  table.require("times", " (table: give times and values, or file)");
  table.require("values", " (required with times)");
  spec.times = *table.numbers("times");
  spec.values = *table.numbers("values");
  if (spec.times.empty()) table.wrong("times", "at least one time");
  if (spec.values.size() != spec.times.size()) {
    table.fail("values", fmt::format("found {} for {}, expected one value for each time",
                                     base::count_text(spec.values.size(), "value"),
                                     base::count_text(spec.times.size(), "time")));
  }
  for (std::size_t i = 1; i < spec.times.size(); ++i) {
    if (spec.times[i] < spec.times[i - 1]) {
      table.fail("times",
                 fmt::format("found {} after {}, expected ascending times",
                             base::format_number(spec.times[i]), base::format_number(spec.times[i - 1])));
    }
    if (i > 1 && spec.times[i] == spec.times[i - 2]) {
      table.fail("times", fmt::format("found time {} three times, expected it at most twice (a jump)",
                                      base::format_number(spec.times[i])));
    }
  }
}

/// Reads period and shift, and sets the number of repetitions of the shape before t_end.
void read_period(Table& table, HistorySpec& spec, double t_end) {
  spec.shift = table.optional_number("shift").value_or(0.0);
  const auto period = table.optional_number("period");
  if (!period) return;
  const bool tabulated = spec.type == HistoryType::table;
  if (!tabulated && !spec.start_given)
    table.fail("period", "needs a start, because the first period begins there");
  const double start = tabulated ? spec.times.front() : spec.start;
  const double length = (tabulated ? spec.times.back() : std::isinf(spec.end) ? start : spec.end) - start;
  if (*period < length * (1.0 - rounding::few_operations))
    table.fail("period", fmt::format("found the number {}, expected at least {}, the duration of the shape",
                                     base::format_number(*period), base::format_number(length)));
  constexpr double most_pieces = 1e5;
  const double first = start + spec.shift;
  const double rounds = std::max(1.0, std::ceil((t_end - first) / *period));
  const double each = tabulated ? static_cast<double>(spec.times.size()) : 3.0;
  if (!(rounds * each <= most_pieces))
    table.fail("period",
               fmt::format(
                   "found the number {}, which gives {:.3g} pieces up to t_end = {}, expected at most {:.3g}",
                   base::format_number(*period), rounds * each, base::format_number(t_end), most_pieces));
  spec.period = *period;
  spec.rounds = static_cast<int>(rounds);
}

/// The unit g applies to the whole history, including its offset.
void read_unit(Table& table, HistorySpec& spec, Role role, const Units& units) {
  if (!table.has("unit")) return;
  if (role != Role::acceleration)
    table.fail("unit", "has no meaning here: only accelerations are given in g");
  static_cast<void>(table.choice("unit"));
  const double g = standard_gravity * metric_acceleration(units);
  spec.offset *= g;
  spec.amplitude *= g;
}

HistorySpec read_history(Table& parent, std::string_view key, Role role, const Scene& scene) {
  const toml::node* node = parent.raw(key);
  if (node && !node->is_table()) parent.wrong(key, describe_type(*find_key("loads[]", "history")));
  Table table(node ? node->as_table() : nullptr, "history", parent.path(key), parent.place(key));

  HistorySpec spec;
  spec.place = table.place();
  // Without a history the shape is constant.
  const std::string type = node ? table.choice("type") : "constant";
  if (!node) table.record("type", toml_string(type));
  spec.type = type_of(type);
  if (role != Role::load) {
    spec.offset = table.number("offset");
    spec.amplitude = table.number("amplitude");
  } else {
    for (const char* outside : {"offset", "amplitude"}) {
      if (table.has(outside))
        table.fail(outside, "has no meaning in a load's history; the load has its own amplitude");
    }
  }
  read_span(table, spec);
  if (spec.type == HistoryType::harmonic) read_harmonic(table, spec);
  if (spec.type == HistoryType::table) read_table(table, spec, role, scene);
  if (spec.type == HistoryType::polynomial) {
    table.require("coefficients", " (required for type = \"polynomial\")");
    spec.coefficients = *table.numbers("coefficients");
    constexpr std::size_t most = 32;
    if (spec.coefficients.empty() || spec.coefficients.size() > most) {
      table.wrong("coefficients", fmt::format("1 to {} coefficients", most));
    }
  }
  read_period(table, spec, scene.run.t_end);
  read_unit(table, spec, role, scene.units);
  table.finish(fmt::format("has no meaning for a history of type \"{}\"", type));
  parent.record(key, table.record().inline_table());
  return spec;
}

}  // namespace

HistorySpec constant_history(double value) {
  HistorySpec spec;
  spec.amplitude = value;
  return spec;
}

HistorySpec read_load_history(Table& table, std::string_view key, const Scene& scene) {
  return read_history(table, key, Role::load, scene);
}

HistorySpec read_number_or_history(Table& table, std::string_view key, const Scene& scene) {
  const toml::node* node = table.raw(key);
  if (node && node->is_table()) return read_history(table, key, Role::standalone, scene);
  if (node && !node->is_number()) table.wrong(key, "a number or a table { type = ... }");
  HistorySpec spec = constant_history(table.optional_number(key).value_or(0.0));
  spec.place = table.place(key);
  return spec;
}

HistorySpec read_acceleration(Table& table, std::string_view key, const Scene& scene) {
  const toml::node* node = table.raw(key);
  if (node && node->is_table()) return read_history(table, key, Role::acceleration, scene);
  return read_number_or_history(table, key, scene);
}

}  // namespace signorini::scene
