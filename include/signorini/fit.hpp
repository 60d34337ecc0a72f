// fit.hpp: least-squares fit of scene keys to measurements.
//
//   minimise  sum_i ( (x_i(p) - m_i) / sigma_i )^2 over p         x_i: time of an event, or value of a column
//   covariance = (J^T J)^-1,  J_ij = (dx_i/dp_j) / sigma_i        J: the exact derivatives (sensitivity.hpp)
//
// Method: Levenberg-Marquardt (GSL). If no sigma is given, the covariance is multiplied by chi^2 / (rows - keys).
// Units: those of the scene. A fit is converged if three conditions are satisfied: the Newton step computed with J is zero
// within the tolerance, at the result and on both sides of it along every key; J has full column rank; the residuals agree
// with the standard deviations sigma.
#pragma once

#include <limits>

#include "signorini/sensitivity.hpp"

namespace signorini {

/// One measured number with its standard deviation sigma.
struct Measurement {
  std::size_t event = 0;  ///< row of events.csv, from 1; 0: the value belongs to a column
  std::string contact;    ///< contact of the event; empty: not checked
  std::string column;     ///< name of the column, as in Sensitivities::columns
  double t = 0.0;         ///< time at which the column has the value
  double value = 0.0;     ///< value of the column, or time of the event
  double sigma = 1.0;
  std::string type = {};  ///< type of the event as in events.csv; empty: not checked
  long line = 0;          ///< line of the measurement file, for messages; 0: there is no file
};

struct Measurements {
  std::vector<Measurement> rows;
  bool has_sigma = false;
  std::string file = {};  ///< file name for messages
};

/// Reads a table with a column t and any of these columns: event_index, columns of history.csv or columns-1.csv, and sigma.
/// sigma applies to every number of its row. With event_index, the columns contact and event are compared with that row of
/// events.csv. Empty cells are skipped. Errors: FileError; Error with the line number of invalid data.
[[nodiscard]] Measurements read_measurements(const std::string& path);

struct FittedKey {
  std::string path;
  double start = 0.0;
  /// Fitted value and its standard deviation. NaN: the measurements do not determine the key.
  double value = 0.0, sigma = 0.0;
};

struct Fit {
  std::vector<FittedKey> keys;
  std::vector<std::vector<double>> covariance;  ///< NaN for keys that the measurements do not determine
  std::vector<double> residuals;  ///< x_i - m_i at the result; NaN: the run has no such event or column value
  double chi_squared = 0.0;
  long freedom = 0;  ///< degrees of freedom: number of measurements minus number of determined keys
  /// Probability of a chi^2 at least this large by chance. NaN: no sigma was given, or there are no degrees of freedom.
  double probability = std::numeric_limits<double>::quiet_NaN();
  int iterations = 0, runs = 0;
  bool converged = false;
  std::string reason;               ///< reason why the iteration ended
  std::vector<std::string> issues;  ///< reasons why the fit is not converged, one sentence each
};

/// `go_on` is called before every run; false stops the fit. Errors: those of sensitivities(); UsageError if there are fewer
/// rows than keys, or a column is unknown. A measurement is refused if the first run has no such event or a different one, or
/// if the measurement's time is after the end of the run: Error with the line of the file, UsageError if there is no file.
[[nodiscard]] Fit fit(const SceneReader& read, const std::vector<std::string>& paths,
                      const Measurements& measured, const std::function<bool()>& go_on = {});

}  // namespace signorini
