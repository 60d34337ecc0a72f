// fit.hpp: least-squares fit of keys of a scene to measurements.
//
//   minimise  sum_i ( (x_i(p) - m_i) / sigma_i )^2 over p         x_i: a time of an event, or a column at a time
//   covariance = (J^T J)^-1,  J_ij = (dx_i/dp_j) / sigma_i        J: the exact derivatives (sensitivity.hpp)
//
// Method: Levenberg-Marquardt (GSL). If no sigma is given, the covariance is multiplied by chi^2 / (rows - keys).
// Units: those of the scene. A result is converged if three conditions hold: the Newton step by J is zero within the
// tolerance, at the result and on both sides of every key; J distinguishes all keys; the measurements are explained.
#pragma once

#include <limits>

#include "signorini/sensitivity.hpp"

namespace signorini {

/// One measured number.
struct Measurement {
  std::size_t event = 0;  ///< row of events.csv, from 1; 0: a column
  std::string contact;    ///< contact of the event, where it is to be checked
  std::string column;     ///< as Sensitivities::columns
  double t = 0.0;         ///< time of a column's value
  double value = 0.0;     ///< value of the column, or time of the event
  double sigma = 1.0;
  std::string type = {};  ///< type of the event as in events.csv, where it is to be checked
  long line = 0;          ///< line of the file; 0: no file
};

struct Measurements {
  std::vector<Measurement> rows;
  bool has_sigma = false;
  std::string file = {};  ///< file name for messages
};

/// Reads a table. It has a column t, and any of these: event_index, columns of history.csv or columns-1.csv,
/// and sigma, which applies to every number of the row. With event_index, columns contact and event are
/// checked against that row of events.csv. Empty cells are skipped. Errors: FileError; Error with the line.
[[nodiscard]] Measurements read_measurements(const std::string& path);

struct FittedKey {
  std::string path;
  double start = 0.0;
  /// NaN: the measurements do not determine it.
  double value = 0.0, sigma = 0.0;
};

struct Fit {
  std::vector<FittedKey> keys;
  std::vector<std::vector<double>> covariance;  ///< NaN for keys that the measurements do not determine
  std::vector<double> residuals;                ///< x_i - m_i at the result; NaN: the run has no such event
  double chi_squared = 0.0;
  long freedom = 0;  ///< degrees of freedom: numbers minus determined keys
  /// Probability that chi^2 is as large by chance; NaN: no sigma was given, or no degree of freedom is left.
  double probability = std::numeric_limits<double>::quiet_NaN();
  int iterations = 0, runs = 0;
  bool converged = false;
  std::string reason;               ///< reason for the end of the iteration
  std::vector<std::string> issues;  ///< reasons why it is not converged, one sentence each
};

/// `go_on` is called before every run; false stops the fit. Errors: those of sensitivities(); UsageError for
/// fewer rows than keys and for unknown columns. Also refused are events that the first run lacks or that
/// differ, and times after its end: by an Error with the line, or by a UsageError if there is no file.
[[nodiscard]] Fit fit(const SceneReader& read, const std::vector<std::string>& paths,
                      const Measurements& measured, const std::function<bool()>& go_on = {});

}  // namespace signorini
