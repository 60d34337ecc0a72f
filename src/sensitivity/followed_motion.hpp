// followed_motion.hpp: the motion of an engine whose steps are no series, computed once more.
//
//   from the start on, u, v and states are its own, to rounding; of the engine it takes which guards fell
//   t_k:   g(t_k) = 0 of the first guard that the engine saw fall, by Newton's method from the engine's own time
//   then   the decision at t_k, made once more
//
// Where the guard has no zero near, or the states decided are not the engine's, it goes on from the engine's own
// state (taken). So the sequence is always the engine's, and an error of its integration does not add up
// in what is derived: a chain of events would amplify it as it amplifies a change of the parameter.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "decide/decider.hpp"
#include "engine/exact/modal/modal_engine.hpp"
#include "run/last_touch.hpp"
#include "run/run_listener.hpp"
#include "sensitivity/tangent_series.hpp"

namespace signorini {

class FollowedMotion {
 public:
  /// The motion at a time after now(), in its mode.
  using MotionAt = std::function<SeriesPoint(double t)>;

  /// All but run must outlive it.
  FollowedMotion(const Model& model, const Structure& structure, ModeSystems& systems, const RunSpec& run);

  void begin(const Decision& start);
  /// The stretch that begins now, under the engine's forcing.
  void start(const Forcing& forcing);
  /// Of that stretch: without guards, since nothing ends it but the engine.
  [[nodiscard]] const Decision& stretch() const { return stretch_; }
  [[nodiscard]] const Forcing& forcing() const { return *forcing_; }
  [[nodiscard]] double t() const { return now_.jet.t; }
  /// Modes of the model; null: none can follow it.
  [[nodiscard]] ModalSystem* modes();
  [[nodiscard]] Stepper& engine(bool in_modes);
  /// The motion at t from a series of its own.
  [[nodiscard]] SeriesPoint at(double t);

  /// When the instant is; nothing: its guard does not fall there.
  [[nodiscard]] std::optional<double> time_of(const RunInstant& instant, const MotionAt& at) const;
  /// The instant at t, where the motion is u and v; the engine's own where that is taken. It lives as long as this.
  [[nodiscard]] RunInstant pass(const RunInstant& instant, double t, const SeriesPoint& before);
  /// The engine's own instant, and its state.
  [[nodiscard]] RunInstant take(const RunInstant& instant);

  [[nodiscard]] long taken() const { return taken_; }
  /// Greatest |t_k - the engine's time|.
  [[nodiscard]] double correction() const { return correction_; }

 private:
  const Model& model_;
  const Structure& structure_;
  ModeSystems& systems_;
  double t_end_;
  Decider decider_;
  std::unique_ptr<ModalEngine> modal_;
  std::unique_ptr<ExactEngine> series_;
  std::unique_ptr<ExactEngine> ahead_;  // looks for the time of an event
  LastTouch touches_;
  Decision now_, stretch_;
  Mode mode_before_;
  Vector v_before_;
  std::optional<Forcing> forcing_;
  long taken_ = 0;
  double correction_ = 0.0;
};

}  // namespace signorini
