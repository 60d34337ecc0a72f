// run_witness.hpp: passes each instant of a run to its witness, and stores the violations.
//
//   (u, v-, N-, T-, mode-), impulses, captures, events, (u, v+, a+, N+, T+, mode+)  ->  witness/witness.hpp
//
// No data are evaluated here: records of engine, decision and log are copied unchanged. Units: those of the computed
// model.
#pragma once

#include "engine/stepper.hpp"
#include "run/witnessed_motion.hpp"

namespace signorini {

inline constexpr std::size_t most_violations = 100;  // limit for stored violations; all are counted

/// Position of a contact at the start, and its largest distance from there.
struct PassedPeak {
  double g0 = 0.0, ut0 = 0.0, surface = 0.0;  // surface: largest displacement of its surface
  Peak most;
};

class RunWitness {
 public:
  /// All arguments must outlive the object; the recorder receives instants if it wants them.
  RunWitness(const Model& model, const WitnessedEngine& engine, Recorder& recorder);

  struct Instant {
    double t = 0.0, resolution = 0.0;
    const Point* before = nullptr;
    const Mode* mode_before = nullptr;
    const Forcing *forcing_before = nullptr, *forcing_after = nullptr;
    const Decision* decision = nullptr;
    const std::vector<Event>* events = nullptr;
    bool start = false, breakpoint = false, load_jumps = false;
    bool adopted = false;     ///< the engine found states, and no time
    double dependence = 1.0;  ///< Stepper::dependence()
  };
  void instant(const Instant& now);
  /// Checks a point inside a stretch.
  void between(double t, const Forcing& forcing, const Mode& mode, const Point& point, double dependence);

  /// Adds a point inside a step: that of a row, or a turning point.
  void passes(double t, const Forcing& forcing, const Point& point);
  /// Adds a point for one contact; only the entries of the point that it depends on are read.
  void passes(std::size_t contact, double t, const Forcing& forcing, const Point& point);
  /// Checks at the end that none of these points exceeds the reported peaks.
  void peaks(double t, const std::vector<Peak>& told);

  /// Reason for ending the run: the first violation without an explanation. Empty: none.
  [[nodiscard]] const std::string& grave() const { return grave_; }
  /// Violations in the units of the model; physical() converts them.
  [[nodiscard]] Testimony& testimony() { return testimony_; }

 private:
  void start_peaks(const Instant& now);
  void keep(std::vector<Violation> found);
  [[nodiscard]] double place_of(std::size_t k) const;

  const Model& model_;
  Recorder& recorder_;
  const WitnessedEngine engine_;
  Witness witness_;
  WitnessedMotion motion_;
  WitnessedSide point_, before_, after_;  // between instants, and at one
  std::vector<PassedPeak> passed_;
  std::array<double, 2> reached_ = {0.0, 0.0};  // largest WitnessedSide::u_reach
  bool holds_ = false;                          // some contact has no spring: its forces enforce constraints
  double held_forces_ = 0.0;                    // largest Witness::held_forces, if there is such a contact
  Testimony testimony_;
  std::string grave_;
};

/// Sentence about a violation, in its units: "at t = 0.1 the momentum of the structure is off by 12.6, where 3e-12 is
/// rounding".
[[nodiscard]] std::string sentence_of(const Violation& violation, const Model& model);
/// Sentence about the first violation, with the number of violations.
[[nodiscard]] std::string sentence_of(const Testimony& testimony, const Model& model);

}  // namespace signorini
