// A hundred of random scenes, each beside one that is related to it: going on, later, turned, in other units, split.
// The rest of them: signorini_differential --relations.
#include <doctest/doctest.h>

#include "differential/generator.hpp"
#include "differential/relations.hpp"

using namespace signorini;
using namespace signorini::differential;

TEST_SUITE("behaviour/relations") {
  TEST_CASE("a hundred random scenes beside related ones") {
    RelationTally tally;
    for (std::uint64_t seed = 1; tally.runs() < 100; ++seed) {
      REQUIRE(seed < 200);
      RelationSettings settings;
      settings.seed = seed;
      settings.place = static_cast<long>(seed % relation_kinds.size());
      settings.bounds.seconds = 1e6;  // no clock: a slow machine is no other verdict
      examine_relations(draw_whole_scene(seed), "drawn", settings,
                        [&](const char* relation, const Related& related, const Likeness& found) {
                          tally.add(relation, found);
                          CAPTURE(seed);
                          CAPTURE(related.name);
                          CAPTURE(found.what);
                          CHECK(is_explained(found.verdict));
                        });
    }
    CHECK(tally.events() > 500);
  }
}
