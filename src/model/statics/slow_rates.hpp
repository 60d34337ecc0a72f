// slow_rates.hpp: the rates with which contacts that touch or are at their limits go on along a slow path.
//
//   w = q + M z,   w >= 0,   z >= 0,   w . z = 0        unknowns and conditions: frictional.hpp, least_share.hpp
//
// Lemke's method first. With friction M is not copositive-plus, and the method may end in a ray although there is a
// solution. Then all combinations of what each contact may do are tried:
//
//   touching      w = 0 of           at its limit   w = 0 of
//   stick         none               stick          none
//   slip +, -     that slip          slip           that slip
//   open          opening and slip, whose sign is free: N' = 0, T' = 0
//
// If several hold, the one with the least |z| is taken: it is the same however a scene is turned, mirrored or numbered.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/statics/least_share.hpp"

namespace signorini {

struct SlowRates {
  Eigen::VectorXd z;     ///< one an unknown
  bool several = false;  ///< other rates satisfy the conditions, too
};

/// q: its greatest entry of magnitude one. Unknowns of one contact stand together, its opening first. Nothing where no
/// combination holds, or where there are more than most_combinations.
[[nodiscard]] std::optional<SlowRates> slow_rates(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                                                  const std::vector<Unknown>& unknowns);

/// Chosen: a start tries them in less than a second.
inline constexpr std::size_t most_combinations = 20'000;

}  // namespace signorini
