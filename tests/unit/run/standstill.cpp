#include "run/run_limits.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/run/standstill");

TEST_CASE("standstill: more instants than allowed within ten resolutions are one too many") {
  run::StallDetector watch(1.0, 3);
  for (const double t : {0.5, 0.5, 0.5 + 9e-9}) CHECK_FALSE(watch.count(t, 1e-9));
  CHECK(watch.count(0.5 + 9e-9, 1e-9) == "3 events at one instant; time does not advance");
}

TEST_CASE("standstill: the count starts anew where time has moved on") {
  run::StallDetector watch(1.0, 3);
  for (int i = 0; i < 100; ++i) CHECK_FALSE(watch.count(0.5 + 11e-9 * (i / 3), 1e-9));
}

TEST_CASE("standstill: ten thousand events may take a hundred thousandth of the run, and no less") {
  const auto after = [](double length) {
    run::StallDetector watch(2.0, 100);
    std::optional<std::string> reason;
    for (int i = 1; i <= 10000 && !reason; ++i) reason = watch.count(length * i / 10000.0, 0.0);
    return reason;
  };
  CHECK_FALSE(after(2.01e-5));
  CHECK(after(1.99e-5) == "10000 events within 1.99e-05 of time; the motion does not advance");
}

TEST_CASE("standstill: contacts are those of the instants that were too many") {
  run::StallDetector watch(1.0, 2);
  CHECK_FALSE(watch.count(0.25, 1e-9, {7}));  // long ago
  CHECK_FALSE(watch.count(0.5, 1e-9, {4}));
  CHECK_FALSE(watch.count(0.5, 1e-9, {1, 4}));
  CHECK(watch.count(0.5, 1e-9, {3}));
  CHECK(watch.contacts() == std::vector<std::size_t>{1, 3, 4});
}

TEST_CASE("standstill: contacts of ten thousand events are those since the last look") {
  run::StallDetector watch(2.0, 100000);
  for (int i = 0; i < 10000; ++i) CHECK_FALSE(watch.count(0.6, 0.0, {9}));
  for (int i = 1; i < 10000; ++i)
    CHECK_FALSE(watch.count(0.6 + 1e-9 * i, 0.0, {static_cast<std::size_t>(i % 2)}));
  CHECK(watch.count(0.6 + 1e-5, 0.0, {5}));
  CHECK(watch.contacts() == std::vector<std::size_t>{0, 1, 5});
}

TEST_SUITE_END();
