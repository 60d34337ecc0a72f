// Friction that rises with the slip rate: closed forms, an integrator of 1e-7 s, and the same scene seen otherwise.
//
//   f = fast - (fast - slow) exp(-|p'| / v)
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "behaviour/halves.hpp"
#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"
#include "signorini/certify.hpp"
#include "signorini/sensitivity.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::rising {
namespace {

constexpr double slow = 0.04, fast = 0.11, velocity = 0.2;
const std::string law = "friction = { slow = 0.04, fast = 0.11, velocity = 0.2 }\n";

/// w = exp(x/v): w' = -(N / m v) (fast w - (fast - slow)), until w = 1.
double time_to_rest(double x, double N, double m, double f_slow = slow, double f_fast = fast,
                    double v = velocity) {
  const double end = (f_fast - f_slow) / f_fast;
  return m * v / (N * f_fast) * std::log((std::exp(x / v) - end) / (1.0 - end));
}

/// An acceleration of the ground at every hundredth of a second, straight between.
struct Quake {
  static constexpr double step = 0.01;
  std::vector<double> values;
  explicit Quake(double t_end, double size) {
    for (int i = 0; i <= static_cast<int>(std::lround(t_end / step)) + 1; ++i) {
      const double t = i * step;
      values.push_back(size * t *
                       (std::sin(9.7 * t) + 0.7 * std::sin(23.1 * t + 0.4) - 0.5 * std::sin(41.3 * t)));
    }
  }
  [[nodiscard]] double at(double t) const {
    const double x = t / step;
    const auto i = static_cast<std::size_t>(x);
    return values[i] + (x - static_cast<double>(i)) * (values[i + 1] - values[i]);
  }
  [[nodiscard]] std::string table() const {
    std::string times, all;
    for (std::size_t i = 0; i < values.size(); ++i) {
      times += fmt::format("{}{:.17g}", i > 0 ? ", " : "", static_cast<double>(i) * step);
      all += fmt::format("{}{:.17g}", i > 0 ? ", " : "", values[i]);
    }
    return "{ type = \"table\", times = [" + times + "], values = [" + all + "] }";
  }
};

/// A mass on a spring and a bearing: spring kt, sliding point without mass, friction.
struct Isolator {
  double m = 100.0, k = 2000.0, kt = 4.0e4, N = 981.0;
};

struct Motion {
  double u = 0.0, v = 0.0, T = 0.0, slid = 0.0, slip = 0.0, turns = 0.0;
};

/// Runge and Kutta's fourth order at a fixed step. T' = kt (v - p'), |p'| by the inverse of f above slow N.
Motion integrated(const Isolator& s, const Quake& quake, double t_end, double h) {
  using Vector4 = std::array<double, 4>;  // u, v, T, work of friction
  const auto slip_rate = [&](double T) {
    const double over = std::abs(T) - slow * s.N;
    if (over <= 0.0) return 0.0;
    const double x = -velocity * std::log((fast * s.N - std::abs(T)) / ((fast - slow) * s.N));
    return T > 0.0 ? x : -x;
  };
  const auto rate = [&](double t, const Vector4& y) {
    const double p = slip_rate(y[2]);
    return Vector4{y[1], -quake.at(t) - (s.k * y[0] + y[2]) / s.m, s.kt * (y[1] - p), y[2] * p};
  };
  Vector4 y{};
  const long steps = std::lround(t_end / h);
  const auto moved = [](const Vector4& a, const Vector4& b, double x) {
    return Vector4{a[0] + x * b[0], a[1] + x * b[1], a[2] + x * b[2], a[3] + x * b[3]};
  };
  for (long i = 0; i < steps; ++i) {
    // Kinks of the record are ends of steps: the last place of a step is looked at from within.
    const double t = static_cast<double>(i) * h, inside = t + h * (1.0 - 1e-9);
    const Vector4 a = rate(t + h * 1e-9, y), b = rate(t + 0.5 * h, moved(y, a, 0.5 * h)),
                  c = rate(t + 0.5 * h, moved(y, b, 0.5 * h)), d = rate(inside, moved(y, c, h));
    for (std::size_t j = 0; j < 4; ++j) y[j] += h / 6.0 * (a[j] + 2.0 * b[j] + 2.0 * c[j] + d[j]);
  }
  return {y[0], y[1], y[2], y[3]};
}

std::string isolator_scene(const Isolator& s, const Quake& quake, double t_end,
                           const std::string& more = "") {
  return "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\n" +
         fmt::format(
             "t_end = {}\noutput_dt = {}\n[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = "
             "{:.17g}\n[[supports]]\nnode = \"A\"\nfix = [\"uy\"]\n[[springs]]\nnode = \"A\"\ndirection = "
             "[1.0, 0.0]\nstiffness = {:.17g}\n",
             t_end, t_end / 10.0, s.m, s.k) +
         fmt::format(
             "[[contacts]]\nname = \"c\"\nnode = \"A\"\nlaw = \"slider\"\ntangent = [1.0, 0.0]\n"
             "normal_force = {:.17g}\ntangential_stiffness = {:.17g}\n",
             s.N, s.kt) +
         law + more + "[base_motion]\ndirection = [1.0, 0.0]\nacceleration = " + quake.table() + "\n";
}

std::string block(double m, double N, double v, double t_end, const std::string& more = "",
                  const std::string& run = "") {
  return matrix_scene(
      run + fmt::format("t_end = {}\ninitial = {{ u = [0.0], v = [{:.17g}] }}", t_end, v),
      fmt::format("mass = [[{:.17g}]]\nstiffness = [[0.0]]", m),
      fmt::format("law = \"slider\"\ntangent = {{ d0 = 1.0 }}\nnormal_force = {:.17g}\n", N) + law + more);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/rising_friction");

TEST_CASE("a block that rising friction brakes comes to rest as the closed form says, and stays") {
  for (const double v : {0.9, -0.21, 0.03}) {
    CAPTURE(v);
    const double end = time_to_rest(std::abs(v), 40.0, 5.0);
    const Result result = run_text(block(5.0, 40.0, v, 1.3 * end), "ida", "1e-11");
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(result.events.size() == 1);
    CHECK(result.events[0].to == State::stick);
    CHECK(std::abs(result.events[0].t - end) < 1e-9 * end);
    CHECK(result.rows.back().v[0] == 0.0);
    CHECK(result.report.audit.friction_work[0] == doctest::Approx(2.5 * v * v).epsilon(1e-9));
    CHECK(result.report.law_checks.violations.empty());
  }
}

TEST_CASE(
    "an isolator with rising friction beside its spring, shaken, is where a fixed step of 1e-7 s puts it") {
  const Isolator isolator;
  const double t_end = 1.0;
  const Quake quake(t_end, 9.0);
  const Motion expected = integrated(isolator, quake, t_end, 1e-7);
  const Result result = run_text(isolator_scene(isolator, quake, t_end), "ida", "1e-10");
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.events.size() >= 4);
  const Result::Row& last = result.rows.back();
  CHECK(std::abs(expected.v) > 0.01);
  CHECK(std::abs(last.u[0] - expected.u) < 1e-8 * 0.1);
  CHECK(std::abs(last.v[0] - expected.v) < 1e-7 * 0.5);
  CHECK(std::abs(last.contacts[0].T - expected.T) < 1e-6 * 100.0);
  CHECK(last.energy.friction == doctest::Approx(expected.slid).epsilon(1e-7));
  CHECK(result.report.audit.energy.value < 1e-6 * result.report.audit.energy_scale);
  CHECK(result.report.law_checks.violations.empty());
}

TEST_CASE("sensitivities to slow, fast and velocity are those of the closed form") {
  const double v = 0.9, N = 40.0, m = 5.0;
  const Sensitivities s =
      rates_of(block(m, N, v, 1.3 * time_to_rest(v, N, m), "", "engine = \"ida\"\nrtol = 1e-11\n"),
               {"contacts.c.friction.slow", "contacts.c.friction.fast", "contacts.c.friction.velocity"});
  REQUIRE(s.events.size() == 1);
  const double h = 1e-4;
  const auto rate = [&](double of_slow, double of_fast, double of_velocity) {
    const auto at = [&](double x) {
      return time_to_rest(v, N, m, slow + x * of_slow, fast + x * of_fast, velocity + x * of_velocity);
    };
    return (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
  };
  CHECK(s.event_rates[0][0].t == doctest::Approx(rate(1.0, 0.0, 0.0)).epsilon(1e-7));
  CHECK(s.event_rates[0][1].t == doctest::Approx(rate(0.0, 1.0, 0.0)).epsilon(1e-7));
  CHECK(s.event_rates[0][2].t == doctest::Approx(rate(0.0, 0.0, 1.0)).epsilon(1e-7));
}

TEST_CASE("a rigid hit takes the friction of the slip rate just before it") {
  const double vx = 0.3, vy = 0.8;
  const std::string text = matrix_scene(
      fmt::format(
          "t_end = 0.02\noutput_times = [0.02]\ninitial = {{ u = [0.0, 0.008], v = [{:.17g}, {:.17g}] }}", vx,
          -vy),
      "mass = [[2.0, 0.0], [0.0, 2.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
      "law = \"rigid\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nrestitution = 0.5\n" + law);
  const Result result = run_text(text, "ida", "1e-10");
  REQUIRE(result.events.size() == 1);
  const double f = fast - (fast - slow) * std::exp(-vx / velocity);
  CHECK(std::abs(result.events[0].t - 0.01) < 1e-12);
  CHECK(result.rows.back().v[1] == doctest::Approx(0.4).epsilon(1e-12));
  CHECK(result.rows.back().v[0] == doctest::Approx(vx - f * 1.5 * vy).epsilon(1e-12));
  CHECK(result.report.law_checks.violations.empty());
}

TEST_CASE(
    "where the compression falls at once friction drops to the fast limit, where it rises the bearing "
    "sticks") {
  for (const double later : {300.0, 2000.0}) {
    CAPTURE(later);
    // 100 t at 0.05 m/s: its speed hardly changes, so T settles where f N of that speed is: 0.6 s after
    // the jump are eleven times N f'(v) / kt = 0.055 s.
    const std::string text = matrix_scene(
        "t_end = 0.9\noutput_times = [0.3, 0.9]\ninitial = { u = [0.0], v = [0.05] }",
        "mass = [[1e5]]\nstiffness = [[0.0]]",
        fmt::format("law = \"slider\"\ntangent = {{ d0 = 1.0 }}\ntangential_stiffness = 1e4\nnormal_force = "
                    "{{ type = "
                    "\"table\", times = [0.0, 0.3, 0.3, 1.0], values = [1000.0, 1000.0, {0}, {0}] }}\n",
                    later) +
            law);
    const Result result = run_text(text, "ida", "1e-10");
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    const auto limit = [&](double v, double N) {
      return N * (fast - (fast - slow) * std::exp(-v / velocity));
    };
    const Event* jump = nullptr;
    for (const Event& e : result.events)
      if (std::abs(e.t - 0.3) < 1e-12 && e.contact == 0) jump = &e;
    REQUIRE(jump);
    CHECK(jump->T == doctest::Approx(limit(0.05, 1000.0)).epsilon(1e-3));
    if (later < 1000.0) {
      CHECK(jump->T_after == doctest::Approx(fast * later).epsilon(1e-7));
    } else {
      CHECK(jump->T_after == doctest::Approx(jump->T).epsilon(1e-9));
      CHECK(jump->to == State::stick);
    }
    const Result::Row& last = result.rows.back();
    CHECK(last.contacts[0].T == doctest::Approx(limit(last.v[0], later)).epsilon(1e-3));
    CHECK(result.report.audit.energy.value < 1e-6 * result.report.audit.energy_scale);
  }
}

TEST_CASE(
    "the smaller the velocity of the law, the nearer to Coulomb's with fast: no slip that goes on "
    "backwards") {
  const auto scene = [](const std::string& friction) {
    return matrix_scene("t_end = 5.0\noutput_dt = 0.05\ninitial = { u = [0.0], v = [0.0] }",
                        "mass = [[10.0]]\nstiffness = [[50.0]]",
                        "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 100.0\n" + friction,
                        "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 15.0\nhistory = { type = "
                        "\"harmonic\", omega = 3.0 }\n");
  };
  const double coulomb = run_text(scene("friction = 0.1\n"), "exact", "1e-10").rows.back().u[0];
  for (const std::string v : {"1e-5", "1e-6", "1e-7"}) {
    CAPTURE(v);
    const Result result =
        run_text(scene("friction = { slow = 0.04, fast = 0.1, velocity = " + v + " }\n"), "ida", "1e-8");
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    CHECK(std::abs(result.rows.back().u[0] - coulomb) < 1e-4);
    CHECK(result.report.audit.friction.value < 1e-3 * result.report.audit.force_scale);
  }
}

TEST_CASE("a contact that is hit in passing slips from its first touch on, and energy is kept") {
  for (const std::string damping : {"", "tangential_damping = 40.0\n"}) {
    CAPTURE(damping);
    const std::string text = matrix_scene(
        "t_end = 0.4\noutput_dt = 0.01\ninitial = { u = [0.0, 0.01], v = [0.5, -0.3] }",
        "mass = [[3.0, 0.2], [0.2, 3.0]]\nstiffness = [[20.0, 0.0], [0.0, 0.0]]",
        "law = \"compliant\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nnormal_stiffness = 3000.0\n"
        "tangential_stiffness = 2000.0\n" +
            damping + law,
        "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -30.0\n");
    const Result result = run_text(text, "ida", "1e-10");
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    REQUIRE_FALSE(result.events.empty());
    CHECK(result.events[0].to == State::slip_plus);
    CHECK(result.report.audit.energy.value < 1e-6 * result.report.audit.energy_scale);
    CHECK(result.report.audit.friction.value < 1e-6 * result.report.audit.force_scale);
    CHECK(result.report.law_checks.violations.empty());
  }
}

// A pad with a dashpot under its spring is thrown up and down by the ground: N grows from zero within milliseconds, and friction
// is at its greatest, up to 23 times the law's velocity. Loss by an explicit integration of m u'' = P - T, T = kt (u - p),
// with p' from the law inverted (steps 2e-6 and 5e-7 s agree to 1e-6): 6.630 J.
TEST_CASE("friction at its greatest takes the work of the whole slip, however fast a dashpot lets N grow") {
  for (const double turn : {0.0, 0.4}) {
    CAPTURE(turn);
    const auto along = [turn](double x, double y) {
      return fmt::format("[{:.17g}, {:.17g}]", std::cos(turn) * x - std::sin(turn) * y,
                         std::sin(turn) * x + std::cos(turn) * y);
    };
    const double c = std::cos(turn), s = std::sin(turn), uy = -0.002, vx = 2.0;
    const std::string text =
        "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\ngravity = " +
        along(0.0, -9.81) + "\n[run]\nt_end = 2.0\noutput_dt = 0.02\n" +
        fmt::format("initial = {{ A = {{ ux = {:.17g}, uy = {:.17g}, vx = {:.17g}, vy = {:.17g} }} }}\n",
                    -s * uy, c * uy, c * vx, s * vx) +
        "[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = 2.0\n[[springs]]\nnode = \"A\"\ndirection "
        "= " +
        along(1.0, 0.0) +
        "\nstiffness = 30.0\n[[contacts]]\nname = \"p\"\nnode = \"A\"\nlaw = \"compliant\"\nnormal = " +
        along(0.0, 1.0) +
        "\nnormal_stiffness = 1900.0\nnormal_damping = 34.3\ntangential_stiffness = 32.7\n"
        "friction = { slow = 0.04, fast = 0.0942, velocity = 0.261 }\n[[base_motion]]\ndirection = " +
        along(0.0, 1.0) +
        "\nacceleration = { type = \"harmonic\", amplitude = 12.5, omega = 48.4 "
        "}\n[[base_motion]]\ndirection = " +
        along(1.0, 0.0) + "\nacceleration = { type = \"harmonic\", amplitude = 6.0, omega = 4.0 }\n";
    const Result result = run_text(text, "ida", "1e-9");
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    CHECK(result.report.audit.final.friction == doctest::Approx(6.630).epsilon(2e-4));
    CHECK(result.report.audit.energy.value < 1e-5 * result.report.audit.energy_scale);
  }
}

// A weight on soft springs hangs metres from where these are at rest, so that the stiff spring of its bearing is a difference
// of displacements ten thousand times as large. Without its weight it moves the same way about zero.
TEST_CASE("a bearing far from where the structure began slips as it does at home") {
  const char* const scene = R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
run = { t_end = 0.3, initial = "static", engine = "ida" }
damping = { alpha = 0.2, beta = 1e-4 }
nodes = { m0 = [0.0, 0.0], m1 = [1.7, 0.3] }
masses = [{ node = "m1", mass = 1.1804287735436891 }]
springs = [
  { node = "m0", direction = [-0.9290991939535066, -0.36983062041283765], stiffness = 100.0, damping = 0.4 },
  { node = "m1", direction = [0.34984280870291945, 0.9368084164859176], stiffness = 5.0 },
  { node = "m1", against = "m0", direction = [1.7, 0.3], stiffness = 1000.0 },
  { node = "m1", against = "m0", direction = [0.40137209104191385, -0.9159150858745813], stiffness = 200.0 },
]
[[contacts]]
name = "k0"
node = "m1"
law = "slider"
normal = [0.0017812573947953696, 0.9999984135597884]
friction = { slow = 0.05, fast = 0.2, velocity = 0.01 }
normal_force = 13.915133470993059
tangential_stiffness = 100000.0
[[loads]]
node = "m0"
direction = [0.20040733943032074, 0.9797126610912305]
amplitude = 20.0
history = { type = "polynomial", coefficients = [0.7083, 0.0625, 18.0764], start = 0.0867, end = 0.1991 }
)";
  const auto run = [&](const char* rtol, const char* gravity) {
    const Scene read = parse_scene(scene, "test.toml", {{"run.rtol", rtol}, {"gravity", gravity}});
    return simulate(build_model(read), read.run);
  };
  const Result home = run("1e-11", "[0.0, 0.0]");
  REQUIRE(home.report.outcome.kind == Outcome::Kind::done);
  REQUIRE(home.events.size() >= 7);
  for (const char* rtol :
       {"5e-8", "2e-8", "1e-8", "8e-9", "5e-9", "3e-9", "2e-9", "1e-9", "1e-10", "1e-11"}) {
    CAPTURE(rtol);
    const Result far = run(rtol, "[0.0, -9.81]");
    INFO(far.report.outcome.reason);
    REQUIRE(far.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(far.events.size() == home.events.size());
    for (std::size_t i = 0; i < home.events.size(); ++i) {
      CHECK(far.events[i].to == home.events[i].to);
      CHECK(std::abs(far.events[i].t - home.events[i].t) < 1e-6);
    }
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::rising
