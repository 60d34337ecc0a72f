// solver_state.hpp: data of one decision while it is computed.
//
//   check the guards of `states` -> `failed` -> the next states -> ...   until no guard fails
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "decide/massless_jump.hpp"
#include "decide/rigid_contact_solver.hpp"

namespace signorini::decide {

/// Factor on noise and resolution of time, applied if states repeat, or if no guard fails although the engine located one.
inline constexpr double retry_noise_factor = 16.0;

/// All data of a decision in progress.
struct SolverState {
  Instant instant;
  const motion::Forcing& after;
  Decision decision;
  contact::ContactStates states;                     // the states tried last
  std::vector<MotionJet> jets;                       // motion in `states`
  std::vector<FailedGuard> failed;                   // guards that fail in the motion `jets`
  std::vector<contact::ContactStates> tried_states;  // all states tried so far, to detect repetition
  std::vector<ContactMotion> noise_before;           // noise of Decision::before
  ImpactResult impact_result;
  std::vector<std::size_t> undecided;  // blocks that rounding leaves undecided; their states no longer change
  bool noise_increased = false;
  Vector initial_u = {};  // at the start: the given u, before massless parts move
  std::vector<MotionJet> motion_up_to_instant =
      {};  // motion up to the instant; empty if Instant::resting_limits is empty
  std::optional<PathTouch> touched = {};          // first contacts that close on the path in this round
  std::vector<std::size_t> stopped_on_path = {};  // contacts that have slid instantaneously and stopped
  // Contacts with a guard that is not clearly positive; nullopt: unknown, any contact may have one.
  std::optional<std::vector<std::size_t>> open = {};
  const motion::Forcing* forcing = nullptr;  // forcing of the last evaluation
  double noise_factor = 0.0;                 // Instant::noise_factor of the last evaluation
  Eigen::VectorXd held = {};                 // impulses that enforce the constraints of `states` on v

  /// Displacements from which massless parts start their instantaneous motion.
  [[nodiscard]] const Vector& jump_origin() const { return instant.start ? initial_u : instant.u; }

  /// Multiplies noise and resolution by retry_noise_factor, because rounding errors may have separated zeros that are equal.
  /// False: noise and resolution were already increased.
  bool increase_noise() {
    if (std::exchange(noise_increased, true)) return false;
    instant.noise_factor = retry_noise_factor;
    instant.resolution *= retry_noise_factor;
    return true;
  }
};

}  // namespace signorini::decide
