#include "contact/friction.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

Contact rising_beside_spring() {
  Contact c;
  c.law = Law::slider;
  c.friction = {0.04, 0.11, {}, 0.05};
  return c;
}

}  // namespace

TEST_SUITE_BEGIN("unit/contact/massless_slip");

TEST_CASE("massless_slip_rate() is where friction takes the pull that the dashpot leaves") {
  const Contact c = rising_beside_spring();
  const double pressed = 800.0;
  for (const double damping : {0.0, 3.0, 700.0, 1e5})
    for (const double pull : {1.0, 31.9, 32.1, 33.0, 60.0, 87.99, 87.999999}) {
      CAPTURE(damping);
      CAPTURE(pull);
      const auto x = contact::massless_slip_rate(c.friction, pull, damping, pressed);
      REQUIRE(x);
      CHECK(pull - damping * *x ==
            doctest::Approx(contact::sliding_friction(c, *x) * pressed).epsilon(1e-13));
      CHECK((*x > 0.0) == (pull > 32.0));
    }
}

TEST_CASE("massless_slip_rate(): beyond what friction reaches only a dashpot tells the rate") {
  const Contact c = rising_beside_spring();
  CHECK_FALSE(contact::massless_slip_rate(c.friction, 88.0, 0.0, 800.0));
  CHECK_FALSE(contact::massless_slip_rate(c.friction, 90.0, 0.0, 800.0));
  const double nearly = 88.0 - 0.07 * 800.0 * contact::saturation_tolerance;
  CHECK_FALSE(contact::massless_slip_rate(c.friction, nearly + 1e-9, 0.0, 800.0));
  const auto last = contact::massless_slip_rate(c.friction, nearly - 1e-9, 0.0, 800.0);
  REQUIRE(last);
  CHECK(*last == doctest::Approx(contact::saturation_rate(c.friction)).epsilon(1e-3));
  CHECK(contact::saturation_rate(c.friction) == doctest::Approx(0.05 * 18.420680743952367).epsilon(1e-14));
  const auto damped = contact::massless_slip_rate(c.friction, 1088.0, 100.0, 800.0);
  REQUIRE(damped);
  CHECK(*damped == doctest::Approx(10.0).epsilon(1e-12));
}

TEST_SUITE_END();
