// engines.hpp: the engines that every behaviour test runs through.
#pragma once

#include <string>
#include <vector>

namespace signorini::tests {

/// Engines that meet a tolerance, by their names in scene files.
inline const std::vector<std::string> engines{"ida", "exact"};
/// All that localise events; newmark is of second order in its step (run_text: 1e-3), so for what its
/// accuracy allows.
inline const std::vector<std::string> locating_engines{"ida", "exact", "newmark"};

}  // namespace signorini::tests
