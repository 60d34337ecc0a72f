// landings.hpp: stiff bodies that fall on rigid contacts late: is every closing a hit?
//
//   g = 0, g' < -capture_velocity     ->     an event of type impact, of no other
//
// A bar that is thrown up and lands on one end, and a block that rocks on two corners, with heights, stiffnesses,
// restitutions and times from a seed. Where rounding is taken for touch, a landing is a `contact` without impulse,
// and energy that was there is gone.
#pragma once

#include <cstdint>
#include <string>

namespace signorini::differential {

/// Odd seeds: the bar; even ones: the block.
[[nodiscard]] std::string draw_landing_scene(std::uint64_t seed);

struct LandingsTally {
  long runs = 0, hits = 0, swallowed = 0, unbalanced = 0, ended = 0, bars = 0;

  void print() const;
  [[nodiscard]] int exit_code() const { return swallowed + unbalanced + ended > 0 ? 1 : 0; }
};

/// Runs the scene and counts; a line for each that is not as it should be.
void look_at_landings(const std::string& name, const std::string& text, LandingsTally& tally);

}  // namespace signorini::differential
