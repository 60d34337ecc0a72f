// Two rigid feet of one body that stick on one motion: it is unique, and of the forces the least within their limits.
//
//   T_L = T_R = F/2 while both are within f |N|;   else T = f |N| at the foot that bears less, the rest at the other
//
// A block of the half width b, its centre at the height h: N_L, N_R = -m g/2 +- m a h/(2 b).
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "behaviour/engines.hpp"
#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::shared_friction {
namespace {

constexpr double m = 2.0, b = 0.8, h = 1.0, g = 10.0, f = 0.5;

std::string block(const std::string& run, const std::string& more) {
  return parts::head +
         fmt::format("gravity = [0.0, {}]\n{}[nodes]\nL = [{}, 0.0]\nR = [{}, 0.0]\n", -g, run, -b, b) +
         fmt::format(
             "[[rigid]]\nname = \"block\"\ncentre = [0.0, {}]\nnodes = [\"L\", \"R\"]\nmass = {}\ninertia = "
             "0.7\n",
             h, m) +
         fmt::format(
             "[[contacts]]\nname = \"foot\"\nnodes = [\"L\", \"R\"]\nlaw = \"rigid\"\nnormal = [0.0, "
             "1.0]\nfriction = {}\n",
             f) +
         more;
}

Result run_scene(const std::string& text, const std::string& engine) {
  const Scene scene = parse_scene(text, "test.toml", {{"run.engine", engine}, {"run.certify", "false"}});
  Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.reason == "");
  CHECK(result.report.law_checks.violations.empty());
  CHECK(result.report.audit.friction.value <= 1e-9 * result.report.audit.force_scale);
  return result;
}

/// Of the ground: A sin(w t) for half a period.
struct Pulse {
  double A = 8.0, w = 9.0;
  [[nodiscard]] double end() const { return std::numbers::pi / w; }
  [[nodiscard]] double at(double t) const { return t < end() ? A * std::sin(w * t) : 0.0; }
  [[nodiscard]] double integral(double t) const { return A / w * (1.0 - std::cos(w * std::min(t, end()))); }
};

template <class Function>
double root(double from, double to, const Function& function) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (from + to);
    ((function(middle) > 0.0) == (function(from) > 0.0) ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/shared_friction");

TEST_CASE("a constant push at two feet: halves, or what the lighter foot can bear and the rest") {
  for (const std::string& engine : engines)
    for (const double push : {3.0, 7.0, -7.0, 9.5}) {
      CAPTURE(engine);
      CAPTURE(push);
      // At the height h: about the feet push h is borne by N.
      const Result result = run_scene(
          block("[run]\nt_end = 1.0\noutput_dt = 0.25\n",
                fmt::format("[[loads]]\nnode = \"block\"\ndirection = [1.0, 0.0]\namplitude = {}\n", push)),
          engine);
      const double lighter = 0.5 * (m * g - std::abs(push) * h / b), half = 0.5 * std::abs(push);
      const double least = std::min(half, f * lighter), rest = std::abs(push) - least;
      const std::size_t light = push > 0.0 ? 0 : 1;
      for (const Result::Row& row : result.rows) {
        CHECK(-row.contacts[light].N == doctest::Approx(lighter).epsilon(1e-12));
        CHECK(std::abs(row.contacts[light].T) == doctest::Approx(least).epsilon(1e-12));
        CHECK(std::abs(row.contacts[1 - light].T) == doctest::Approx(rest).epsilon(1e-12));
        CHECK(row.u.norm() < 1e-12);
      }
      CHECK(std::any_of(
          result.report.warnings.begin(), result.report.warnings.end(),
          [](const std::string& w) { return w.find("prevent the same motion") != std::string::npos; }));
    }
}

TEST_CASE("a block slides under a half sine of its ground as an event follower says") {
  const Pulse pulse;
  // Sticks up to a = f g, whatever the feet bear; slides by v' = f g - a; rests where v is zero again.
  const double start = std::asin(f * g / pulse.A) / pulse.w;
  const auto v = [&](double t) { return f * g * (t - start) - (pulse.integral(t) - pulse.integral(start)); };
  const double crest = std::numbers::pi / pulse.w - start;
  const double end = root(crest, 5.0, v);
  double slid = 0.0;  // Gauss's rule of two points on small pieces
  for (int i = 0; i < 20000; ++i) {
    const double d = (end - start) / 20000, middle = start + (i + 0.5) * d, off = 0.5 * d / std::sqrt(3.0);
    slid += 0.5 * d * (v(middle - off) + v(middle + off));
  }
  const std::string text = block(
      "[run]\nt_end = 1.0\n",
      fmt::format(
          "[[base_motion]]\ndirection = [1.0, 0.0]\nacceleration = {{ type = \"half_sine\", start = 0.0, "
          "duration = {:.17g}, amplitude = {:.17g} }}\n",
          pulse.end(), pulse.A));
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result result = run_scene(text, engine);
    const double bound = engine == "exact" ? 1e-10 : 1e-6;
    // The foot that bears less is at its limit before, when a/2 = f (g - a h/b)/2; then the other one slips.
    const double alone = std::asin(f * g / (1.0 + f * h / b) / pulse.A) / pulse.w;
    double first = -1.0, both = -1.0, rests = -1.0;
    for (const Event& event : result.events) {
      if (first < 0.0 && slip_sign(event.to) != 0) first = event.t;
      if (slip_sign(event.to) != 0) both = event.t;
      if (rests < 0.0 && both > 0.0 && event.t > both && event.to == State::stick) rests = event.t;
    }
    CHECK(first == doctest::Approx(alone).epsilon(bound));
    CHECK(both == doctest::Approx(start).epsilon(bound));
    CHECK(rests == doctest::Approx(end).epsilon(bound));
    CHECK(result.rows.back().u[0] == doctest::Approx(slid).epsilon(1e-7));
  }
}

