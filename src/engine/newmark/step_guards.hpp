// step_guards.hpp: the guards of the current contact states, at both ends of a step of engine `newmark`.
//
//   g0, g1, g0', g1'      values and rates; rates only if displacements, velocities and accelerations determine the rates
//   candidates            waiting guards (active_guards.hpp), guards that are not positive at the end of the step, and guards
//                         that may reach zero inside the step. A zero inside the step is excluded if two curves have positive
//                         Bernstein coefficients: the cubic through values and rates, and the parabola through three values
//
// Most contacts are compliant and have no prescribed motion: their guards are linear forms of N, T, g, ut, vn and vt. The
// coefficients of such guards are stored contiguously, and collected again after a change of the contact's state.
#pragma once

#include "engine/events/active_guards.hpp"
#include "engine/events/step_history.hpp"
#include "engine/stepper.hpp"
#include "motion/point.hpp"

namespace signorini::newmark {

class StepGuards {
 public:
  explicit StepGuards(const Model& model);

  /// Sets the guards of segment.decision, without values. Decision and forcing must stay valid until the next start().
  void start(const engine::Segment& segment);
  /// Evaluates the values and rates of all guards at the end of the step. `point` must contain accelerations.
  void evaluate(const motion::Point& point, double t);
  /// Begins the next step: the values at the end of the last step become the values at the beginning of the next step. Clears
  /// the list of dismiss().
  void begin_next_step();

  [[nodiscard]] const events::ActiveGuards& active_guards() const { return active_guards_; }
  [[nodiscard]] double value(std::size_t slot, double t, const motion::Point& point) const;
  /// Bound on the rounding error of the guard at `point`, which must contain accelerations. The sign of a smaller value is not
  /// significant.
  [[nodiscard]] double level(std::size_t slot, double t, const motion::Point& point) const;
  /// Values and rates at both ends of a step of length h.
  [[nodiscard]] events::GuardCubic path(std::size_t slot, double h) const {
    return {g0_[slot], g1_[slot], h * rate0_[slot], h * rate1_[slot]};
  }
  [[nodiscard]] bool has_rate(std::size_t slot) const { return has_rate_[slot] != 0; }
  /// Place in the step, 0 to 1, at which a guard that is positive at both ends may reach zero, estimated from its rates. If the
  /// rates show no such place, it is estimated from the last three values, because modes far faster than the step make rates
  /// useless. nullopt: there is no such place. h_before: length of the previous step; 0: no previous step.
  [[nodiscard]] std::optional<double> dip(std::size_t slot, double h, double h_before) const;
  /// Makes dip() return nullopt for this guard until the next step. Call it if a shorter step shows that the guard is positive
  /// at the dip.
  void dismiss(std::size_t slot) { dismissed_.push_back(slot); }
  /// Slots of the guards that may reach zero in a step of length h, in ascending order. All other guards stay positive.
  [[nodiscard]] const std::vector<std::size_t>& candidate_slots(double h, double h_before);
  /// Arms waiting guards that are clearly positive at the end of a step.
  void update_active_guards(double t, const motion::Point& point);

 private:
  /// Coefficients of a guard that is a plain linear form (decide/guard_signs.hpp).
  struct LinearGuard {
    double N = 0.0, T = 0.0, gap = 0.0, ut = 0.0, vn = 0.0, vt = 0.0, constant = 0.0;
  };
  /// Data of a contact for candidate_slots().
  struct ContactGuards {
    bool watched = false;  // at least one guard is active
    // True if guards and rows are plain forms, and nothing prescribes the motion of the contact.
    bool is_linear = false;
    bool needs_accelerations = false;  // the rate of at least one guard depends on accelerations
    double gap = 0.0, surface = 0.0;   // initial gap; displacement of the surface
    double normal_gap = 0.0, tangent_N = 0.0, tangent_ut = 0.0;
    std::array<LinearGuard, ContactLaw::max_guards> guards{};
  };
  struct Term {
    std::size_t dof;
    double n, t;
  };
  void gather(std::size_t contact);
  void evaluate_linear(std::size_t contact, const motion::Point& point);
  void evaluate_general(std::size_t contact, const motion::Point& point, double t);
  [[nodiscard]] bool rates_known(std::size_t slot) const;

  const Model& model_;
  std::vector<Term> terms_;           // terms of n . u and t . u of all contacts, in the order of contacts
  std::vector<std::size_t> ends_{0};  // index after the last term of each contact
  engine::Segment segment_;
  contact::ContactStates states_;  // contact states of the last call of gather()
  events::ActiveGuards active_guards_;
  std::vector<ContactGuards> contact_guards_;  // one entry for each contact
  // One entry for each slot. before_: value at the beginning of the previous step.
  std::vector<double> before_, g0_, g1_, rate0_, rate1_;
  std::vector<char> has_rate_;
  std::vector<std::size_t> waiting_, dismissed_, candidate_slots_;
};

}  // namespace signorini::newmark
