// sensitivity.hpp: derivatives of the events, peaks and columns of a run with respect to keys of its scene.
//
//   M u'' + C u' + K u + sum ( n N + t T ) = P,  rows of the contact state  the motion
//   M w'' + C w' + K w + sum ( n N_p + t T_p )
//     = P_p - M_p u'' - C_p u' - K_p u - sum ( n_p N + t_p T )              w = du/dp, the tangent motion
//   dt/dp = - (G_p + grad G . w) / G'                                       an event at which the guard G reaches zero
//   w+ = w- + (u'- - u'+) dt/dp,   w'+ = w'- + (u''- - u''+) dt/dp          jumps at the event
//
// A subscript p denotes the derivative of given data with respect to p at fixed time; grad G . w includes all arguments of G.
// At impacts of rigid contacts w' follows from the derivative of the impact's equations. The run uses the scene's engine and
// flow. Between events w is computed in modes or by Taylor series, with errors of rounding size.
//
//   Sensitivities s = sensitivities(reader_of("models/pipeline.toml"), {"contacts.*.friction"});
//   s.event_rates[0][0].t                       dt/dp of the first event, in the scene's units
//
// Unit of a derivative: unit of the quantity / unit of the key. NaN: the derivative does not exist or is unknown;
// Parameter::until and Parameter::reason give the time and the reason.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "signorini/result.hpp"

