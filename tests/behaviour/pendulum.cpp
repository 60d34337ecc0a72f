// Friction pendulums: period, loop, decay, forces that vary, and the same bearing seen otherwise.
//
//   m u'' + N u / R + T = P,   N = m g:   period 2 pi sqrt(R / g),   u falls by 2 f R from turn to turn
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "behaviour/halves.hpp"
#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"
#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::pendulum {
namespace {

constexpr double pi = std::numbers::pi, g = 9.81;

/// In units of its own, turned, its tangent one way or the other.
struct View {
  double force = 1.0, length = 1.0, angle = 0.0;
  bool mirrored = false;
};
std::string view_head(const View& view) {
  const bool kilo = view.force != 1.0, milli = view.length != 1.0;
  return fmt::format(
      "schema = 1\nunits = {{ force = \"{}\", mass = \"{}\", length = \"{}\", time = \"{}\" }}\n",
      kilo ? "kN" : "N", kilo && !milli ? "t" : "kg", milli ? "mm" : "m", milli ? "ms" : "s");
}

struct Bearing {
  double m = 300.0, R = 2.2, start = 0.3;
  std::string friction = "0.05";
  std::string more = {};  ///< keys of the pendulum
  std::string rest = {};  ///< tables
  double t_end = 6.0;

  /// Along x, on a support.
  [[nodiscard]] std::string scene() const {
    return view_head({}) +
           fmt::format(
               "[run]\nt_end = {}\noutput_dt = {:.17g}\ninitial = {{ A = {{ ux = {:.17g} }} }}\n[nodes]\nA = "
               "[0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = {}\n[[supports]]\nnode = \"A\"\nfix = "
               "[\"uy\"]\n",
               t_end, t_end / 50.0, start, m) +
           fmt::format(
               "[[pendulums]]\nname = \"p\"\nnode = \"A\"\nradius = {}\nfriction = {}\nnormal_force = "
               "{:.17g}\n",
               R, friction, m * g) +
           more + rest;
  }
};

/// u, v, T along the bearing, and upwards u and v.
using Sliding = std::array<double, 5>;
struct Slider {
  double m, R, kt, slow, fast, velocity;
};

/// Runge and Kutta's fourth order at a fixed step: m u'' = -N u/R - T, T' = kt (u' - p'), |p'| by the inverse of the law.
Sliding slide(const Slider& s, Sliding y, double t_end, double h,
              const std::function<double(double, const Sliding&)>& pressed) {
  const auto rate = [&](double t, const Sliding& x) {
    const double N = pressed(t, x), over = std::abs(x[2]) - s.slow * N;
    double p = 0.0;
    if (over > 0.0) p = -s.velocity * std::log((s.fast * N - std::abs(x[2])) / ((s.fast - s.slow) * N));
    if (x[2] < 0.0) p = -p;
    return Sliding{x[1], -(N * x[0] / s.R + x[2]) / s.m, s.kt * (x[1] - p), x[4], N / s.m - g};
  };
  const auto moved = [](Sliding a, const Sliding& b, double x) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += x * b[i];
    return a;
  };
  const long steps = std::lround(t_end / h);
  for (long i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) * h;
    const Sliding a = rate(t, y), b = rate(t + 0.5 * h, moved(y, a, 0.5 * h)),
                  c = rate(t + 0.5 * h, moved(y, b, 0.5 * h)), d = rate(t + h, moved(y, c, h));
    for (std::size_t j = 0; j < y.size(); ++j) y[j] += h / 6.0 * (a[j] + 2.0 * b[j] + 2.0 * c[j] + d[j]);
  }
  return y;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/pendulum");

TEST_CASE("a pendulum without friction swings with the period 2 pi sqrt(R/g), whatever it carries") {
  for (const double m : {1.0, 300.0}) {
    Bearing b;
    b.m = m;
    b.friction = "0.0";
    const double period = 2.0 * pi * std::sqrt(b.R / g);
    b.t_end = 3.0 * period;
    for (const char* engine : {"exact", "ida"}) {
      CAPTURE(engine);
      const Result result = run_text(b.scene(), engine, "1e-11");
      CHECK(result.rows.back().u[0] == doctest::Approx(b.start).epsilon(1e-9));
      CHECK(std::abs(result.rows[25].u[0] + b.start) < 1e-9);  // half of three periods
    }
  }
}

