#include "run/output_monitor.hpp"

#include <doctest/doctest.h>

namespace signorini::tests::output_values {

TEST_SUITE_BEGIN("unit/run/output_value");

TEST_CASE("an output is the sum of its terms, its magnitude that of their sizes, whatever cancels") {
  motion::Point point;
  point.u = Eigen::Vector2d(2.0, -1.0);
  point.v = Eigen::Vector2d(0.5, -3.0);
  point.a = Eigen::Vector2d(4.0, 1.0);
  point.forces = Eigen::Vector4d(-4.0, 3.0, -8.0, 0.5);
  const ForceLayout layout(2);
  Output output;
  output.constant = -2.0;
  output.u.terms = {{0, -3.0}, {1, 2.0}};                         // -6 - 2
  output.v.terms = {{1, -2.0}};                                   // 6
  output.a.terms = {{0, 0.5}};                                    // 2
  output.forces = {{0, 1.5, -2.0}, {1, -1.0, 4.0}};               // -6 - 6, 8 + 2
  output.restoring = {{1, Combination{{{0, 1.0}}}, -0.25, 6.0}};  // -0.25 (8 - 6) 2
  output.given.resize(2);
  output.given[0].history = History::constant(5.0);
  output.given[1].history = History::constant(-3.0);
  for (const motion::Side side : {motion::Side::before, motion::Side::after}) {
    CHECK(run::value_of(output, 0.7, side, point, layout, {}) == -3.0);
    CHECK(run::magnitude_of(output, 0.7, side, point, layout) == 49.0);
  }
  // Two forces in balance: nothing is left of them but their rounding, which is that of both.
  Output balance;
  balance.forces = {{0, 1.0, 0.0}, {1, -0.5, 0.0}};
  CHECK(run::value_of(balance, 0.0, motion::Side::after, point, layout, {}) == 0.0);
  CHECK(run::magnitude_of(balance, 0.0, motion::Side::after, point, layout) == 8.0);
}

TEST_SUITE_END();

}  // namespace signorini::tests::output_values
