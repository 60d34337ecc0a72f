// tangent_run.hpp: tangent motions of several parameters, computed together with a run, and derivatives of contact phases.
//
//   begin:    w = u0_p, w' = v0_p, and derivatives of the initial anchors
//   step:     every tangent in the modes of the stretch (modal_tangents.hpp), or by the step's series
//             (tangent_series.hpp); the step is halved if the series of the tangent does not converge
//   instant:  across the event (tangent_event.hpp)
//
// If the engine's steps are not series (`ida`, `newmark`), the motion is recomputed after each stretch without integration
// error, together with the tangents and the time of the event (recomputed_motion.hpp). A modal stretch of `exact` whose
// tangents cannot be computed in modes is recomputed by series. Tangents with respect to the initial state alone can cross a
// stretch of `exact` in closed form (state_flow.hpp).
//
// Work and losses are integrals over time (work_rates.hpp). If they are requested, every stretch is computed by series.
//
// A listener receives the requested results: rows at output times, extremes, instants.
#pragma once

#include "sensitivity/modal_tangents.hpp"
#include "sensitivity/recomputed_motion.hpp"
#include "sensitivity/state_flow.hpp"
#include "sensitivity/tangent_state.hpp"
#include "signorini/sensitivity.hpp"

namespace signorini::sensitivity {

class TangentRun final : public run::RunListener {
 public:
  /// model, run: in internal units. All arguments except `sizes` must outlive the object.
  TangentRun(const Model& model, const RunSpec& run, const std::vector<ModelDerivative>& derivatives,
             const std::vector<double>& sizes, TangentListener& listener, bool losses = false);
  /// For derivatives with respect to the initial state alone: stretches of `exact` for which `flow` has modes are crossed in
  /// closed form, for any excitation. The listener then receives instants but no rows. `flow` must outlive this object.
  void use_state_flow(StateFlow& flow) { flow_ = &flow; }
  /// Sets the modal data that the engine shares with an outer listener; that listener forwards its calls to this object.
  /// `share` must outlive this object.
  void use_shared_modes(const modal::SharedModalData& share) { share_ = &share; }
  /// For derivatives of states alone: crosses grazing events without jumps (see tangent_event.hpp).
  void cross_smooth_grazes() {
    for (TangentState& state : states_) state.events.cross_smooth_grazes();
  }

  /// Data that the engine of the run must provide to this listener.
  [[nodiscard]] run::ListenerNeeds needs() { return {&own_share_}; }
  void begin(const run::RunInstant& start) override;
  void step(const run::RunStep& step) override;
  void instant(const run::RunInstant& instant) override;
  void end(const run::RunPoint& last, const engine::StepperReport& engine) override;

  [[nodiscard]] const std::vector<TangentState>& states() const { return states_; }
  [[nodiscard]] Stretches stretches() const;

 private:
  /// Method for the stretch after an instant. recomputed_... and closed_form compute the stretch when its end is known.
  enum class StretchMethod { unknown, series, modes, recomputed_series, recomputed_modes, closed_form };
  [[nodiscard]] StretchMethod choose_stretch_method(const run::RunStep& step);
  [[nodiscard]] bool starts_in_modes(const run::RunStep& step);
  void observe(const run::RunStep& step);
  void observe_modes(const run::RunStep& step);
  void observe_series(const run::RunStep& step);
  [[nodiscard]] bool crosses(const run::RunStep& step);
  void follow(double t);
  void cross(double t);
  void arrive(double t);
  [[nodiscard]] bool is_followed() const {
    return stretch_method_ == StretchMethod::recomputed_series ||
           stretch_method_ == StretchMethod::recomputed_modes;
  }
  void follow_instant(const run::RunInstant& instant);
  [[nodiscard]] SeriesPoint just_before(const run::RunInstant& instant);
  [[nodiscard]] std::vector<RequestedPlace> wanted(const run::RunStep& step, std::span<const double> turns);
  [[nodiscard]] std::vector<double> turns_in_modes(const run::RunStep& step) const;
  [[nodiscard]] double refine_turning_point(double t, std::size_t contact, std::size_t which,
                                            const run::RunStep& step) const;
  void pass(const run::RunInstant& instant);
  void rows_at(const run::RunInstant& instant, const SeriesPoint& after);

  const Model& model_;
  linear::SystemMatrices structure_;
  motion::StateSystems systems_;
  TangentListener& listener_;
  std::vector<TangentState> states_;
  std::vector<double> grid_;
  std::size_t next_ = 0;
  std::vector<const ModelDerivative*> data_;
  bool losses_;
  std::optional<ModalTangents> modal_;  ///< empty: tangents of this model are not computed in modes
  SeriesTangents series_;
  RecomputedMotion recomputed_motion_;
  StretchMethod stretch_method_ = StretchMethod::unknown;
  modal::SharedModalData own_share_;
  const modal::SharedModalData* share_ = &own_share_;
  bool engine_without_series_ = false;  ///< true: the engine's steps are not series
  Stretches stretches_;
  SeriesPoint end_;  ///< motion just before the next instant
  StateFlow* flow_ = nullptr;
  contact::ContactStates crossed_;  ///< contact states of the stretch that flow_ crosses
  double begin_ = 0.0;              ///< time at the beginning of the stretch
  bool closed_form_flow_;           ///< see EngineCapabilities::closed_form_flow of the run's engine
};

// Derivatives of contact phases (run/touch_tracker.hpp) with respect to the parameters.
//
//   impulse_p = sum of DPn at impacts + W_p(end) - W_p(start)       W: integral of -N, along the moving instants
//   peak_p    = -N_p at an extreme of N, or -DN at an instant

class LandingRecord {
 public:
  /// The model must outlive the object.
  LandingRecord(const Model& model, std::size_t parameters)
      : model_(model), parameters_(parameters), all_(model.contacts.size()), active_(all_.size(), false) {}

  void turn(const TangentSample& sample);
  void instant(const InstantMotion& motion, const std::vector<TangentState>& states);
  /// One list per contact, in internal units. A contact phase that has not ended ends with the run. In MovingLanding::value
  /// only peak_force is set.
  [[nodiscard]] std::vector<std::vector<MovingLanding>> finish(const std::vector<TangentState>& states) const;

 private:
  struct ContactPhase {
    MovingLanding landing;
    std::vector<double> from;  ///< W_p at the beginning of the phase, one entry per parameter
  };
  void begin(std::size_t contact, const std::vector<double>& start, const std::vector<TangentState>& states);
  void update_peak(std::size_t contact, double force, const std::vector<double>& rates);

  const Model& model_;
  std::size_t parameters_;
  std::vector<std::vector<ContactPhase>> all_;  // phases of each contact
  std::vector<bool> active_;                    // true while the contact is closed
  bool begun_ = false;                          // true after the first instant
};

}  // namespace signorini::sensitivity