TEST_CASE("with friction a pendulum turns every half period, 2 f R nearer each time, and sticks within f R") {
  const Bearing b;  // 0.3, 0.08 the other way: 0.3 - 2 * 0.05 * 2.2 = 0.08 < f R = 0.11
  const double half = pi * std::sqrt(b.R / g);
  for (const char* engine : {"exact", "ida", "newmark"}) {
    CAPTURE(engine);
    const bool steps = engine[0] == 'n';
    const Result result = run_text(b.scene(), engine, "1e-11", "1e-4");
    REQUIRE(result.events.size() == 1);
    CHECK(std::abs(result.events[0].t - half) < (steps ? 1e-7 : 1e-10));
    CHECK(result.events[0].to == State::stick);
    CHECK(std::abs(result.rows.back().u[0] + 0.3 - 0.1 * b.R) < (steps ? 1e-7 : 1e-10));
  }
  Bearing far = b;
  far.t_end = 8.0;
  far.start = 1.0;  // 0.78, 0.56, 0.34, 0.12, then 0.1
  const Result result = run_text(far.scene(), "exact");
  REQUIRE(result.events.size() == 5);
  CHECK(result.events.back().t == doctest::Approx(5.0 * half).epsilon(1e-12));
  CHECK(std::abs(result.rows.back().u[0]) == doctest::Approx(0.1).epsilon(1e-11));
}

TEST_CASE("a cycle of a shaken pendulum costs 4 f N D") {
  Bearing b;
  b.start = 0.0;
  const double omega = 1.4 * std::sqrt(g / b.R), period = 2.0 * pi / omega;
  b.t_end = 60.0 * period;
  b.rest = fmt::format(
      "[[loads]]\nnode = \"A\"\ndirection = [1.0, 0.0]\namplitude = {:.17g}\nhistory = {{ type = "
      "\"harmonic\", omega = "
      "{:.17g} }}\n",
      0.14 * b.m * g, omega);
  // Den Hartog (1931): D = P/k sqrt( V^2 - (F/P)^2 U^2 ),  r = omega/omega0,  V = 1/(1 - r^2),
  // U = sin(pi/r) / ( r (1 + cos(pi/r)) )
  const double r = 1.4, share = 0.05 / 0.14, V = 1.0 / (1.0 - r * r),
               U = std::sin(pi / r) / (r * (1.0 + std::cos(pi / r)));
  const double D = 0.14 * b.R * std::sqrt(V * V - share * share * U * U);
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Result result = run_text(b.scene(), engine, "1e-10");
    const auto work = [&](std::size_t i) { return result.rows[i].energy.friction; };
    REQUIRE(result.rows.size() == 51);
    CHECK(result.rows[45].t == doctest::Approx(54.0 * period));
    CHECK((work(50) - work(45)) / 6.0 == doctest::Approx(4.0 * 0.05 * b.m * g * D).epsilon(1e-6));
  }
}

TEST_CASE("a bearing whose force varies with time is where a fixed step of 1e-6 s puts it") {
  // N = N0 (1 + 0.3 sin 9 t)
  Bearing b;
  b.m = 100.0;
  b.start = 0.06;
  b.t_end = 1.2;
  b.friction = "{ slow = 0.03, fast = 0.08, velocity = 0.1 }";
  const double N0 = b.m * g, kt = 1.5e4;
  std::string scene = b.scene();
  const std::string given = fmt::format("normal_force = {:.17g}\n", N0);
  scene.replace(
      scene.find(given), given.size(),
      fmt::format("normal_force = {{ type = \"harmonic\", offset = {:.17g}, amplitude = {:.17g}, omega = 9.0 "
                  "}}\ntangential_stiffness = {:.17g}\ninitial_shear = 0.0\n",
                  N0, 0.3 * N0, kt));
  const auto pressed = [&](double t) { return N0 * (1.0 + 0.3 * std::sin(9.0 * t)); };
  const Sliding expected = slide({b.m, b.R, kt, 0.03, 0.08, 0.1}, {b.start, 0.0, 0.0, 0.0, 0.0}, b.t_end,
                                 1e-6, [&](double t, const Sliding&) { return pressed(t); });
  const Result result = run_text(scene, "ida", "1e-10");
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.events.size() > 3);
  CHECK(std::abs(result.rows.back().u[0] - expected[0]) < 1e-9);
  CHECK(std::abs(result.rows.back().v[0] - expected[1]) < 1e-8);
  CHECK(std::abs(result.rows.back().contacts[0].T - expected[2]) < 1e-5);
  CHECK(result.report.audit.energy.value < 1e-6 * result.report.audit.energy_scale);
  CHECK(result.report.witness.violations.empty());
  CHECK(result.report.audit.equilibrium.value < 1e-5 * N0);
}

