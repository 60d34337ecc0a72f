// Which contacts are struck next, and where all gaps are then.
#include "decide/impact.hpp"

#include <doctest/doctest.h>

namespace signorini::tests::turns {

using Turn = std::vector<std::size_t>;

TEST_SUITE_BEGIN("unit/decide/impact");

TEST_CASE("of those that close the first is struck, and all move to there") {
  std::vector<decide::Approach> all{{3, 0.5, -1.0, 0.01, 0.001, true},   // after 0.5
                                    {5, 0.5, -2.0, 0.01, 0.001, true},   // after 0.25
                                    {7, 0.25, 1.0, 0.01, 0.001, true}};  // leaves
  CHECK(decide::next_impact(all) == Turn{5});
  CHECK(all[0].gap == 0.25);
  CHECK(all[1].gap == 0.0);
  CHECK(all[2].gap == 0.5);
  all[1].rate = 2.0;
  CHECK(decide::next_impact(all) == Turn{3});
  CHECK(all[1].gap == 0.5);
  all[0].rate = 0.0;
  CHECK(decide::next_impact(all).empty());
}

TEST_CASE("what touches at rest is struck with its neighbour, what leaves is not") {
  std::vector<decide::Approach> all{{0, 0.0, -1.0, 0.01, 0.001, true},
                                    {1, 0.0, 0.0, 0.01, 0.001, false},   // presses
                                    {2, 0.0, 0.009, 0.01, 0.001, true},  // slower than what flies
                                    {3, 0.0, 0.02, 0.01, 0.001, true}};
  CHECK(decide::next_impact(all) == Turn{0, 1, 2});
}

TEST_CASE("what rests goes on touching while another comes, whatever rounding has left of its rate") {
  std::vector<decide::Approach> all{{0, 0.5, -1.0, 0.01, 0.001, true}, {1, 0.0, 1e-12, 0.01, 0.001, false}};
  CHECK(decide::next_impact(all) == Turn{0, 1});
}

TEST_CASE("two that meet together are struck together, whatever rounding makes of the product") {
  std::vector<decide::Approach> all{{0, 0.3, -0.1, 0.01, 0.001, true}, {1, 0.9, -0.3, 0.01, 0.001, true}};
  CHECK(decide::next_impact(all) == Turn{0, 1});
}

TEST_SUITE_END();

}  // namespace signorini::tests::turns
