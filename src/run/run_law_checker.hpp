// run_law_checker.hpp: passes each instant of a run to the law checker, and stores the violations.
//
//   (u, v-, N-, T-, states-), impulses, captures, events, (u, v+, a+, N+, T+, states+)  ->  law_check/law_checker.hpp
//
// No data are evaluated here: records of engine, decision and log are copied unchanged. Units: those of the computed
// model.
#pragma once

#include <array>

#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"
#include "law_check/law_checker.hpp"
#include "motion/forcing.hpp"

namespace signorini::run {

// Data of a motion that the law checker needs in addition to u and v: motions and forces that drive
// contacts, loads on massless parts, and the largest displacements so far.
//
//   CheckedMotion motion(model, engine);
//   motion.reach(checker, u, v);
//   CheckedSide side = motion.side(forcing, t);        u, v, forces, states: to be set
//   motion.leave(forcing, t);                            the instant is over
//
// Used for a run (run/run_law_checker.hpp) and for a directory of results (study/law_check/directory_law_checker.hpp).

/// Limits and abilities of a run's engine.
struct CheckedEngine {
  law_check::LawLimits limits;
  bool located = true;            ///< the engine locates the zeros of guards
  bool laws_at_step_ends = true;  ///< laws hold at ends of steps
  bool sums_over_modes = false;
};
/// Limits and abilities of run.engine. flow: "modal" or another name; low_flights: the engine computes
/// flights lower than the rounding of their gaps.
[[nodiscard]] CheckedEngine checked_engine(const RunSpec& run, const engine::Tolerance& tolerance,
                                           const std::string& flow, bool low_flights);

/// The event as recorded for the law checker, without guard_rate.
[[nodiscard]] law_check::RecordedEvent recorded_event(const Event& event);

/// Final states and forces of the run that is continued (Model::continues); guessed: states for user-defined laws.
[[nodiscard]] std::vector<ContactState> final_states(const Model& model,
                                                     const std::vector<ContactState>& guessed);
[[nodiscard]] Vector final_forces(const Model& model);

class CheckedMotion {
 public:
  CheckedMotion(const Model& model, const CheckedEngine& engine);

  /// Updates the largest displacements and velocities. Called at instants only: values between two instants
  /// are hardly larger, or of the scene's own scale.
  void update_maxima(const law_check::LawChecker& witness, const Vector& u, const Vector& v);
  /// Value of CheckedSide::acceleration_terms.
  [[nodiscard]] std::array<double, 2> acceleration_terms(const law_check::LawChecker& witness,
                                                         const Vector& a, double dependence) const;
  /// dependence: StepFacts::eigenvector_condition of the motion up to t.
  [[nodiscard]] law_check::CheckedSide side(const motion::Forcing& forcing, double t,
                                            double dependence) const;
  /// Same as side() for an existing side, whose memory is reused. Its `driven` must be empty or come from
  /// this object, since constant entries are kept.
  void fill(const motion::Forcing& forcing, double t, double dependence, law_check::CheckedSide& side) const;
  /// Ends an instant, with the forcing after it.
  void finish_instant(const motion::Forcing& forcing, double t);

 private:
  [[nodiscard]] law_check::Driven driven_at(std::size_t k, const motion::Forcing& forcing, double t) const;

  const Model& model_;
  bool sums_over_modes_, massless_;
  double step_;                      // LawLimits::step
  std::vector<std::size_t> driven_;  // contacts whose surface or compression may change
  std::vector<double> jerk_;         // |s'''| of each surface just after the last instant
  std::array<double, 2> u_reach_ = {0.0, 0.0}, v_reach_ = {0.0, 0.0};  // CheckedSide
  double energy_ = 0.0;                                                // largest LawChecker::twice_energy
  double kinetic_ = 0.0;                                               // for sums over modes: largest v^T M v
  std::vector<double> lightness_, speeds_;  // of each contact; times the root of energy_
  std::array<double, 2> u_modal_ = {0.0, 0.0}, v_modal_ = {0.0, 0.0};  // LawChecker::modal_size
};

inline constexpr std::size_t max_stored_violations = 100;  // limit for stored violations; all are counted

/// Position of a contact at the start, and its largest distance from there.
struct ObservedPeak {
  double g0 = 0.0, ut0 = 0.0, surface = 0.0;  // surface: largest displacement of its surface
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
    bool adopted = false;                ///< the engine found states, and no time
    double eigenvector_condition = 1.0;  ///< StepFacts::eigenvector_condition
  };
  void instant(const Instant& now);
  /// Checks a point inside a stretch.
  void between(double t, const motion::Forcing& forcing, const contact::ContactStates& states,
               const motion::Point& point, double dependence);

  /// Adds a point inside a step: that of a row, or a turning point.
  void observe(double t, const motion::Forcing& forcing, const motion::Point& point);
  /// Adds a point for one contact; only the entries of the point that it depends on are read.
  void observe(std::size_t contact, double t, const motion::Forcing& forcing, const motion::Point& point);
  /// Checks at the end that none of these points exceeds the reported peaks.
  void peaks(double t, const std::vector<Peak>& recorded);

  /// Reason for ending the run: the first violation without an explanation. Empty: none.
  [[nodiscard]] const std::string& unexplained() const { return law_violated_; }
  /// Violations in the units of the model; physical() converts them.
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
  law_check::CheckedSide point_, before_, after_;  // between instants, and at one
  std::vector<ObservedPeak> observed_peaks_;
  std::array<double, 2> reached_ = {0.0, 0.0};  // largest CheckedSide::max_u
  bool has_constraints_ = false;                // some contact has no spring: its forces enforce constraints
  double held_forces_ = 0.0;  // largest LawChecker::constraint_force_terms, if there is such a contact
  LawCheckSummary law_checks_;
  std::string law_violated_;
};

/// Sentence about a violation, in its units: "at t = 0.1 the momentum of the structure is off by 12.6, where 3e-12 is
/// rounding".
[[nodiscard]] std::string sentence_of(const Violation& violation, const Model& model);
/// Sentence about the first violation, with the number of violations.
[[nodiscard]] std::string sentence_of(const LawCheckSummary& law_checks, const Model& model);

}  // namespace signorini::run
