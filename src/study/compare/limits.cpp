#include "study/compare/limits.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/number.hpp"
#include "base/suggest.hpp"
#include "signorini/error.hpp"

namespace signorini {

namespace {

constexpr const char* sequence = "sequence";
const std::string response = "response:";  // and the name of an [[output]]

std::vector<std::string> limit_names() {
  std::vector<std::string> names = quantity_names();
  names.emplace_back(sequence);
  return names;
}

}  // namespace

std::vector<std::string> quantity_names() {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities({}, {})) names.push_back(quantity.name);
  return names;
}

std::vector<Limit> parse_limits(const std::vector<std::string>& texts) {
  const std::vector<std::string> names = limit_names();
  std::vector<Limit> limits;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw UsageError("--limit " + text + ": expected NAME=NUMBER, such as event_time=1e-4");
    const std::string name = text.substr(0, equals);
    const bool of_output = name.starts_with(response) && name != response;
    if (!of_output && std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError(fmt::format("--limit {}: no quantity \"{}\"{}", text, name, suggestion(name, names)));
    const std::optional<double> value = parse_number(text.substr(equals + 1));
    if (!value || !(*value >= 0.0))
      throw UsageError(
          fmt::format("--limit {}: found \"{}\", expected a number >= 0", text, text.substr(equals + 1)));
    if (std::any_of(limits.begin(), limits.end(), [&](const Limit& l) { return l.name == name; }))
      throw UsageError("--limit " + text + ": \"" + name + "\" has a limit already");
    limits.push_back({name, *value});
  }
  return limits;
}

std::vector<Quantity> quantities(const Comparison& c, const Units& units) {
  const std::string &length = units.length, &time = units.time, &force = units.force;
  std::vector<Quantity> list = {{"event_time", time, &c.event_time},
                                {"displacement", length, &c.displacement},
                                {"rotation", "rad", &c.rotation},
                                {"velocity", length + "/" + time, &c.velocity},
                                {"angular_velocity", "rad/" + time, &c.angular_velocity},
                                {"force", force, &c.force},
                                {"force_away", force, &c.force_away},
                                {"energy", force + " " + length, &c.energy}};
  for (const Comparison::Response& r : c.response) list.push_back({response + r.name, r.unit, &r.deviation});
  return list;
}

std::vector<std::string> exceeded(const std::vector<Limit>& limits, const RunFigures& reference,
                                  const RunFigures& other, const Comparison& comparison) {
  std::vector<std::string> list;
  if (limits.empty()) return list;
  for (const RunFigures* run : {&reference, &other}) {
    if (run->done()) continue;
    list.push_back(fmt::format("{}: {} at t = {:.9g}, so no limit is kept beyond", run->name,
                               run->facts.outcome, run->t));
  }
  const auto& split = comparison.alignment.split;
  const bool sequence_limited =
      std::any_of(limits.begin(), limits.end(), [](const Limit& l) { return l.name == sequence; });
  for (const Limit& limit : limits) {
    if (limit.name == "event_time" && split && !sequence_limited)
      list.push_back(
          fmt::format("{}: {} from t = {:.9g} on have no partner whose time could keep event_time {}",
                      other.name, count_of(split->unaligned, "event"), split->t, shortest(limit.value)));
    if (limit.name == sequence) {
      const std::size_t unaligned = split ? split->unaligned : 0;
      if (static_cast<double>(unaligned) <= limit.value) continue;
      list.push_back(fmt::format("{}: sequence parts at t = {:.9g}, {} from there on exceed {}", other.name,
                                 split->t, count_of(unaligned, "event"), shortest(limit.value)));
      continue;
    }
    const std::vector<Quantity> known = quantities(comparison, reference.facts.units);
    if (std::none_of(known.begin(), known.end(), [&](const Quantity& q) { return q.name == limit.name; }))
      list.push_back(
          fmt::format("{}: {} has a limit, and not both runs have such an output", other.name, limit.name));
    for (const Quantity& quantity : known) {
      if (quantity.name != limit.name) continue;
      const Greatest& greatest = quantity.deviation->whole;
      // No events, or no such columns, is no failure; no common output time is.
      const bool nothing = quantity.name != "event_time" && comparison.common_times < 2;
      if (nothing)
        list.push_back(
            fmt::format("{}: {} has a limit, and no output times to compare", other.name, limit.name));
      else if (!(greatest.value <= limit.value))
        list.push_back(fmt::format("{}: {} {:.6g} {} at t = {:.9g} ({}) exceeds {}", other.name, limit.name,
                                   greatest.value, quantity.unit, greatest.t, greatest.where,
                                   shortest(limit.value)));
    }
  }
  return list;
}

}  // namespace signorini
