// certify.hpp: which digits of a run are right?
//
// A companion computes the same motion again: the exact flow, or the same engine with a finer setting. What
// the two differ by bounds the error of the run, that of all earlier events included. t': of the same event
// of the companion; c, l: src/certify/companion.hpp.
//
//   D_k = greatest |t - t'| over the events k-4 to k
//   t_error_k = c D_k + l t_uncertainty_k + 2 eps t_k
//
// The events of each contact are paired in their order. The sequence is certain until
//
//   an event has no partner: another one, from or to
//   c |change of t - t'|, from one event of a contact to the next, exceeds half the time between them
//     (errors that both share shift no event past another)
//   the companion has stopped
//
// The order of events of different contacts that lie closer than their errors is counted, and ends nothing.
// How often that holds: validation/certified.
//
//   CertifiedReport run = simulate_certified(model, scene.run, recorder);
//   if (run.certificate) use(run.certificate->until);
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "signorini/simulate.hpp"
#include "signorini/trace.hpp"

namespace signorini {

/// Bounds of the errors of history.csv; empty where nothing was recorded.
struct HistoryErrors {
  std::vector<double> t;  ///< of the rows, as far as both runs have them
  std::size_t width =
      0;  ///< columns: those of the model, then N and T of each contact, and outputs, where asked for
  /// By rows; infinite from `Certificate::until` on. Units: those of the columns.
  std::vector<double> bounds;
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return bounds[row * width + column]; }
};

/// What leaving modes out may have changed at the contacts (src/certify/truncation.hpp).
struct Truncation {
  double displacement = 0.0, force = 0.0;
};

struct Certificate {
  std::string companion;  ///< "exact", "ida, rtol 1e-10", ...
  std::string choice;     ///< why this one: "as given" or "auto: ..."
  double factor = 1.0;    ///< c
  double until = 0.0;     ///< every event before it is certain
  bool complete = false;  ///< until the end of the run
  std::string reason;     ///< why no further, one sentence; empty if complete
  /// The first row of events that is not certain.
  std::optional<std::size_t> first_uncertain;
  /// One a row of events; NaN: not certain.
  std::vector<double> t_errors;
  std::size_t unordered = 0;  ///< pairs of neighbours of different contacts, closer than their errors
  HistoryErrors history;
  std::vector<std::optional<Peak>> peaks;                     ///< bounds, one a contact; none unless complete
  std::vector<std::vector<std::optional<Landing>>> landings;  ///< bounds, as Report::landings
  std::optional<Truncation> reduction;                        ///< of a reduced model
  double wall_time = 0.0;                                     ///< s, of all companions
  double wait = 0.0;  ///< s, from the end of the run to that of the companions

  [[nodiscard]] bool certain(std::size_t row) const { return t_errors[row] == t_errors[row]; }
  [[nodiscard]] std::size_t certain_events() const;
};

struct CertifiedReport {
  Report report;
  std::optional<Certificate> certificate;
  std::string why_not;  ///< one sentence where there is no certificate
};

struct CertifyOptions {
  RoundListener listener = {};  ///< of the run's own decisions
  /// Asked now and then, on the calling thread, while companions are waited for; false ends them.
  std::function<bool()> go_on = [] { return true; };
  bool forces = false;  ///< bounds of N, T and outputs at the output times, too
};

/// As simulate(), with a companion beside it where settings.certify asks for one; the run itself is the same
/// to the last digit. Errors: SceneError for what the engine refuses, or the companion that is asked for.
[[nodiscard]] CertifiedReport simulate_certified(const Model& model, const RunSpec& settings,
                                                 Recorder& recorder, const CertifyOptions& options = {});

}  // namespace signorini
