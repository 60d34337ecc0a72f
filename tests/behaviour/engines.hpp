// engines.hpp: the engines that every behaviour test runs through.
#pragma once

#include <string>
#include <vector>

namespace signorini::tests {

/// Engines with event localisation, by their names in scene files.
inline const std::vector<std::string> engines{"ida", "exact", "newmark"};

}  // namespace signorini::tests
