// tangent_run.hpp: the tangent motions of several parameters, carried along beside a run.
//
//   begin:    w = u0_p, w' = v0_p, anchors from the start
//   step:     every tangent in the modes of the stretch (modal_tangents.hpp), or over the step's series
//             (tangent_series.hpp), halved where it does not converge
//   instant:  across the event (tangent_event.hpp)
//
// An engine whose steps are no series (`ida`, `newmark`) is followed when a stretch has ended: the motion is
// computed once more, to rounding, with the tangents beside it, and the event's time with it (followed_motion.hpp).
// A stretch of `exact` in modes that tangents cannot follow there is followed along series. Tangents by the initial state
// alone cross a stretch of `exact` in closed form where they are asked to (state_flow.hpp).
//
// Works and losses are integrals along the way (work_rates.hpp): where they are wanted every stretch is followed
// along series.
//
// What is wanted of them on the way is handed to a listener: rows at output times, turns, instants.
#pragma once

#include "sensitivity/followed_motion.hpp"
#include "sensitivity/modal_tangents.hpp"
#include "sensitivity/series_tangents.hpp"
#include "sensitivity/state_flow.hpp"
#include "signorini/sensitivity.hpp"

namespace signorini {

class TangentRun final : public RunListener {
 public:
  /// model, run: in the machine's units. All but sizes must outlive it.
  TangentRun(const Model& model, const RunSpec& run, const std::vector<ModelDerivative>& derivatives,
             const std::vector<double>& sizes, TangentListener& listener, bool losses = false);
  /// For derivatives by the initial state alone: stretches of `exact` whose modes `flow` knows are crossed in closed form,
  /// whatever drives them. No rows are told on the way, instants are. It must outlive this.
  void cross_by(StateFlow& flow) { flow_ = &flow; }
  /// Of an observer that hands on what it hears: what the engine shares with that one. It must outlive this.
  void listens_with(const ModalShare& share) { share_ = &share; }
  /// Of states alone: events that graze are crossed where nothing jumps (tangent_event.hpp).
  void cross_smooth_grazes() {
    for (TangentState& state : states_) state.events.cross_smooth_grazes();
  }

  /// The engine of the run is asked for this.
  [[nodiscard]] ListenerNeeds needs() { return {&own_share_}; }
  void begin(const RunInstant& start) override;
  void step(const RunStep& step) override;
  void instant(const RunInstant& instant) override;
  void end(const RunPoint& last, const StepperReport& engine) override;

  [[nodiscard]] const std::vector<TangentState>& states() const { return states_; }
  [[nodiscard]] Stretches stretches() const;

 private:
  /// What the stretch after an instant is followed by; the last two: once its end is known.
  enum class Way { unknown, series, modes, own_series, own_modes, closed };
  [[nodiscard]] Way way_of(const RunStep& step);
  [[nodiscard]] bool starts_in_modes(const RunStep& step);
  void observe(const RunStep& step);
  void observe_modes(const RunStep& step);
  void observe_series(const RunStep& step);
  [[nodiscard]] bool crosses(const RunStep& step);
  void follow(double t);
  void cross(double t);
  void arrive(double t);
  [[nodiscard]] bool is_followed() const { return way_ == Way::own_series || way_ == Way::own_modes; }
  void follow_instant(const RunInstant& instant);
  [[nodiscard]] SeriesPoint just_before(const RunInstant& instant);
  [[nodiscard]] std::vector<WantedPlace> wanted(const RunStep& step, std::span<const double> turns);
  [[nodiscard]] std::vector<double> turns_in_modes(const RunStep& step) const;
  [[nodiscard]] double turn_near(double t, std::size_t contact, std::size_t which, const RunStep& step) const;
  void pass(const RunInstant& instant);
  void rows_at(const RunInstant& instant, const SeriesPoint& after);

  const Model& model_;
  Structure structure_;
  ModeSystems systems_;
  TangentListener& listener_;
  std::vector<TangentState> states_;
  std::vector<double> grid_;
  std::size_t next_ = 0;
  std::vector<const ModelDerivative*> data_;
  bool losses_;
  std::optional<ModalTangents> modal_;  ///< where modes can follow the model
  SeriesTangents series_;
  FollowedMotion followed_;
  Way way_ = Way::unknown;
  ModalShare own_share_;
  const ModalShare* share_ = &own_share_;
  bool foreign_ = false;  ///< the engine makes no series
  Stretches stretches_;
  SeriesPoint end_;  ///< the motion just before the next instant
  StateFlow* flow_ = nullptr;
  Mode crossed_;        ///< of the stretch that flow_ crosses
  double begin_ = 0.0;  ///< of the stretch
  bool closed_flow_;    ///< EngineAbilities::closed_flow of the run's engine
};

}  // namespace signorini
