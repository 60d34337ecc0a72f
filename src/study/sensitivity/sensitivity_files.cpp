#include "study/sensitivity/sensitivity_files.hpp"

#include <fmt/core.h>

#include <cmath>

#include "base/json.hpp"
#include "result/csv.hpp"
#include "result/units_json.hpp"

namespace signorini {
namespace {

namespace fs = std::filesystem;

std::optional<double> known(double x) { return std::isfinite(x) ? std::optional(x) : std::nullopt; }
Json json_number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

std::string event_table(const Sensitivities& s) {
  CsvBlock block;
  for (const char* name : {"event_index", "t", "contact", "event", "parameter"}) block.text(name);
  for (const EventRateColumn& column : event_rate_columns) block.text(column.name);
  block.text("elasticity").end_row();
  for (std::size_t i = 0; i < s.events.size(); ++i)
    for (std::size_t p = 0; p < s.parameters.size(); ++p) {
      const Event& event = s.events[i];
      block.text(std::to_string(i + 1))
          .number(event.t)
          .text(contact_of(s, event))
          .text(to_string(event.type));
      block.text(s.parameters[p].path);
      for (const EventRateColumn& column : event_rate_columns)
        block.number(known(s.event_rates[i][p].*column.value));
      block.number(known(elasticity(s.parameters[p].value, event.t, s.event_rates[i][p].t))).end_row();
    }
  return block.str();
}

std::string figure_table(const Sensitivities& s) {
  CsvBlock block;
  for (const char* name :
       {"figure", "contact", "value", "t", "parameter", "dvalue_dp", "dt_dp", "elasticity"})
    block.text(name);
  block.end_row();
  for (const Response& r : s.responses)
    for (std::size_t p = 0; p < s.parameters.size(); ++p) {
      block.text(r.name).text(contact_of(s, r)).number(r.value).number(r.t);
      block.text(s.parameters[p].path).number(known(r.rates[p])).number(known(r.t_rates[p]));
      block.number(known(elasticity(s.parameters[p].value, r.value, r.rates[p]))).end_row();
    }
  return block.str();
}

std::string landing_table(const Sensitivities& s) {
  CsvBlock block;
  for (const char* name : {"contact", "landing", "start", "end", "impulse", "peak_force", "parameter",
                           "dstart_dp", "dend_dp", "dimpulse_dp", "dpeak_force_dp"})
    block.text(name);
  block.end_row();
  int number = 0;
  for (std::size_t i = 0; i < s.landings.size(); ++i) {
    const MovingLanding& landing = s.landings[i];
    number = i > 0 && s.landings[i - 1].contact == landing.contact ? number + 1 : 1;
    for (std::size_t p = 0; p < s.parameters.size(); ++p) {
      block.text(s.contacts[static_cast<std::size_t>(landing.contact)]).text(std::to_string(number));
      const Landing& l = landing.value;
      for (const double x : {l.start, l.end, l.impulse, l.peak_force}) block.number(x);
      block.text(s.parameters[p].path);
      const LandingRates& rates = landing.rates[p];
      for (const double x : {rates.start, rates.end, rates.impulse, rates.peak_force}) block.number(known(x));
      block.end_row();
    }
  }
  return block.str();
}

const char* kind_of(const Swap& swap) { return swap.vanish ? "vanish" : "swap"; }

std::string sequence_table(const Sensitivities& s) {
  CsvBlock block;
  for (const char* name : {"parameter", "value", "change", "kind", "first", "second", "t"}) block.text(name);
  block.end_row();
  for (const Swap& swap : least_swaps(s))
    block.text(s.parameters[swap.parameter].path)
        .number(s.parameters[swap.parameter].value)
        .number(swap.change)
        .text(kind_of(swap))
        .text(std::to_string(swap.first + 1))
        .text(std::to_string(swap.second + 1))
        .number(s.events[swap.first].t)
        .end_row();
  return block.str();
}

std::string column_table(const Sensitivities& s, std::size_t p) {
  CsvBlock block;
  block.text("t");
  for (const std::string& name : s.columns) block.text(name);
  block.end_row();
  for (std::size_t i = 0; i < s.times.size(); ++i) {
    block.number(s.times[i]);
    for (const double x : s.value_rates[p][i]) block.number(known(x));
    block.end_row();
  }
  return block.str();
}

std::string spread_table(const Sensitivities& s, const Spread& spread) {
  CsvBlock block;
  for (const char* name : {"what", "contact", "value", "sigma"}) block.text(name);
  block.end_row();
  for (std::size_t i = 0; i < s.events.size(); ++i)
    block.text(fmt::format("t of event {}", i + 1))
        .text(contact_of(s, s.events[i]))
        .number(s.events[i].t)
        .number(known(spread.events[i]))
        .end_row();
  for (std::size_t i = 0; i < s.responses.size(); ++i)
    block.text(s.responses[i].name)
        .text(contact_of(s, s.responses[i]))
        .number(s.responses[i].value)
        .number(known(spread.responses[i]))
        .end_row();
  return block.str();
}

}  // namespace

std::string unit_of(const Response& figure, const Units& units) {
  if (figure.name == "peak N" || figure.name == "peak T") return units.force;
  const bool work = figure.name.starts_with("lost by") || figure.name.starts_with("work of");
  return work ? units.force + " " + units.length : units.length;
}

double elasticity(double p, double x, double rate) {
  return p != 0.0 && x != 0.0 ? p / x * rate : EventRates::none;
}

std::string contact_of(const Sensitivities& s, const Event& event) {
  return event.contact < 0 ? "" : s.contacts[static_cast<std::size_t>(event.contact)];
}

std::string contact_of(const Sensitivities& s, const Response& figure) {
  return figure.contact < 0 ? "" : s.contacts[static_cast<std::size_t>(figure.contact)];
}

std::string sensitivity_json(const Sensitivities& s, const Sigmas& sigmas) {
  Json json = {{"title", s.title}, {"units", units_json(s.units)}, {"events", s.events.size()}};
  json["outcome"] = s.report.outcome.reason.empty() ? "done" : s.report.outcome.reason;
  const Method& method = s.report.method;
  json["settings"] = {{"engine", to_string(method.engine)}, {"engine_reason", method.reason}};
  if (!method.flow.empty()) {
    json["settings"]["flow"] = method.flow;
    json["settings"]["flow_reason"] = method.flow_reason;
  }
  json["stretches"] = {{"modes", s.stretches.modes},
                       {"series", s.stretches.series},
                       {"followed", s.stretches.followed},
                       {"taken", s.stretches.taken},
                       {"correction", s.stretches.correction}};
  json["wall_time"] = s.report.wall_time;
  json["parameters"] = Json::array();
  const std::vector<Swap> swaps = least_swaps(s);
  std::optional<Spread> spreads;
  if (!sigmas.empty()) spreads = spread(s, sigmas);
  for (std::size_t p = 0; p < s.parameters.size(); ++p) {
    const Parameter& parameter = s.parameters[p];
    Json row = {{"path", parameter.path}, {"value", parameter.value}, {"step", parameter.step}};
    row["until"] = json_number(parameter.until);
    row["reason"] = parameter.reason;
    row["sequence_changes"] = Json::array();
    for (const Swap& swap : swaps)
      if (swap.parameter == p)
        row["sequence_changes"].push_back({{"change", swap.change},
                                           {"events", {swap.first + 1, swap.second + 1}},
                                           {"kind", kind_of(swap)}});
    if (spreads) {
      row["sigma"] = sigmas[p];
      row["reach"] = json_number(spreads->reach[p]);
    }
    json["parameters"].push_back(std::move(row));
  }
  json["warnings"] = s.report.warnings;
  return json_text(json);
}

void write_sensitivities(const fs::path& directory, const Sensitivities& s, const Sigmas& sigmas) {
  write_file(directory / "sensitivities.csv", event_table(s));
  write_file(directory / "figures.csv", figure_table(s));
  write_file(directory / "sequence.csv", sequence_table(s));
  if (!s.landings.empty()) write_file(directory / "landings.csv", landing_table(s));
  for (std::size_t p = 0; p < s.parameters.size(); ++p)
    write_file(directory / fmt::format("columns-{}.csv", p + 1), column_table(s, p));
  if (!sigmas.empty()) write_file(directory / "spread.csv", spread_table(s, spread(s, sigmas)));
}

}  // namespace signorini
