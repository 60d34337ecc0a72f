#include "study/sensitivity/fit_files.hpp"

#include <cmath>
#include <numeric>

#include "base/json.hpp"
#include "result/table.hpp"

namespace signorini {

namespace {

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(); }

}  // namespace

std::string fit_json(const Fit& fit, const Measurements& measured) {
  Json json = {{"converged", fit.converged},   {"reason", fit.reason},
               {"iterations", fit.iterations}, {"runs", fit.runs},
               {"rows", measured.rows.size()}, {"chi_squared", fit.chi_squared}};
  json["sigma_given"] = measured.has_sigma;
  json["freedom"] = fit.freedom;
  json["probability"] = number_or_null(fit.probability);
  json["doubts"] = fit.doubts;
  json["keys"] = Json::array();
  for (const FittedKey& key : fit.keys)
    json["keys"].push_back({{"path", key.path},
                            {"start", key.start},
                            {"value", number_or_null(key.value)},
                            {"sigma", number_or_null(key.sigma)}});
  json["covariance"] = Json::array();
  for (const std::vector<double>& row : fit.covariance) {
    Json numbers = Json::array();
    for (const double x : row) numbers.push_back(number_or_null(x));
    json["covariance"].push_back(numbers);
  }
  return json_text(json);
}

void write_fit(const std::filesystem::path& directory, const Fit& fit, const Measurements& measured) {
  const auto of_event = [&](std::size_t i) { return measured.rows[i].event > 0; };
  const auto given = [&](std::size_t i, double value) {
    return of_event(i) ? std::nullopt : std::optional(value);
  };
  const CsvTable<std::size_t> table = {
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
  write_file(directory / "residuals.csv", table.text(rows));
  write_file(directory / "fit.json", fit_json(fit, measured));
}

}  // namespace signorini
