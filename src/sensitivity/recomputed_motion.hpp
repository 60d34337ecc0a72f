// recomputed_motion.hpp: recomputes the motion of an engine whose steps are not Taylor series.
//
//   u, v and states are computed independently, without integration error; the engine provides the triggered guards
//   t_k:   g(t_k) = 0 for the first triggered guard, by Newton's method starting from the engine's time
//   then   the decision at t_k is repeated
//
// If the guard has no zero nearby, or if the decided states differ from the engine's, the motion continues from the engine's
// state (fallback_count). So the sequence of events is always the engine's. Integration errors of the engine do not
// accumulate in the derivatives, where a chain of events would amplify them like changes of the parameter.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "decide/contact_state_solver.hpp"
#include "engine/exact/modal/modal_engine.hpp"
#include "run/run_listener.hpp"
#include "run/touch_tracker.hpp"
#include "sensitivity/tangent_series.hpp"

namespace signorini::sensitivity {

class RecomputedMotion {
 public:
  /// The recomputed motion at a time after t(), in its present contact states.
  using MotionAt = std::function<SeriesPoint(double t)>;

  /// All arguments except `run` must outlive the object.
  RecomputedMotion(const Model& model, const linear::SystemMatrices& structure, motion::StateSystems& systems,
                   const RunSpec& run);

  void begin(const decide::Decision& start);
  /// Starts a stretch at t(), with the engine's forcing.
  void start(const motion::Forcing& forcing);
  /// Decision at the start of the stretch. It contains no guards, because only the engine ends the stretch.
  [[nodiscard]] const decide::Decision& stretch() const { return stretch_; }
  [[nodiscard]] const motion::Forcing& forcing() const { return *forcing_; }
  [[nodiscard]] double t() const { return now_.jet.t; }
  /// Modes of the model; nullptr: the motion cannot be computed in modes.
  [[nodiscard]] modal::ModalSystem* modes();
  [[nodiscard]] engine::Stepper& engine(bool in_modes);
  /// The motion at t, from a separately computed series.
  [[nodiscard]] SeriesPoint at(double t);

  /// Time of the instant in the recomputed motion; nullopt: the guard has no zero nearby.
  [[nodiscard]] std::optional<double> time_of(const run::RunInstant& instant, const MotionAt& at) const;
  /// The instant at t, decided from the recomputed motion; if the decided states differ from the engine's, the engine's
  /// instant. The result is valid as long as this object exists.
  [[nodiscard]] run::RunInstant pass(const run::RunInstant& instant, double t, const SeriesPoint& before);
  /// Continues from the engine's state and returns the engine's instant.
  [[nodiscard]] run::RunInstant adopt_engine_state(const run::RunInstant& instant);

  [[nodiscard]] long fallback_count() const { return fallback_count_; }
  /// Largest difference between t_k and the engine's time of the same instant.
  [[nodiscard]] double correction() const { return correction_; }

 private:
  const Model& model_;
  const linear::SystemMatrices& structure_;
  motion::StateSystems& systems_;
  double t_end_;
  decide::ContactStateSolver decider_;
  std::unique_ptr<modal::ModalEngine> modal_;
  std::unique_ptr<exact::ExactEngine> series_;
  std::unique_ptr<exact::ExactEngine> event_search_;  // finds event times
  run::TouchTracker touches_;
  decide::Decision now_, stretch_;
  contact::ContactStates states_before_;
  Vector v_before_;
  std::optional<motion::Forcing> forcing_;
  long fallback_count_ = 0;
  double correction_ = 0.0;
};

}  // namespace signorini::sensitivity
