// Resultants of a seam against sums by hand.
#include "result/run_tables.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

TEST_SUITE_BEGIN("unit/result/seam_table");

TEST_CASE("seam_row: sums of forces and lengths, moment about the middle of the arc") {
  // Three nodes along a line at 33.7 degrees; the normal is square to it, to its left.
  const double a = 33.7 * 3.14159265358979323846 / 180.0, c = std::cos(a), s = std::sin(a);
  SeamSpec seam;
  seam.name = "joint";
  const double lengths[] = {0.5, 1.0, 0.25}, along[] = {0.0, 1.0, 1.75};
  for (int i = 0; i < 3; ++i) {
    seam.nodes.push_back({i, {4.0 + along[i] * c, -2.0 + along[i] * s}, lengths[i], {-s, c}});
  }
  std::vector<ContactSample> contacts(4);
  seam.first_contact = 1;  // one before it belongs to no seam
  contacts[0].N = -1e6;
  contacts[1].N = -3.0;
  contacts[1].T = 0.5;
  contacts[1].state = State::stick;
  contacts[2].N = -7.0;
  contacts[2].T = -2.0;
  contacts[2].state = State::slip_minus;
  contacts[3].state = State::open;

  const result::SeamRow row = result::seam_row(seam, 1.5, contacts);
  CHECK(row.t == 1.5);
  CHECK(row.seam == "joint");
  CHECK(row.N == doctest::Approx(-10.0));
  CHECK(row.T == doctest::Approx(-1.5));
  CHECK(row.stick == 0.5);
  CHECK(row.slip == 1.0);
  CHECK(row.open == 0.25);
  // Forces -N n push the slave along n; those along the line have no moment about a point on it.
  const double middle = (0.0 * 0.5 + 1.0 * 1.0 + 1.75 * 0.25) / 1.75;
  CHECK(row.moment == doctest::Approx((0.0 - middle) * 3.0 + (1.0 - middle) * 7.0).epsilon(1e-12));
}

TEST_SUITE_END();
