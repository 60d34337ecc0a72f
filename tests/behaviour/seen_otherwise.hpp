// seen_otherwise.hpp: a scene turned, mirrored, permuted, reversed and in other units has the same events.
#pragma once

#include <doctest/doctest.h>

#include "differential/metamorphic.hpp"

namespace signorini::tests {

/// At least so many ways, each with more than two events.
inline void check_seen_otherwise(const Scene& scene, int least) {
  differential::MetamorphicSettings settings;
  settings.bounds.seconds = 1e6;
  const differential::Metamorphic judge(scene, settings);
  REQUIRE(judge.hindrance().empty());
  int ways = 0;
  for (const differential::Transformed& other : differential::transformations(scene, 3)) {
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
