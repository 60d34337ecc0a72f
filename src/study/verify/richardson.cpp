#include "study/verify/richardson.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini::verify {

std::vector<ObservedColumn> observed_columns(const Model& model) {
  const Units& units = model.units;
  std::vector<ObservedColumn> list;
  for (const Column& column : model.columns) {
    const char* kind = model.is_rotation(column) ? column.velocity ? "angular_velocity" : "rotation"
                       : column.velocity         ? "velocity"
                                                 : "displacement";
    list.push_back({column.name, kind, model.unit_of(column)});
  }
  for (const Contact& contact : model.contacts)
    for (const char* force : {".N", ".T"}) list.push_back({contact.name + force, "force", units.force});
  for (const Output& output : model.outputs) {
    const std::string unit = unit_text(output.unit, units);
    list.push_back({output.name, "output [" + unit + "]", unit});
  }
  return list;
}

ObservedRun observed_run(certify::CompanionTracker&& tracker, Report report) {
  ObservedRun result;
  result.track = {std::move(tracker.events), report.outcome.t, report.outcome.reason};
  result.rows = std::move(tracker.rows);
  result.report = std::move(report);
  return result;
}

ObservedRun observe(const Model& model, const RunSpec& run, const std::function<bool()>& go_on) {
  ObservingRecorder patient(go_on);
  certify::CompanionTracker tracker(model, true, &patient);
  Report report = simulate(model, run, tracker);
  return observed_run(std::move(tracker), std::move(report));
}

namespace {

constexpr double second_order = 3.0;  // denominator of the extrapolation, 2^2 - 1
// Number of later values whose differences an error bar includes, too.
constexpr std::size_t ahead = 5;
/// Part of the difference |x_h/2 - x_h/4| that a bar includes, for errors of third order that vary from step to step.
constexpr double third_order_part = 0.02;
/// Largest deviations from order two, for is_second_order() and for usable().
constexpr double settled_order_tolerance = 0.1, usable_order_tolerance = 0.6;

double square(double x) { return x * x; }

/// result[i] = largest value up to index i + ahead.
std::vector<double> greatest_so_far(const std::vector<double>& values) {
  std::vector<double> result(values.size());
  double greatest = 0.0;
  for (std::size_t i = 0, next = 0; i < values.size(); ++i) {
    for (; next < std::min(values.size(), i + ahead + 1); ++next) greatest = std::max(greatest, values[next]);
    result[i] = greatest;
  }
  return result;
}

}  // namespace

void ConvergenceOrder::add(const std::vector<StepTriple>& series, double negligible) {
  for (const StepTriple& x : series) {
    coarse_ += square(x[0] - x[1]);
    fine_ += square(x[1] - x[2]);
    rounding_ += square(std::max(rounding::many_operations * std::abs(x[2]), negligible));
  }
}

std::optional<double> ConvergenceOrder::value() const {
  if (!(fine_ > 4.0 * rounding_) || !(coarse_ > 0.0)) return std::nullopt;
  return 0.5 * std::log2(coarse_ / fine_);
}

bool is_second_order(const std::optional<double>& order) {
  return !order || std::abs(*order - 2.0) <= settled_order_tolerance;
}

bool usable(const std::optional<double>& order) {
  return !order || std::abs(*order - 2.0) <= usable_order_tolerance;
}

Extrapolation extrapolate(const std::vector<StepTriple>& series, const SeriesKind& kind) {
  Extrapolation result;
  std::vector<double> off;
  for (const StepTriple& x : series) {
    const double fine = x[2] + (x[2] - x[1]) / second_order, coarse = x[1] + (x[1] - x[0]) / second_order;
    result.value.push_back(fine);
    const double last = std::abs(x[2] - x[1]);
    off.push_back(is_second_order(kind.order) ? 2.0 * std::abs(fine - coarse) + third_order_part * last
                                              : last);
  }
  result.error_bound = greatest_so_far(off);
  for (double& bar : result.error_bound)
    bar += rounding::many_operations * std::sqrt(std::max(1.0, kind.steps)) * kind.scale;
  return result;
}

}  // namespace signorini::verify
