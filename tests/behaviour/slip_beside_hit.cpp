// What slips beside a hit goes on slipping: a hit ends a slip only where it lets |N| jump up, through a dashpot along
// the normal, or turns its rate.
//
//   B_i slides on a compliant foot; a chain of springs leads from A, which hits a wall, to B_1, B_2, ...
//
// Held against an integrator of its own: Runge and Kutta's method of order four, events by bisection of a step.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "signorini/simulate.hpp"

namespace signorini::tests::slip_beside_hit {
namespace {

struct Setup {
  int bodies = 1;
  double spring = 1.0, restitution = 0.5, gap = 0.1, hitter_speed = 1.0, speed = 0.5;
  double stiffness = 1e4, dashpot = 10.0, fs = 0.5, fk = 0.3, weight = 10.0;
  double second_wall =
      0.0;  // distance from B_1, along a normal that is inclined by `inclined`; 0: there is none
  double inclined = 0.0;
};

enum class Foot : unsigned char { stick, slip };

/// Of all that moves: A first. The y axis of A has no force.
struct Chain {
  struct Body {
    double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0, p = 0.0;
    Foot foot = Foot::stick;
    int sign = 0;
  };
  Setup s;
  std::vector<Body> all;
  std::vector<double> times;  // of sticks, slips and hits

  explicit Chain(const Setup& setup) : s(setup), all(static_cast<std::size_t>(setup.bodies) + 1) {
    all[0].vx = s.hitter_speed;
    for (std::size_t i = 1; i < all.size(); ++i) {
      all[i].vx = s.speed;
      all[i].y = -s.weight / s.stiffness;
    }
  }
  [[nodiscard]] double N(const Body& b) const { return s.stiffness * b.y + s.dashpot * b.vy; }
  [[nodiscard]] double T(const Body& b) const {
    return b.foot == Foot::stick ? s.stiffness * (b.x - b.p) : -b.sign * s.fk * N(b);
  }
  /// s p'
  [[nodiscard]] double rate(const Body& b) const {
    const double ay = -N(b) - s.weight;
    return b.sign * b.vx + s.fk * (s.stiffness * b.vy + s.dashpot * ay) / s.stiffness;
  }
  using Rates = std::vector<std::array<double, 4>>;
  [[nodiscard]] Rates rates(const std::vector<Body>& now) const {
    Rates result(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
      double fx = 0.0, fy = 0.0;
      if (i > 0) fx -= s.spring * (now[i].x - now[i - 1].x);
      if (i + 1 < now.size()) fx += s.spring * (now[i + 1].x - now[i].x);
      if (i > 0) fx -= T(now[i]);
      if (i > 0) fy = -N(now[i]) - s.weight;
      result[i] = {now[i].vx, now[i].vy, fx, fy};
    }
    return result;
  }
  [[nodiscard]] static std::vector<Body> moved(std::vector<Body> b, const Rates& r, double h) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      b[i].x += h * r[i][0];
      b[i].y += h * r[i][1];
      b[i].vx += h * r[i][2];
      b[i].vy += h * r[i][3];
    }
    return b;
  }
  [[nodiscard]] std::vector<Body> after(double h) const {
    const Rates a = rates(all), b = rates(moved(all, a, h / 2)), c = rates(moved(all, b, h / 2)),
                d = rates(moved(all, c, h));
    Rates mean(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k) mean[i][k] = (a[i][k] + 2 * b[i][k] + 2 * c[i][k] + d[i][k]) / 6;
    return moved(all, mean, h);
  }
  /// Guards: the wall of A, that of B_1, then one a foot. Positive while nothing happens.
  [[nodiscard]] std::vector<double> guards(const std::vector<Body>& b) const {
    std::vector<double> g{s.gap - b[0].x, 1.0};
    if (s.second_wall > 0.0)
      g[1] = s.second_wall - std::cos(s.inclined) * b[1].x - std::sin(s.inclined) * (b[1].y - y0());
    for (std::size_t i = 1; i < b.size(); ++i)
      g.push_back(b[i].foot == Foot::stick ? s.fs * std::abs(N(b[i])) - std::abs(T(b[i])) : rate(b[i]));
    return g;
  }
  [[nodiscard]] double y0() const { return -s.weight / s.stiffness; }

