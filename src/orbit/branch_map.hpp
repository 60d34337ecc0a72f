// branch_map.hpp: the period map of a scene for any value of one of its keys.
//
//   y = (x, dT, s)       x: coordinates at the section; dT: change of the period, if self-excited
//                        s = (p - from)/(to - from),  p: value of the key
//   G(y) = B^T (z(T; z, s) - z),    dG/ds by a finite difference of the map, dG/dx from Phi
//   conservative motions: G has one more row, (E(x, s) - E*(s))/E1
//     the energy is the parameter:            E*(s) = from + s (to - from), E1 = to - from, dG/ds = 0 in all other rows
//     a key is the parameter, E is given:     E* = E1 = the given energy
//
// All models use the machine units of the first one, so states are comparable.
#pragma once

#include "orbit/load_period.hpp"
#include "orbit/orbit_engine.hpp"
#include "orbit/period_map.hpp"
#include "signorini/orbit.hpp"

namespace signorini::orbit {

/// Length, in periods, of a transient that searches for the orbit beyond a gap of the branch.
inline constexpr int restart_periods = 40;

/// An orbit, or an initial guess of one.
struct BranchState {
  OrbitState state;       ///< state at the section
  double duration = 0.0;  ///< period in machine units; for a forced orbit a multiple of the loads' period
  double s = 0.0;
};

class BranchMap {
 public:
  BranchMap(const SceneReader& read, const BranchOptions& options, const Orbit& first, Recorder* recorder);

  /// The orbit at `state` in the form that find_orbit() returns: period, phase, and the state at the orbit's time 0.
  [[nodiscard]] Orbit orbit_at(const BranchState& state) const;
  /// Returns a map of the same scene over twice the period.
  [[nodiscard]] BranchMap doubled() const;
  [[nodiscard]] bool autonomous() const { return autonomous_; }
  /// True if the parameter of the branch is the energy of conservative motions.
  [[nodiscard]] bool conservative() const { return options_.path == over_energy; }
  /// True if each orbit has a prescribed energy: the parameter of the branch, or a given constant.
  [[nodiscard]] bool keeps_energy() const { return conservative() || options_.orbit.energy.has_value(); }
  /// Prescribed energy E*(s), and its unit E1, both in the scene's unit; nullopt if the energy is not prescribed.
  [[nodiscard]] std::optional<double> energy(double s) const {
    return conservative() ? std::optional(parameter(s)) : options_.orbit.energy;
  }
  [[nodiscard]] double energy_unit() const {
    return conservative() ? range() : options_.orbit.energy.value_or(1.0);
  }
  [[nodiscard]] double range() const { return options_.to - options_.from; }
  [[nodiscard]] double parameter(double s) const;
  /// Period of an orbit at s, in machine units: a multiple of the loads' period, or for self-excited motions
  /// the period of the first orbit.
  [[nodiscard]] double period(double s) const;
  [[nodiscard]] const BranchState& start() const { return start_; }
  [[nodiscard]] const Model& model() const { return first_; }
  /// Time of the section as a fraction of the period.
  [[nodiscard]] double section() const { return section_; }
  void set_section(double fraction) { section_ = fraction; }

  /// The map at s. The maps of the last few values of s are cached.
  [[nodiscard]] std::shared_ptr<const PeriodMap> at(double s) const;
  /// The state at s, corrected to satisfy the rigid constraints of the contact states `states`. Closed
  /// contacts: n . u = -g0 and n . v = 0. Sticking contacts: t . v = s'. The key may change n, g0, t and s'.
  [[nodiscard]] OrbitState projected(OrbitState state, const contact::ContactStates& states, double s) const;
  /// One pass through the period that begins at `state`.
  [[nodiscard]] OrbitPass pass(const BranchState& state, bool tangents = true, bool outputs = false) const;
  /// A pass that computes the margins of contacts: with more samples than other passes and without tangents.
  [[nodiscard]] OrbitPass margins(const BranchState& state) const;
  /// dG/ds by a one-sided difference, in coordinates at the section, not multiplied by B^T. If the energy is
  /// prescribed, the last row is the derivative of the energy. The accuracy suffices for the matrix of
  /// Newton's method and for the direction of the branch.
  [[nodiscard]] Vector parameter_derivative(const BranchState& state, const OrbitPass& pass) const;

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
  double phase_;  // time of the scene at the orbits' time 0, in machine units
  double t_end_;  // smallest run.t_end of the scenes, in the scene's unit
  CountedLoads drive_;
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
  std::shared_ptr<modal::ModalCache> memory_ = std::make_shared<modal::ModalCache>();
  // Closed form that advances tangents (PeriodMap::flow()), from the last map that had such a form.
  mutable std::shared_ptr<sensitivity::StateFlow> flow_;
};

}  // namespace signorini::orbit
