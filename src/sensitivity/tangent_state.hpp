// tangent_state.hpp: state of one parameter's tangent during a run, its advance along series, and listener
// interface.
//
//   TangentState    one parameter: its data, the state just before the next instant, works and losses
//   TangentSample   the motion and all tangents at one time between events
//   TangentListener receives requested results: rows at output times, extremes, instants
#pragma once

#include "run/run_listener.hpp"
#include "sensitivity/tangent_event.hpp"
#include "sensitivity/tangent_series.hpp"
#include "sensitivity/work_rates.hpp"

namespace signorini::sensitivity {

/// Motion and tangents at one time between events.
struct TangentSample {
  double t = 0.0;
  const motion::Forcing& forcing;
  const contact::ContactStates& contact_states;
  SeriesPoint point;
  Vector force_bends;                            ///< second derivatives of the contact forces
  std::vector<SeriesPoint> tangents;             ///< one per parameter; empty vectors if it no longer exists
  std::vector<std::vector<DrivenRates>> driven;  ///< [parameter][contact]
  std::vector<std::vector<double>> anchors;      ///< [parameter][contact]
  std::vector<WorkRates> works = {};             ///< one per parameter; empty: not followed
};

/// Tangent of one parameter.
struct TangentState {
  explicit TangentState(const Model& model, const linear::SystemMatrices& structure,
                        motion::StateSystems& systems, const ModelDerivative& data, double size, double t_end)
      : derivative(data), series(model, structure, data, size), events(model, systems, data, size, t_end) {}

  const ModelDerivative& derivative;
  TangentSeries series;
  TangentEvents events;
  TangentBefore now;                    ///< state just before the next instant
  std::optional<ForcingRates> forcing;  ///< forcing of the current segment
  double reach = 0.0;                   ///< time over which its series converged last; 0: unknown
  /// Error of all stretches so far, relative (TangentSeries::error); only for derivatives of states alone.
  double error = 0.0;
  bool valid = true;
  double valid_until = 0.0;  ///< if not valid: time from which the tangent does not exist
  std::string reason;
  std::vector<EventRates> rates;  ///< rates at the last instant, one per contact
  double dt = 0.0;                ///< dt/dp of the last instant
  // only if works and losses are followed
  std::optional<WorkTangent> works;  ///< current values, at fixed time
  std::optional<LossRates> losses;
  WorkRates along;               ///< along the last instant
  std::vector<double> impulses;  ///< derivatives of Pn at the last instant; empty: no impulse
};

class TangentListener {
 public:
  virtual ~TangentListener() = default;
  /// Called at output times (row), and where T, N, g or ut of a contact may have a new extreme (turn).
  virtual void sample(const TangentSample& sample, bool row, bool turn) = 0;
  /// Called after every instant, including the start.
  virtual void at_instant(const InstantMotion& motion, const std::vector<TangentState>& states) = 0;
  /// True if a value of watched() exceeds all previous ones.
  [[nodiscard]] virtual bool exceeds(std::size_t contact, std::size_t which, double value) const = 0;
};

// Advances one tangent along the series of a step, part by part, with its works.
//
//   [0, x_end]  =  parts, each as long as the tangent's own series converges, halved if it does not
//   W_p        +=  sum over Gauss points of factor (power)_p               (work_rates.hpp)
//
// Works over a part of a step use ten Gauss points for each half of a step.

/// A place in a step at which a tangent is requested: time t, and x in the variable of the step's series. row,
/// turn: as in TangentListener::sample().
struct RequestedPlace {
  double t = 0.0, x = 0.0;
  bool row = false, turn = false;
};

/// Second derivatives of the contact forces at x.
[[nodiscard]] Vector force_bends(const motion::Series& series, std::size_t degree, double x);
/// Times at which a contact's compression has a maximum: N' reaches zero and then rises.
[[nodiscard]] std::vector<double> compression_maxima(const Model& model, const run::RunStep& step);

class SeriesTangents {
 public:
  /// Model and systems must outlive the object.
  SeriesTangents(const Model& model, motion::StateSystems& systems,
                 const std::vector<const ModelDerivative*>& data, bool losses);

  /// Advances to the end of the step; adds the parameter's tangent to samples, one for each requested place.
  void advance(TangentState& state, const run::RunStep& step, const std::vector<RequestedPlace>& wanted,
               std::vector<TangentSample>& samples, std::size_t parameter) const;

 private:
  [[nodiscard]] motion::StateSystemPtr system_at(const motion::StateSystem& system,
                                                 const motion::Series& series) const;
  void integrate(TangentState& state, const run::RunStep& step, double begin, double from, double to) const;

  const Model& model_;
  motion::StateSystems& systems_;
  std::vector<Eigen::Index> touched_;  // degrees of freedom on which contacts, or their derivatives, depend
  bool losses_;
};

}  // namespace signorini::sensitivity