  void press_harder(Body& b, double N_before, double T_before) const {
    if (b.foot == Foot::slip && N(b) < N_before - 1e-12) {
      b.foot = Foot::stick;
      b.p = b.x - T_before / s.stiffness;
    }
  }
  void happen(std::size_t which) {
    if (which == 0) {
      all[0].vx *= -s.restitution;
    } else if (which == 1) {
      Body& b = all[1];
      const double N_before = N(b), T_before = T(b), nx = std::cos(s.inclined), ny = std::sin(s.inclined);
      const double vn = nx * b.vx + ny * b.vy;
      b.vx -= (1.0 + s.restitution) * vn * nx;
      b.vy -= (1.0 + s.restitution) * vn * ny;
      press_harder(b, N_before, T_before);
      settle(b);
    } else {
      Body& b = all[which - 1];
      if (b.foot == Foot::stick) {
        slip(b);
      } else {
        b.p = b.x - T(b) / s.stiffness;
        b.foot = Foot::stick;
      }
    }
  }
  void slip(Body& b) const {
    b.sign = T(b) > 0.0 ? 1 : -1;
    b.foot = Foot::slip;
  }
  /// Just after a hit.
  void settle(Body& b) const {
    if (b.foot == Foot::slip && rate(b) < 0.0) {
      b.p = b.x - T(b) / s.stiffness;
      b.foot = Foot::stick;
    }
    if (b.foot == Foot::stick && std::abs(T(b)) > s.fs * std::abs(N(b))) slip(b);
  }
  void run(double t_end, double h) {
    for (double t = 0.0; t < t_end;) {
      const double step = std::min(h, t_end - t);
      const std::vector<double> g = guards(after(step));
      double soonest = step;
      std::size_t which = g.size();
      for (std::size_t i = 0; i < g.size(); ++i) {
        if (g[i] >= 0.0) continue;
        double lo = 0.0, hi = step;
        for (int k = 0; k < 60; ++k) (guards(after(0.5 * (lo + hi)))[i] < 0.0 ? hi : lo) = 0.5 * (lo + hi);
        if (hi <= soonest) {
          soonest = hi;
          which = i;
        }
      }
      all = after(soonest);
      t += soonest;
      if (which == g.size()) continue;
      happen(which);
      times.push_back(t);
    }
  }
};

