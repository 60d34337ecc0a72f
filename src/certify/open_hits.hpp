// open_hits.hpp: impacts that a run and its companion may both have missed.
//
//   smallest gap g of the companion,   e = c max |g - g'| at rows around that time:   open if g <= e
//   starting time: g + bend (t' - t)^2 = g + e
//
// A run with accumulated step errors may miss a grazing impact, and so may its companion if its own error is no
// smaller.
#pragma once

#include "certify/bounds.hpp"
#include "engine/falls/graze.hpp"

namespace signorini {

/// The first of these near impacts that is open. factor: c.
[[nodiscard]] std::optional<Track::Objection> first_open_hit(const Model& model, const Kept& run,
                                                             const Kept& companion,
                                                             const std::vector<NearHit>& near, double factor);

}  // namespace signorini
