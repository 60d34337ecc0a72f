// slow_rates.hpp: quasi-static rates of contacts that touch or are at their friction limits.
//
//   w = q + M z,   w >= 0,   z >= 0,   w . z = 0        unknowns and conditions: frictional.hpp, least_share.hpp
//
// Lemke's method is tried first. With friction M is not copositive-plus, and the method may end in a ray although there
// is a solution. Then all combinations of the contacts' alternatives are tried:
//
//   touching      w = 0 of           at its limit   w = 0 of
//   stick         none               stick          none
//   slip +, -     that slip          slip           that slip
//   open          opening and slip, whose sign is free: N' = 0, T' = 0
//
// If several hold, the one with the smallest |z| is taken: it is independent of the scene's orientation, reflection and
// numbering.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/statics/least_share.hpp"

namespace signorini {

struct SlowRates {
  Eigen::VectorXd z;     ///< one per unknown
  bool several = false;  ///< other rates satisfy the conditions, too
};

/// q: its largest entry has magnitude one. Unknowns of one contact are adjacent, its opening first. nullopt if no
/// combination holds, or if there are more than most_combinations.
[[nodiscard]] std::optional<SlowRates> slow_rates(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                                                  const std::vector<Unknown>& unknowns);

/// Chosen value: a start tries this number in less than a second.
inline constexpr std::size_t most_combinations = 20'000;

}  // namespace signorini
