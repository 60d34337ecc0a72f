#include "motion/point.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace signorini::tests::term_sizes {

TEST_SUITE_BEGIN("unit/motion/term_size");

TEST_CASE("in the plane the size of form . x is |form| |x|, whatever the angle between them and the axes") {
  Model model;
  model.dofs.resize(4);
  Vector x(4);
  x << 3.0, -4.0, 12.0, 0.5;  // |x| = 5 of the first two, 13 with the third
  for (int degrees = 4; degrees < 360; degrees += 7) {
    CAPTURE(degrees);
    const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
    CHECK(motion::form_magnitude(model, {{{0, 2.0 * c}, {1, 2.0 * s}}}, x) ==
          doctest::Approx(2.0 * 5.0).epsilon(1e-14));
    // Of two nodes: what moves apart counts with both.
    CHECK(motion::form_magnitude(model, {{{0, c}, {1, s}, {2, -3.0}}}, x) ==
          doctest::Approx(std::sqrt(10.0) * 13.0).epsilon(1e-14));
  }
}

TEST_CASE(
    "components that a form does not have do not count, rotations and terms of long forms by themselves") {
  Model model;
  model.dofs.resize(6);
  model.dofs[2].rotation = true;
  Vector x(6);
  x << 3.0, -4.0, -0.5, 2.0, 1.0, 7.0;
  CHECK(motion::form_magnitude(model, {{{0, -0.5}, {1, 0.0}}}, x) == 1.5);
  CHECK(motion::form_magnitude(model, {{{0, 3.0}, {1, 4.0}, {2, 6.0}}}, x) ==
        doctest::Approx(25.0 + 3.0).epsilon(1e-15));
  CHECK(motion::form_magnitude(model, {{{0, 1.0}, {1, 2.0}, {3, -3.0}, {4, 4.0}, {5, -1.0}}}, x) ==
        3.0 + 8.0 + 6.0 + 4.0 + 7.0);
}

TEST_SUITE_END();

}  // namespace signorini::tests::term_sizes
