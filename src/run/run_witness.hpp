// run_witness.hpp: hands each instant of a run to its witness, and keeps what it finds.
//
//   (u, v-, N-, T-, mode-), impulses, captures, events, (u, v+, a+, N+, T+, mode+)  ->  witness/witness.hpp
//
// Nothing here is weighed: what engine, decision and log have recorded is copied as it is. Units: those of the model
// that is computed.
#pragma once

#include <array>

#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"
#include "witness/witness.hpp"

namespace signorini {

class RunWitness {
 public:
  RunWitness(const Model& model, const RunSpec& run, const Tolerance& tolerance, bool sums_over_modes,
             bool knows_low_flights);

  struct Instant {
    double t = 0.0, resolution = 0.0;
    const Point* before = nullptr;
    const Mode* mode_before = nullptr;
    const Forcing *forcing_before = nullptr, *forcing_after = nullptr;
    const Decision* decision = nullptr;
    const std::vector<Event>* events = nullptr;
    bool start = false, breakpoint = false, load_jumps = false;
    bool adopted = false;  ///< the engine found states, and no time
  };
  void instant(const Instant& now);
  /// A point inside a stretch.
  void between(double t, const Forcing& forcing, const Mode& mode, const Point& point);

  /// Why the run ends: the first violation that nothing explains. Empty: there is none.
  [[nodiscard]] const std::string& grave() const { return grave_; }
  /// In the units of the model; physical() knows their units.
  [[nodiscard]] Testimony& testimony() { return testimony_; }

 private:
  [[nodiscard]] WitnessedSide side_of(const Forcing& forcing, double t) const;
  void reach(const Vector& u, const Vector& v);
  void keep(std::vector<Violation> found);

  const Model& model_;
  Witness witness_;
  bool located_, follows_, ends_,
      sums_over_modes_;  // ends_: engines of given steps are rough, and are warned of
  std::array<double, 2> u_reach_ = {0.0, 0.0}, v_reach_ = {0.0, 0.0};  // WitnessedSide
  Testimony testimony_;
  std::string grave_;
};

/// "at t = 0.1 the momentum of the structure is off by 12.6, where 3e-12 is rounding": in the units of the violation.
[[nodiscard]] std::string sentence_of(const Violation& violation, const Model& model);
/// The first, and how many there are.
[[nodiscard]] std::string sentence_of(const Testimony& testimony, const Model& model);

}  // namespace signorini
