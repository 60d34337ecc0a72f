// run_law_checker.hpp: passes each instant of a run to the law checker, and stores the violations.
//
//   (u, v-, N-, T-, states-), impulses, captures, events, (u, v+, a+, N+, T+, states+)  ->  law_check/law_checker.hpp
//
// The data that engine, decision and event log recorded are passed on unchanged. Units: those of the computed model.
#pragma once

#include <array>

#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"
#include "law_check/law_checker.hpp"
#include "motion/forcing.hpp"

namespace signorini::run {

// Data of a motion that the law checker needs in addition to u and v: prescribed motions and normal forces of contacts,
// loads on massless parts, and the largest displacements and velocities so far.
//
//   CheckedMotion motion(model, engine);
//   motion.update_maxima(checker, u, v);
//   CheckedSide side = motion.side(forcing, t, condition);   the caller sets u, v, forces and states
//   motion.finish_instant(forcing, t);
//
// Used during a run, and for a directory of results (study/law_check/directory_law_checker.hpp).

/// Limits and capabilities of the engine of a run.
struct CheckedEngine {
  law_check::LawLimits limits;
  bool located = true;            ///< the engine locates the zeros of guards
  bool laws_at_step_ends = true;  ///< contact laws are satisfied at the ends of steps
  bool sums_over_modes = false;   ///< the motion is a sum over modes
};
/// Limits and capabilities of run.engine. flow: "modal", or another flow of the engine; low_flights: the engine computes
/// flights that are lower than the rounding of their gaps.
[[nodiscard]] CheckedEngine checked_engine(const RunSpec& run, const engine::Tolerance& tolerance,
                                           const std::string& flow, bool low_flights);

/// Copy of an event for the law checker, without guard_rate.
[[nodiscard]] law_check::RecordedEvent recorded_event(const Event& event);

/// Final contact states and forces of the previous run, if the model continues one (Model::continues). Contacts with user
/// laws keep the states in `guessed`.
[[nodiscard]] std::vector<ContactState> final_states(const Model& model,
                                                     const std::vector<ContactState>& guessed);
[[nodiscard]] Vector final_forces(const Model& model);

class CheckedMotion {
 public:
  CheckedMotion(const Model& model, const CheckedEngine& engine);

  /// Updates the largest displacements and velocities. Called at instants only: between two instants the values are hardly
  /// larger, or stay below the scene's scales.
  void update_maxima(const law_check::LawChecker& witness, const Vector& u, const Vector& v);
  /// Value of CheckedSide::acceleration_terms for the acceleration a. dependence: StepFacts::eigenvector_condition.
  [[nodiscard]] std::array<double, 2> acceleration_terms(const law_check::LawChecker& witness,
                                                         const Vector& a, double dependence) const;
  /// Data of one side of an instant. dependence: StepFacts::eigenvector_condition of the motion up to t.
  [[nodiscard]] law_check::CheckedSide side(const motion::Forcing& forcing, double t,
                                            double dependence) const;
  /// Sets the data of side() in an existing side, whose memory is reused. side.driven must be empty or a result of this
  /// object, since constant entries are not computed again.
  void fill(const motion::Forcing& forcing, double t, double dependence, law_check::CheckedSide& side) const;
  /// Ends an instant. forcing: the forcing just after it.
  void finish_instant(const motion::Forcing& forcing, double t);

 private:
  [[nodiscard]] law_check::Driven driven_at(std::size_t k, const motion::Forcing& forcing, double t) const;

