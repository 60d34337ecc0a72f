#include "study/sensitivity/sensitivity_files.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <numeric>

#include "base/files.hpp"
#include "base/json.hpp"
#include "result/csv.hpp"
#include "result/summary_parts.hpp"
#include "result/table.hpp"
#include "signorini/error.hpp"

namespace signorini::sensitivity_study {
namespace {

namespace fs = std::filesystem;

std::optional<double> known(double x) { return std::isfinite(x) ? std::optional(x) : std::nullopt; }
base::Json json_number(double x) { return std::isfinite(x) ? base::Json(x) : base::Json(nullptr); }

/// Row of a table: one event, figure or landing, with its derivatives with respect to one key.
template <class Figure>
struct KeyRow {
  const Figure& figure;
  std::size_t index, key;
};

template <class Figure>
std::vector<KeyRow<Figure>> rows_of(const std::vector<Figure>& figures, const Sensitivities& s) {
  std::vector<KeyRow<Figure>> rows;
  for (std::size_t i = 0; i < figures.size(); ++i)
    for (std::size_t p = 0; p < s.parameters.size(); ++p) rows.push_back({figures[i], i, p});
  return rows;
}

/// Text of sensitivities.csv.
std::string event_text(const Sensitivities& s) {
  using R = KeyRow<Event>;
  result::CsvTable<R> table = {{"event_index", [](const R& r) { return std::to_string(r.index + 1); }},
                               {"t", [](const R& r) { return r.figure.t; }},
                               {"contact", [&s](const R& r) { return contact_of(s, r.figure); }},
                               {"event", [](const R& r) { return to_string(r.figure.type); }},
                               {"parameter", [&s](const R& r) { return s.parameters[r.key].path; }}};
  for (const EventRateColumn& column : event_rate_columns)
    table.add(column.name,
              [&s, &column](const R& r) { return known(s.event_rates[r.index][r.key].*column.value); });
  table.add("elasticity", [&s](const R& r) {
    return known(elasticity(s.parameters[r.key].value, r.figure.t, s.event_rates[r.index][r.key].t));
  });
  return table.text(rows_of(s.events, s));
}

/// Text of figures.csv.
std::string figure_text(const Sensitivities& s) {
  using R = KeyRow<Response>;
  const result::CsvTable<R> table = {
      {"figure", [](const R& r) { return r.figure.name; }},
      {"contact", [&s](const R& r) { return contact_of(s, r.figure); }},
      {"value", [](const R& r) { return r.figure.value; }},
      {"t", [](const R& r) { return r.figure.t; }},
      {"parameter", [&s](const R& r) { return s.parameters[r.key].path; }},
      {"dvalue_dp", [](const R& r) { return known(r.figure.rates[r.key]); }},
      {"dt_dp", [](const R& r) { return known(r.figure.t_rates[r.key]); }},
      {"elasticity", [&s](const R& r) {
         return known(elasticity(s.parameters[r.key].value, r.figure.value, r.figure.rates[r.key]));
       }}};
  return table.text(rows_of(s.responses, s));
}

/// Text of landings.csv.
std::string landing_text(const Sensitivities& s) {
  using R = KeyRow<MovingLanding>;
  std::vector<int> numbers;  // number of each landing at its contact, from 1
  for (std::size_t i = 0; i < s.landings.size(); ++i)
    numbers.push_back(i > 0 && s.landings[i - 1].contact == s.landings[i].contact ? numbers.back() + 1 : 1);
  const result::CsvTable<R> table = {
      {"contact", [&s](const R& r) { return s.contacts[static_cast<std::size_t>(r.figure.contact)]; }},
      {"landing", [&numbers](const R& r) { return numbers[r.index]; }},
      {"start", [](const R& r) { return r.figure.value.start; }},
      {"end", [](const R& r) { return r.figure.value.end; }},
      {"impulse", [](const R& r) { return r.figure.value.impulse; }},
      {"peak_force", [](const R& r) { return r.figure.value.peak_force; }},
      {"parameter", [&s](const R& r) { return s.parameters[r.key].path; }},
      {"dstart_dp", [](const R& r) { return known(r.figure.rates[r.key].start); }},
      {"dend_dp", [](const R& r) { return known(r.figure.rates[r.key].end); }},
      {"dimpulse_dp", [](const R& r) { return known(r.figure.rates[r.key].impulse); }},
      {"dpeak_force_dp", [](const R& r) { return known(r.figure.rates[r.key].peak_force); }}};
  return table.text(rows_of(s.landings, s));
}

const char* kind_of(const SequenceChange& swap) { return swap.vanish ? "vanish" : "swap"; }

/// Text of sequence.csv.
std::string sequence_text(const Sensitivities& s) {
  const result::CsvTable<SequenceChange> table = {
      {"parameter", [&s](const SequenceChange& w) { return s.parameters[w.parameter].path; }},
      {"value", [&s](const SequenceChange& w) { return s.parameters[w.parameter].value; }},
      {"change", &SequenceChange::change},
      {"kind", kind_of},
      {"first", [](const SequenceChange& w) { return w.first + 1; }},
      {"second", [](const SequenceChange& w) { return w.second + 1; }},
      {"t", [&s](const SequenceChange& w) { return s.events[w.first].t; }}};
  return table.text(smallest_sequence_changes(s));
}

/// Text of columns-N.csv, N = p + 1: derivatives with respect to the p-th key.
std::string column_text(const Sensitivities& s, std::size_t p) {
  result::CsvTable<std::size_t> table = {{"t", [&s](std::size_t i) { return s.times[i]; }}};
  for (std::size_t j = 0; j < s.columns.size(); ++j)
    table.add(s.columns[j], [&s, p, j](std::size_t i) { return known(s.value_rates[p][i][j]); });
  std::vector<std::size_t> rows(s.times.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return table.text(rows);
}

/// An uncertain quantity and its standard deviation.
struct SpreadRow {
  std::string what, contact;
  double value, sigma;
};

/// Text of spread.csv.
std::string spread_text(const Sensitivities& s, const Spread& spread) {
  const result::CsvTable<SpreadRow> table = {{"what", &SpreadRow::what},
                                             {"contact", &SpreadRow::contact},
                                             {"value", &SpreadRow::value},
                                             {"sigma", [](const SpreadRow& r) { return known(r.sigma); }}};
  std::vector<SpreadRow> rows;
  for (std::size_t i = 0; i < s.events.size(); ++i)
    rows.push_back(
        {fmt::format("t of event {}", i + 1), contact_of(s, s.events[i]), s.events[i].t, spread.events[i]});
  for (std::size_t i = 0; i < s.responses.size(); ++i)
    rows.push_back(
        {s.responses[i].name, contact_of(s, s.responses[i]), s.responses[i].value, spread.responses[i]});
  return table.text(rows);
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
  base::Json json = {{"title", s.title}, {"units", result::units_json(s.units)}, {"events", s.events.size()}};
  json["outcome"] = s.report.outcome.reason.empty() ? "done" : s.report.outcome.reason;
  const Method& method = s.report.method;
  json["settings"] = {{"engine", to_string(method.engine)}, {"engine_reason", method.engine_reason()}};
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
  json["parameters"] = base::Json::array();
  const std::vector<SequenceChange> swaps = smallest_sequence_changes(s);
  std::optional<Spread> spreads;
  if (!sigmas.empty()) spreads = spread(s, sigmas);
  for (std::size_t p = 0; p < s.parameters.size(); ++p) {
    const Parameter& parameter = s.parameters[p];
    base::Json row = {{"path", parameter.path}, {"value", parameter.value}, {"step", parameter.step}};
    row["until"] = json_number(parameter.until);
    row["reason"] = parameter.reason;
    row["sequence_changes"] = base::Json::array();
    for (const SequenceChange& swap : swaps)
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
  return base::json_text(json);
}

void write_sensitivities(const fs::path& directory, const Sensitivities& s, const Sigmas& sigmas) {
  result::write_file(directory / "sensitivities.csv", event_text(s));
  result::write_file(directory / "figures.csv", figure_text(s));
  result::write_file(directory / "sequence.csv", sequence_text(s));
  if (!s.landings.empty()) result::write_file(directory / "landings.csv", landing_text(s));
  for (std::size_t p = 0; p < s.parameters.size(); ++p)
    result::write_file(directory / fmt::format("columns-{}.csv", p + 1), column_text(s, p));
  if (!sigmas.empty()) result::write_file(directory / "spread.csv", spread_text(s, spread(s, sigmas)));
}

namespace {

base::Json number_or_null(double x) { return std::isfinite(x) ? base::Json(x) : base::Json(); }

}  // namespace

std::string fit_json(const Fit& fit, const Measurements& measured) {
  base::Json json = {{"converged", fit.converged},   {"reason", fit.reason},
                     {"iterations", fit.iterations}, {"runs", fit.runs},
                     {"rows", measured.rows.size()}, {"chi_squared", fit.chi_squared}};
  json["sigma_given"] = measured.has_sigma;
  json["freedom"] = fit.freedom;
  json["probability"] = number_or_null(fit.probability);
  json["doubts"] = fit.issues;
  json["keys"] = base::Json::array();
  for (const FittedKey& key : fit.keys)
    json["keys"].push_back({{"path", key.path},
                            {"start", key.start},
                            {"value", number_or_null(key.value)},
                            {"sigma", number_or_null(key.sigma)}});
  json["covariance"] = base::Json::array();
  for (const std::vector<double>& row : fit.covariance) {
    base::Json numbers = base::Json::array();
    for (const double x : row) numbers.push_back(number_or_null(x));
    json["covariance"].push_back(numbers);
  }
  return base::json_text(json);
}

void write_fit(const std::filesystem::path& directory, const Fit& fit, const Measurements& measured) {
  const auto of_event = [&](std::size_t i) { return measured.rows[i].event > 0; };
  const auto given = [&](std::size_t i, double value) {
    return of_event(i) ? std::nullopt : std::optional(value);
  };
  const result::CsvTable<std::size_t> table = {
      {"row", [](std::size_t i) { return std::to_string(i + 1); }},
      {"event_index",
       [&](std::size_t i) { return of_event(i) ? std::to_string(measured.rows[i].event) : std::string(); }},
      {"column", [&](std::size_t i) { return of_event(i) ? std::string() : measured.rows[i].column; }},
      {"t", [&](std::size_t i) { return given(i, measured.rows[i].t); }},
      {"measured", [&](std::size_t i) { return measured.rows[i].value; }},
      {"residual",
       [&](std::size_t i) {
         return std::isfinite(fit.residuals[i]) ? std::optional(fit.residuals[i]) : std::nullopt;
       }},
      {"sigma", [&](std::size_t i) {
         return measured.has_sigma ? std::optional(measured.rows[i].sigma) : std::nullopt;
       }}};
  std::vector<std::size_t> rows(measured.rows.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  result::write_file(directory / "residuals.csv", table.text(rows));
  result::write_file(directory / "fit.json", fit_json(fit, measured));
}

// read_sensitivities(): reads the data for pictures.

namespace fs = std::filesystem;

namespace {

double rate_in(const result::CsvReader& reader, std::size_t column) {
  return reader.cell(column).empty() ? EventRates::none : reader.number(column);
}

/// Index of a contact in s.contacts, to which an unknown name is added; -1 for an empty name: a row of the whole run.
int contact_numbered(Sensitivities& s, const std::string& name) {
  if (name.empty()) return -1;
  const auto found = std::find(s.contacts.begin(), s.contacts.end(), name);
  if (found == s.contacts.end()) s.contacts.push_back(name);
  return static_cast<int>(std::find(s.contacts.begin(), s.contacts.end(), name) - s.contacts.begin());
}

void read_parameters(const fs::path& file, Sensitivities& s, Sigmas& sigmas) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string(), "cannot be read" + base::system_error_text(errno));
  try {
    const base::Json json = base::parse_json(stream);
    s.title = json.at("title");
    s.units = result::units_from(json.at("units"));
    for (const base::Json& row : json.at("parameters")) {
      Parameter& parameter = s.parameters.emplace_back();
      parameter.path = row.at("path");
      parameter.value = row.at("value");
      if (row.contains("sigma")) sigmas.push_back(row.at("sigma"));
    }
  } catch (const base::Json::exception& error) {
    throw FileError(file.string(), std::string("is not a file of `signorini sensitivity`: ") + error.what());
  }
  if (s.parameters.empty()) throw FileError(file.string(), "has no parameter, expected at least one");
  if (!sigmas.empty() && sigmas.size() != s.parameters.size())
    throw FileError(
        file.string(),
        fmt::format("has a sigma for {} of {} parameters, expected a sigma for all of them or for none",
                    sigmas.size(), s.parameters.size()));
}

}  // namespace

Sensitivities read_sensitivities(const fs::path& directory, Sigmas& sigmas) {
  Sensitivities s;
  sigmas.clear();
  read_parameters(directory / "sensitivity.json", s, sigmas);
  const std::size_t parameters = s.parameters.size();
  result::CsvReader figures(directory / "figures.csv");
  for (std::size_t row = 0; figures.next(); ++row) {
    if (row % parameters == 0) {
      Response& figure = s.responses.emplace_back();
      figure.name = figures.cell(figures.column("figure"));
      figure.contact = contact_numbered(s, figures.cell(figures.column("contact")));
      figure.value = figures.number(figures.column("value"));
      figure.rates.assign(parameters, EventRates::none);
    }
    s.responses.back().rates[row % parameters] = rate_in(figures, figures.column("dvalue_dp"));
  }
  result::CsvReader events(directory / "sensitivities.csv");
  for (std::size_t row = 0; events.next(); ++row) {
    if (row % parameters == 0) {
      Event& event = s.events.emplace_back();
      event.t = events.number(events.column("t"));
      event.contact = contact_numbered(s, events.cell(events.column("contact")));
      s.event_rates.emplace_back(parameters);
    }
    s.event_rates.back()[row % parameters].t = rate_in(events, events.column("dt_dp"));
  }
  return s;
}

namespace {

template <class RateOf>
double sigma_of(const Sigmas& sigmas, const RateOf& rate) {
  double sum = 0.0;
  for (std::size_t p = 0; p < sigmas.size(); ++p)
    if (sigmas[p] > 0.0) sum += rate(p) * sigmas[p] * rate(p) * sigmas[p];
  return std::sqrt(sum);
}

}  // namespace

Spread spread(const Sensitivities& s, const Sigmas& sigmas) {
  Spread result;
  for (const auto& rates : s.event_rates)
    result.events.push_back(sigma_of(sigmas, [&](std::size_t p) { return rates[p].t; }));
  for (const Response& r : s.responses)
    result.responses.push_back(sigma_of(sigmas, [&](std::size_t p) { return r.rates[p]; }));
  result.reach.assign(sigmas.size(), std::numeric_limits<double>::infinity());
  for (const SequenceChange& swap : smallest_sequence_changes(s))
    if (sigmas[swap.parameter] > 0.0)
      result.reach[swap.parameter] =
          std::min(result.reach[swap.parameter], std::abs(swap.change) / sigmas[swap.parameter]);
  return result;
}

}  // namespace signorini::sensitivity_study
