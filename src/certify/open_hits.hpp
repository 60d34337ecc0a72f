// open_hits.hpp: hits that neither a run nor its companion may have seen.
//
//   least gap g of the companion,   e = c max |g - g'| at rows around that time:   open where g <= e
//   from when on: g + bend (t' - t)^2 = g + e
//
// A run whose error is that of many steps passes by a hit that just grazes, and so does its companion where its own error is
// no smaller.
#pragma once

#include "certify/bounds.hpp"
#include "engine/falls/graze.hpp"

namespace signorini {

/// The first of these near hits that is open. factor: c.
[[nodiscard]] std::optional<Track::Objection> first_open_hit(const Model& model, const Kept& run,
                                                             const Kept& companion,
                                                             const std::vector<NearHit>& near, double factor);

}  // namespace signorini
