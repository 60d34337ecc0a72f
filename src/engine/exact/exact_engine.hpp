// exact_engine.hpp: engine `exact` by Taylor series: motion in each contact state, with proof that no event is missed.
//
//   u(t + s x) = sum_k u_k x^k        motion/taylor.hpp; the step s x is so short that the remainder is below rounding
//   guard(x)   = sum_k g_k x^k        first root by interval bounds, engine/events/first_root.hpp
//
// Between events the equations of a contact state are linear with constant coefficients. The Taylor series of the motion
// converges for all x, and |u_(k+1)| <= W s/(k+1) |u_k|, where W is the greatest growth rate of the contact state. A step has
// the greatest length for which this bound proves convergence down to rounding and the terms do not cancel. docs/theory.md
// contains the proof that no event is missed.
//
// The part of a series after an event is not used, so a step that begins at an event is limited to twice the recent time
// between events. Exception: on large structures, an event in compliant contacts changes the motion only near these contacts
// during a step. Then the series near these contacts is updated (motion/local_series.hpp). The roots of all other guards remain
// valid, so one series is used across several events.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "engine/events/active_guards.hpp"
#include "engine/events/first_root.hpp"
#include "engine/events/turning_points.hpp"
#include "engine/exact/flow_growth.hpp"
#include "engine/exact/patched_series.hpp"
#include "engine/exact/series_works.hpp"
#include "engine/stepper.hpp"
#include "motion/contact_series.hpp"

namespace signorini::exact {

/// Largest number of levels of a series (motion/taylor.hpp).
inline constexpr int max_levels = 30;

/// The exact a + b minus `sum`, which is fl(a + b) or differs from it by a few roundings (Knuth's two-sum).
/// A time that is added up from steps without this part drifts: for steps of equal length each rounding has the same sign.
[[nodiscard]] constexpr double rest_of_sum(double a, double b, double sum) {
  const double of_b = sum - a;
  return (a - (sum - of_b)) + (b - of_b);
}

/// Options of ExactEngine.
struct SeriesOptions {
  bool local_updates = false;   ///< allow local updates; requires that no listener reads the series
  std::uint64_t step_seed = 0;  ///< seed of random step lengths; 0: step lengths are not random
};

class ExactEngine final : public engine::Stepper, public engine::DenseOutput {
 public:
  /// All arguments except t_end must outlive the object.
  ExactEngine(const Model& model, const linear::SystemMatrices& structure, motion::StateSystems& systems,
              double t_end, const SeriesOptions& use = {});

  void start(const engine::Segment& segment) override;
  [[nodiscard]] engine::Step advance() override;
  [[nodiscard]] engine::DenseOutput& dense_output() override { return *this; }
  void evaluate(double t, motion::Point& point) override;
  /// Evaluates u, v and forces, but no accelerations.
  void evaluate_watched(double t, std::optional<std::size_t> contact, motion::Point& point) override;
  void integrate(double from, double to, motion::WorkIntegrals& works) override;
  [[nodiscard]] double residual() override;
  /// Zero, because guards are exact up to rounding, and the decision itself accounts for rounding.
  [[nodiscard]] double guard_error(const GuardForm&, const ContactMotion&, std::size_t) const override {
    return 0.0;
  }
  [[nodiscard]] engine::StepFacts facts() const override;

