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

/// Factor on noise and resolution of time if states repeat, or if a guard that an engine located does not
/// fail.
inline constexpr double retry_noise_factor = 16.0;

/// A decision in progress.
struct SolverState {
  Instant instant;
  const motion::Forcing& after;
  Decision decision;
  contact::ContactStates states;                     // states tried last
  std::vector<MotionJet> jets;                       // motion in these states
  std::vector<FailedGuard> failed;                   // guards that fail in this motion
  std::vector<contact::ContactStates> tried_states;  // states tried so far, to recognise repetition
  std::vector<ContactMotion> noise_before;           // noise of Decision::before
  ImpactResult impact_result;
  std::vector<std::size_t> undecided;  // blocks that rounding cannot decide: their states are kept
  bool noise_increased = false;
  Vector initial_u = {};                        // at the start: given u, before massless parts move
  std::vector<MotionJet> so_far = {};           // motion up to the instant; empty: no Instant::resting_limits
  std::optional<PathTouch> touched = {};        // first touch of massless parts in this round
  std::vector<std::size_t> slid_contacts = {};  // contacts that have slid instantaneously and stopped
  // Contacts with a guard that is not clearly positive; nullopt: any contact.
  std::optional<std::vector<std::size_t>> open = {};
  const motion::Forcing* forcing = nullptr;  // forcing of the last evaluation
  double noise_factor = 0.0;                 // Instant::noise_factor of the last evaluation
  Eigen::VectorXd held = {};  // impulses by which v was set on the constraints of the states tried last

  /// Displacements from which massless parts move instantaneously.
  [[nodiscard]] const Vector& jump_origin() const { return instant.start ? initial_u : instant.u; }

  /// Increases noise and resolution by retry_noise_factor: the rounding of one sample may have separated
  /// zeros too sharply. False: both have been increased before.
  bool increase_noise() {
    if (std::exchange(noise_increased, true)) return false;
    instant.noise_factor = retry_noise_factor;
    instant.resolution *= retry_noise_factor;
    return true;
  }
};

}  // namespace signorini::decide
