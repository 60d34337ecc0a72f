// load_period.hpp: common period of all excitations of a scene, and a guess of a self-excited motion's
// period.
//   f(t + T) = f(t) for all t >= periodic_from
//
// f: loads, motions of supports and of the base, normal forces, surface motions.
//
// A load of amplitude zero is ignored unless `count` includes it: a branch over the amplitude keeps its
// period where the load vanishes.
//
// Several periods have a smallest common multiple if there is one up to a hundred times the longest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orbit/orbit_state.hpp"
#include "signorini/scene.hpp"

namespace signorini::orbit {

struct LoadPeriod {
  std::optional<double> period;  ///< nullopt: everything is constant from periodic_from on
  double periodic_from = 0.0;    ///< end of the part that is not periodic
  bool surfaces_move = false;    ///< there is a belt
};

/// Loads that count even with amplitude zero, one entry per load; empty: none.
using CountedLoads = std::vector<bool>;

/// Loads with nonzero amplitude; all of them if there are none.
[[nodiscard]] CountedLoads driving_loads(const Scene& scene);

/// Common period of the excitations. Errors: SceneError at a history that has no period in common with the
/// others.
[[nodiscard]] LoadPeriod load_period(const Scene& scene, const CountedLoads& count = {});

/// Same with a given period. Errors: SceneError at a history without this period.
[[nodiscard]] LoadPeriod check_period(const Scene& scene, double period, const CountedLoads& count = {});

/// Overrides by which all excitations act earlier by `time`. Histories made in code are ignored.
[[nodiscard]] std::vector<Override> shifted_excitation(const Scene& scene, double time);

// Initial guess of the period of a self-excited motion, and a section away from events.
//
//   T = t_b - t_a       instants a < b with equal states, for which the motion is closest to repeating itself
//   section: the middle of the longest stretch between two instants of a period

struct ReturnMapStart {
  double period = 0.0;    ///< 0: the motion did not return
  double section = 0.0;   ///< time of the section
  double distance = 0.0;  ///< between the two states, relative to the range of the motion
};

/// instants: of a run, in order of time.
[[nodiscard]] ReturnMapStart return_map_start(const Model& model, const std::vector<OrbitPoint>& instants);

/// Best position of the section in [0, T): 0, unless an instant is within a fiftieth of T.
[[nodiscard]] double section_away_from(const std::vector<OrbitPoint>& instants, double T);

}  // namespace signorini::orbit