namespace signorini {

/// Reads the scene after the given changes of keys.
using SceneReader = std::function<Scene(const std::vector<Override>& changes)>;
/// Reads the file once, at this call; later changes of the file have no effect. The overrides `always` are applied at every
/// call, before the changes. Errors: FileError; SceneError if the file is larger than 64 MB.
[[nodiscard]] SceneReader reader_of(std::string path, std::vector<Override> always = {});

/// A key that is varied, named as in `--set`; all keys that match "contacts.*.friction" form one parameter.
struct Parameter {
  std::string path;
  double value = 0.0;
  double step = 0.0;  ///< change of the key for differences of the model's data, in the key's unit
  /// True if the key may have this value; an inertia, for example, must not be negative.
  std::function<bool(double)> is_valid = [](double) { return true; };
  /// Time until which derivatives are known; `reason` explains the limit. Infinity: up to the end of the run.
  double until = std::numeric_limits<double>::infinity();
  std::string reason;
};

/// Derivatives with respect to one parameter: of the time of an event, and of its columns in events.csv.
struct EventRates {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double t = none;
  double gap = none, N = none, T = none, N_after = none, T_after = none;
  double vn = none, vn_after = none, vt = none, vt_after = none;
  double impulse_n = none, impulse_t = none;
};

struct EventRateColumn {
  const char* name;
  const char* of;  ///< column of events.csv whose derivative has this name
  double EventRates::*value;
};
inline constexpr std::array event_rate_columns = {
    EventRateColumn{"dt_dp", "t", &EventRates::t},
    EventRateColumn{"dgap_dp", "gap", &EventRates::gap},
    EventRateColumn{"dN_dp", "N", &EventRates::N},
    EventRateColumn{"dT_dp", "T", &EventRates::T},
    EventRateColumn{"dN_after_dp", "N_after", &EventRates::N_after},
    EventRateColumn{"dT_after_dp", "T_after", &EventRates::T_after},
    EventRateColumn{"dvn_dp", "vn", &EventRates::vn},
    EventRateColumn{"dvn_after_dp", "vn_after", &EventRates::vn_after},
    EventRateColumn{"dvt_dp", "vt", &EventRates::vt},
    EventRateColumn{"dvt_after_dp", "vt_after", &EventRates::vt_after},
    EventRateColumn{"dimpulse_n_dp", "impulse_n", &EventRates::impulse_n},
    EventRateColumn{"dimpulse_t_dp", "impulse_t", &EventRates::impulse_t},
};

/// A scalar result of a contact: a peak with its time, or a value at the end of the run. With `losses` also a scalar result of
/// the whole run.
struct Response {
  /// "peak N", "peak T", "peak normal", "peak tangential", "rest tangential", "rest slip", "lost by friction"; for the
  /// run: "lost by damping", "lost by impacts", "work of loads", "work of surfaces", "lost by friction"
  std::string name;
  int contact = -1;                    ///< index of the contact; -1: the whole run
  double value = 0.0, t = 0.0;         ///< t: time of the peak
  std::vector<double> rates, t_rates;  ///< one entry per parameter; t_rates: derivatives of the peak's time
};

/// Derivatives of a contact phase (Landing) with respect to one parameter.
struct LandingRates {
  double start = 0.0, end = 0.0, impulse = 0.0, peak_force = 0.0;
};
/// A contact phase with its derivatives.
struct MovingLanding {
  int contact = -1;
  Landing value;
  std::vector<LandingRates> rates;  ///< one entry per parameter
};

/// Options for further derivatives and for another method.
struct SensitivityOptions {
  /// Also computes derivatives of work, losses, energies at output times, and landings. The tangent motion is then computed
  /// by Taylor series everywhere, at the cost of about one run by series for each parameter.
  bool losses = false;
  /// Engine `newmark`: computes derivatives of the discrete solution, including its steps, not of the exact motion. Available
  /// for events, peaks at events, and columns; not for peaks between events. Excludes `losses`.
  bool discrete = false;
};

/// Number of motions between two instants whose derivatives were computed in modes and by series. `followed`: number of these
/// motions that were computed again by series, with the engine's sequence of guards, because the engines `ida` and `newmark`
/// do not provide a series.
struct Stretches {
  long modes = 0, series = 0, followed = 0;
  long taken = 0;  ///< number of instants at which the recomputed motion restarted from the engine's state
  double correction = 0.0;  ///< largest difference between a recomputed event time and the engine's
};

struct Sensitivities {
  std::vector<Parameter> parameters;
  std::vector<std::string> contacts;  ///< names of the contacts
  std::vector<Event> events;
  std::vector<std::vector<EventRates>> event_rates;  ///< [event][parameter]
  /// Columns of history.csv; then "NAME.N", ".T", ".ut", ".slip", ".gap" of each contact. With `losses` also "energy.kinetic"
  /// and the other columns of energy.csv.
  std::vector<std::string> columns;
  std::vector<double> times;                                  ///< output times
  std::vector<std::vector<double>> values;                    ///< [time][column]
  std::vector<std::vector<std::vector<double>>> value_rates;  ///< [parameter][time][column]
  std::vector<Response> responses;
  std::vector<MovingLanding> landings;  ///< with losses: by contact, then by time
  Units units;
  std::string title;
  Stretches stretches;
  Report report;
};

/// A first-order estimate of a change in the sequence: two neighbouring events swap, or both vanish if they are on one
/// contact.
struct SequenceChange {
  std::size_t parameter = 0, first = 0, second = 0;  ///< indices into `events`, with ascending times
  double change = 0.0;  ///< change of the parameter at which the times of both events coincide
  bool vanish = false;  ///< true: both events are on one contact
};

/// The smallest change of each parameter, upwards and downwards, at which two neighbouring events coincide. There is no entry
/// if no events coincide, or if the key is invalid at that change.
[[nodiscard]] std::vector<SequenceChange> smallest_sequence_changes(const Sensitivities& s);

/// Derivatives of a run with respect to the keys at these paths. `recorder` receives the rows of the run; Recorder::steers()
/// must be false. Errors: SceneError, also if the engine refuses the scene; UsageError if options exclude each other, if a key
/// is not a number, or if the model does not depend smoothly on a key.
[[nodiscard]] Sensitivities sensitivities(const SceneReader& read, const std::vector<std::string>& paths,
                                          Recorder* recorder = nullptr,
                                          const SensitivityOptions& options = {});

}  // namespace signorini
