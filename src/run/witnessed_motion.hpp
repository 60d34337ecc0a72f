// witnessed_motion.hpp: data of a motion that the witness needs in addition to u and v: motions and forces that drive
// contacts, loads on massless parts, and the largest displacements so far.
//
//   WitnessedMotion motion(model, engine);
//   motion.reach(witness, u, v);
//   WitnessedSide side = motion.side(forcing, t);        u, v, forces, states: to be set
//   motion.leave(forcing, t);                            the instant is over
//
// Used for a run (run/run_witness.hpp) and for a directory of results (study/witness/directory_witness.hpp).
#pragma once

#include <array>

#include "engine/tolerance.hpp"
#include "motion/forcing.hpp"
#include "witness/witness.hpp"

namespace signorini {

/// Limits and abilities of a run's engine.
struct WitnessedEngine {
  WitnessLimits limits;
  bool located = true;  ///< the engine locates the zeros of guards
  bool follows = true;  ///< laws hold at ends of steps
  bool sums_over_modes = false;
};
/// flow: "modal" or not. low_flights: the engine computes flights lower than the rounding of their gaps.
[[nodiscard]] WitnessedEngine witnessed_engine(const RunSpec& run, const Tolerance& tolerance,
                                               const std::string& flow, bool low_flights);

/// Event row of a contact, without guard_rate.
[[nodiscard]] RecordedEvent recorded_event(const Event& event);

/// Final states and forces of the run that is continued (Model::continues); guessed: states for user-defined laws.
[[nodiscard]] std::vector<ContactState> left_states(const Model& model,
                                                    const std::vector<ContactState>& guessed);
[[nodiscard]] Vector left_forces(const Model& model);

class WitnessedMotion {
 public:
  WitnessedMotion(const Model& model, const WitnessedEngine& engine);

  /// Called at instants only: values between two instants are hardly larger, or of the scene's own scale.
  void reach(const Witness& witness, const Vector& u, const Vector& v);
  /// Value of WitnessedSide::a_reach.
  [[nodiscard]] std::array<double, 2> of_accelerations(const Witness& witness, const Vector& a,
                                                       double dependence) const;
  /// dependence: StepFacts::eigenvector_condition of the motion up to t.
  [[nodiscard]] WitnessedSide side(const Forcing& forcing, double t, double dependence) const;
  /// The same for an existing side, whose memory is reused. It must come from this motion, since constant `driven`
  /// entries are kept, or be without `driven`.
  void fill(const Forcing& forcing, double t, double dependence, WitnessedSide& side) const;
  /// Ends an instant, with the forcing after it.
  void leave(const Forcing& forcing, double t);

 private:
  [[nodiscard]] Driven driven_at(std::size_t k, const Forcing& forcing, double t) const;

  const Model& model_;
  bool sums_over_modes_, massless_;
  double step_;                      // WitnessLimits::step
  std::vector<std::size_t> driven_;  // contacts whose surface or compression may change
  std::vector<double> jerk_;         // |s'''| of each surface just after the last instant
  std::array<double, 2> u_reach_ = {0.0, 0.0}, v_reach_ = {0.0, 0.0};  // WitnessedSide
  double energy_ = 0.0;                                                // largest Witness::twice_energy
  double kinetic_ = 0.0;                                               // for sums over modes: largest v^T M v
  std::vector<double> lightness_, speeds_;  // of each contact; times the root of energy_
  std::array<double, 2> u_modal_ = {0.0, 0.0}, v_modal_ = {0.0, 0.0};  // Witness::modal_size
};

}  // namespace signorini
