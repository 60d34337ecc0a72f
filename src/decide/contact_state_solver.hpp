// contact_state_solver.hpp: decides the states of all contacts just after an instant.
//
//   every guard g of the new states:  g, g', g'', ...  is lexicographically nonnegative
//
// The states after an instant are consistent if no guard becomes negative just after the instant. A contact whose guard fails
// takes its next state (contact/law.hpp). The motion is then computed again in the new states, until no guard fails. Rigid
// contacts are decided together (decide/rigid_contact_solver.hpp): velocities first if a contact closes with g' < 0, then
// accelerations and their derivatives. Sliders without tangential stiffness are decided with the rigid contacts if states
// repeat, or if several contacts may constrain the same motion. If states still repeat, decide/cycle_fallback.hpp continues.
//
// If no states are consistent, the decision is refused. If a low flight was replaced by rest, a second attempt computes this
// flight. If the second attempt is refused as well, a third attempt treats slip rates up to the speed of the replaced flights
// as zero.
#pragma once

#include "decide/cycle_fallback.hpp"
#include "motion/local_derivatives.hpp"

namespace signorini::decide {

class ContactStateSolver {
 public:
  /// max_rounds: limit for the rounds of state changes at one instant. capture_velocity: value for rigid contacts
  /// without their own value. whole_jets: true if the caller uses derivatives in Decision::jet beyond accelerations and force
  /// rates.
  ContactStateSolver(motion::StateSystems& systems, int max_rounds, double capture_velocity,
                     bool whole_jets = true);

  /// Decides the states just after an instant. `before` and `after`: the forcing just before and just after the instant.
  [[nodiscard]] Decision decide(Instant instant, const motion::Forcing& before, const motion::Forcing& after);
  /// Decision with the given states, for an engine that determines the states itself. Computes forces and accelerations; they
  /// are equal before and after the instant.
  [[nodiscard]] Decision adopt(const Instant& instant, const contact::ContactStates& states,
                               const motion::Forcing& forcing);

  /// Refusal for a run in which events repeat without progress in time. last: the last decision; contacts: contacts of these
  /// events. The refusal contains the condition number for the forces of these contacts.
  [[nodiscard]] Refusal standstill(const Decision& last, std::vector<std::size_t> contacts,
                                   std::string reason);

  /// Sets a listener, which is called in each round with the contact states that were tried.
  void trace(RoundListener listener) { listener_ = std::move(listener); }

 private:
  struct Attempt {
    Decision decision;
    bool flight_taken_as_rest = false;  // ImpactResult::flight_taken_as_rest
    double max_rest_speed = 0.0;
  };
  [[nodiscard]] Attempt attempt(const Instant& instant, const motion::Forcing& before,
                                const motion::Forcing& after);
  [[nodiscard]] bool evaluate(const motion::Forcing& forcing, contact::ContactStates& states,
                              SolverState& solver_state);
  [[nodiscard]] Refusal begin(const motion::Forcing& before, SolverState& solver_state);
  void check_guards(SolverState& solver_state, bool before);
  void restart_path_at_stop(const FailedGuard& f, SolverState& solver_state) const;
  [[nodiscard]] std::vector<Block> decide_separate_contacts(SolverState& solver_state) const;
  void stop(const std::vector<std::size_t>& turning, SolverState& solver_state) const;
  void record_closed_gaps(SolverState& solver_state) const;
  [[nodiscard]] Refusal propose_states(SolverState& solver_state);
  [[nodiscard]] Refusal try_next_states(SolverState& solver_state);
  [[nodiscard]] bool held_by_others(std::size_t c, const SolverState& solver_state) const;
  [[nodiscard]] bool guard_is_kept_at_zero(std::size_t c, Guard guard, const SolverState& solver_state) const;
  void add_released(SolverState& solver_state) const;
  [[nodiscard]] Refusal iterate(const motion::Forcing& before, SolverState& solver_state);
  [[nodiscard]] static bool sticks_at_limit(const SolverState& solver_state, std::size_t c,
                                            const GuardStart& guard, double noise);
  [[nodiscard]] bool stops_at_static_limit(const SolverState& solver_state, std::size_t c,
                                           const GuardStart& guard, double noise) const;
  [[nodiscard]] static bool has_clear_guards(const SolverState& solver_state, std::size_t c);
  void check_guard_start(SolverState& solver_state, std::size_t contact, const GuardForm& guard,
                         GuardStart& start) const;
  void finish(SolverState& solver_state);
  void record_released(const SolverState& solver_state, Decision& decision) const;
  [[nodiscard]] Refusal refuse_undetermined_slip(const SolverState& solver_state) const;
  [[nodiscard]] std::vector<motion::BodySlide> slides(const motion::Forcing& forcing,
                                                      const Decision& decision) const;

  const Model& model_;
  motion::StateSystems& systems_;
  motion::JetMaker jets_;
  std::optional<motion::LocalDerivatives> local_derivatives_;  // nullopt: jets of the whole structure
  const std::vector<std::size_t> all_contacts_;                // indices of all contacts
  int max_rounds_;
  RigidContactSolver rigid_solver_;
  GuardCache guards_;
  ContactBlocks blocks_;
  CycleFallback cycle_fallback_;
  bool decide_separately_ = false;  // true: contacts are decided one by one unless states repeat
  std::vector<MotionJet> scratch_;  // memory for jets, reused by each decision
  RoundListener listener_;
};

}  // namespace signorini::decide