// Both feet are closed to a rounding of displacements that are themselves rounding.
TEST_CASE("a static start, and a run that goes on, stand on both feet") {
  const std::string push = fmt::format(
      "[[loads]]\nnode = \"block\"\ndirection = [1.0, 0.0]\namplitude = 6.0\n"
      "history = {{ type = \"half_sine\", start = {}, duration = 1.0 }}\n",
      0.25);
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result result = run_scene(block("[run]\nt_end = 2.0\ninitial = \"static\"\n", push), engine);
    CHECK(std::none_of(result.events.begin(), result.events.end(),
                       [](const Event& event) { return event.type == EventType::impact; }));
    CHECK(result.rows.front().contacts[1].N == doctest::Approx(-0.5 * m * g).epsilon(1e-12));

    Scene second = parse_scene(block("[run]\nt_end = 1.0\n", push), "test.toml",
                               {{"run.engine", engine}, {"run.certify", "false"}});
    second.loads[0].history.shift = -0.75;
    const Scene first = parse_scene(block("[run]\nt_end = 0.75\n", push), "test.toml",
                                    {{"run.engine", engine}, {"run.certify", "false"}});
    const Model model = build_model(first);
    second.initial.saved = last_state(model, simulate(model, first.run));
    const Result later = simulate(build_model(second), second.run);
    CHECK(later.report.outcome.reason == "");
    // 6 at its crest: the foot that bears less has 6.25, and f times that is above a half of 6.
    for (const ContactSample& contact : later.rows.front().contacts)
      CHECK(contact.T == doctest::Approx(3.0).epsilon(1e-9));
  }
}

TEST_CASE("a block that rocks comes to rest on both feet") {
  const std::string text =
      block("[run]\nt_end = 4.0\ninitial = { block = { vx = -0.3, vy = 0.24, wz = 0.3 } }\n", "");
  std::string sticky = text;
  sticky.replace(sticky.find("friction = 0.5"), 14, "friction = 1.0");
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result result = run_scene(sticky, engine);
    for (const ContactSample& contact : result.rows.back().contacts) {
      CHECK(contact.state == State::stick);
      CHECK(contact.N == doctest::Approx(-0.5 * m * g).epsilon(1e-12));
      CHECK(std::abs(contact.T) < 1e-9);
    }
  }
}

// With the moment m g h of its weight the slip rate of a foot at its limit is zero to rounding only.
TEST_CASE("a block by matrices rocks, rests, is pushed, rocks and rests, with every engine alike") {
  const double mass = 2880.0, half = 0.3, weight = mass * g, inertia = 1046.4;
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "10.0\n"
      "dt = 4e-3\ninitial = { u = [0.0, 0.0, 0.0], v = [-0.2, 0.06, 0.2] }\n";
  text += fmt::format(
      "[matrices]\ndofs = [\"x\", \"y\", \"r\"]\nmass = [[{0}, 0.0, 0.0], [0.0, {0}, 0.0], [0.0, 0.0, {1}]]\n"
      "stiffness = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, {2}]]\n[[loads]]\ndirection = {{ y = {2} "
      "}}\n"
      "amplitude = 1.0\n[[loads]]\ndirection = {{ x = {2} }}\namplitude = 0.45\n"
      "history = {{ type = \"half_sine\", start = 3.0, duration = 0.6 }}\n",
      mass, inertia, -weight);
  for (const double side : {-half, half})
    text += fmt::format(
        "[[contacts]]\nname = \"{}\"\nlaw = \"rigid\"\nnormal = {{ y = 1.0, r = {} }}\ntangent = {{ x = 1.0, "
        "r = 1.0 "
        "}}\nfriction = 0.8\n",
        side < 0.0 ? "L" : "R", side);
  // Pushed to the left it lifts R when 0.45 m g sin(w t) h = m g b; before that, R is at its limit.
  const double w = std::numbers::pi / 0.6;
  const double limit = 3.0 + std::asin(0.8 / (1.0 + 0.8 / half) / 0.45) / w,
               lifts = 3.0 + std::asin(half / 0.45) / w;
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Result result = run_scene(text, engine);
    const auto after = std::find_if(result.events.begin(), result.events.end(),
                                    [](const Event& event) { return event.t > 3.0; });
    REQUIRE(result.events.end() - after > 10);
    const double bound = engine == "exact" ? 1e-11 : 1e-5;
    CHECK(after->t == doctest::Approx(limit).epsilon(bound));
    CHECK(after->to == State::slip_minus);
    CHECK((after + 1)->t == doctest::Approx(lifts).epsilon(bound));
    CHECK((after + 1)->to == State::open);
    for (const ContactSample& contact : result.rows.back().contacts) {
      CHECK(contact.state == State::stick);
      CHECK(contact.N == doctest::Approx(-0.5 * weight).epsilon(1e-9));
    }
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::shared_friction
