// friction_iteration.hpp: engine `friction-iteration`: the reference method of the paper.
//
//   repeat within a step of fixed length, with the bounds B_k = f |N_k| of the last iterate:
//     contact states for the given bound:
//       open if N > 0;  T = kt (ut - p) while |T| <= B,  else T = s B
//     B := B + w (f |N| - B)
//   until no bound changes
//
// Events are not located: a change of a contact state is an event at the end of the step, but a contact that closes in a step
// acts from the beginning of this step. T = s B is a load, so the matrices are symmetric. The iteration may cycle, because with
// high friction T has a strong effect on N. Then the engine stops the run and reports the failure.
// Source: Lukashevich et al. 2021, the iterative algorithm.
#pragma once

#include <numbers>

#include "engine/newmark/newmark_step.hpp"
#include "engine/stepper.hpp"
#include "motion/consistent_motion.hpp"
#include "motion/point.hpp"

namespace signorini::newmark {

class FrictionIteration final : public engine::Stepper, public engine::DenseOutput {
 public:
  /// The first three arguments must outlive the object. run.dt must be given.
  FrictionIteration(const Model& model, const linear::SystemMatrices& structure,
                    motion::StateSystems& systems, const RunSpec& run);

  void start(const engine::Segment& segment) override;
  [[nodiscard]] engine::Step advance() override;
  [[nodiscard]] engine::DenseOutput& dense_output() override { return *this; }
  void evaluate(double t, motion::Point& point) override;
  void accelerate(double t, motion::Point& point) override;
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
  [[nodiscard]] double guard_error(const GuardForm&, const ContactMotion&, std::size_t) const override {
    return 0.0;
  }

 private:
  /// Iterate of a contact during a step.
  struct ContactIterate {
    State state = State::open;  // state in the last iterate
    double anchor = 0.0;        // slip p that applies if the contact sticks at the end of the step
    double normal_force = 0.0;  // |N| that determines the bound B of |T|
  };
  struct ForceScale {
    double greatest = 0.0, error = 0.0;  // largest contact force; error of a converged bound, as a force
  };
  [[nodiscard]] ForceScale known_forces(const motion::Point& point) const;
  void begin_iterates();
  void apply_rows();
  [[nodiscard]] State state_of(std::size_t k) const;
  [[nodiscard]] bool update_states();
  [[nodiscard]] std::string iterate(double h, bool kept);
  void solve_massless_velocities();

  const Model& model_;
  const linear::SystemMatrices& structure_;
  const double dt_, relaxation_;
  const int max_iterations_;
  NewmarkStep step_;
  NewmarkWorkIntegrals works_;
  motion::StateSystems& systems_;
  motion::ConsistentMotion consistent_;
  engine::Segment segment_;
  std::vector<ContactIterate> iterates_;
  NewmarkStep::Key key_, key_in_force_;
  contact::ContactStates states_;  // states at the end of the last step
  bool changed_ = false;
  double bound_error_ = 0.0;  // allowed violation of |T| <= f |N|, as a force
  motion::Point begin_, end_;
  double t0_ = 0.0, t1_ = 0.0;
  double segment_dt_ = 0.0;  // length of full steps: dt, or less in a short pulse
};

}  // namespace signorini::newmark
