// Values of known order: what is seen of it, and whether the bar holds the error that is left.
#include "study/verify/richardson.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

/// x + c h^2 + d h^3 at h, h/2, h/4.
verify::StepTriple at_steps(double x, double c, double d, double h) {
  verify::StepTriple values;
  for (std::size_t i = 0; i < 3; ++i, h *= 0.5) values[i] = x + c * h * h + d * h * h * h;
  return values;
}

/// An oscillation whose error grows and passes through zero.
std::vector<verify::StepTriple> growing(double d) {
  std::vector<verify::StepTriple> series;
  for (int i = 1; i <= 100; ++i)
    series.push_back(
        at_steps(std::sin(0.3 * i), 0.1 * i * std::cos(0.3 * i), d * i * std::cos(0.3 * i), 0.01));
  return series;
}

}  // namespace

TEST_SUITE_BEGIN("unit/study/verify/richardson");

TEST_CASE("richardson: order two is seen, and the limit lies within the bar") {
  const std::vector<verify::StepTriple> series = growing(0.3);
  verify::ConvergenceOrder order;
  order.add(series);
  REQUIRE(order.value());
  CHECK(*order.value() == doctest::Approx(2.0).epsilon(0.02));
  CHECK(verify::is_second_order(order.value()));
  const verify::Extrapolation limit = verify::extrapolate(series, {order.value(), 1.0, 1000.0});
  for (std::size_t i = 0; i < series.size(); ++i) {
    CAPTURE(i);
    const double truth = std::sin(0.3 * static_cast<double>(i + 1));
    CHECK(std::abs(limit.value[i] - truth) <= limit.error_bound[i]);
    CHECK(limit.error_bound[i] < 0.1 * std::abs(0.1 * 100.0 * 1e-4 / 4.0));  // far below the coarse error
  }
}

TEST_CASE("richardson: where the order has not settled the bar is the whole difference") {
  std::vector<verify::StepTriple> series;
  for (int i = 0; i < 20; ++i) series.push_back({1.0 + 0.4, 1.0 + 0.14, 1.0 + 0.05});
  verify::ConvergenceOrder order;
  order.add(series);
  CHECK(*order.value() == doctest::Approx(std::log2(0.26 / 0.09)));
  CHECK_FALSE(verify::is_second_order(order.value()));
  CHECK(verify::usable(order.value()));
  CHECK(verify::extrapolate(series, {order.value(), 1.0, 1.0}).error_bound[10] == doctest::Approx(0.09));
  CHECK_FALSE(verify::usable(1.0));
  CHECK_FALSE(verify::usable(3.5));
}

TEST_CASE("richardson: differences that are rounding have no order, and are no reason for doubt") {
  std::vector<verify::StepTriple> series;
  for (int i = 1; i <= 20; ++i) series.push_back({1.0 * i, 1.0 * i * (1.0 + 1e-16), 1.0 * i});
  verify::ConvergenceOrder order;
  order.add(series);
  CHECK_FALSE(order.value());
  CHECK(verify::is_second_order(order.value()));
}
