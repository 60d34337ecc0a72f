// fit.hpp: keys of a scene from what was measured.
//
//   minimise  sum_i ( (x_i(p) - m_i) / sigma_i )^2 over p         x_i: a time of an event, or a column at a time
//   covariance = (J^T J)^-1,  J_ij = (dx_i/dp_j) / sigma_i        J: the exact derivatives (sensitivity.hpp)
//
// Levenberg and Marquardt's method (GSL). Where no sigma is given the covariance is times chi^2 / (rows - keys). Units:
// those of the scene. A result is converged where the step that J asks for is none, beside the result too, on both sides
// of every key; where J tells all keys apart; and where the measurements are explained.
#pragma once

#include <limits>

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
  std::string type = {};  ///< of the event, as in events.csv, where it is to be checked
  long line = 0;          ///< of the file; 0: of none
};

struct Measurements {
  std::vector<Measurement> rows;
  bool has_sigma = false;
  std::string file = {};  ///< in messages
};

/// A table with a column t, any of event_index (and contact and event of that row of events.csv, which are checked),
/// columns of history.csv or columns-1.csv, and sigma, that of every number of the row. Empty cells are not measured.
/// Errors: FileError; Error with the line.
[[nodiscard]] Measurements read_measurements(const std::string& path);

struct FittedKey {
  std::string path;
  double start = 0.0;
  /// NaN: the measurements do not determine it.
  double value = 0.0, sigma = 0.0;
};

struct Fit {
  std::vector<FittedKey> keys;
  std::vector<std::vector<double>> covariance;  ///< NaN of keys that are not determined
  std::vector<double> residuals;                ///< x_i - m_i at the end; NaN: the run has no such event
  double chi_squared = 0.0;
  long freedom = 0;  ///< numbers less keys that are determined
  /// That chi^2 is as great by chance; NaN: no sigma was given, or nothing is left over.
  double probability = std::numeric_limits<double>::quiet_NaN();
  int iterations = 0, runs = 0;
  bool converged = false;
  std::string reason;               ///< of the end
  std::vector<std::string> doubts;  ///< why it is not converged, a sentence each
};

/// `go_on` is asked before every run. Errors: as sensitivities(), UsageError for fewer rows than keys and for columns
/// that the run has not; for events that it has not at the start, or that are others, and for times after its end Error
/// with the line, UsageError where there is no file.
[[nodiscard]] Fit fit(const SceneReader& read, const std::vector<std::string>& paths,
                      const Measurements& measured, const std::function<bool()>& go_on = {});

}  // namespace signorini
