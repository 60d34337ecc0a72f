// certify.hpp: error bounds of a run from a companion run, and the time until which its sequence of events is certain.
//
// A companion run computes the same motion again, with the exact flow or with the same engine and a finer setting. The
// difference of the two runs bounds the error of the run, including errors carried over from earlier events. t' is the time
// of the same event in the companion run; the factors c and l are defined in src/certify/companion.hpp.
//
//   D_k = greatest |t - t'| over the events k-4 to k
//   t_error_k = c D_k + l t_uncertainty_k + 2 eps t_k
//
// Events are paired contact by contact, in their order. The certain part of the sequence ends as soon as one of these occurs:
//
//   an event has no partner, or the contact, `from` or `to` of the partner is different
//   c |change of t - t'|, from one event of a contact to the next, exceeds half the time between these two events
//     (an error that is equal for both events does not change their order)
//   the companion run stops
//
// If two events of different contacts lie closer than their errors, their order is uncertain. Such pairs are counted
// (Certificate::unordered) but do not end the certificate. validation/certified measures how often the bounds are correct.
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

/// Error bounds of the values in history.csv; empty if the run recorded no rows.
struct HistoryErrors {
  std::vector<double> t;  ///< times of the rows that run and companion have in common
  /// Number of columns: the columns of the model; with CertifyOptions::forces also N and T of each contact, then the outputs.
  std::size_t width = 0;
  /// bounds[row, column], row by row; infinite from `Certificate::until` on. Unit: the unit of the column.
  std::vector<double> bounds;
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return bounds[row * width + column]; }
};

/// Estimated displacement and force, at the contacts, of the modes that a reduction leaves out (src/certify/error_bounds.hpp).
/// It is that of one loading: slips that follow from it add up over a run, and an event that it shifts may change all later
/// ones.
struct Truncation {
  double displacement = 0.0, force = 0.0;
};

struct Certificate {
  std::string companion;  ///< name of the companion run, for example "exact" or "ida, rtol 1e-10"
  std::string choice;     ///< reason for the choice of this companion: "as given" or "auto: ..."
  double factor = 1.0;    ///< factor c of the bound t_error_k above
  double until = 0.0;     ///< time; every earlier event is certain
  bool complete = false;  ///< true: all events up to the end of the run are certain
  std::string reason;     ///< reason why the certificate ends early, one sentence; empty if complete
  /// First row of events.csv that is not certain.
  std::optional<std::size_t> first_uncertain;
  /// Error bounds of the times of events, one per row of events.csv; NaN: the event is not certain.
  std::vector<double> t_errors;
  /// Number of pairs of neighbouring events, on different contacts, that lie closer than their errors.
  std::size_t unordered = 0;
  HistoryErrors history;
  /// Error bounds of Report::peaks, one per contact; empty unless `complete`.
  std::vector<std::optional<Peak>> peaks;
  std::vector<std::vector<std::optional<Landing>>> landings;  ///< error bounds of Report::landings
  std::optional<Truncation> reduction;                        ///< present only for a reduced model
  double wall_time = 0.0;  ///< sum of the wall times of all companion runs, s
  double wait = 0.0;       ///< wall time from the end of the run to the end of its last companion run, s

  /// True if the row of events.csv is certain, that is, if its error bound is not NaN.
  [[nodiscard]] bool certain(std::size_t row) const { return t_errors[row] == t_errors[row]; }
  /// Number of certain rows of events.csv.
  [[nodiscard]] std::size_t certain_events() const;
};

struct CertifiedReport {
  Report report;
  std::optional<Certificate> certificate;
  std::string reason;  ///< reason why there is no certificate, one sentence
  /// Present only for a reduced model: neither the run nor its certificate contains the modes that are left out.
  std::optional<Truncation> reduction = {};
};

struct CertifyOptions {
  RoundListener listener = {};  ///< receives the decision rounds of the run, but not those of companion runs
  /// Called on the calling thread while it waits for companion runs; false stops them.
  std::function<bool()> go_on = [] { return true; };
  bool forces = false;  ///< true: also computes bounds of N, T and outputs at the output times
};

/// simulate() together with a companion run if settings.certify asks for one; the companion run does not change the results of
/// the run. Errors: SceneError if the engine of the run or of the requested companion refuses the scene.
[[nodiscard]] CertifiedReport simulate_certified(const Model& model, const RunSpec& settings,
                                                 Recorder& recorder, const CertifyOptions& options = {});

}  // namespace signorini
