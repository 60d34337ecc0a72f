#include "motion/point.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/motion/point");

TEST_CASE("between two points all of the state lies on a straight line") {
  const auto at = [](double x) {
    return motion::Point{Vector::Constant(2, 1.0 + x), Vector::Constant(2, 2.0 - x),
                         Vector::Constant(4, 3.0 * x), Vector::Constant(2, 4.0 + 2.0 * x)};
  };
  const motion::Point p = motion::interpolate(at(0.0), at(1.0), 0.25), q = at(0.25);
  CHECK(p.u.isApprox(q.u));
  CHECK(p.v.isApprox(q.v));
  CHECK(p.forces.isApprox(q.forces));
  CHECK(p.a.isApprox(q.a));
}

TEST_SUITE_END();
