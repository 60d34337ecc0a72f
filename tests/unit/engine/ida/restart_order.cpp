// The past that IDA is given: its polynomials, and the order that segments begin with.
#include "engine/ida/restart_order.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "behaviour/one_mass.hpp"

namespace signorini::tests {
namespace {

/// A block that bounces on a foot of this law, 0.3 s.
Result bounces(const std::string& foot, const char* rtol = "1e-7") {
  return run_text(matrix_scene("t_end = 0.3\noutput_dt = 0.1\ninitial = { u = [0.004], v = [0.0] }",
                               "mass = [[2.0]]\nstiffness = [[30.0]]", "normal = { d0 = 1.0 }\n" + foot,
                               "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -20.0\n"),
                  "ida", rtol);
}

long steps_of_order(const Result& result, int order) {
  const auto& steps = result.report.counters.steps_by_order;
  const auto found = steps.find(order);
  return found == steps.end() ? 0 : found->second;
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/ida/restart_order");

TEST_CASE("a polynomial of derivatives, and its own derivatives") {
  const std::vector<double> values = {0.7, -1.2, 3.1, 0.4, -2.2};
  const double* const d = values.data();  // of exp-like coefficients d_k x^k / k!
  const double x = -0.37;
  const auto sum = [&](std::size_t p) {
    double total = 0.0, term = 1.0;
    for (std::size_t k = p; k < values.size(); ++k) {
      total += d[k] * term;
      term *= x / static_cast<double>(k - p + 1);
    }
    return total;
  };
  for (const Eigen::Index p : {0, 1, 2, 4})
    CHECK(ida::taylor_derivative(d, 4, p, x) ==
          doctest::Approx(sum(static_cast<std::size_t>(p))).epsilon(1e-15));
  CHECK(ida::taylor_derivative(d, 1, 0, x) == doctest::Approx(0.7 + 1.2 * 0.37).epsilon(1e-15));
}

TEST_CASE(
    "on a jet's polynomials u, v and a are derivatives of each other; without mass fewer derivatives are "
    "known") {
  motion::Jet jet;
  jet.u.resize(2, 7);
  jet.forces.resize(2, 5);
  for (Eigen::Index k = 0; k < 7; ++k) {
    jet.u(0, k) = std::pow(-1.3, static_cast<double>(k));  // of exp(-1.3 x)
    jet.u(1, k) = k <= motion::Jet::orders ? jet.u(0, k) : 1e9;
    if (k < 5) jet.forces(0, k) = jet.forces(1, k) = jet.u(0, k);
  }
  const double x = -0.04;
  const auto along = [&](Eigen::Index p) {
    Vector places(2);
    ida::displacement_derivatives(
        jet, p, x, true, [](Eigen::Index dof) { return dof == 1; }, places);
    return places;
  };
  const Vector u = along(0), v = along(1), a = along(2);
  Vector forces(2);
  ida::taylor_derivatives(jet.forces, motion::Jet::orders, 0, x, forces);
  CHECK(std::abs(u[0] - std::exp(-1.3 * x)) < std::pow(1.3 * 0.04, 7) / 5040.0 * 1.1);
  CHECK(std::abs(u[1] - std::exp(-1.3 * x)) < std::pow(1.3 * 0.04, 5) / 120.0 * 1.1);
  CHECK(std::abs(v[0] + 1.3 * std::exp(-1.3 * x)) < 1.3 * std::pow(1.3 * 0.04, 6) / 720.0 * 1.1);
  CHECK(std::abs(a[0] - 1.69 * std::exp(-1.3 * x)) < 1.69 * std::pow(1.3 * 0.04, 5) / 120.0 * 1.1);
  CHECK(forces[1] == doctest::Approx(u[1]).epsilon(1e-15));
}

TEST_CASE("after each event of a compliant contact IDA begins at order three; of a rigid one at order one") {
  const Result soft = bounces("law = \"compliant\"\nnormal_stiffness = 4e4\n");
  REQUIRE(soft.events.size() >= 4);
  CHECK(steps_of_order(soft, 1) + steps_of_order(soft, 2) == 0);
  CHECK(steps_of_order(soft, 3) >= static_cast<long>(soft.events.size()));
  CHECK(soft.report.audit.energy.value < 1e-5 * soft.report.audit.energy_scale);
  CHECK(soft.report.law_checks.violations.empty());
  const Result hard = bounces("law = \"rigid\"\nrestitution = 0.7\n");
  REQUIRE(hard.events.size() >= 2);
  CHECK(steps_of_order(hard, 1) > 5);
}

TEST_CASE("a segment that begins with a past is as exact as the tolerance asks") {
  // m u'' + (k + kn) u = -F in contact, m u'' + k u = -F in flight: each event in closed form.
  const double m = 2.0, k = 30.0, kn = 4e4, F = 20.0;
  const double w = std::sqrt(k / m), sag = F / k;
  double t = std::acos(sag / (0.004 + sag)) / w, v = -(0.004 + sag) * w * std::sin(w * t);
  std::vector<double> times = {t};
  const double W = std::sqrt((k + kn) / m), rest = F / (k + kn);
  for (int i = 0; i < 3; ++i) {
    // u = -rest + rest cos Wt + v/W sin Wt is zero again at tan(Wt/2) = (v/W)/rest
    t += 2.0 / W * (std::numbers::pi - std::atan(-v / W / rest));
    times.push_back(t);
    v = -v;
    t += 2.0 / w * std::atan(v / w / sag);
    times.push_back(t);
    v = -v;
  }
  double before = 0.0;
  for (const char* rtol : {"1e-6", "1e-9"}) {
    const Result result = bounces("law = \"compliant\"\nnormal_stiffness = 4e4\n", rtol);
    double worst = 0.0;
    REQUIRE(result.events.size() >= 4);
    for (std::size_t i = 0; i < std::min(times.size(), result.events.size()); ++i)
      worst = std::max(worst, std::abs(result.events[i].t - times[i]));
    CHECK(worst < 2e3 * std::atof(rtol) * 0.3);
    if (before > 0.0) CHECK(worst < 0.05 * before);
    before = worst;
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests
