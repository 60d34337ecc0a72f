// tangent_run.hpp: the tangent motions of several parameters, carried along beside a run.
//
//   begin:    w = u0_p, w' = v0_p, anchors from the start
//   step:     every tangent in the modes of the stretch (modal_tangents.hpp), or over the step's series
//             (tangent_series.hpp), halved where it does not converge
//   instant:  across the event (tangent_event.hpp)
//
// An engine whose steps are no series (`ida`, `newmark`) is followed when a stretch has ended: between two events
// the motion obeys linear equations, so that it is computed once more, from the engine's own state after one
// event to its time of the next, to rounding, with the tangents beside it. Friction that depends on the slip rate
// is followed in the same way, by series of its own.
//
// Works and losses are integrals along the way (work_rates.hpp): where they are wanted every stretch is followed
// along series.
//
// What is wanted of them on the way is handed to a listener: rows at output times, turns, instants.
#pragma once

#include "engine/exact/modal/modal_engine.hpp"
#include "sensitivity/loss_rates.hpp"
#include "sensitivity/modal_tangents.hpp"
#include "sensitivity/tangent_event.hpp"
#include "signorini/sensitivity.hpp"

namespace signorini {

/// The motion and its tangents at one time between events.
struct TangentSample {
  double t = 0.0;
  const Forcing& forcing;
  const Mode& mode;
  SeriesPoint point;
  Vector force_bends;                            ///< second derivatives of the contact forces
  std::vector<SeriesPoint> tangents;             ///< one a parameter; empty vectors: it has none any more
  std::vector<std::vector<DrivenRates>> driven;  ///< [parameter][contact]
  std::vector<std::vector<double>> anchors;      ///< [parameter][contact]
  std::vector<WorkRates> works = {};             ///< one a parameter; empty: not followed
};

/// One parameter's tangent.
struct TangentState {
  explicit TangentState(const Model& model, const Structure& structure, ModeSystems& systems,
                        const ModelDerivative& data, double size, double t_end)
      : derivative(data), series(model, structure, data, size), events(model, systems, data, size, t_end) {}

  const ModelDerivative& derivative;
  TangentSeries series;
  TangentEvents events;
  TangentBefore now;                    ///< the state just before the next instant
  std::optional<ForcingRates> forcing;  ///< of the segment
  double reach = 0.0;                   ///< time over which its series converged last; 0: not known
  bool alive = true;
  double until = 0.0;  ///< where it is not
  std::string reason;
  std::vector<EventRates> rates;  ///< of the last instant, one a contact
  double dt = 0.0;                ///< of the last instant
  // where works and losses are followed
  std::optional<WorkTangent> works;  ///< now, at fixed time
  std::optional<LossRates> losses;
  WorkRates along;               ///< along the last instant
  std::vector<double> impulses;  ///< derivatives of Pn at the last instant; empty: there were none
};

class TangentListener {
 public:
  virtual ~TangentListener() = default;
  /// Output time: a row. turn: T, N, g or ut of a contact may turn here beyond all before.
  virtual void sample(const TangentSample& sample, bool row, bool turn) = 0;
  /// After every instant, the start among them.
  virtual void instant(const InstantMotion& motion, const std::vector<TangentState>& states) = 0;
  /// Of watched(): beyond all before.
  [[nodiscard]] virtual bool exceeds(std::size_t contact, std::size_t which, double value) const = 0;
};

class TangentRun final : public MotionObserver {
 public:
  /// model, run: in the machine's units. All but sizes must outlive it.
  TangentRun(const Model& model, const RunSpec& run, const std::vector<ModelDerivative>& derivatives,
             const std::vector<double>& sizes, TangentListener& listener, bool losses = false);

  void begin(const ObservedInstant& start) override;
  void step(const ObservedStep& step) override;
  void instant(const ObservedInstant& instant) override;
  void end(double t) override;

  [[nodiscard]] const std::vector<TangentState>& states() const { return states_; }
  [[nodiscard]] const Stretches& stretches() const { return stretches_; }

 private:
  struct Output {
    double t = 0.0, x = 0.0;
    bool row = false, turn = false;
  };
  /// What the stretch after an instant is followed by; the last two: once its end is known.
  enum class Way { unknown, series, modes, own_series, own_modes };
  [[nodiscard]] Way way_of(const ObservedStep& step);
  [[nodiscard]] bool starts_in_modes(const ObservedStep& step);
  void observe(const ObservedStep& step);
  void observe_modes(const ObservedStep& step);
  void observe_series(const ObservedStep& step);
  void follow(double t);
  void arrive(double t);
  [[nodiscard]] SeriesPoint just_before(const ObservedInstant& instant);
  [[nodiscard]] std::vector<Output> outputs(const ObservedStep& step);
  [[nodiscard]] std::vector<double> turns_in_modes(const ObservedStep& step) const;
  [[nodiscard]] double turn_near(double t, std::size_t contact, std::size_t which,
                                 const ObservedStep& step) const;
  [[nodiscard]] static std::vector<double> pressing_turns(const Model& model, const ObservedStep& step);
  void integrate(TangentState& state, const ObservedStep& step, double begin, double from, double to) const;
  void advance(TangentState& state, const ObservedStep& step, const std::vector<Output>& outputs,
               std::vector<TangentSample>& samples, std::size_t parameter);
  [[nodiscard]] ModeSystemPtr system_at(const ModeSystem& system, const Series& series);
  void pass(const ObservedInstant& instant);
  void rows_at(const ObservedInstant& instant, const SeriesPoint& after);

  const Model& model_;
  Structure structure_;
  ModeSystems systems_;
  TangentListener& listener_;
  std::vector<TangentState> states_;
  std::vector<double> grid_;
  double t_end_;
  std::size_t next_ = 0;
  std::vector<const ModelDerivative*> data_;
  bool losses_;
  std::optional<ModalTangents> modal_;  ///< where modes can follow the model
  std::unique_ptr<ModalEngine> modal_engine_;
  std::unique_ptr<ExactEngine> series_engine_;
  Way way_ = Way::unknown;
  Stretches stretches_;
  Decision decision_;  ///< of the stretch that is followed at its end, without guards
  std::optional<Forcing> forcing_;
  SeriesPoint end_;  ///< the motion just before the next instant
};

}  // namespace signorini
