// run_witness.hpp: hands each instant of a run to its witness, and keeps what it finds.
//
//   (u, v-, N-, T-, mode-), impulses, captures, events, (u, v+, a+, N+, T+, mode+)  ->  witness/witness.hpp
//
// Nothing here is weighed: what engine, decision and log have recorded is copied as it is. Units: those of the model
// that is computed.
#pragma once

#include "engine/stepper.hpp"
#include "run/witnessed_motion.hpp"

namespace signorini {

inline constexpr std::size_t most_violations = 100;  // of a run, that are kept; all are counted

/// Where a contact was at the start, and the farthest that it was seen from there.
struct PassedPeak {
  double g0 = 0.0, ut0 = 0.0, surface = 0.0;  // surface: the farthest place of its own surface
  Peak most;
};

class RunWitness {
 public:
  /// All must outlive it; the recorder is handed instants if it wants them.
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
  /// A point inside a stretch.
  void between(double t, const Forcing& forcing, const Mode& mode, const Point& point, double dependence);

  /// A point inside a step, that of a row or where something turns.
  void passes(double t, const Forcing& forcing, const Point& point);
  /// One contact; of the point what it touches.
  void passes(std::size_t contact, double t, const Forcing& forcing, const Point& point);
  /// At the end: none of those points is beyond what is told.
  void peaks(double t, const std::vector<Peak>& told);

  /// Why the run ends: the first violation that nothing explains. Empty: there is none.
  [[nodiscard]] const std::string& grave() const { return grave_; }
  /// In the units of the model; physical() knows their units.
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
  WitnessedSide point_, before_, after_;  // between instants, and of one
  std::vector<PassedPeak> passed_;
  std::array<double, 2> reached_ = {0.0, 0.0};  // the greatest WitnessedSide::u_reach
  bool holds_ = false;                          // some contact has no spring: its forces hold accelerations
  double held_forces_ = 0.0;                    // greatest Witness::held_forces, where one holds
  Testimony testimony_;
  std::string grave_;
};

/// "at t = 0.1 the momentum of the structure is off by 12.6, where 3e-12 is rounding": in the units of the violation.
[[nodiscard]] std::string sentence_of(const Violation& violation, const Model& model);
/// The first, and how many there are.
[[nodiscard]] std::string sentence_of(const Testimony& testimony, const Model& model);

}  // namespace signorini
