// Histories: offset + amplitude * shape(t); shape(t) is zero before start and from end on.
#include <fmt/core.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "scene/data_file.hpp"
#include "scene/readers.hpp"
#include "scene/time_table.hpp"

namespace signorini::scene {

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

/// One m/s^2, m/s or m in the scene's units.
double metric(RecordQuantity quantity, const Units& units) {
  const double metre = units.length == "mm" ? 1000.0 : 1.0, second = second_in(units);
  return quantity == RecordQuantity::acceleration ? metre / (second * second)
         : quantity == RecordQuantity::velocity   ? metre / second
                                                  : metre;
}

/// Use of a history.
struct HistoryRole {
  bool of_load = false;                            ///< the amplitude is a key of the load, not of the history
  RecordQuantity quantity = RecordQuantity::none;  ///< quantity of records that it takes, and of `unit`
};

/// The unit that the scene gives; empty without one. Units of another quantity are refused.
std::optional<RecordUnit> read_unit_name(Table& table, HistoryRole role) {
  if (!table.has("unit")) return std::nullopt;
  if (role.quantity == RecordQuantity::none)
    table.fail("unit", "has no meaning here: only accelerations, motions and velocities have a unit");
  const std::optional<RecordUnit> unit = record_unit(table.choice("unit"));
  if (!unit || unit->quantity != role.quantity)
    table.wrong("unit", fmt::format("a unit of {}, because the history is one", name_of(role.quantity)));
  return unit;
}

/// Reads column and time_step, the layout of the file. The caller records these keys together with the file.
TableLayout read_layout(Table& table, const std::filesystem::path& path, HistoryRole role) {
  TableLayout layout;
  layout.wanted = role.quantity;
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  layout.by_name = extension == ".at2"   ? RecordQuantity::acceleration
                   : extension == ".vt2" ? RecordQuantity::velocity
                   : extension == ".dt2" ? RecordQuantity::displacement
                                         : RecordQuantity::none;
  layout.peer = layout.by_name != RecordQuantity::none;
  if (layout.peer && table.has("column"))
    table.fail("column", "has no meaning for a PEER file, whose format defines it");
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

/// Refuses a unit in the scene that the header of the record contradicts.
void check_unit(const Table& table, const std::optional<RecordUnit>& given,
                const std::optional<RecordUnit>& stated) {
  if (given && stated && given->si != stated->si)
    table.fail("unit", fmt::format("found \"{}\", expected no unit: the file gives its values in {}",
                                   given->name, stated->name));
}

/// Reads the file's values in the scene's units, or in the unit that the scene gives.
void read_table_file(Table& table, HistorySpec& spec, HistoryRole role,
                     const std::optional<RecordUnit>& given, const Scene& scene) {
  // Limit of the rows in run.toml; for a larger table run.toml names the file.
  constexpr std::size_t most_inline_rows = 10'000;
  for (const char* other : {"times", "values"}) {
    if (table.has(other)) table.fail(other, "cannot be combined with file; give only one of them");
  }
  const toml::node* node = table.raw("file");
  if (!node->is_string()) table.wrong("file", "the name of a file");
  const std::filesystem::path path = directory_of(scene) / node->as_string()->get();
  std::ifstream in = open_data_file(table, "file", path);
  TableLayout layout = read_layout(table, path, role);
  layout.unit_given = given.has_value();
  layout.second = second_in(scene.units);
  TimeTable rows = read_time_table(in, path.string(), table.path("file"), layout);
  check_unit(table, given, rows.unit);
  if (rows.unit && !given)
    for (double& value : rows.values) value *= rows.unit->si * metric(role.quantity, scene.units);
  spec.times = std::move(rows.times);
  spec.values = std::move(rows.values);
  if (spec.times.size() > most_inline_rows) {
    table.record("file", toml_string(std::filesystem::absolute(path).lexically_normal().string()));
    if (layout.column != 0) table.record("column", std::to_string(layout.column));
    if (layout.time_step > 0.0) table.record("time_step", toml_number(layout.time_step));
    return;
  }
  table.record("times", toml_numbers(spec.times));
  table.record("values", toml_numbers(spec.values));
}

void read_table(Table& table, HistorySpec& spec, HistoryRole role, const std::optional<RecordUnit>& unit,
                const Scene& scene) {
  spec.steffen = table.choice("interpolation") == "steffen";
  if (table.has("hold")) spec.hold = table.flag("hold");
  if (table.has("file")) {
    read_table_file(table, spec, role, unit, scene);
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

/// The unit applies to the whole history, including its offset.
void apply_unit(HistorySpec& spec, HistoryRole role, const std::optional<RecordUnit>& unit,
                const Units& units) {
  if (!unit) return;
  const double factor = unit->si * metric(role.quantity, units);
  spec.offset *= factor;
  spec.amplitude *= factor;
}

HistorySpec read_history(Table& parent, std::string_view key, HistoryRole role, const Scene& scene) {
  const toml::node* node = parent.raw(key);
  if (node && !node->is_table()) parent.wrong(key, describe_type(*find_key("loads[]", "history")));
  Table table(node ? node->as_table() : nullptr, "history", parent.path(key), parent.place(key));

  HistorySpec spec;
  spec.place = table.place();
  // Without a history the shape is constant.
  const std::string type = node ? table.choice("type") : "constant";
  if (!node) table.record("type", toml_string(type));
  spec.type = type_of(type);
  if (!role.of_load) {
    spec.offset = table.number("offset");
    spec.amplitude = table.number("amplitude");
  } else {
    for (const char* outside : {"offset", "amplitude"}) {
      if (table.has(outside))
        table.fail(outside, "has no meaning in a load's history; the load has its own amplitude");
    }
  }
  const std::optional<RecordUnit> unit = read_unit_name(table, role);
  read_span(table, spec);
  if (spec.type == HistoryType::harmonic) read_harmonic(table, spec);
  if (spec.type == HistoryType::table) read_table(table, spec, role, unit, scene);
  if (spec.type == HistoryType::polynomial) {
    table.require("coefficients", " (required for type = \"polynomial\")");
    spec.coefficients = *table.numbers("coefficients");
    constexpr std::size_t most = 32;
    if (spec.coefficients.empty() || spec.coefficients.size() > most) {
      table.wrong("coefficients", fmt::format("1 to {} coefficients", most));
    }
  }
  read_period(table, spec, scene.run.t_end);
  apply_unit(spec, role, unit, scene.units);
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
  return read_history(table, key, {true, RecordQuantity::none}, scene);
}

HistorySpec read_number_or_history(Table& table, std::string_view key, const Scene& scene,
                                   RecordQuantity quantity) {
  const toml::node* node = table.raw(key);
  if (node && node->is_table()) return read_history(table, key, {false, quantity}, scene);
  if (node && !node->is_number()) table.wrong(key, "a number or a table { type = ... }");
  HistorySpec spec = constant_history(table.optional_number(key).value_or(0.0));
  spec.place = table.place(key);
  return spec;
}

}  // namespace signorini::scene
