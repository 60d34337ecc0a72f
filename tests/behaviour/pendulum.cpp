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

TEST_CASE("damping beta acts on the springs of a structure, not on the restoring force of its pendulums") {
  Bearing b;
  b.friction = "0.0";
  const double period = 2.0 * pi * std::sqrt(b.R / g), beta = 0.2;
  b.t_end = 3.0 * period;
  const std::string damped = fmt::format("[damping]\nbeta = {}\n", beta);
  // Beside a spring k: m u'' + beta k u' + (k + m g / R) u = 0.
  const double k = 400.0, decay = 0.5 * beta * k / b.m,
               w = std::sqrt((k + b.m * g / b.R) / b.m - decay * decay);
  const double slowed =
      b.start * std::exp(-decay * b.t_end) * (std::cos(w * b.t_end) + decay / w * std::sin(w * b.t_end));
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    b.rest = damped;
    const Result alone = run_text(b.scene(), engine, "1e-11");
    CHECK(alone.rows.back().u[0] == doctest::Approx(b.start).epsilon(1e-9));
    CHECK(std::abs(alone.report.audit.final.damping) < 1e-9 * alone.report.audit.initial.stored());
    b.rest = damped + fmt::format("[[springs]]\nnode = \"A\"\ndirection = [1.0, 0.0]\nstiffness = {}\n", k);
    CHECK(run_text(b.scene(), engine, "1e-11").rows.back().u[0] == doctest::Approx(slowed).epsilon(1e-8));
  }
  // A bearing that carries what the structure gives it, turned: its stiffness N_K / R is not damped either.
  for (const double angle : {0.0, 0.7}) {
    CAPTURE(angle);
    const double c = std::cos(angle), s = std::sin(angle), kn = 1e8, sunk = b.m * g / kn;
    const std::string text =
        view_head({}) +
        fmt::format(
            "gravity = [{:.17g}, {:.17g}]\n[run]\nt_end = {:.17g}\noutput_dt = {:.17g}\ninitial = {{ A = {{ "
            "ux "
            "= {:.17g}, uy = {:.17g} }} }}\n[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = {}\n"
            "[[pendulums]]\nname = \"p\"\nnode = \"A\"\nradius = {}\nnormal = [{:.17g}, {:.17g}]\n"
            "normal_stiffness = {}\nnormal_force = {:.17g}\n",
            g * s, -g * c, b.t_end, b.t_end / 3.0, b.start * c + sunk * s, b.start * s - sunk * c, b.m, b.R,
            -s, c, kn, b.m * g);
    const Result result = run_text(text + damped, "ida", "1e-11");
    CHECK(result.rows.back().u[0] * c + result.rows.back().u[1] * s ==
          doctest::Approx(b.start).epsilon(1e-7));
  }
}

