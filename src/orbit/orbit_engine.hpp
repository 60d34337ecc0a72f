// orbit_engine.hpp: choice of the engine for orbits, its accuracy, and readers of a scene with a varied key.
//
//   auto:   exact, unless `exact` refuses the scene or a period exceeds 2000 times the shortest decay time
//   flow:   auto uses complex modes if the scene permits them, because all periods reuse the modes of contact states
//   error:  error of a state / amplitude, within which an orbit is regarded as closed: exact 0, ida 100 rtol
//
// An orbit search compares many short runs of one period. Therefore `auto` accepts the closed form up to a
// higher cost than for one long run (run/choose_engine.hpp).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "signorini/model.hpp"
#include "signorini/sensitivity.hpp"

namespace signorini::orbit {

/// The engine for orbits; duration: length of a period, or an estimate of it, in the units of model and run.
[[nodiscard]] Engine orbit_engine(const Model& model, const RunSpec& run, double duration);

/// The flow for orbits; run.engine must be the result of orbit_engine().
[[nodiscard]] Flow orbit_flow(const Model& model, const RunSpec& run);

/// Error of a state / amplitude in a run with this engine and these tolerances; 0: rounding only.
[[nodiscard]] double orbit_state_error(const RunSpec& run);

// A reader of a scene with one key set to a value.
//
//   reader_at(read, path, x)(changes) = read([path = x, changes...])
//   branch_reader: as reader_at, but for a branch over the energy of conservative motions no key is changed

/// Reads the scene with this value of the key, in the unit of the key. Errors: those of `read`.
[[nodiscard]] inline SceneReader reader_at(SceneReader read, std::string path, double value) {
  return [read = std::move(read), path = std::move(path), value](const std::vector<Override>& changes) {
    std::vector<Override> all{{path, base::format_number(value)}};
    all.insert(all.end(), changes.begin(), changes.end());
    return read(all);
  };
}

/// Path that denotes the energy of conservative motions instead of a key.
inline constexpr const char* over_energy = "energy";

/// Reads the scene at a value of the branch's parameter.
[[nodiscard]] inline SceneReader branch_reader(SceneReader read, const std::string& path, double value) {
  return path == over_energy ? std::move(read) : reader_at(std::move(read), path, value);
}

}  // namespace signorini::orbit
