#include "differential/generator.hpp"

#include <fmt/core.h>

#include "differential/families.hpp"

namespace signorini::differential {

std::string run_table(double t_end) {
  return fmt::format("[run]\nt_end = {}\noutput_dt = {}\n", t_end, t_end / 200.0);
}

std::string draw_scene(std::uint64_t seed) {
  Random draw(seed);
  const int family = draw.integer(0, 9);
  const char* name = family < 4 ? "matrices" : family < 6 ? "chain" : family < 8 ? "frame" : "block";
  const std::string head = fmt::format(
      "schema = 1\ntitle = \"{}, seed {}\"\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = "
      "\"s\" }}\n",
      name, seed);
  return head + (family < 4   ? matrices_scene(draw)
                 : family < 6 ? chain_scene(draw)
                 : family < 8 ? frame_scene(draw)
                              : block_scene(draw));
}

}  // namespace signorini::differential
