// sensitivity.hpp: derivatives of events, peaks and columns of a run by keys of its scene.
//
//   M u'' + C u' + K u + sum ( n N + t T ) = P,  rows of the contact state  the motion
//   M w'' + C w' + K w + sum ( n N_p + t T_p )
//     = P_p - M_p u'' - C_p u' - K_p u - sum ( n_p N + t_p T )              w = du/dp, the tangent motion
//   dt/dp = - (G_p + grad G . w) / G'                                       an event at which the guard G reaches zero
//   w+ = w- + (u'- - u'+) dt/dp,   w'+ = w'- + (u''- - u''+) dt/dp          across it
//
// _p: derivatives by p of given data, at fixed time; grad G . w includes all arguments of G. At impacts of rigid
// contacts w' follows from the derivative of the impact's equations. The run uses the scene's engine and flow; between
// events w is computed to rounding, in modes or along series.
//
//   Sensitivities s = sensitivities(reader_of("models/pipeline.toml"), {"contacts.*.friction"});
//   s.event_rates[0][0].t                       dt/dp of the first event, in the scene's units
//
// Units: unit of the quantity over that of the key. NaN: the derivative does not exist or is unknown; Parameter::until
// and `reason` give the time and the reason.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "signorini/result.hpp"

namespace signorini {

/// Reads the scene with some of its keys changed.
using SceneReader = std::function<Scene(const std::vector<Override>& changes)>;
/// Reads the file once, at this call; later changes to it have no effect. The overrides `always` are applied first, at
/// every call. Errors: FileError; SceneError if the file is larger than 64 MB.
[[nodiscard]] SceneReader reader_of(std::string path, std::vector<Override> always = {});

/// A key that is varied, as `--set` takes it; "contacts.*.friction" is one parameter.
struct Parameter {
  std::string path;
  double value = 0.0;
  double step = 0.0;  ///< step of the differences of the model's data, in the key's unit
  /// True if the key may have this value: an inertia, for example, is never negative.
  std::function<bool(double)> is_valid = [](double) { return true; };
  /// Derivatives are known before this time; `reason` says why not later. Infinity: to the end.
  double until = std::numeric_limits<double>::infinity();
  std::string reason;
};

/// Derivatives of a row of events.csv by one parameter: of its time, and of its state columns at the event.
struct EventRates {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double t = none;
  double gap = none, N = none, T = none, N_after = none, T_after = none;
  double vn = none, vn_after = none, vt = none, vt_after = none;
  double impulse_n = none, impulse_t = none;
};

struct EventRateColumn {
  const char* name;
  const char* of;  ///< the column of events.csv
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

/// A scalar result of a contact: a peak with its time, or a residual value at the end. With losses also
/// scalar results of the run.
struct Response {
  /// "peak N", "peak T", "peak normal", "peak tangential", "rest tangential", "rest slip", "lost by friction"; for the
  /// run: "lost by damping", "lost by impacts", "work of loads", "work of surfaces", "lost by friction"
  std::string name;
  int contact = -1;  ///< -1: the run
  double value = 0.0, t = 0.0;
  std::vector<double> rates, t_rates;  ///< one per parameter; t_rates: of a peak's time
};

/// Derivatives of a contact phase by one parameter.
struct LandingRates {
  double start = 0.0, end = 0.0, impulse = 0.0, peak_force = 0.0;
};
/// A contact phase with its derivatives.
struct MovingLanding {
  int contact = -1;
  Landing value;
  std::vector<LandingRates> rates;  ///< one per parameter
};

/// Options beyond the derivatives of the motion.
struct SensitivityOptions {
  /// Also derivatives of works, losses, energies at output times and landings. The tangent motion is then
  /// computed along series everywhere; the cost is about one run in series for each parameter.
  bool losses = false;
  /// For engine `newmark`: derivatives of the discrete solution, steps included, not of the exact motion.
  /// They exist for events, peaks at events, and columns, not for peaks between events. Excludes `losses`.
  bool discrete = false;
};

/// Number of motions between two instants whose derivatives were computed in modes and along series;
/// `followed` of them along a recomputed motion. Engines without series (`ida`, `newmark`) need it: a
/// separate motion that takes the sequence of guards from the engine.
struct Stretches {
  long modes = 0, series = 0, followed = 0;
  long taken = 0;           ///< instants at which the recomputed motion restarted from the engine's state
  double correction = 0.0;  ///< largest difference of an event's time from the engine's
};

struct Sensitivities {
  std::vector<Parameter> parameters;
  std::vector<std::string> contacts;  ///< names
  std::vector<Event> events;
  std::vector<std::vector<EventRates>> event_rates;  ///< [event][parameter]
  /// Columns of history.csv; then "NAME.N", ".T", ".ut", ".slip", ".gap" of each contact; with losses then
  /// "energy.kinetic" and so on, as in energy.csv.
  std::vector<std::string> columns;
  std::vector<double> times;                                  ///< the grid
  std::vector<std::vector<double>> values;                    ///< [time][column]
  std::vector<std::vector<std::vector<double>>> value_rates;  ///< [parameter][time][column]
  std::vector<Response> responses;
  std::vector<MovingLanding> landings;  ///< with losses: by contact, then by time
  Units units;
  std::string title;
  Stretches stretches;
  Report report;
};

/// A first-order estimate of a change of the sequence: two neighbours swap or, if on one contact, both vanish.
struct SequenceChange {
  std::size_t parameter = 0, first = 0, second = 0;  ///< indices of events, times ascending
  double change = 0.0;                               ///< change of the parameter at which their times meet
  bool vanish = false;                               ///< both are on one contact
};

/// The smallest change of each parameter, upwards and downwards, at which two neighbours meet. No entry if no two meet
/// or if the key cannot have that value.
[[nodiscard]] std::vector<SequenceChange> smallest_sequence_changes(const Sensitivities& s);

/// Derivatives of a run by the keys at these paths. `recorder` receives the run's rows, and may not steer.
/// Errors: SceneError, also for scenes that the engine refuses; UsageError for options that exclude each
/// other, and for a key that is not a number or on which the model does not depend smoothly.
[[nodiscard]] Sensitivities sensitivities(const SceneReader& read, const std::vector<std::string>& paths,
                                          Recorder* recorder = nullptr,
                                          const SensitivityOptions& options = {});

}  // namespace signorini
