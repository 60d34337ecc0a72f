// fit.hpp: keys of a scene from what was measured.
//
//   minimise  sum_i ( (x_i(p) - m_i) / sigma_i )^2 over p         x_i: a time of an event, or a column at a time
//   covariance = (J^T J)^-1,  J_ij = (dx_i/dp_j) / sigma_i        J: the exact derivatives (sensitivity.hpp)
//
// Levenberg and Marquardt's method (GSL). Where no sigma is given the covariance is times chi^2 / (rows - keys). Units:
// those of the scene.
#pragma once

#include "signorini/sensitivity.hpp"

namespace signorini {

/// One measured number.
struct Measurement {
  std::size_t event = 0;  ///< row of events.csv, from 1; 0: a column
  std::string contact;    ///< of the event, where it is to be checked
  std::string column;     ///< as Sensitivities::columns
  double t = 0.0;         ///< of the column
  double value = 0.0;     ///< of the column, or the time of the event
  double sigma = 1.0;
};

struct Measurements {
  std::vector<Measurement> rows;
  bool has_sigma = false;
};

/// A table with the columns event_index,t and, if given, contact and sigma; or t,COLUMN,... of history.csv or
/// columns-1.csv and, if given, sigma. Errors: FileError with the line.
[[nodiscard]] Measurements read_measurements(const std::string& path);

struct FittedKey {
  std::string path;
  double start = 0.0, value = 0.0, sigma = 0.0;
};

struct Fit {
  std::vector<FittedKey> keys;
  std::vector<std::vector<double>> covariance;
  std::vector<double> residuals;  ///< x_i - m_i at the end; NaN: the run has no such event
  double chi_squared = 0.0;
  int iterations = 0, runs = 0;
  bool converged = false;
  std::string reason;  ///< of the end
};

/// `go_on` is asked before every run. Errors: as sensitivities(), UsageError for fewer rows than keys and for columns
/// that the run has not, FileError for events that it has not at the start.
[[nodiscard]] Fit fit(const SceneReader& read, const std::vector<std::string>& paths,
                      const Measurements& measured, const std::function<bool()>& go_on = {});

}  // namespace signorini
