// contact_state_solver.hpp: the states of all contacts just after an instant.
//
//   every guard g of the new states:  g, g', g'', ...  is lexicographically not negative
//
// The states after an instant are those whose guards hold on the solution after it. A contact whose guard
// fails takes its next state (contact/law.hpp). The jet is then expanded again with the new states, until all
// guards hold. Rigid contacts are decided together (decide/rigid_contact_solver.hpp): velocities first if one
// closes with g' < 0, then accelerations and their derivatives. Sliders without tangential stiffness join
// them if their own states repeat, or if several of them may hold one motion. If states repeat,
// decide/cycle_fallback.hpp continues.
//
// If no states are consistent, the decision is refused. If a flight was taken as rest because of its height
// only, a second attempt computes this flight. If that attempt is refused as well, a third attempt takes slip
// rates as small as the speeds of such flights as zero.
#pragma once

#include "decide/cycle_fallback.hpp"
#include "motion/local_derivatives.hpp"

namespace signorini::decide {

class ContactStateSolver {
 public:
  /// max_rounds: limit for the rounds of state changes at one instant. capture_velocity: for rigid contacts
  /// without a value of their own. whole_jets: Decision::jet is used beyond accelerations and the rates of
  /// forces.
  ContactStateSolver(motion::StateSystems& systems, int max_rounds, double capture_velocity,
                     bool whole_jets = true);

  /// Decides the states just after an instant. `before`, `after`: the forcing on both sides of it.
  [[nodiscard]] Decision decide(Instant instant, const motion::Forcing& before, const motion::Forcing& after);
  /// Adopts `states` from an engine that finds states, but not the instants at which they change: computes
  /// their forces and accelerations, which are the same before and after.
  [[nodiscard]] Decision adopt(const Instant& instant, const contact::ContactStates& states,
                               const motion::Forcing& forcing);

  /// Refusal that ends a run whose events take no time, after the decision `last`: the reason with its
  /// contacts and the condition number of their forces.
  [[nodiscard]] Refusal standstill(const Decision& last, std::vector<std::size_t> contacts,
                                   std::string reason);

  /// Sets a listener that is called with the contact states of every round.
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
  void stop_there(const FailedGuard& f, SolverState& solver_state) const;
  [[nodiscard]] std::vector<Block> react(SolverState& solver_state) const;
  void stop(const std::vector<std::size_t>& turning, SolverState& solver_state) const;
  void note_hits(SolverState& solver_state) const;
  [[nodiscard]] Refusal propose(SolverState& solver_state);
  [[nodiscard]] Refusal try_next(SolverState& solver_state);
  [[nodiscard]] bool held_by_others(std::size_t c, const SolverState& solver_state) const;
  [[nodiscard]] bool holds_foot(std::size_t c, Guard guard, const SolverState& solver_state) const;
  void add_released(SolverState& solver_state) const;
  [[nodiscard]] Refusal iterate(const motion::Forcing& before, SolverState& solver_state);
  [[nodiscard]] static bool rests_at_limit(const SolverState& solver_state, std::size_t c,
                                           const GuardStart& guard);
  [[nodiscard]] bool meets_static_limit(const SolverState& solver_state, std::size_t c,
                                        const GuardStart& guard) const;
  [[nodiscard]] static bool clearly_holds(const SolverState& solver_state, std::size_t c);
  void check_guard_start(SolverState& solver_state, std::size_t contact, const GuardForm& guard,
                         GuardStart& start) const;
  void finish(SolverState& solver_state);
  void record_released(const SolverState& solver_state, Decision& decision) const;
  [[nodiscard]] Refusal held_at_rest(const SolverState& solver_state) const;
  [[nodiscard]] std::vector<motion::BodySlide> slides(const motion::Forcing& forcing,
                                                      const Decision& decision) const;

  const Model& model_;
  motion::StateSystems& systems_;
  motion::JetMaker jets_;
  std::optional<motion::LocalDerivatives> local_derivatives_;  // nullopt: jets use the whole structure
  const std::vector<std::size_t> all_contacts_;                // all contacts
  int max_rounds_;
  RigidContactSolver rigid_solver_;
  GuardCache guards_;
  ContactBlocks blocks_;
  CycleFallback cycle_fallback_;
  bool decide_separately_ = false;  // contacts are decided separately, except if states repeat
  std::vector<MotionJet> scratch_;  // memory of the last decision, reused by the next one
  RoundListener listener_;
};

}  // namespace signorini::decide