  const Model& model_;
  bool sums_over_modes_, massless_;
  double step_;                      // LawLimits::step
  std::vector<std::size_t> driven_;  // contacts whose surface motion or given normal force may change
  std::vector<double> jerk_;         // |s'''| of each surface just after the last instant
  // Largest |u_i| and |v_i| so far: [0] of translations, [1] of rotations.
  std::array<double, 2> u_reach_ = {0.0, 0.0}, v_reach_ = {0.0, 0.0};
  double energy_ = 0.0;  // largest LawChecker::twice_energy
  // Largest v^T M v, if motions are sums over modes.
  double kinetic_ = 0.0;
  // For each contact: LawChecker::speed_per_energy_root, and its product with sqrt(energy_).
  std::vector<double> lightness_, speeds_;
  std::array<double, 2> u_modal_ = {0.0, 0.0}, v_modal_ = {0.0, 0.0};  // LawChecker::modal_size
};

/// Limit of the number of stored violations; further violations are only counted.
inline constexpr std::size_t max_stored_violations = 100;

/// Position of a contact at the start, and its largest distances from this position.
struct ObservedPeak {
  double g0 = 0.0, ut0 = 0.0, surface = 0.0;  // surface: largest displacement of the contact's surface
  Peak most;
};

class RunLawChecker {
 public:
  /// All arguments must outlive the object; the recorder receives instants if it wants them.
  RunLawChecker(const Model& model, const CheckedEngine& engine, Recorder& recorder);

  struct Instant {
    double t = 0.0, resolution = 0.0;
    const motion::Point* before = nullptr;
    const contact::ContactStates* states_before = nullptr;
    const motion::Forcing *forcing_before = nullptr, *forcing_after = nullptr;
    const decide::Decision* decision = nullptr;
    const std::vector<Event>* events = nullptr;
    bool start = false, breakpoint = false, load_jumps = false;
    bool adopted = false;                ///< the engine found the states, but did not locate the time
    double eigenvector_condition = 1.0;  ///< StepFacts::eigenvector_condition
  };
  void instant(const Instant& now);
  /// Checks the laws at a point between two instants. dependence: StepFacts::eigenvector_condition.
  void between(double t, const motion::Forcing& forcing, const contact::ContactStates& states,
               const motion::Point& point, double dependence);

  /// Updates the largest values with a point inside a step: an output row or a turning point.
  void observe(double t, const motion::Forcing& forcing, const motion::Point& point);
  /// Updates the largest values of one contact; reads only those entries of the point that affect this contact.
  void observe(std::size_t contact, double t, const motion::Forcing& forcing, const motion::Point& point);
  /// Checks, at the end of the run, that no observed value exceeds the recorded peaks.
  void peaks(double t, const std::vector<Peak>& recorded);

  /// Message about the first unexplained violation, after which the run must end; empty: no such violation.
  [[nodiscard]] const std::string& unexplained() const { return unexplained_violation_; }
  /// Violations so far, in the units of the computed model.
  [[nodiscard]] LawCheckSummary& law_checks() { return law_checks_; }

 private:
  void start_peaks(const Instant& now);
  void store_violations(std::vector<Violation> found);
  [[nodiscard]] double place_of(std::size_t k) const;

  const Model& model_;
  Recorder& recorder_;
  const CheckedEngine engine_;
  law_check::LawChecker law_checker_;
  CheckedMotion motion_;
  law_check::CheckedSide point_, before_, after_;  // buffers: between instants; both sides of an instant
  std::vector<ObservedPeak> observed_peaks_;
  std::array<double, 2> reached_ = {0.0, 0.0};  // largest CheckedSide::max_u
  bool has_constraints_ = false;                // some contact has no spring: its forces enforce constraints
  double max_constraint_force_terms_ =
      0.0;  // largest LawChecker::constraint_force_terms; 0 without such a contact
  LawCheckSummary law_checks_;
  std::string unexplained_violation_;
};

/// Sentence about a violation, in the units of `violation`: "the structure violates a law (momentum) at t = 0.1: error 12.6,
/// allowed 3e-12".
[[nodiscard]] std::string sentence_of(const Violation& violation, const Model& model);
/// Sentence about the first violation, with the number of violations if there are several.
[[nodiscard]] std::string sentence_of(const LawCheckSummary& law_checks, const Model& model);

}  // namespace signorini::run
