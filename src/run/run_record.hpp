// run_record.hpp: listener that records rows, events, extremes, pictures, audit and law-check data of a run.
//
//   a step       work in the whole step, so that output times do not change the results; rows inside the step;
//                extremes of outputs; rows for pictures and peaks; the end of the step
//   an instant   outputs before the instant, audit, event log, law check; a row at this time shows the side after it
//
// All recorders and their order are listed here only: each point inside a step is evaluated once for all recorders.
#pragma once

#include <memory>
#include <optional>

#include "run/audit.hpp"
#include "run/curve_record.hpp"
#include "run/event_log.hpp"
#include "run/fault_injector.hpp"
#include "run/motion_record.hpp"
#include "run/output_monitor.hpp"
#include "run/output_sampler.hpp"
#include "run/part_rows.hpp"
#include "run/run_law_checker.hpp"
#include "run/run_limits.hpp"
#include "run/run_listener.hpp"
#include "run/touch_tracker.hpp"
#include "run/warnings.hpp"

namespace signorini::run {

class RunRecord final : public RunListener {
 public:
  /// All arguments except method and share must outlive the object. faults: faults injected by a test; null: none.
  RunRecord(const Model& model, const RunSpec& run, const Method& method,
            const linear::SystemMatrices& structure, const engine::Stepper& engine, Recorder& recorder,
            Report& report, FaultInjector* faults, const PartShare& share);

  void begin(const RunInstant& start) override;
  void step(const RunStep& step) override;
  void reached(const RunStep& step, const RunPoint& end) override;
  void before(const RunPoint& point) override;
  void instant(const RunInstant& instant) override;
  /// Completes the report.
  void end(const RunPoint& last, const engine::StepperReport& engine) override;

  /// Records the energy at a point at which no contact states could be decided.
  void refused(const RunPoint& point) { last_energy_ = auditor_.energy(point.t, point.states, point.point); }
  /// Updates the frequencies of outputs after a change of the model's loads.
  void loads_changed() { response_.loads_changed(); }
  /// Sample for a steering recorder, valid until the next row.
  [[nodiscard]] Sample sample(const RunPoint& point);
  /// Message about the first unexplained violation of a law, after which the run must end; empty: no such violation.
  [[nodiscard]] const std::string& law_violated() const { return law_checker_.unexplained(); }
  /// Time of the row inside the last step at which the recorder ended the run.
  [[nodiscard]] const std::optional<double>& stopped_at() const { return stopped_at_; }
  /// Energy after the last decision.
  [[nodiscard]] const Energy& energy() const { return last_energy_; }
  /// True if the points just before instants must contain accelerations, because the model has outputs.
  [[nodiscard]] bool needs_accelerations() const { return response_.has_outputs(); }

 private:
  [[nodiscard]] const Model& exact_model(FaultInjector* faults);
  [[nodiscard]] bool records_interior_peaks() const {
    return faults_ == nullptr || !faults_->skips_interior_peaks();
  }
  [[nodiscard]] double rows(const RunStep& step);
  void row(const RunStep& step, double t, motion::Point& point);
  void turns(const RunStep& step, double end);
  void add_curves(double t, const contact::ContactStates& states, const motion::Point& point,
                  const RunStep* step = nullptr);
  void after(const RunInstant& instant, const std::optional<std::vector<std::size_t>>& changed);

  const Model& model_;
  const engine::Stepper& engine_;
  Recorder& recorder_;
  Report& report_;
  FaultInjector* faults_;
  std::unique_ptr<Model> exact_model_;  // model without injected faults; null: no faults
  RunLawChecker law_checker_;
  Auditor auditor_;
  EventLog log_;
  OutputSampler samples_;
  MotionRecord motion_;
  CurveRecord curves_;
  OutputMonitor response_;
  LargeMotionDetector large_;
  ZeroTracker zero_since_;
  DecisionWarnings warnings_;
  motion::Point point_;  // buffer for points inside a step
  motion::WorkIntegrals works_;
  Energy last_energy_;
  double condition_ = 1.0;  // StepFacts::eigenvector_condition of the last step
  std::optional<double> stopped_at_;
  bool residual_due_ = false;  // a row was written: audit the residual at the end of its step
};

}  // namespace signorini::run