 private:
  [[nodiscard]] double flights_limit() const;
  void choose_first_step();
  [[nodiscard]] double length_by_event_rate() const;
  [[nodiscard]] double random_step_factor();
  void set_weights();
  void measure_coefficients(std::size_t first, std::size_t last);
  [[nodiscard]] bool converges(const double* a, std::size_t last, double x) const;
  [[nodiscard]] bool converges(const std::vector<double>& sizes, const motion::ForcingSeries& forcing,
                               double x) const;
  [[nodiscard]] double expand(double scale);
  void begin_series(double scale);
  [[nodiscard]] bool can_continue_series(const decide::Decision& decision, bool same_forcing) const;
  [[nodiscard]] bool continue_series(const contact::ContactStates& before);
  [[nodiscard]] double local_radius(const motion::LocalSeries::LocalExpansion& near, double x);
  [[nodiscard]] double local_remainder(const motion::LocalSeries::LocalExpansion& near, double x);
  /// Bounds on the remainders of g and ut, and the factor from the remainder of a polynomial to that of its derivative.
  struct MotionRemainder {
    double gap, ut, rate;
    /// Bound on the remainder of the form without its forces.
    [[nodiscard]] double of(const Form& f) const {
      return std::abs(f.gap) * gap + std::abs(f.ut) * ut + std::abs(f.vn) * rate * gap +
             std::abs(f.vt) * rate * ut + std::abs(f.an) * rate * rate * gap;
    }
  };
  [[nodiscard]] ContactMotion force_remainders(std::size_t contact, double rest,
                                               const MotionRemainder& motion) const;
  [[nodiscard]] double remainder_of(const Form& form, std::size_t contact, double x, double rest) const;
  [[nodiscard]] double remainder_of(const GuardForm& guard, std::size_t contact, double x, double rest) const;
  [[nodiscard]] double series_remainder(double x);
  [[nodiscard]] double drift_of(const decide::GuardStart& guard, double x) const;
  [[nodiscard]] events::FirstRoot first_root_of(std::size_t slot);
  /// The guard that reaches zero first (nullopt: none), and the place of its zero in motion_.
  struct Earliest {
    std::optional<std::size_t> slot;
    double at = 1.0;
    bool not_finite = false;  // the motion has overflowed
  };
  [[nodiscard]] Earliest earliest_crossing();
  void warn_of_touch(std::size_t slot, double t);
  void update_unarmed(double x);
  [[nodiscard]] std::string failure_reason(double scale) const;
  [[nodiscard]] engine::Step failed(std::string reason);
  [[nodiscard]] double x_of(double t) const { return (t - motion_.whole.t) / motion_.whole.scale; }

  const Model& model_;
  const linear::SystemMatrices& structure_;
  motion::Taylor taylor_;
  const double t_end_;
  FlowNorm norm_;
  FlowGrowth growth_;
  std::size_t degree_ = 0;  // degree of all polynomials on the last step
  engine::Segment segment_;
  PatchedSeries motion_;
  std::optional<motion::LocalSeries> local_series_;  // nullopt: no local updates
  contact::ContactStates states_;  // contact states of the segment, if local_series_ is used
  bool series_continued_ = false;  // true: the next step continues the series motion_
  double begin_x_ = 0.0;           // beginning of the step, as a place in motion_
  double reach_ = 0.0;             // place in motion_ at which its valid range ends
  double valid_end_time_ = 0.0;    // time of the place reach_
  /// Bound `rest` on the remainder of the displacements near a contact, in norm_, up to the distance x from the origin of the
  /// contact's polynomials.
  struct LocalRemainder {
    double rest = 0.0, x = 0.0;
  };
  std::vector<LocalRemainder> local_remainders_;
  /// Result of the search for the first zero crossing of a guard in motion_.
  struct ZeroCrossing {
    events::FirstRoot::Kind kind = events::FirstRoot::Kind::none;
    bool stands = false;  // the guard was armed at the search, so the result is valid for the whole series
    double at = 0.0;
  };
  std::vector<ZeroCrossing> crossings_;
  events::ActiveGuards active_guards_;
  std::vector<double> scales_, weights_, sizes_, guard_, local_sizes_;
  Vector local_column_;
  double greatest_ = 0.0;                      // greatest displacement, in units of scales_
  std::size_t forcing_polynomial_degree_ = 0;  // greatest polynomial degree in the forcing
  int touches_ = 0;
  std::optional<std::mt19937_64> random_;  // generator of random step lengths
  motion::Point end_;                      // end of the last step
  double t_ = 0.0, growth_now_ = 0.0;
  double rest_ = 0.0,
         origin_rest_ = 0.0;     // exact time minus t_ at the end of the last step, and at x = 0 in motion_
  double max_next_step_ = 0.0;   // limit of the length of the next step
  double segment_begin_ = 0.0;   // beginning of the segment
  double event_interval_ = 0.0;  // mean time between recent events; 0: none
  // event_interval_ limits the steps, because all series of this segment were long enough.
  bool limited_by_events_ = false;
  double end_x_ = 0.0;  // end of the last step, as a place in motion_
  engine::Step step_;
  SeriesWorkIntegrals works_;
  events::TurningPointDetector turns_;
};

}  // namespace signorini::exact
