// exact_engine.hpp: engine `exact`: the flow of each mode in closed form, and no event unseen.
//
//   u(t + s x) = sum_k u_k x^k        motion/taylor.hpp; h = s x chosen so that the rest is below rounding
//   guard(x)   = sum_k g_k x^k        first fall by interval bounds, engine/falls/first_fall.hpp
//
// Between events the system of a mode is linear with constant coefficients, so its Taylor series has the
// radius of the forcing's, infinite, and |x_(k+1)| <= W s/(k+1) |x_k| with W the greatest growth of the mode.
// A step is as long as the series still converges to rounding with that bound, and short enough that its
// terms do not cancel. docs/theory.md gives the argument that no event is missed. What lies behind an event is computed in
// vain, so that a step which begins at one is no longer than twice the time between events lately. On large structures an event
// in compliant contacts changes the motion near them alone for as long as the series reaches: there it is made anew, falls
// that were found elsewhere stand (motion/near_series.hpp), and a series is as long as some events.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "engine/exact/flow_growth.hpp"
#include "engine/exact/pieced_series.hpp"
#include "engine/exact/series_works.hpp"
#include "engine/falls/arming.hpp"
#include "engine/falls/first_fall.hpp"
#include "engine/falls/turning_points.hpp"
#include "engine/stepper.hpp"
#include "motion/contact_series.hpp"

namespace signorini {

/// Terms of a series at most.
inline constexpr int most_levels = 30;

/// What its steps are used for.
struct SeriesUse {
  bool pieces = false;  ///< the motion may be put together from pieces, since nobody asks for its series
  std::uint64_t step_seed = 0;  ///< not 0: steps are shorter by chance (share_of_step)
};

class ExactEngine final : public Stepper, public DenseOutput {
 public:
  /// All but t_end must outlive it.
  ExactEngine(const Model& model, const Structure& structure, ModeSystems& systems, double t_end,
              const SeriesUse& use = {});

  void start(const Segment& segment) override;
  [[nodiscard]] Step advance() override;
  [[nodiscard]] DenseOutput& dense_output() override { return *this; }
  void evaluate(double t, Point& point) override;
  /// Without accelerations.
  void evaluate_watched(double t, std::optional<std::size_t> contact, Point& point) override;
  void integrate(double from, double to, Works& works) override;
  [[nodiscard]] double residual() override;
  /// The guard is exact but for rounding, which the decision knows.
  [[nodiscard]] double guard_error(const GuardForm&, const ContactMotion&, std::size_t) const override {
    return 0.0;
  }
  [[nodiscard]] StepFacts facts() const override;

 private:
  [[nodiscard]] double few_flights() const;
  void choose_first_step();
  [[nodiscard]] double paced_length() const;
  [[nodiscard]] double share_of_step();
  void weigh();
  void measure(std::size_t first, std::size_t last);
  [[nodiscard]] bool stands(const double* a, std::size_t last, double x) const;
  [[nodiscard]] bool stands(const std::vector<double>& sizes, const ForcingSeries& forcing, double x) const;
  [[nodiscard]] double expand(double scale);
  void begin_series(double scale);
  [[nodiscard]] bool goes_on(const Decision& decision, bool same_forcing) const;
  [[nodiscard]] bool go_on(const Mode& before);
  [[nodiscard]] double reach_near(const NearSeries::Made& near, double x);
  [[nodiscard]] double rest_near(const NearSeries::Made& near, double x);
  [[nodiscard]] double rest_of(const Form& form, std::size_t contact, double x, double rest) const;
  [[nodiscard]] double rest_of(const GuardForm& guard, std::size_t contact, double x, double rest) const;
  [[nodiscard]] double rest_of_series(double x);
  [[nodiscard]] double drift_of(const GuardStart& guard, double x) const;
  [[nodiscard]] FirstFall fall_of(std::size_t slot);
  /// Of all guards: the one that falls first, and where in the series.
  struct Earliest {
    std::optional<std::size_t> slot;
    double at = 1.0;
    bool lost = false;  // a motion that is no number
  };
  [[nodiscard]] Earliest earliest_fall();
  void warn_of_touch(std::size_t slot, double t);
  void see_unarmed(double x);
  [[nodiscard]] std::string hindrance(double scale) const;
  [[nodiscard]] Step failed(std::string reason);
  [[nodiscard]] double x_of(double t) const { return (t - motion_.whole.t) / motion_.whole.scale; }

  const Model& model_;
  const Structure& structure_;
  Taylor taylor_;
  const double t_end_;
  FlowNorm norm_;
  FlowGrowth growth_;
  std::size_t degree_ = 0;  // of all polynomials on the last step
  Segment segment_;
  PiecedSeries motion_;
  std::optional<NearSeries> beside_;  // nothing: each event makes the series of the whole structure anew
  Mode mode_;                         // of the segment, where that counts: beside_
  bool went_on_ = false;              // the segment begins within motion_
  double begin_x_ = 0.0;              // of the step in motion_, up to
  double reach_ = 0.0;                // the end of what it holds,
  double reach_time_ = 0.0;           // at this time
  /// What the polynomials of a contact leave out of displacements, in norm_, and how far these go from their origin.
  struct Reached {
    double rest = 0.0, x = 0.0;
  };
  std::vector<Reached> reached_;
  /// The first fall of a guard in motion_, once looked for.
  struct Fall {
    FirstFall::Kind kind = FirstFall::Kind::none;
    bool stands = false;  // it was looked for, of this guard, and the guard was positive
    double at = 0.0;
  };
  std::vector<Fall> falls_;
  Arming arming_;
  std::vector<double> scales_, weights_, sizes_, guard_, near_sizes_;
  Vector near_column_;
  double greatest_ = 0.0;       // motion, by scales_
  std::size_t polynomial_ = 0;  // greatest degree in the forcing
  int touches_ = 0;
  std::optional<std::mt19937_64> chance_;  // of the lengths of steps
  Point end_;                              // of the last step
  double t_ = 0.0, growth_now_ = 0.0;
  double next_ = 0.0;   // length of the next step of the segment at most
  double begun_ = 0.0;  // the segment
  double pace_ = 0.0;   // time between events lately; 0: none was
  bool paced_ = false;  // no series has been too short yet for the step that pace_ asked for
  double end_x_ = 0.0;  // of the last step in its series
  Step step_;
  SeriesWorks works_;
  TurningPoints turns_;
};

}  // namespace signorini