/// The same as a scene, turned by an angle, its x axis mirrored.
std::string scene_of(const Setup& s, double t_end, double angle, bool mirrored) {
  const double c = std::cos(angle), q = std::sin(angle), m = mirrored ? -1.0 : 1.0;
  const auto vector = [&](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", c * m * x - q * y, q * m * x + c * y);
  };
  const auto values = [&](const char* kind, double x, double y) {
    return fmt::format("{0}x = {1:.17g}, {0}y = {2:.17g}", kind, c * m * x - q * y, q * m * x + c * y);
  };
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\n";
  text += fmt::format("t_end = {}\ninitial = {{ n0 = {{ {} }}", t_end, values("v", s.hitter_speed, 0.0));
  for (int i = 1; i <= s.bodies; ++i)
    text += fmt::format(", n{} = {{ {}, {} }}", i, values("u", 0.0, -s.weight / s.stiffness),
                        values("v", s.speed, 0.0));
  text += " }\n[nodes]\n";
  for (int i = 0; i <= s.bodies; ++i) text += fmt::format("n{} = {}\n", i, vector(i, 0.0));
  for (int i = 0; i <= s.bodies; ++i) text += fmt::format("[[masses]]\nnode = \"n{}\"\nmass = 1.0\n", i);
  for (int i = 1; i <= s.bodies; ++i) {
    text +=
        fmt::format("[[springs]]\nnode = \"n{}\"\nagainst = \"n{}\"\ndirection = {}\nstiffness = {:.17g}\n",
                    i, i - 1, vector(1.0, 0.0), s.spring);
    text += fmt::format("[[loads]]\nnode = \"n{}\"\ndirection = {}\namplitude = {:.17g}\n", i,
                        vector(0.0, -1.0), s.weight);
    text += fmt::format(
        "[[contacts]]\nname = \"foot{0}\"\nnode = \"n{0}\"\nlaw = \"compliant\"\nnormal = "
        "{1}\nnormal_stiffness = "
        "{2:.17g}\ntangential_stiffness = {2:.17g}\nnormal_damping = {3:.17g}\nfriction = {{ static = "
        "{4:.17g}, "
        "kinetic = {5:.17g} }}\n",
        i, vector(0.0, 1.0), s.stiffness, s.dashpot, s.fs, s.fk);
  }
  const auto wall = [&](const char* name, const char* node, double x, double y, double gap) {
    text += fmt::format(
        "[[contacts]]\nname = \"{}\"\nnode = \"{}\"\nlaw = \"rigid\"\nnormal = {}\ngap = "
        "{:.17g}\nrestitution = "
        "{:.17g}\n",
        name, node, vector(-x, -y), gap, s.restitution);
  };
  wall("wall", "n0", 1.0, 0.0, s.gap);
  if (s.second_wall > 0.0)  // gaps are those of the undeformed structure
    wall("slope", "n1", std::cos(s.inclined), std::sin(s.inclined),
         s.second_wall + std::sin(s.inclined) * s.weight / s.stiffness * -1.0);
  return text;
}

/// dt: that of newmark; 0 leaves it out.
std::vector<double> times_of(const std::string& text, const std::string& engine, double dt) {
  std::vector<Override> how{{"run.engine", engine}, {"run.rtol", "1e-10"}, {"run.certify", "false"}};
  if (dt > 0.0) how.push_back({"run.dt", fmt::format("{}", dt)});
  const Scene scene = parse_scene(text, "test.toml", how);
  const Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.reason == "");
  std::vector<double> times;
  for (const Event& event : result.events)
    if (event.contact >= 0) times.push_back(event.t);
  return times;
}

/// Like bodies begin to slip within nanoseconds: events closer than a tenth of a microsecond are one.
std::vector<double> instants_of(const std::vector<double>& times) {
  std::vector<double> result;
  for (const double t : times)
    if (result.empty() || t > result.back() + 1e-7) result.push_back(t);
  return result;
}

void check_times(const std::vector<double>& all, const std::vector<double>& all_expected, double off) {
  const std::vector<double> times = instants_of(all), expected = instants_of(all_expected);
  REQUIRE(times.size() == expected.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(times[i] - expected[i]) < off);
  }
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/slip_beside_hit");

TEST_CASE("a neighbour's hit does not stop what slips on a dashpot") {
  const double t_end = 0.2;
  Chain chain{Setup{}};
  chain.run(t_end, 1e-4);
  REQUIRE(chain.times.size() == 3);  // it slips, the hit, it comes to rest
  CHECK(chain.times.back() == doctest::Approx(0.168817621).epsilon(1e-8));
  for (const double angle : {0.0, 0.4, 2.0})
    for (const bool mirrored : {false, true}) {
      CAPTURE(angle);
      CAPTURE(mirrored);
      const std::string text = scene_of({}, t_end, angle, mirrored);
      check_times(times_of(text, "exact", 0.0), chain.times, 1e-9);
      check_times(times_of(text, "ida", 0.0), chain.times, 1e-7);
      check_times(times_of(text, "newmark", 1e-4), chain.times, 1e-5);
    }
  const std::string modal = scene_of({}, t_end, 0.4, false) + "";
  const Scene scene = parse_scene(modal, "test.toml", {{"run.engine", "exact"}, {"run.flow", "modal"}});
  const Result result = simulate(build_model(scene), scene.run);
  REQUIRE(!result.events.empty());
  CHECK(std::abs(result.events.back().t - chain.times.back()) < 1e-9);
}

