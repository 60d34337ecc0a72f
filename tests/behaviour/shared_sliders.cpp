// Sliders without a spring that stick on one motion: it is unique, and of the forces the least within their limits.
//
//   two on one body:      T_L = T_R = F/2 while both are within f N;   else T = f N at the lighter one, the rest at the other
//   d0, d1, d0 + d1:      T_0 + T_2 = F_0, T_1 + T_2 = F_1, least sum of squares:  T_2 = (F_0 + F_1)/3
//
// As one motion the two are one slider with the sum of their limits.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "behaviour/engines.hpp"
#include "behaviour/one_mass.hpp"
#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"
#include "study/check/check.hpp"

namespace signorini::tests::shared_sliders {
namespace {

constexpr double m = 10.0, k = 50.0, A = 15.0, w = 3.0, f = 0.1, left = 60.0, right = 40.0;
constexpr double pi = 3.14159265358979323846;

/// A body between its nodes L and R, turned by an angle; `loads` of the left slider and of the right one, if any.
std::string body(double turn, const std::string& contacts) {
  const double c = std::cos(turn), s = std::sin(turn);
  const auto vector = [&](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
  };
  std::string text = parts::head +
                     "[run]\nt_end = 5.0\noutput_dt = 0.125\n[nodes]\nL = " + vector(-0.3, 0.1) +
                     "\nR = " + vector(0.3, 0.1) + "\n[[rigid]]\nname = \"B\"\ncentre = " + vector(0.0, 0.0) +
                     fmt::format("\nnodes = [\"L\", \"R\"]\nmass = {}\ninertia = 1.0\n", m);
  // Nothing lifts it and nothing turns it: springs that are far stiffer than all that is asked of them.
  for (const char* node : {"L", "R"})
    text +=
        fmt::format("[[springs]]\nnode = \"{}\"\ndirection = {}\nstiffness = 1e4\n", node, vector(0.0, 1.0));
  text += fmt::format("[[springs]]\nnode = \"B\"\ndirection = {}\nstiffness = {}\n", vector(1.0, 0.0), k);
  text += fmt::format(
      "[[loads]]\nnode = \"B\"\ndirection = {}\namplitude = {}\nhistory = {{ type = \"harmonic\", omega = {} "
      "}}\n",
      vector(1.0, 0.0), A, w);
  std::string placed = contacts;
  for (std::size_t at; (at = placed.find("ALONG")) != std::string::npos;)
    placed.replace(at, 5, vector(1.0, 0.0));
  return text + placed;
}

std::string slider(const std::string& name, double N, const std::string& node, const std::string& more = "") {
  return fmt::format(
      "[[contacts]]\nname = \"{}\"\nnode = \"{}\"\nlaw = \"slider\"\ntangent = ALONG\nnormal_force = {}\n"
      "friction = {}\n{}",
      name, node, N, f, more);
}

Result run_scene(const std::string& text, const std::string& engine, const std::string& rtol = "1e-10") {
  const Scene scene =
      parse_scene(text, "test.toml",
                  {{"run.engine", engine}, {"run.certify", "false"}, {"run.rtol", rtol}, {"run.dt", "1e-3"}});
  Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.reason == "");
  CHECK(result.report.law_checks.violations.empty());
  CHECK(result.report.audit.friction.value <= 1e-9 * result.report.audit.force_scale);
  return result;
}

double along(const Result::Row& row, double turn) {
  return std::cos(turn) * row.u[0] + std::sin(turn) * row.u[1];
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/shared_sliders");

TEST_CASE(
    "two sliders of one body are one with the sum of their limits, and share the force by the least norm") {
  // Both at the centre's height: the body does not turn, whatever it slides.
  for (const double turn : {0.0, 0.7}) {
    const auto at_centre = [&](std::string text) {
      for (std::size_t at; (at = text.find("node = \"L\"\nlaw")) != std::string::npos;)
        text.replace(at, 10, "node = \"B\"");
      for (std::size_t at; (at = text.find("node = \"R\"\nlaw")) != std::string::npos;)
        text.replace(at, 10, "node = \"B\"");
      return text;
    };
    const std::string two = body(turn, slider("L", left, "L") + slider("R", right, "R"));
    const std::string one = body(turn, slider("all", left + right, "B"));
    for (const std::string& engine : engines) {
      CAPTURE(engine);
      CAPTURE(turn);
      const double bound = engine == "exact" ? 1e-11 : 1e-7;
      const Result both = run_scene(at_centre(two), engine), alone = run_scene(one, engine);
      // The lighter one is at its limit when half of the load is, then the body slips at the sum.
      REQUIRE(both.events.size() > 4);
      CHECK(both.events[0].t == doctest::Approx(std::asin(2.0 * f * right / A) / w).epsilon(bound));
      CHECK(both.events[0].contact == 1);
      CHECK(both.events[0].to == State::slip_plus);
      CHECK(both.events[1].t == doctest::Approx(std::asin(f * (left + right) / A) / w).epsilon(bound));
      CHECK(both.events[1].contact == 0);
      REQUIRE(both.rows.size() == alone.rows.size());
      for (std::size_t i = 0; i < both.rows.size(); ++i) {
        const auto &two_of = both.rows[i].contacts, &one_of = alone.rows[i].contacts;
        CHECK(std::abs(along(both.rows[i], turn) - along(alone.rows[i], turn)) < bound);
        CHECK(std::abs(two_of[0].T + two_of[1].T - one_of[0].T) < 1e4 * bound);
        CHECK(std::abs(two_of[0].T) <= f * left * (1.0 + 1e-9));
        CHECK(std::abs(two_of[1].T) <= f * right * (1.0 + 1e-9));
      }
      CHECK(std::any_of(both.report.warnings.begin(), both.report.warnings.end(),
                        [](const std::string& warning) {
                          return warning.find("prevent the same motion") != std::string::npos;
                        }));
      CHECK(both.rows.back().energy.friction ==
            doctest::Approx(alone.rows.back().energy.friction).epsilon(100.0 * bound));
      const Result::Row& first = both.rows[1];  // 15 sin 0.375 = 5.49: halves
      CHECK(first.contacts[0].T == doctest::Approx(0.5 * A * std::sin(w * 0.125)).epsilon(1e-9));
      CHECK(first.contacts[1].T == doctest::Approx(0.5 * A * std::sin(w * 0.125)).epsilon(1e-9));
    }
  }
}

TEST_CASE("two sliders beside the centre: which of them slips first, and where the body comes to rest") {
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result result = run_scene(body(0.3, slider("L", left, "L") + slider("R", right, "R")), engine);
    CHECK(result.events.size() > 8);
    const Result one = run_scene(body(0.3, slider("L", left + right, "L")), engine);
    for (std::size_t i = 0; i < one.rows.size(); ++i)  // both act on the line through L and R
      CHECK((result.rows[i].u - one.rows[i].u).norm() < (engine == "exact" ? 1e-10 : 1e-6));
  }
}

TEST_CASE(
    "newmark's steps with two sliders are those with one; what decides each contact alone refuses them by "
    "name") {
  const std::string two = body(0.0, slider("L", left, "B") + slider("R", right, "B"));
  const Result both = run_scene(two, "newmark");
  const Result one = run_scene(body(0.0, slider("L", left + right, "B")), "newmark");
  REQUIRE(both.rows.size() == one.rows.size());
  for (std::size_t i = 0; i < one.rows.size(); ++i)
    CHECK(std::abs(both.rows[i].u[0] - one.rows[i].u[0]) < 1e-5);
  CHECK_THROWS_WITH_AS(static_cast<void>(run_scene(two, "friction-iteration")),
                       doctest::Contains("solves each contact alone, but contacts 'L' and 'R'"), SceneError);
}

TEST_CASE("three sliders on two motions share what they hold by the least norm") {
  const auto scene = [](double x, double y) {
    std::string text =
        matrix_scene("t_end = 1.0\noutput_dt = 0.5\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
                     "mass = [[2.0, 0.3], [0.3, 1.0]]\nstiffness = [[4.0, -1.0], [-1.0, 3.0]]",
                     "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 10.0\nfriction = 0.5",
                     "[[contacts]]\nname = \"d\"\nlaw = \"slider\"\ntangent = { d1 = 1.0 }\nnormal_force = "
                     "10.0\nfriction = 0.5\n"
                     "[[contacts]]\nname = \"e\"\nlaw = \"slider\"\ntangent = { d0 = 1.0, d1 = 1.0 "
                     "}\nnormal_force = 10.0\n"
                     "friction = 0.5\n");
    for (const auto& [dof, force] : {std::pair{"d0", x}, std::pair{"d1", y}})
      text += fmt::format("[[loads]]\ndirection = {{ {} = 1.0 }}\namplitude = {}\n", dof, force);
    return text;
  };
  for (const std::string& engine : engines)
    for (const auto& [x, y] : {std::pair{3.0, 1.5}, std::pair{-2.0, 3.5}, std::pair{6.0, 6.6}}) {
      CAPTURE(engine);
      CAPTURE(x);
      const Result result = run_scene(scene(x, y), engine);
      const double shared = (x + y) / 3.0;  // 4.2 of 5 at most
      for (const Result::Row& row : result.rows) {
        CHECK(row.contacts[2].T == doctest::Approx(shared).epsilon(1e-12));
        CHECK(row.contacts[0].T == doctest::Approx(x - shared).epsilon(1e-12));
        CHECK(row.contacts[1].T == doctest::Approx(y - shared).epsilon(1e-12));
        CHECK(row.u.norm() < 1e-14);
      }
    }
  // Beyond what the third can bear the others take the rest: 5, and 4 + 5 - 9 ...
  const Result result = run_scene(scene(9.2, 7.0), "exact");
  CHECK(result.rows.back().contacts[2].T == doctest::Approx(5.0).epsilon(1e-12));
  CHECK(result.rows.back().contacts[0].T == doctest::Approx(4.2).epsilon(1e-12));
  CHECK(result.rows.back().contacts[1].T == doctest::Approx(2.0).epsilon(1e-12));
}

TEST_CASE("sliders that share: a start with friction, a run that goes on, check") {
  const std::string sliders = slider("L", left, "B") + slider("R", right, "B");
  std::string text = body(0.0, sliders);
  CHECK_NOTHROW(
      (void)check::check(parse_scene(text, "test.toml"), build_model(parse_scene(text, "test.toml"))));
  std::string frictional = text;
  frictional.replace(frictional.find("t_end = 5.0"), 11, "t_end = 5.0\ninitial = \"frictional\"");
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result whole = run_scene(text, engine), slow = run_scene(frictional, engine);
    CHECK((whole.rows.back().u - slow.rows.back().u).norm() < 1e-6);
    Scene half = parse_scene(text, "test.toml",
                             {{"run.engine", engine}, {"run.certify", "false"}, {"run.t_end", "2.0"}});
    const Model model = build_model(half);
    Scene second = parse_scene(text, "test.toml",
                               {{"run.engine", engine}, {"run.certify", "false"}, {"run.t_end", "3.0"}});
    second.loads[0].history.shift = -2.0;
    second.initial.saved = last_state(model, simulate(model, half.run));
    const Result later = simulate(build_model(second), second.run);
    CHECK(later.report.outcome.reason == "");
    CHECK((later.rows.back().u - whole.rows.back().u).norm() < (engine == "exact" ? 1e-10 : 1e-6));
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::shared_sliders
