// generator.hpp: a scene from a seed, as the text of its file.
//
//   family    what is drawn
//   matrices  M diagonal or full, K of any rank, C = alpha M + beta K; forms of contacts at random, or floors
//   chain     masses between springs, sliders under them, stops between them and at the end
//   frame     beams on supports and contacts, under gravity from static equilibrium, or thrown
//   block     a mass between a floor and a wall, on springs; the ground or the floor may move
//
//   const Scene scene = parse_scene(draw_scene(7), "seed-7.toml");
//
// Units are N, kg, m, s. The same seed means the same text on every machine.
#pragma once

#include <cstdint>
#include <string>

namespace signorini::differential {

[[nodiscard]] std::string draw_scene(std::uint64_t seed);
/// A frame with the loads, motions and parts that the others have not: heat, moments, distributed loads,
/// supports that move, hinges, stops, stages of a frictional start.
[[nodiscard]] std::string draw_loaded_scene(std::uint64_t seed);
/// All that a scene can say (draw_whole.cpp): one of the above or blocks in a yard, with parts without mass,
/// dashpots, segments, reduction and outputs; by exact, ida or newmark.
[[nodiscard]] std::string draw_whole_scene(std::uint64_t seed);
/// Rigid bodies, shapes of sections, bends, hangers, pendulums, P-delta, stresses and envelopes
/// (draw_structure.cpp).
[[nodiscard]] std::string draw_structure_scene(std::uint64_t seed);

}  // namespace signorini::differential
