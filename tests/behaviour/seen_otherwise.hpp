// seen_otherwise.hpp: a scene turned, mirrored, permuted, reversed and in other units has the same events.
#pragma once

#include <doctest/doctest.h>

#include <vector>

#include "differential/metamorphic.hpp"

namespace signorini::tests {

/// At least so many ways, each with more than two events; of all ways every `step`-th.
inline void check_seen_otherwise(const Scene& scene, int least, std::size_t step = 1) {
  differential::MetamorphicSettings settings;
  settings.bounds.seconds = 1e6;
  const differential::Metamorphic judge(scene, settings);
  REQUIRE(judge.hindrance().empty());
  int ways = 0;
  const std::vector<differential::Transformed> all = differential::transformations(scene, 3);
  for (std::size_t i = 0; i < all.size(); i += step) {
    const differential::Transformed& other = all[i];
    const differential::Sameness found = judge.compare(other);
    CAPTURE(other.name);
    CAPTURE(found.what);
    CHECK(found.verdict == differential::Sameness::Verdict::same);
    CHECK(found.events > 2);
    ++ways;
  }
  CHECK(ways >= least);
}

}  // namespace signorini::tests
