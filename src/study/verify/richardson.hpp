// richardson.hpp: observations of runs, and Richardson extrapolation of three runs with the steps h, h/2, h/4.
//
//   x_h = x + C h^2 + O(h^3)
//   order p = log2( rms(x_h - x_h/2) / rms(x_h/2 - x_h/4) )
//
//   R  = x_h/4 + (x_h/4 - x_h/2) / 3      without the error of second order
//   R' = x_h/2 + (x_h/2 - x_h) / 3
//   bar = 2 |R - R'| + |x_h/2 - x_h/4| / 50, the largest value up to five values later
//
// The remaining error of R is of third order, a h^3 / 8, and that of R' is a h^3, so |R - R'| is seven times
// the error of R if a is smooth. At events a is not smooth, because their position within a step is random;
// then R and R' may have equal errors. A fiftieth of the last difference covers these errors (measured: a
// thousandth, case 02b). Such errors persist, so the bar never decreases. The bar includes five later values,
// because a single difference may vanish by chance. If the observed order is not yet two, the bar is the
// whole difference |x_h/2 - x_h/4|. Rounding grows with the square root of the number of steps.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "certify/companion.hpp"
#include "signorini/simulate.hpp"

namespace signorini::verify {

/// Observations of a run: its events, and the values of observed_columns() at output times.
struct ObservedRun {
  certify::EventSequence track;
  certify::RecordedRows rows;
  Report report;

  [[nodiscard]] double at(std::size_t row, std::size_t column) const {
    return rows.values[row * rows.width + column];
  }
};

/// A column of ObservedRun::rows.
struct ObservedColumn {
  std::string name;  ///< "A.ux", "first.N", or the name of an output
  /// "displacement", "rotation", "velocity", "angular_velocity", "force", "output [m/s^2]"
  std::string kind;
  std::string unit;
};
/// Columns of ObservedRun::rows for this model.
[[nodiscard]] std::vector<ObservedColumn> observed_columns(const Model& model);

/// Recorder that stores no data. go_on: called periodically; the run is interrupted if go_on returns false.
class ObservingRecorder : public Recorder {
 public:
  explicit ObservingRecorder(const std::function<bool()>& go_on) : go_on_(go_on) {}
  void event(const Event& /*event*/) override {}
  void sample(const Sample& /*sample*/) override {}
  bool progress(double /*t*/) override { return go_on_(); }

 private:
  const std::function<bool()>& go_on_;
};

/// Runs the model, and returns its observations. Errors: SceneError for scenes that the engine refuses.
[[nodiscard]] ObservedRun observe(const Model& model, const RunSpec& run, const std::function<bool()>& go_on);

/// Observations of a run, from the tracker that has recorded it.
[[nodiscard]] ObservedRun observed_run(certify::CompanionTracker&& tracker, Report report);

/// Values of a quantity at one instant, computed with the steps h, h/2, h/4.
using StepTriple = std::array<double, 3>;

/// Limits of the values for h = 0, and their error bounds.
struct Extrapolation {
  std::vector<double> value, error_bound;
};

/// Observed order, from sums of squares of the differences between steps. All series must have the same unit.
class ConvergenceOrder {
 public:
  /// negligible: smaller differences are ignored, for instance differences far below IDA's own error.
  void add(const std::vector<StepTriple>& series, double negligible = 0.0);
  /// Observed order; nullopt if the differences are rounding or negligible, for instance if the method is exact.
  [[nodiscard]] std::optional<double> value() const;

 private:
  double coarse_ = 0.0, fine_ = 0.0, rounding_ = 0.0;
};

/// True if the order is two within a tenth, or if it is unknown (nullopt).
[[nodiscard]] bool is_second_order(const std::optional<double>& order);
/// True if the order is so near to two that differences between steps bound the errors, or if it is unknown (nullopt).
[[nodiscard]] bool usable(const std::optional<double>& order);

/// Properties of all series of one kind, which have the same unit.
struct SeriesKind {
  std::optional<double> order;
  double scale = 0.0;  ///< largest magnitude of the values
  double steps = 1.0;  ///< number of steps of the finest run
};

/// Limits of a series of values and their error bounds. The series must be in the order of time.
[[nodiscard]] Extrapolation extrapolate(const std::vector<StepTriple>& series, const SeriesKind& kind);

}  // namespace signorini::verify
