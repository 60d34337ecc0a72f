// at_once.hpp: parts without mass that move at once while states are decided: what they touch first, and where they stop.
//
//   u(x) = (1 - x) u_from + x u_to,   0 <= x <= 1:   a gap closes at (1 - x) g + x g' = 0
//
// No time passes on such a way. The states of what it passes are told by where on it that is.
#pragma once

#include <optional>
#include <vector>

#include "decide/guard_signs.hpp"
#include "signorini/model.hpp"

namespace signorini {

struct MasslessWay {
  const Vector &from, &to;
};

/// A contact that is touched on the way.
struct TouchOnWay {
  std::size_t contact;
  double part;  ///< x
  double ut;    ///< its ut there, less that at the end of the way
};

/// The contact that the way closes first; of the failures those of contacts that it closes later are dropped: after
/// the first one it is another way. Nothing: it closes none.
[[nodiscard]] std::optional<TouchOnWay> first_touch(const Model& model, const MasslessWay& way,
                                                    std::vector<Failure>& failed);

/// Another contact of parts without mass fails by more than the instant: they are on their way to where the states that are
/// tried balance. How fast the rest of them slides is told where they arrive; its failures are dropped.
void leave_sliding_for_later(const Model& model, std::vector<Failure>& failed);

/// A part without mass that friction has let go has slid at once, along its slip, and stops where it has come to, held there by
/// the dashpot beside it. noise: of its ut.
[[nodiscard]] bool stops_on_way(const Contact& contact, const Failure& failure, State slip,
                                const MasslessWay& way, double noise);

}  // namespace signorini
