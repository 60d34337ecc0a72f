// load_period.hpp: common period of all excitations of a scene, and a guess of a self-excited motion's
// period.
//   f(t + T) = f(t) for all t >= periodic_from
//
// f: loads, motions of supports and of the base, normal forces, surface motions.
//
// A load of amplitude zero is ignored unless `count` includes this load. A branch over the amplitude of a load includes
// the load, so that the period does not change where the amplitude is zero.
//
// The common period is the smallest common multiple of all periods, up to a hundred times the longest period.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orbit/orbit_state.hpp"
#include "signorini/scene.hpp"

namespace signorini::orbit {

struct LoadPeriod {
  std::optional<double> period;  ///< nullopt: all excitations are constant from periodic_from on
  double periodic_from = 0.0;    ///< time from which all excitations are periodic or constant
  bool surfaces_move = false;    ///< true if a contact has a moving surface (belt)
};

/// One entry per load: true if the load's period is used even if its amplitude is zero. Empty: false for all loads.
using CountedLoads = std::vector<bool>;

/// True for each load with nonzero amplitude; true for all loads if all amplitudes are zero.
[[nodiscard]] CountedLoads driving_loads(const Scene& scene);

/// Common period of the excitations. Errors: SceneError at a history whose period has no common multiple with
/// the periods of earlier histories.
[[nodiscard]] LoadPeriod load_period(const Scene& scene, const CountedLoads& count = {});

/// Checks that all excitations have the given period. Errors: SceneError at a history without this period.
[[nodiscard]] LoadPeriod check_period(const Scene& scene, double period, const CountedLoads& count = {});

/// Overrides that make all excitations act earlier by `time`. Histories defined in C++ code are not shifted.
[[nodiscard]] std::vector<Override> shifted_excitation(const Scene& scene, double time);

// Initial guess of the period of a self-excited motion, and a section away from events.
//
//   T = t_b - t_a       instants a < b with equal contact states and the most similar displacements and velocities
//   section: the middle of the longest stretch between two instants of a period

struct ReturnMapStart {
  double period = 0.0;    ///< estimated period; 0: no state is near an earlier one
  double section = 0.0;   ///< time of the section
  double distance = 0.0;  ///< distance of the states at t_a and t_b, relative to the range of the motion
};

/// Initial guess from one run. instants: the motion just after each change of a contact state, in order of time.
[[nodiscard]] ReturnMapStart return_map_start(const Model& model, const std::vector<OrbitPoint>& instants);

/// Time of the section in [0, T): 0, or, if an instant is nearer to 0 or T than T/50, the middle of the longest stretch.
[[nodiscard]] double section_away_from(const std::vector<OrbitPoint>& instants, double T);

}  // namespace signorini::orbit
