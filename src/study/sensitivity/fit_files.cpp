#include "study/sensitivity/fit_files.hpp"

#include <cmath>

#include "base/json.hpp"
#include "result/csv.hpp"

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
  CsvBlock block;
  for (const char* name : {"row", "event_index", "column", "t", "measured", "residual", "sigma"})
    block.text(name);
  block.end_row();
  for (std::size_t i = 0; i < measured.rows.size(); ++i) {
    const Measurement& m = measured.rows[i];
    block.text(std::to_string(i + 1));
    if (m.event > 0)
      block.text(std::to_string(m.event)).empty().empty();
    else
      block.empty().text(m.column).number(m.t);
    block.number(m.value);
    if (std::isfinite(fit.residuals[i]))
      block.number(fit.residuals[i]);
    else
      block.empty();
    if (measured.has_sigma)
      block.number(m.sigma);
    else
      block.empty();
    block.end_row();
  }
  write_file(directory / "residuals.csv", block.str());
  write_file(directory / "fit.json", fit_json(fit, measured));
}

}  // namespace signorini
