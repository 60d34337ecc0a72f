// solver_state.hpp: state of one decision while it is computed.
//
//   check the guards of `mode` -> `failed` -> the next mode -> ...       until none fails
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "decide/massless_jump.hpp"
#include "decide/rigid_contact_solver.hpp"

namespace signorini::decide {

/// Factor of noise and resolution if modes repeat, or if an engine and a decision disagree.
inline constexpr double unlucky = 16.0;

/// A decision in progress.
struct SolverState {
  Instant instant;
  const motion::Forcing& after;
  Decision decision;
  contact::ContactStates mode;               // the mode tried last,
  std::vector<MotionJet> jets;               // its motion,
  std::vector<Failure> failed;               // and its failed guards
  std::vector<contact::ContactStates> seen;  // modes tried so far, for recognising repetition
  std::vector<ContactMotion> noise_before;
  ImpactResult found;
  std::vector<std::size_t> undecided;  // blocks that rounding cannot decide: their states are kept
  bool blurred = false;
  Vector given = {};                       // at the start: given u, before massless parts move
  std::vector<MotionJet> so_far = {};      // motion up to the instant; empty if no limit has rested
  std::optional<TouchOnWay> touched = {};  // first touch of massless parts in this round
  std::vector<std::size_t> slid = {};      // contacts that have slid instantaneously and stopped
  std::optional<std::vector<std::size_t>> open =
      {};  // contacts with a guard that is not clearly positive; nullopt: any contact
  const motion::Forcing* forcing = nullptr;  // of the last evaluation
  double blur = 0.0;                         // Instant::blur of the last evaluation
  Eigen::VectorXd held = {};                 // constraint impulses of the mode tried last; Decision::captures

  /// Displacements from which massless parts move instantaneously.
  [[nodiscard]] const Vector& comes_from() const { return instant.start ? given : instant.u; }

  /// Increases noise and resolution: one sample of rounding, and the clock, may have separated zeros too sharply.
  /// False: this was done before.
  bool make_blurred() {
    if (std::exchange(blurred, true)) return false;
    instant.blur = unlucky;
    instant.resolution *= unlucky;
    return true;
  }
};

}  // namespace signorini::decide
