#include "run/standstill.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/run/standstill");

TEST_CASE("standstill: more instants than allowed within ten resolutions are one too many") {
  Standstill watch(1.0, 3);
  for (const double t : {0.5, 0.5, 0.5 + 9e-9}) CHECK_FALSE(watch.count(t, 1e-9));
  CHECK(watch.count(0.5 + 9e-9, 1e-9) == "3 events at one instant; time does not advance");
}

TEST_CASE("standstill: the count starts anew where time has moved on") {
  Standstill watch(1.0, 3);
  for (int i = 0; i < 100; ++i) CHECK_FALSE(watch.count(0.5 + 11e-9 * (i / 3), 1e-9));
}

TEST_CASE("standstill: ten thousand events may take a hundred thousandth of the run, and no less") {
  const auto after = [](double length) {
    Standstill watch(2.0, 100);
    std::optional<std::string> reason;
    for (int i = 1; i <= 10000 && !reason; ++i) reason = watch.count(length * i / 10000.0, 0.0);
    return reason;
  };
  CHECK_FALSE(after(2.01e-5));
  CHECK(after(1.99e-5) == "10000 events within 1.99e-05 of time; the motion does not get on");
}

TEST_SUITE_END();