TEST_CASE("a bearing that presses as the structure bounces is where a fixed step of 1e-6 s puts it") {
  Bearing b;
  b.m = 100.0;
  const double kt = 1.5e4, kn = 4e5, fall = 0.04;
  const std::string scene = view_head({}) +
                            fmt::format(
                                "gravity = [0.0, {:.17g}]\n[run]\nt_end = 0.8\ninitial = {{ A = {{ ux = "
                                "0.05, uy = {:.17g}, vy = {:.17g} }} "
                                "}}\n[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = {}\n",
                                -g, -b.m * g / kn, -fall, b.m) +
                            fmt::format(
                                "[[pendulums]]\nname = \"p\"\nnode = \"A\"\nradius = {}\nnormal_stiffness = "
                                "{:.17g}\nnormal_force = 700.0\ntangential_stiffness = {:.17g}\nfriction = "
                                "{{ slow = 0.03, fast = 0.08, "
                                "velocity = 0.1 }}\n",
                                b.R, kn, kt);
  // A force is carried at rest only to be taken out again: what it is does not matter.
  const Sliding expected = slide({b.m, b.R, kt, 0.03, 0.08, 0.1}, {0.05, 0.0, 0.0, -b.m * g / kn, -fall}, 0.8,
                                 1e-6, [&](double, const Sliding& y) { return std::max(-kn * y[3], 0.0); });
  const Result result = run_text(scene, "ida", "1e-10");
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(std::abs(result.rows.back().u[0] - expected[0]) < 1e-9);
  CHECK(std::abs(result.rows.back().u[1] - expected[3]) < 1e-9);
  CHECK(std::abs(result.rows.back().v[0] - expected[1]) < 1e-7);
  CHECK(result.report.audit.energy.value < 1e-6 * result.report.audit.energy_scale);
  CHECK(result.report.witness.violations.empty());
}

TEST_CASE("from a static start a pendulum is driven back by the weight that it carries") {
  const std::string scene = view_head({}) +
                            "gravity = [0.0, -9.81]\n[run]\nt_end = 1.0\ninitial = \"static\"\n[nodes]\nA = "
                            "[0.0, 0.0]\n[[masses]]\nnode = "
                            "\"A\"\nmass = 100.0\n[[pendulums]]\nname = \"p\"\nnode = \"A\"\nradius = "
                            "2.0\nnormal_stiffness = 1e6\n";
  const Model model = build_model(parse_scene(scene, "test.toml"));
  CHECK(model.contacts[0].bowl->carried == doctest::Approx(981.0));
  CHECK(model.stiffness.coeff(0, 0) == doctest::Approx(490.5));
  CHECK(model.omega1 == doctest::Approx(std::sqrt(g / 2.0)));
}

TEST_CASE("engines that need laws which are linear refuse what varies, by name") {
  Bearing b;
  std::string scene = b.scene();
  const std::string given = fmt::format("normal_force = {:.17g}\n", b.m * g);
  scene.replace(scene.find(given), given.size(),
                "normal_force = { type = \"harmonic\", offset = 10.0, amplitude = 1.0, omega = 9.0 }\n");
  Bearing rising;
  rising.friction = "{ slow = 0.03, fast = 0.08, velocity = 0.1 }";
  for (const char* engine : {"exact", "newmark", "friction-iteration"}) {
    CAPTURE(engine);
    CHECK_THROWS_WITH(static_cast<void>(run_text(scene, engine)),
                      doctest::Contains("pendulum 'p' has one that goes with its normal force"));
    CHECK_THROWS_WITH(static_cast<void>(run_text(rising.scene(), engine)),
                      doctest::Contains("friction of contact 'p' depends on its slip rate; use \"ida\""));
  }
}

TEST_CASE(
    "sensitivities of a pendulum: the radius moves its turns by the closed form, and what varies is "
    "refused") {
  Bearing b;
  const Sensitivities s = rates_of(b.scene(), {"pendulums.p.radius"});
  REQUIRE(s.events.size() == 1);
  CHECK(s.event_rates[0][0].t == doctest::Approx(0.5 * pi / std::sqrt(b.R * g)).epsilon(1e-9));
  b.friction = "{ slow = 0.03, fast = 0.08, velocity = 0.1 }";
  b.more = "tangential_stiffness = 1e5\n";
  std::string scene = b.scene();
  scene.replace(scene.find("[run]\n"), 6, "[run]\nengine = \"ida\"\n");
  CHECK_THROWS_WITH(
      static_cast<void>(rates_of(scene, {"pendulums.p.radius"})),
      doctest::Contains("sensitivities do not know friction that rises with the slip rate beside"));
}

TEST_SUITE_END();

}  // namespace signorini::tests::pendulum
