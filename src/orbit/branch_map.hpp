// branch_map.hpp: the period map of a scene at any value of one of its keys.
//
//   y = (x, dT, s)       x: directions at the section; dT where the motion is driven by itself; s: (p - from)/(to - from)
//   G(y) = B^T (z(T; z, s) - z),    dG/ds by a difference of the map, dG/dx from Phi
//   of conservative motions one row more: (E(x, s) - E*(s))/E1 = 0
//     over the energy:            E*(s) = from + s (to - from), E1 = to - from, and dG/ds = 0
//     over a key at an energy:    E* = E1 = that energy
//
// All models have the units of the machine of the first one, so that states are comparable.
#pragma once

#include "orbit/load_period.hpp"
#include "orbit/period_map.hpp"
#include "orbit/reader_at.hpp"
#include "signorini/orbit.hpp"

namespace signorini {

/// Of a transient that looks for the orbit behind a gap of the branch.
inline constexpr int restart_periods = 40;

/// An orbit, or a guess at one.
struct BranchState {
  OrbitState state;       ///< at the section
  double duration = 0.0;  ///< machine's; of a forced orbit that of the loads
  double s = 0.0;
};

class BranchMap {
 public:
  BranchMap(const SceneReader& read, const BranchOptions& options, const Orbit& first, Recorder* recorder);

  /// What find_orbit() would say of this orbit: period, phase, the state at its time 0.
  [[nodiscard]] Orbit orbit_at(const BranchState& state) const;
  /// The same over twice the period.
  [[nodiscard]] BranchMap doubled() const;
  [[nodiscard]] bool autonomous() const { return autonomous_; }
  /// Over the energy of conservative motions.
  [[nodiscard]] bool conservative() const { return options_.path == over_energy; }
  /// Over the energy, or over a key at a given energy.
  [[nodiscard]] bool keeps_energy() const { return conservative() || options_.orbit.energy.has_value(); }
  /// E*(s) of orbits that keep it, in the scene's unit; E1.
  [[nodiscard]] std::optional<double> energy(double s) const {
    return conservative() ? std::optional(parameter(s)) : options_.orbit.energy;
  }
  [[nodiscard]] double energy_unit() const {
    return conservative() ? range() : options_.orbit.energy.value_or(1.0);
  }
  [[nodiscard]] double range() const { return options_.to - options_.from; }
  [[nodiscard]] double parameter(double s) const;
  /// The loads' period at s, times `times`; machine's.
  [[nodiscard]] double period(double s) const;
  [[nodiscard]] const BranchState& start() const { return start_; }
  [[nodiscard]] const Model& model() const { return first_; }
  /// Section as a part of the period.
  [[nodiscard]] double section() const { return section_; }
  void move_section(double part) { section_ = part; }

  /// Those of the last values of s are kept.
  [[nodiscard]] std::shared_ptr<const PeriodMap> at(double s) const;
  /// The state at s that holds what this mode holds rigidly: n . u = -g0 and n . v = 0 of closed contacts, t . v that of the
  /// surface of those that stick. A key may move all three.
  [[nodiscard]] OrbitState fitted(OrbitState state, const Mode& mode, double s) const;
  [[nodiscard]] OrbitPass pass(const BranchState& state, bool tangents = true, bool outputs = false) const;
  /// Margins alone, from many rows.
  [[nodiscard]] OrbitPass margins(const BranchState& state) const;
  /// dG/ds by a difference to one side, coordinates at the section, not yet times B^T, and the row of the energy if there is
  /// one. A matrix of Newton's method and a direction: neither needs more digits.
  [[nodiscard]] Vector by_parameter(const BranchState& state, const OrbitPass& pass) const;

 private:
  [[nodiscard]] Scene scene_at(double s) const;
  [[nodiscard]] double period_of(const Scene& scene) const;
  [[nodiscard]] LoadPeriod loads_at(const Scene& scene) const;
  void check_structure(const Model& model) const;

  const SceneReader& read_;
  BranchOptions options_;
  Recorder* recorder_;
  bool autonomous_;
  Factors machine_;
  double phase_;  // machine's
  double t_end_;  // of scenes
  SilentLoads drive_;
  double section_ = 0.0;
  Model first_;
  BranchState start_;
  struct Kept {
    double s, section, period;
    std::shared_ptr<const PeriodMap> map;
  };
  [[nodiscard]] const Kept& kept(double at) const;
  [[nodiscard]] Kept make(double s) const;
  mutable std::vector<Kept> kept_;
  std::shared_ptr<ModalMemory> memory_ = std::make_shared<ModalMemory>();
  mutable std::shared_ptr<StateFlow> flow_;  // of the last map that had one
};

}  // namespace signorini
