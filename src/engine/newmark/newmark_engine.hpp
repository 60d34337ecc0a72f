// newmark_engine.hpp: engine `newmark`: the paper's step-by-step algorithm.
//
//   1. trial step in the current contact states (newmark_step.hpp)
//   2. evaluate the guards at the end of this step; find the guard that reaches zero first
//   3. repeat the step up to the time of this root -> event
//
//   refine = "root"    shorter steps are tried until the guard at the end is zero to the resolution of time (Brent)
//   refine = "linear"  one shorter step up to the interpolated time, (8) to (10); further steps only if the guard is still
//                      positive; contacts without springs are treated as with "root"
//
// The step after an event has the full length again. Factorisations are cached by contact states and step length, so only new
// contact states need a factorisation. Inside a step, the solution at t is that of a shorter step to t, which also satisfies
// equilibrium and the contact laws. Source: Lukashevich et al. 2021, (5) to (11), corrected as described in docs/theory.md.
#pragma once

#include <numbers>

#include "engine/events/step_history.hpp"
#include "engine/newmark/newmark_step.hpp"
#include "engine/newmark/step_guards.hpp"
#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"
#include "motion/consistent_motion.hpp"
#include "motion/point.hpp"

namespace signorini::newmark {

class NewmarkEngine final : public engine::Stepper, public engine::DenseOutput {
 public:
  /// The first three arguments must outlive the object. run.dt must be given.
  NewmarkEngine(const Model& model, const linear::SystemMatrices& structure, motion::StateSystems& systems,
                const RunSpec& run, const engine::Tolerance& tolerance);

  void start(const engine::Segment& segment) override;
  [[nodiscard]] engine::Step advance() override;
  [[nodiscard]] engine::DenseOutput& dense_output() override { return *this; }
  void evaluate(double t, motion::Point& point) override;
  void accelerate(double t, motion::Point& point) override;
  void interpolate(double t, motion::Point& point) override;
  void integrate(double from, double to, motion::WorkIntegrals& works) override;
  /// The motion is a parabola on the step, so its phase angle is 2 pi.
  [[nodiscard]] engine::StepFacts facts() const override {
    engine::StepFacts facts;
    facts.phase_angle = 2.0 * std::numbers::pi;
    return facts;
  }
  [[nodiscard]] double residual() override {
    return motion::equilibrium_residual(model_, structure_, *segment_.forcing, t1_, end_);
  }
  [[nodiscard]] double guard_error(const GuardForm& guard, const ContactMotion& motion,
                                   std::size_t contact) const override;

 private:
  /// A guard that may reach zero in the step; its zero is not yet located.
  struct Candidate {
    enum class Kind { none, crossing, dip, sink } kind = Kind::none;
    std::size_t slot = 0;
    double x = 2.0;  // approximate place of the zero in the step, 0 to 1; greater than 1: no candidate
  };

  [[nodiscard]] bool take(double h, double t, bool kept, motion::Point& to);
  [[nodiscard]] bool violates_guard(double t, const motion::Point& point) const;
  [[nodiscard]] const motion::Point& point_inside(double t);
  [[nodiscard]] std::optional<double> dip_of(std::size_t slot, double h) const;
  /// Bound on the rounding error of the guard at the end of the step. The sign of a smaller value is not significant.
  [[nodiscard]] double level(std::size_t slot) const { return guards_.level(slot, t1_, end_); }
  [[nodiscard]] double value_after(std::size_t slot, double h);
  [[nodiscard]] double value_near(std::size_t slot, double h, double longer);
  [[nodiscard]] Candidate earliest_candidate(double h, bool located, std::size_t slot);
  [[nodiscard]] bool has_springs(std::size_t slot) const;
  [[nodiscard]] double zero_of(std::size_t slot) const;
  [[nodiscard]] double crossing_between(std::size_t slot, double lo, double g_lo, double hi, double g_hi,
                                        double floor = 0.0);
  /// Estimated root of a guard (at, a step length), and the slope of the tangent or secant that leads to it.
  struct Tangent {
    double at = 0.0, slope = 0.0;
  };
  [[nodiscard]] std::optional<Tangent> tangent_near(std::size_t slot, double h, Tangent first);
  [[nodiscard]] double crossing_near(std::size_t slot, double h);
  [[nodiscard]] bool interpolates(std::size_t slot) const;
  [[nodiscard]] double linear_root(std::size_t slot, double hi);
  [[nodiscard]] bool was_never_positive(std::size_t slot) const;
  /// Shortens the step length h to the time of the candidate's event. False: the candidate is no event.
  [[nodiscard]] bool locate(const Candidate& candidate, double& h);
  [[nodiscard]] bool end_after(double h);
  [[nodiscard]] double length_by_doubling(double remaining);
  engine::Step failed(std::string reason) const;

  const Model& model_;
  const linear::SystemMatrices& structure_;
  motion::ConsistentMotion consistent_;
  const engine::Tolerance tolerance_;
  const double dt_;
  const bool linear_, doubling_;
  NewmarkStep step_;
  NewmarkWorkIntegrals works_;
  engine::Segment segment_;
  StepGuards guards_;
  // True if there are massless parts. Their velocities are computed from the equations after each step.
  bool solves_massless_velocities_ = false;
  motion::Point begin_, end_, inner_, fine_, coarse_;
  Vector a_before_;          // accelerations at the beginning of the previous step; empty: no previous step
  double inner_time_ = 0.0;  // time of inner_; NaN: not set
  double tried_ = 0.0;       // length of the step from begin_ to inner_; 0: inner_ is not set
  double t0_ = 0.0, t1_ = 0.0;       // beginning and end of the last step
  double h_ = 0.0, h_before_ = 0.0;  // length of the last step and of the previous step (0: none)
  double regular_ = 0.0;             // length of steps without events
  double segment_dt_ = 0.0;          // fixed steps: dt, or less in a short pulse
  // Fixed steps end at grid_begin_ + grid_steps_ * grid_length_, so that rounding errors do not add up.
  double grid_begin_ = 0.0;
  double grid_length_ = 0.0;
  long grid_steps_ = 0;
  /// Event of a guard that started at zero and was positive at none of the tried step lengths.
  struct NeverPositiveGuard {
    double t = 0.0;
    std::size_t slot = 0;
    Guard guard = Guard::none;
  };
  std::optional<NeverPositiveGuard> never_positive_guard_;  // last event of this kind
  bool second_ = false;  // step doubling: this is the second step of a pair
};

}  // namespace signorini::newmark