TEST_CASE("a rigid rim stops a pendulum on either side, and it swings back from there") {
  Bearing b;
  b.friction = "0.0";
  b.more = "stop = 0.15\n";
  b.t_end = 2.0;
  b.start = 0.5;  // of the velocity
  const double omega = std::sqrt(g / b.R), hit = std::asin(0.15 * omega / 0.5) / omega;
  for (const double side : {1.0, -1.0}) {
    std::string text = b.scene();
    text.replace(text.find("ux = 0.5"), 8, side > 0.0 ? "vx = 0.5" : "vx = -0.5");
    for (const char* engine : {"exact", "ida"}) {
      CAPTURE(engine);
      const Result result = run_text(text, engine, "1e-11");
      REQUIRE(!result.events.empty());
      CHECK(result.events[0].type == EventType::impact);
      CHECK(result.events[0].contact == (side > 0.0 ? 1 : 2));  // after the bearing itself
      CHECK(result.events[0].t == doctest::Approx(hit).epsilon(1e-9));
      CHECK(result.events[0].vn == doctest::Approx(-0.5 * std::cos(omega * hit)).epsilon(1e-9));
      CHECK(result.rows.back().u[0] ==
            doctest::Approx(side * 0.15 * std::cos(omega * (2.0 - hit))).epsilon(1e-8));
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

namespace {

/// N = N0 (1 + 0.3 sin 9 t), by ida beside a fixed step.
void check_time_varying(double step) {
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
                                 step, [&](double t, const Sliding&) { return pressed(t); });
  const Result result = run_text(scene, "ida", "1e-10");
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.events.size() > 3);
  CHECK(std::abs(result.rows.back().u[0] - expected[0]) < 1e-9);
  CHECK(std::abs(result.rows.back().v[0] - expected[1]) < 1e-8);
  CHECK(std::abs(result.rows.back().contacts[0].T - expected[2]) < 1e-5);
  CHECK(result.report.audit.energy.value < 1e-6 * result.report.audit.energy_scale);
  CHECK(result.report.law_checks.violations.empty());
  CHECK(result.report.audit.equilibrium.value < 1e-5 * N0);
}

}  // namespace

TEST_CASE("a bearing whose force varies with time is where a fixed step of 1e-6 s puts it") {
  check_time_varying(1e-6);
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
  CHECK(result.report.law_checks.violations.empty());
}

TEST_CASE("from a static start a pendulum is driven back by the weight that it carries") {
  const std::string scene = view_head({}) +
                            "gravity = [0.0, -9.81]\n[run]\nt_end = 1.0\ninitial = \"static\"\n[nodes]\nA = "
                            "[0.0, 0.0]\n[[masses]]\nnode = "
                            "\"A\"\nmass = 100.0\n[[pendulums]]\nname = \"p\"\nnode = \"A\"\nradius = "
                            "2.0\nnormal_stiffness = 1e6\n";
  const Model model = build_model(parse_scene(scene, "test.toml"));
  CHECK(model.contacts[0].pendulum_surface->nominal_force == doctest::Approx(981.0));
  CHECK(model.stiffness.coeff(0, 0) == doctest::Approx(490.5));
  CHECK(model.omega1 == doctest::Approx(std::sqrt(g / 2.0)));
}

TEST_CASE("a start on pendulums is one in equilibrium: u = H R / N, by springs that feel it, too") {
  // A slab that wind pushes, with friction and without; beside one bearing a column leans on it by a spring, so that
  // what each bears depends on where the slab stands: W in the bearings by moments, H = sum N u / R + k (u - c).
  const std::string scene =
      view_head({}) +
      "gravity = [0.0, -9.81]\n[run]\nt_end = 1.0\nengine = \"ida\"\ninitial = \"static\"\n[damping]\nbeta = "
      "1e-3\n[nodes]\nW = [-1.0, 0.0]\nE = [1.0, 0.0]\n[[rigid]]\nname = \"slab\"\ncentre = [0.0, "
      "0.5]\nnodes = [\"W\", \"E\"]\nmass = 100.0\ninertia = 20.0\n[[springs]]\nnode = \"slab\"\n"
      "direction = [1.0, 1.0]\nstiffness = 300.0\n[[loads]]\nnode = \"slab\"\ndirection = [1.0, 0.0]\n"
      "amplitude = 30.0\n";
  const auto bearings = [](const std::string& more) {
    std::string text;
    for (const char* node : {"W", "E"})
      text += fmt::format(
          "[[pendulums]]\nname = \"p{}\"\nnode = \"{}\"\nradius = 2.0\nnormal_stiffness = 1e6\n{}", node,
          node, more);
    return text;
  };
  for (const char* more :
       {"", "normal_force = 400.0\n", "friction = 0.05\ntangential_stiffness = 1e4\n",
        "normal_force = 400.0\nfriction = 0.05\ntangential_stiffness = 1e4\nnormal_damping = 100.0\n"}) {
    CAPTURE(more);
    const Model model = build_model(parse_scene(scene + bearings(more), "test.toml"));
    const double x = model.u0[0], y = model.u0[1], r = model.u0[2];  // of the centre
    const double along = 300.0 * 0.5 * (x + y), left = -1e6 * (y - r), right = -1e6 * (y + r);
    const double back = (left + right) * (x + 0.5 * r) / 2.0;
    CHECK(std::abs(30.0 - along - back) < 1e-10);
    CHECK(std::abs(left + right - 981.0 - along) < 1e-9);
    CHECK(std::abs(left - right + 0.5 * back) < 1e-9);  // moments about the centre
    CHECK(std::abs(x) > 0.01);
    const Result rests = run_text(scene + bearings(more), "ida", "1e-10");
    CHECK((rests.rows.back().u - model.physical(model.u0)).norm() < 1e-10);
    CHECK(rests.report.law_checks.violations.empty());
  }
  const std::string with_friction = bearings("friction = 0.02\ntangential_stiffness = 1e4\n");
  std::string slow = scene;
  slow.replace(slow.find("\"static\""), 8, "\"frictional\"");
  const Result rests = run_text(slow + with_friction, "ida", "1e-10");
  CHECK((rests.rows.back().u - rests.rows.front().u).norm() < 1e-10);
  CHECK(rests.rows.front().contacts[0].T > 1.0);
}

namespace {

/// A mass of 100 kg on a pendulum against a pier that is held, turned: the pier's reaction along and across.
std::string on_pier(double degrees, const std::string& pendulum, const std::string& more) {
  const double a = degrees * pi / 180.0, c = std::cos(a), s = std::sin(a);
  return view_head({}) +
         fmt::format(
             "gravity = [{2:.17g}, {3:.17g}]\n[run]\nt_end = 0.5\noutput_dt = 0.01\nengine = \"ida\"\nrtol = "
             "1e-10\n"
             "initial = {{ A = {{ ux = {4:.17g}, uy = {5:.17g} }} }}\n[nodes]\nA = [0.0, 0.0]\npier = "
             "[{6:.17g}, {7:.17g}]\n"
             "[[masses]]\nnode = \"A\"\nmass = 100.0\n[[supports]]\nnode = \"pier\"\nfix = [\"ux\", \"uy\"]\n"
             "[[output]]\nname = \"shear\"\nkind = \"reaction\"\nat = \"pier\"\ndirection = [{0:.17g}, "
             "{1:.17g}]\n"
             "[[output]]\nname = \"pull\"\nkind = \"acceleration\"\nat = \"A\"\ndirection = [{0:.17g}, "
             "{1:.17g}]\n"
             "[[output]]\nname = \"both\"\nkind = \"combination\"\nterms = {{ shear = -2.0 }}\n"
             "[[pendulums]]\nname = \"p\"\nnode = \"A\"\nagainst = \"pier\"\nradius = 2.0\nnormal = "
             "[{8:.17g}, "
             "{9:.17g}]\n",
             c, s, 9.81 * s, -9.81 * c, 0.2 * c, 0.2 * s, s, -c, -s, c) +
         pendulum + more;
}

}  // namespace

TEST_CASE("a reaction has N u / R of an N that varies: it is what accelerates the mass") {
  for (const double degrees : {0.0, 37.3})
    for (const char* pendulum :
         {"normal_stiffness = 1e5\n", "normal_stiffness = 1e5\nnormal_force = 900.0\n",
          "normal_stiffness = 1e5\nfriction = 0.02\ntangential_stiffness = 1e4\nnormal_damping = 200.0\n"}) {
      CAPTURE(degrees);
      CAPTURE(pendulum);
      const Scene scene = parse_scene(on_pier(degrees, pendulum, ""), "test.toml");
      const Result swings = simulate(scene);
      REQUIRE(swings.responses.size() > 40);
      double most = 0.0;
      for (const auto& row : swings.responses) {
        most = std::max(most, std::abs(row.values[0]));
        CHECK(std::abs(row.values[0] - 100.0 * row.values[1]) < 1e-5);  // of 98 N; ida's tolerance of N
        CHECK(std::abs(row.values[2] + 2.0 * row.values[0]) < 1e-12 * 100.0);
      }
      CHECK(most > 90.0);
      CHECK(swings.report.response[0].minimum ==
            doctest::Approx(100.0 * swings.report.response[1].minimum).epsilon(1e-7));
      REQUIRE(swings.report.audit.reactions);
      CHECK(swings.report.audit.reactions->value < 1e-5);
    }
  // N as a history, on a support: R = -N(t) u / 2.
  const std::string given =
      on_pier(0.0, "normal_force = { type = \"harmonic\", offset = 981.0, amplitude = 300.0, omega = 9.0 }\n",
              "[[supports]]\nnode = \"A\"\nfix = [\"uy\"]\n");
  const Scene scene = parse_scene(given, "test.toml");
  const Result swings = simulate(scene);
  for (std::size_t i = 0; i < swings.responses.size(); ++i) {
    const auto& row = swings.responses[i];
    const auto at =
        std::find_if(swings.rows.begin(), swings.rows.end(), [&](const auto& r) { return r.t == row.t; });
    REQUIRE(at != swings.rows.end());
    CHECK(row.values[0] ==
          doctest::Approx(-(981.0 + 300.0 * std::sin(9.0 * row.t)) * at->u[0] / 2.0).epsilon(1e-9));
  }
  const std::string number =
      on_pier(0.0, "normal_force = 981.0\n", "[[supports]]\nnode = \"A\"\nfix = [\"uy\"]\n");
  const Result node_index = run_text(number, "exact", "1e-10");  // N u / R pushes the pier along u
  CHECK(node_index.report.response[0].minimum == doctest::Approx(-981.0 * 0.2 / 2.0).epsilon(1e-10));
}

TEST_CASE("piers under a slab in the wind: reactions of damped pendulums balance loads and inertia") {
  // What each bears depends on where the slab stands, so K has N_K u / R beside the spring that the scene says; C has neither.
  std::string scene =
      view_head({}) +
      "gravity = [0.0, -9.81]\n[run]\nt_end = 1.0\nengine = \"ida\"\nrtol = 1e-10\ninitial = "
      "\"static\"\n[damping]\nbeta = 1e-2\n[nodes]\nW = [-1.0, 0.0]\nE = [1.0, 0.0]\nPW = [-1.0, "
      "-1.0]\nPE = [1.0, -1.0]\n[[rigid]]\nname = \"slab\"\ncentre = [0.0, 0.5]\nnodes = [\"W\", "
      "\"E\"]\nmass = 100.0\ninertia = 20.0\n[[supports]]\nnode = \"PW\"\nfix = [\"ux\", "
      "\"uy\"]\n[[supports]]\nnode = \"PE\"\nfix = [\"ux\", \"uy\"]\n[[loads]]\nnode = "
      "\"slab\"\ndirection = [1.0, 0.3]\namplitude = 30.0\n[[loads]]\nnode = \"slab\"\ndirection = "
      "[1.0, 0.0]\namplitude = 80.0\nhistory = { type = \"rectangle\", start = 0.1, end = 0.4 }\n";
  for (const char* pier : {"W", "E"})
    scene += fmt::format(
        "[[pendulums]]\nname = \"p{0}\"\nnode = \"{0}\"\nagainst = \"P{0}\"\nradius = 2.0\nnormal_stiffness "
        "= "
        "1e6\nnormal_force = {1}\n[[output]]\nname = \"R{0}\"\nkind = \"reaction\"\nat = \"P{0}\"\ndirection "
        "= [1.0, "
        "0.0]\n",
        pier, pier[0] == 'W' ? 400.0 : 500.0);
  const Result swings = simulate(parse_scene(scene, "test.toml"));
  REQUIRE(swings.report.audit.reactions);
  CHECK(swings.report.response[0].minimum < -10.0);
  CHECK(swings.report.audit.reactions->value < 1e-5);
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
                      doctest::Contains("the stiffness of pendulum 'p' varies with its normal force"));
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
      doctest::Contains(
          "sensitivities cannot differentiate friction that rises with the slip rate together"));
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/behaviour/pendulum");

TEST_CASE("an isolator whose friction depends on its slip rate is where a fixed step of 1e-7 s puts it") {
  check_time_varying(1e-7);
}

TEST_SUITE_END();

}  // namespace signorini::tests::pendulum
