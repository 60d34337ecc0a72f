// solver_state.hpp: state of one decision while it is computed.
//
//   check the guards of `states` -> `failed` -> the next states -> ...   until none fails
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "decide/massless_jump.hpp"
#include "decide/rigid_contact_solver.hpp"

namespace signorini::decide {

/// Factor of noise and resolution if states repeat, or if an engine and a decision disagree.
inline constexpr double retry_noise_factor = 16.0;

/// A decision in progress.
struct SolverState {
  Instant instant;
  const motion::Forcing& after;
  Decision decision;
  contact::ContactStates states;                     // the states tried last,
  std::vector<MotionJet> jets;                       // its motion,
  std::vector<FailedGuard> failed;                   // and its failed guards
  std::vector<contact::ContactStates> tried_states;  // states tried so far, for recognising repetition
  std::vector<ContactMotion> noise_before;
  ImpactResult impact_result;
  std::vector<std::size_t> undecided;  // blocks that rounding cannot decide: their states are kept
  bool noise_increased = false;
  Vector initial_u = {};                        // at the start: given u, before massless parts move
  std::vector<MotionJet> so_far = {};           // motion up to the instant; empty if no limit has rested
  std::optional<PathTouch> touched = {};        // first touch of massless parts in this round
  std::vector<std::size_t> slid_contacts = {};  // contacts that have slid instantaneously and stopped
  std::optional<std::vector<std::size_t>> open =
      {};  // contacts with a guard that is not clearly positive; nullopt: any contact
  const motion::Forcing* forcing = nullptr;  // of the last evaluation
  double noise_factor = 0.0;                 // Instant::blur of the last evaluation
  Eigen::VectorXd held = {};  // constraint impulses of the states tried last; Decision::captures

  /// Displacements from which massless parts move instantaneously.
  [[nodiscard]] const Vector& jump_origin() const { return instant.start ? initial_u : instant.u; }

  /// Increases noise and resolution: one sample of rounding, and the clock, may have separated zeros too sharply.
  /// False: this was done before.
  bool increase_noise() {
    if (std::exchange(noise_increased, true)) return false;
    instant.noise_factor = retry_noise_factor;
    instant.resolution *= retry_noise_factor;
    return true;
  }
};

}  // namespace signorini::decide