TEST_CASE("chains of slipping neighbours, dashpots from 1e-6 to 10: beside an integrator of its own") {
  std::mt19937 random(3);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  for (int variant = 0; variant < 24; ++variant) {
    CAPTURE(variant);
    Setup s;
    s.bodies = 1 + variant % 3;
    s.spring = uniform(0.5, 20.0);
    s.restitution = uniform(0.2, 0.9);
    s.gap = uniform(0.02, 0.15);
    s.dashpot = std::pow(10.0, uniform(-6.0, 1.0));
    s.fk = uniform(0.1, 0.4);
    s.fs = s.fk + uniform(0.01, 0.3);
    const double t_end = 0.25;
    Chain chain{s};
    chain.run(t_end, 1e-4);
    const std::string text = scene_of(s, t_end, uniform(0.0, 3.0), variant % 2 == 1);
    check_times(times_of(text, "exact", 0.0), chain.times, 1e-8);
  }
}

TEST_CASE("its own hit stops what it presses harder, and only that") {
  for (const double inclined : {0.35, -0.35}) {
    CAPTURE(inclined);
    Setup s;
    s.gap = 1.0;  // A flies free
    s.second_wall = 0.05;
    s.inclined = inclined;
    s.dashpot = 20.0;
    s.restitution = 0.1;
    const double t_end = 0.11;
    Chain chain{s};
    chain.run(t_end, 2e-5);
    for (const double angle : {0.0, 0.4})
      check_times(times_of(scene_of(s, t_end, angle, false), "exact", 0.0), chain.times, 1e-7);
  }
}

TEST_CASE("a load that jumps elsewhere does not stop what slips without mass") {
  // A pulls B, which has no mass, along its slider by a spring; D is free. B begins to slip once k x = fs q, where x is
  // how far A is ahead, and slips with T = fk q from there on.
  const auto events = [](const std::string& more, const std::string& engine) {
    const std::string text =
        "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
        "0.6\ninitial = { A = { vx = 1.0 } }\n[nodes]\nA = [0.0, 0.0]\nB = [1.0, 0.0]\nD = [9.0, 0.0]\n"
        "[[masses]]\nnode = \"A\"\nmass = 1.0\n[[masses]]\nnode = \"D\"\nmass = 1.0\n[[supports]]\nnodes = "
        "[\"A\", \"B\", \"D\"]\nfix = [\"uy\"]\n[[springs]]\nnode = \"B\"\nagainst = \"A\"\ndirection = "
        "[1.0, "
        "0.0]\nstiffness = 10.0\n[[contacts]]\nname = \"foot\"\nnode = \"B\"\nlaw = \"slider\"\ntangent = "
        "[1.0, "
        "0.0]\nnormal_force = 1.0\ntangential_stiffness = 100.0\nfriction = { static = 0.5, kinetic = 0.3 "
        "}\n" +
        more;
    std::vector<double> times;
    for (const Event& event : simulate(parse_scene(text, "test.toml", {{"run.engine", engine}})).events)
      if (event.contact >= 0 && event.type != EventType::time) times.push_back(event.t);
    return times;
  };
  const double k = 10.0 * 100.0 / 110.0, w = std::sqrt(k);  // both springs, until it slips
  for (const char* engine : {"exact", "ida"})
    for (const char* history :
         {"type = \"step\", start = 0.3", "type = \"table\", times = [0.0, 0.3, 0.6], values = [0, 1, 0]"}) {
      CAPTURE(engine);
      CAPTURE(history);
      const std::vector<double> times = events(
          std::string("[[loads]]\nnode = \"D\"\ndirection = [1.0, 0.0]\namplitude = 1.0\nhistory = { ") +
              history + " }\n",
          engine);
      REQUIRE(times.size() == 1);
      CHECK(times[0] == doctest::Approx(std::asin(0.5 / k * w) / w).epsilon(1e-7));
    }
}

TEST_SUITE_END();

}  // namespace signorini::tests::slip_beside_hit
