// tangent_state.hpp: the tangent of one parameter under way, and who hears of it.
//
//   TangentState    one parameter: its data, the state just before the next instant, works and losses
//   TangentSample   the motion and all tangents at one time between events
//   TangentListener what is wanted of them on the way: rows at output times, turns, instants
#pragma once

#include "sensitivity/loss_rates.hpp"
#include "sensitivity/tangent_event.hpp"
#include "sensitivity/tangent_series.hpp"

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
  double error = 0.0;  ///< of all stretches so far, relative (TangentSeries::error); of states alone
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
  virtual void at_instant(const InstantMotion& motion, const std::vector<TangentState>& states) = 0;
  /// Of watched(): beyond all before.
  [[nodiscard]] virtual bool exceeds(std::size_t contact, std::size_t which, double value) const = 0;
};

}  // namespace signorini
