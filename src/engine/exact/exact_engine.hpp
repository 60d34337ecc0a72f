// exact_engine.hpp: engine `exact`: the flow of each mode in closed form, and no event unseen.
//
//   u(t + s x) = sum_k u_k x^k        motion/taylor.hpp; h = s x chosen so that the rest is below rounding
//   guard(x)   = sum_k g_k x^k        first fall by interval bounds, engine/falls/first_fall.hpp
//
// Between events the system of a mode is linear with constant coefficients, so its Taylor series has the
// radius of the forcing's, infinite, and |x_(k+1)| <= W s/(k+1) |x_k| with W the greatest growth of the mode.
// A step is as long as the series still converges to rounding with that bound, and short enough that its
// terms do not cancel. docs/theory.md gives the argument that no event is missed. What lies behind an event is computed in
// vain, so that a step which begins at one is no longer than twice the time between events lately.
//
// W of a state is found from twenty levels of a series. Of large structures most states differ from one that is known in
// few soft contacts; in the norm of flow_norm.hpp these add at most
//   W^2 <= W_0^2 + sum over contacts that differ ( kn |M^-1 n| |n| + kt |M^-1 t| |t| + f kn |M^-1 t| |n| )
// and that is taken as long as it adds little.
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <random>

#include "engine/exact/flow_norm.hpp"
#include "engine/exact/series_works.hpp"
#include "engine/falls/arming.hpp"
#include "engine/falls/first_fall.hpp"
#include "engine/falls/turning_points.hpp"
#include "engine/stepper.hpp"
#include "motion/contact_series.hpp"

namespace signorini {

/// Terms of a series at most.
inline constexpr int most_levels = 30;
/// Growths of modes are kept longer than their systems: one takes a series to find and 8 bytes to keep.
inline constexpr CacheBounds most_growths{16384, std::size_t{1} << 20};

class ExactEngine final : public Stepper {
 public:
  /// All but t_end must outlive it. step_seed: not 0: steps are shorter by chance (share_of_step).
  ExactEngine(const Model& model, const Structure& structure, ModeSystems& systems, double t_end,
              std::uint64_t step_seed = 0);

  void start(const Segment& segment) override;
  [[nodiscard]] Step advance() override;
  void evaluate(double t, Point& point) override;
  /// Without accelerations.
  void glimpse(double t, Point& point) override;
  void glimpse(double t, std::size_t contact, Point& point) override;
  [[nodiscard]] std::optional<std::vector<ContactTurn>> contact_turns() const override;
  void integrate(double from, double to, Works& works) override;
  [[nodiscard]] double residual() override;
  /// The guard is exact but for rounding, which the decision knows.
  [[nodiscard]] double guard_error(const Form&, const ContactMotion&, std::size_t) const override {
    return 0.0;
  }
  [[nodiscard]] bool knows_low_flights() const override { return true; }
  [[nodiscard]] const std::vector<double>& turning_points() const override { return turns_.times(); }
  [[nodiscard]] double turns() const override { return std::numbers::pi * static_cast<double>(degree_); }
  [[nodiscard]] Expansion expansion() const override {
    return {&series_, degree_, end_x_, taylor_.system().get()};
  }

 private:
  [[nodiscard]] double growth_of(const ModeSystemPtr& system);
  [[nodiscard]] double probed_growth(const ModeSystemPtr& system);
  [[nodiscard]] std::optional<double> growth_beside(const ModeSystem& system);
  [[nodiscard]] double stiffening(const ModeSystem& system, std::size_t contact);
  [[nodiscard]] double few_flights() const;
  void choose_first_step();
  [[nodiscard]] double share_of_step();
  void weigh();
  void measure(std::size_t first, std::size_t last);
  [[nodiscard]] bool stands(const double* a, std::size_t last, double x) const;
  [[nodiscard]] bool stands(double x) const;
  [[nodiscard]] double expand(double scale);
  [[nodiscard]] double rest_of(const Form& form, std::size_t contact, double x, double rest) const;
  [[nodiscard]] double rest_of_series(double x);
  [[nodiscard]] double drift_of(const GuardStart& guard, double x) const;
  [[nodiscard]] FirstFall fall_of(std::size_t slot, double x, double rest);
  /// Of all guards on [0, x]: the one that falls first, and in which part of the step.
  struct Earliest {
    std::optional<std::size_t> slot;
    double at = 1.0;
    bool lost = false;  // a motion that is no number
  };
  [[nodiscard]] Earliest earliest_fall(double x);
  void warn_of_touch(std::size_t slot, double t);
  void see_unarmed(double x);
  [[nodiscard]] std::string hindrance(double scale) const;
  [[nodiscard]] Step failed(std::string reason);
  void evaluate_at(double x, Point& point) const;
  void place_at(double x, Point& point) const;

  const Model& model_;
  const Structure& structure_;
  Taylor taylor_;
  const double t_end_;
  FlowNorm norm_;
  std::size_t degree_ = 0;  // of all polynomials on the last step
  BoundedCache<std::vector<State>, double> growth_{most_growths};
  std::vector<State> near_;  // the last states whose growth was found from a series; empty: none
  double near_growth_ = 0.0;
  std::vector<double> stiffenings_;  // one a contact; negative: not known yet
  Segment segment_;
  Series series_;
  std::vector<ContactSeries> contacts_;
  Arming arming_;
  std::vector<double> scales_, weights_, sizes_, guard_;
  double fastest_ = 0.0;        // bound on all rates of the structure, for scaling
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
