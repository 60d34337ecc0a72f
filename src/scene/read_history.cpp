// Histories: offset + amplitude * shape(t), the shape zero before start and from end on.
#include <fmt/core.h>

#include <map>
#include <numbers>

#include "base/number.hpp"
#include "scene/data_file.hpp"
#include "scene/readers.hpp"

namespace signorini {

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
    if (table.has("duration")) table.fail("end", "stands beside duration, expected one of the two");
    return;
  }
  table.require("duration", " (half_sine; or end)");
  spec.end = spec.start + table.number("duration");
  if (!(spec.end > spec.start)) table.fail("duration", "too short to end after the start");
}

void read_span(Table& table, HistorySpec& spec) {
  if (spec.type == HistoryType::table) return;  // its times say where it starts and ends
  // A constant without start is a load that has always been there: writing down its default would start it.
  const bool writes_start = table.has("start") || spec.type != HistoryType::constant;
  if (writes_start) spec.start = table.number("start");
  spec.start_given = writes_start;

  if (spec.type == HistoryType::half_sine) read_half_sine_end(table, spec);
  if (spec.type == HistoryType::rectangle || spec.type == HistoryType::triangle) {
    table.require("end",
                  " (" + std::string(spec.type == HistoryType::triangle ? "triangle" : "rectangle") + ")");
  }
  if (const auto end = table.optional_number("end")) {
    spec.end = *end;
    if (spec.end <= spec.start) {
      table.fail("end", fmt::format("found the number {}, expected a time after the start at {}",
                                    shortest(spec.end), shortest(spec.start)));
    }
  }
}

void read_harmonic(Table& table, HistorySpec& spec) {
  if (table.has("omega") && table.has("frequency")) {
    table.fail("frequency", "stands beside omega, expected one of the two");
  }
  if (const auto frequency = table.optional_number("frequency")) {
    spec.omega = 2.0 * std::numbers::pi * *frequency;
  } else {
    table.require("omega", " (or frequency)");
    spec.omega = table.number("omega");
  }
  spec.phase = table.number("phase");
}

void read_table_file(Table& table, HistorySpec& spec, const std::filesystem::path& directory) {
  constexpr std::size_t most_inline_rows = 10'000;  // a larger table stays in its file in run.toml
  for (const char* other : {"times", "values"}) {
    if (table.has(other)) table.fail(other, "stands beside file, expected one of the two");
  }
  const toml::node* node = table.raw("file");
  if (!node->is_string()) table.wrong("file", "the name of a file");
  const std::filesystem::path path = directory / node->as_string()->get();
  std::ifstream in = open_data_file(table, "file", path);
  TimeTable rows = read_time_table(in, path.string(), table.path("file"));
  spec.times = std::move(rows.times);
  spec.values = std::move(rows.values);
  if (spec.times.size() > most_inline_rows) {
    table.record("file", toml_string(std::filesystem::absolute(path).lexically_normal().string()));
    return;
  }
  table.record("times", toml_numbers(spec.times));
  table.record("values", toml_numbers(spec.values));
}

void read_table(Table& table, HistorySpec& spec, const std::filesystem::path& directory) {
  spec.steffen = table.choice("interpolation") == "steffen";
  if (table.has("file")) {
    read_table_file(table, spec, directory);
    return;
  }
  table.require("times", " (table; or file)");
  table.require("values", " (table)");
  spec.times = *table.numbers("times");
  spec.values = *table.numbers("values");
  if (spec.times.empty()) table.wrong("times", "at least one time");
  if (spec.values.size() != spec.times.size()) {
    table.fail("values",
               fmt::format("found {}, expected one for each of the {}", count_of(spec.values.size(), "value"),
                           count_of(spec.times.size(), "time")));
  }
  for (std::size_t i = 1; i < spec.times.size(); ++i) {
    if (spec.times[i] < spec.times[i - 1]) {
      table.fail("times", fmt::format("found {} after {}, expected ascending times", shortest(spec.times[i]),
                                      shortest(spec.times[i - 1])));
    }
    if (i > 1 && spec.times[i] == spec.times[i - 2]) {
      table.fail("times", fmt::format("found {} three times, expected at most twice (a jump)",
                                      shortest(spec.times[i])));
    }
  }
}

HistorySpec read_history(Table& parent, std::string_view key, bool stands_alone,
                         const std::filesystem::path& directory) {
  const toml::node* node = parent.raw(key);
  if (node && !node->is_table()) parent.wrong(key, describe_type(*find_key("loads[]", "history")));
  Table table(node ? node->as_table() : nullptr, "history", parent.path(key), parent.place(key));

  HistorySpec spec;
  spec.place = table.place();
  // An absent history is a constant.
  const std::string type = node ? table.choice("type") : "constant";
  if (!node) table.record("type", toml_string(type));
  spec.type = type_of(type);
  if (stands_alone) {
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
  if (spec.type == HistoryType::table) read_table(table, spec, directory);
  if (spec.type == HistoryType::polynomial) {
    table.require("coefficients", " (polynomial)");
    spec.coefficients = *table.numbers("coefficients");
    constexpr std::size_t most = 32;
    if (spec.coefficients.empty() || spec.coefficients.size() > most) {
      table.wrong("coefficients", fmt::format("1 to {} coefficients", most));
    }
  }
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

HistorySpec read_load_history(Table& table, std::string_view key, const std::filesystem::path& directory) {
  return read_history(table, key, false, directory);
}

HistorySpec read_standing_history(Table& table, std::string_view key,
                                  const std::filesystem::path& directory) {
  const toml::node* node = table.raw(key);
  if (node && node->is_table()) return read_history(table, key, true, directory);
  if (node && !node->is_number()) table.wrong(key, "a number or a table { type = ... }");
  HistorySpec spec = constant_history(table.optional_number(key).value_or(0.0));
  spec.place = table.place(key);
  return spec;
}

}  // namespace signorini
