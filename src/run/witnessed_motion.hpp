// witnessed_motion.hpp: what the witness knows of a motion beside u and v: what drives contacts, what loads parts without
// mass, and how far the motion has reached.
//
//   WitnessedMotion motion(model, engine);
//   motion.reach(witness, u, v);
//   WitnessedSide side = motion.side(forcing, t);        u, v, forces, states: to be set
//   motion.leave(forcing, t);                            the instant is over
//
// Of a run (run/run_witness.hpp) and of a directory of results (study/witness/directory_witness.hpp).
#pragma once

#include <array>

#include "engine/tolerance.hpp"
#include "motion/forcing.hpp"
#include "witness/witness.hpp"

namespace signorini {

/// What a run's engine is asked for.
struct WitnessedEngine {
  WitnessLimits limits;
  bool located = true;  ///< it finds the times at which guards are zero
  bool follows = true;  ///< laws hold at ends of steps
  bool sums_over_modes = false;
};
/// flow: "modal" or not. low_flights: it follows flights that are lower than the rounding of their gaps.
[[nodiscard]] WitnessedEngine witnessed_engine(const RunSpec& run, const Tolerance& tolerance,
                                               const std::string& flow, bool low_flights);

/// A row of a contact, but for guard_rate.
[[nodiscard]] RecordedEvent recorded_event(const Event& event);

/// States and forces that a run has left to the one that goes on from it (Model::continues); guessed: of laws of one's own.
[[nodiscard]] std::vector<ContactState> left_states(const Model& model,
                                                    const std::vector<ContactState>& guessed);
[[nodiscard]] Vector left_forces(const Model& model);

class WitnessedMotion {
 public:
  WitnessedMotion(const Model& model, const WitnessedEngine& engine);

  /// At instants alone: what is greater between two is little greater, or of the scene's own scale.
  void reach(const Witness& witness, const Vector& u, const Vector& v);
  /// WitnessedSide::a_reach.
  [[nodiscard]] std::array<double, 2> of_accelerations(const Witness& witness, const Vector& a,
                                                       double dependence) const;
  /// dependence: StepFacts::eigenvector_condition of the motion up to t.
  [[nodiscard]] WitnessedSide side(const Forcing& forcing, double t, double dependence) const;
  /// The same into one that is there, whose memory is used again: one of this motion, whose contacts that nothing drives
  /// stay as they are; or one without `driven`.
  void fill(const Forcing& forcing, double t, double dependence, WitnessedSide& side) const;
  /// Of an instant, with the forcing after it.
  void leave(const Forcing& forcing, double t);

 private:
  [[nodiscard]] Driven driven_at(std::size_t k, const Forcing& forcing, double t) const;

  const Model& model_;
  bool sums_over_modes_, massless_;
  double step_;                      // WitnessLimits::step
  std::vector<std::size_t> driven_;  // contacts whose surface or compression may change
  std::vector<double> jerk_;         // |s'''| of each surface just after the last instant
  std::array<double, 2> u_reach_ = {0.0, 0.0}, v_reach_ = {0.0, 0.0};  // WitnessedSide
  double energy_ = 0.0;                                                // greatest Witness::twice_energy
  double kinetic_ = 0.0;                    // of sums over modes: the greatest v^T M v
  std::vector<double> lightness_, speeds_;  // of each contact; times the root of energy_
  std::array<double, 2> u_modal_ = {0.0, 0.0}, v_modal_ = {0.0, 0.0};  // Witness::modal_size
};

}  // namespace signorini
