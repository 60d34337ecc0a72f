// tangent_state.hpp: state of one parameter's tangent during a run, its advance by series, and the listener interface.
//
//   TangentState    for one parameter: data, state just before the next instant, derivatives of work and losses
//   TangentSample   the motion and all tangents at one time between events
//   TangentListener receives requested results: rows at output times, extremes, instants
#pragma once

#include "run/run_listener.hpp"
#include "sensitivity/tangent_event.hpp"
#include "sensitivity/tangent_series.hpp"
#include "sensitivity/work_rates.hpp"

namespace signorini::sensitivity {

/// Motion and tangents of all parameters at one time between events.
struct TangentSample {
  double t = 0.0;
  const motion::Forcing& forcing;
  const contact::ContactStates& contact_states;
  SeriesPoint point;
  Vector force_bends;  ///< second time derivatives of the contact forces
  /// One entry per parameter; empty vectors: the tangent no longer exists.
  std::vector<SeriesPoint> tangents;
  std::vector<std::vector<DrivenRates>> driven;  ///< [parameter][contact]
  std::vector<std::vector<double>> anchors;      ///< [parameter][contact]
  std::vector<WorkRates> works = {};             ///< one entry per parameter; empty: not computed
};

/// The tangent with respect to one parameter.
struct TangentState {
  explicit TangentState(const Model& model, const linear::SystemMatrices& structure,
                        motion::StateSystems& systems, const ModelDerivative& data, double size, double t_end)
      : derivative(data), series(model, structure, data, size), events(model, systems, data, size, t_end) {}

  const ModelDerivative& derivative;
  TangentSeries series;
  TangentEvents events;
  TangentBefore now;                    ///< state just before the next instant
  std::optional<ForcingRates> forcing;  ///< derivatives of the forcing on the current stretch
  double reach = 0.0;                   ///< length of time over which the last series converged; 0: unknown
  /// Relative error of all stretches so far (TangentSeries::error); only for derivatives of states alone.
  double error = 0.0;
  bool valid = true;
  double valid_until = 0.0;  ///< if not valid: time after which the tangent does not exist
  std::string reason;
  std::vector<EventRates> rates;  ///< derivatives at the last instant, one entry per contact
  double dt = 0.0;                ///< dt/dp of the last instant
  // The members below are used only if work and losses are computed.
  std::optional<WorkTangent> works;  ///< present derivatives, at fixed time
  std::optional<LossRates> losses;
  WorkRates along;               ///< derivatives of work and losses along the last instant
  std::vector<double> impulses;  ///< derivatives of the impulses Pn at the last instant; empty: no impact
};

class TangentListener {
 public:
  virtual ~TangentListener() = default;
  /// Called at output times (row), and at times where T, N, g or ut of a contact may have a new extreme (turn).
  virtual void sample(const TangentSample& sample, bool row, bool turn) = 0;
  /// Called after every instant, including the start.
  virtual void at_instant(const InstantMotion& motion, const std::vector<TangentState>& states) = 0;
  /// True if a value of watched() exceeds all earlier ones in magnitude.
  [[nodiscard]] virtual bool exceeds(std::size_t contact, std::size_t which, double value) const = 0;
};

// Advances one tangent by the series of a step, part by part, together with the derivatives of work.
//
//   [0, x_end]  =  parts, each as long as the tangent's series converges; halved if it does not
//   W_p        +=  sum over Gauss points of factor (power)_p               (work_rates.hpp)
//
// The power over a part of a step is integrated with ten Gauss points for each half of the part.

/// A place in a step at which a tangent is requested: time t, and x in the variable of the step's series. row, turn: see
/// TangentListener::sample().
struct RequestedPlace {
  double t = 0.0, x = 0.0;
  bool row = false, turn = false;
};

/// Second time derivatives of the contact forces at position x.
[[nodiscard]] Vector force_bends(const motion::Series& series, std::size_t degree, double x);
/// Times at which the compression of a contact has a maximum: N' changes from negative to positive.
[[nodiscard]] std::vector<double> compression_maxima(const Model& model, const run::RunStep& step);

class SeriesTangents {
 public:
  /// Model and systems must outlive the object.
  SeriesTangents(const Model& model, motion::StateSystems& systems,
                 const std::vector<const ModelDerivative*>& data, bool losses);

  /// Advances the tangent to the end of the step. Writes it into `samples`, which has one entry per requested place.
  void advance(TangentState& state, const run::RunStep& step, const std::vector<RequestedPlace>& wanted,
               std::vector<TangentSample>& samples, std::size_t parameter) const;

 private:
  [[nodiscard]] motion::StateSystemPtr system_at(const motion::StateSystem& system,
                                                 const motion::Series& series) const;
  void integrate(TangentState& state, const run::RunStep& step, double begin, double from, double to) const;

  const Model& model_;
  motion::StateSystems& systems_;
  std::vector<Eigen::Index> touched_;  // degrees of freedom on which contacts or their derivatives depend
  bool losses_;
};

}  // namespace signorini::sensitivity
