// families.hpp: one function a family of scenes (generator.hpp); each returns a file without its title.
#pragma once

#include <string>

#include "differential/random.hpp"

namespace signorini::differential {

[[nodiscard]] std::string matrices_scene(Random& draw);
[[nodiscard]] std::string chain_scene(Random& draw);
[[nodiscard]] std::string frame_scene(Random& draw);
[[nodiscard]] std::string block_scene(Random& draw);

/// "[run]" with its end and a grid of 200 rows, without `initial`.
[[nodiscard]] std::string run_table(double t_end);

}  // namespace signorini::differential
