// Contacts that parts without mass leave at once, where no continuous motion goes on.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "signorini/sensitivity.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests {
namespace {

struct ReleasedScene {
  const char* number;
  double t_end;
  const char* heavy;  // the nodes that have mass
  double release;     // about when
};
// Random scenes, and what is known of them from the same scenes with a damper of 1e-2, 1e-3 and 1e-4 on all parts
// without mass: c2 of 40030 is left at the start; c0 of 40092 slips by itself until N = 0, opens and is pressed
// again; so does c1 of 40154; c2 of 40216 is left as its friction drops.
constexpr ReleasedScene released_scenes[] = {{"40030", 0.3, "n0", 0.0},
                                             {"40092", 0.6, "n1", 0.19834},
                                             {"40154", 1.5, "n0", 1.388},
                                             {"40216", 0.7, "n0 n1 n3", 0.3346}};

std::string text_of_scene(const std::string& number) {
  std::ifstream file(std::string(SIGNORINI_TEST_DATA) + "/scenes/massless/released_" + number + ".toml");
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// With dampers of this size on all that has no mass.
std::string damped_scene(const ReleasedScene& scene, double damper) {
  std::string text = text_of_scene(scene.number);
  for (const char* node : {"n0", "n1", "n2", "n3"}) {
    if (std::string(scene.heavy).find(node) != std::string::npos) continue;
    if (text.find(fmt::format("\"{}\" = [", node)) == std::string::npos) continue;
    for (const char* direction : {"[1.0, 0.0]", "[0.0, 1.0]"})
      text += fmt::format("[[springs]]\nnode = \"{}\"\ndirection = {}\nstiffness = 0.0\ndamping = {}\n", node,
                          direction, damper);
  }
  return text;
}

Result released_run(const std::string& text, const ReleasedScene& scene, const std::string& engine) {
  const Scene read = parse_scene(text, "test.toml",
                                 {{"run.engine", engine},
                                  {"run.certify", "false"},
                                  {"run.t_end", fmt::format("{}", scene.t_end)},
                                  {"run.output_dt", fmt::format("{}", scene.t_end / 60.0)},
                                  {"run.rtol", "1e-10"},
                                  {"run.dt", "2e-5"}});
  return simulate(build_model(read), read.run);
}

/// Greatest difference of the displacements of what has mass, beside the greatest of them.
double apart(const Result& one, const Result& other, const Model& model) {
  double off = 0.0, size = 0.0;
  REQUIRE(one.rows.size() == other.rows.size());
  for (std::size_t row = 0; row < one.rows.size(); ++row)
    for (int i = 0; i < model.size(); ++i) {
      if (model.dofs[static_cast<std::size_t>(i)].massless) continue;
      off = std::max(off, std::abs(one.rows[row].u[i] - other.rows[row].u[i]));
      size = std::max(size, std::abs(other.rows[row].u[i]));
    }
  return off / size;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/massless_release");

TEST_CASE("massless release: the motion is the limit of small dampers") {
  for (const ReleasedScene& scene : released_scenes) {
    CAPTURE(std::string(scene.number));
    const std::string text = text_of_scene(scene.number);
    const Model model = build_model(parse_scene(text, "test.toml"));
    const Result exact = released_run(text, scene, "exact");
    INFO(exact.report.outcome.reason);
    REQUIRE(exact.report.outcome.kind == Outcome::Kind::done);
    CHECK(std::any_of(
        exact.report.warnings.begin(), exact.report.warnings.end(),
        [](const std::string& warning) { return warning.find("released at t = ") != std::string::npos; }));
    CHECK(exact.report.law_checks.violations.empty());
    CHECK(exact.report.audit.energy.value < 1e-9 * exact.report.audit.energy_scale);
    // A damper d delays what it holds by about d/k: the motions differ by d times a number of the scene, which is 4.7
    // for 40216 and 0.1 for the others. A hundredth of d leaves a hundredth, and some rounding of event times.
    double last = 1.0;
    for (const double damper : {1e-2, 1e-4, 1e-6}) {
      CAPTURE(damper);
      const double off = apart(released_run(damped_scene(scene, damper), scene, "ida"), exact, model);
      CHECK(off < 0.1 * last);
      last = off;
    }
    CHECK(last < 1e-5);
  }
}

TEST_CASE("massless release: all engines find the same") {
  for (const ReleasedScene& scene : released_scenes) {
    CAPTURE(std::string(scene.number));
    const std::string text = text_of_scene(scene.number);
    const Model model = build_model(parse_scene(text, "test.toml"));
    const Result exact = released_run(text, scene, "exact");
    for (const std::string engine : {"ida", "newmark"}) {
      CAPTURE(engine);
      const Result other = released_run(text, scene, engine);
      INFO(other.report.outcome.reason);
      REQUIRE(other.report.outcome.kind == Outcome::Kind::done);
      CHECK(other.report.law_checks.violations.empty());
      REQUIRE(other.events.size() == exact.events.size());
      for (std::size_t i = 0; i < exact.events.size(); ++i) {
        CHECK(other.events[i].contact == exact.events[i].contact);
        CHECK(other.events[i].to == exact.events[i].to);
        CHECK(std::abs(other.events[i].t - exact.events[i].t) < 1e-6);
      }
      CHECK(apart(other, exact, model) < 1e-6);
    }
  }
}

namespace {

/// A point without mass on a slider and a spring of 40 N/m, drawn by 12 N/s; a mass stands beside it. Turned; `way`: which way
/// it is drawn.
struct Drawing {
  double dashpot = 0.0;
  std::string friction = "{ static = 0.5, kinetic = 0.3 }";
  std::string history = "history = { type = \"polynomial\", coefficients = [0.0, 12.0] }";
};
std::string drawn_point(double degrees, double way, const Drawing& drawing = {}) {
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  return fmt::format(
      R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 1.0, output_dt = 0.125 }}
nodes = {{ Q = [0.0, 0.0], far = [5.0, 5.0] }}
masses = [{{ node = "far", mass = 1.0 }}]
springs = [
  {{ node = "far", direction = [1.0, 0.0], stiffness = 1.0 }},
  {{ node = "far", direction = [0.0, 1.0], stiffness = 1.0 }},
  {{ node = "Q", direction = [{0:.17g}, {1:.17g}], stiffness = 40.0 }},
  {{ node = "Q", direction = [{3:.17g}, {0:.17g}], stiffness = 70.0 }},
]
[[contacts]]
name = "shoe"
node = "Q"
law = "slider"
tangent = [{0:.17g}, {1:.17g}]
normal_force = 10.0
tangential_stiffness = 200.0
tangential_damping = {4}
friction = {5}
[[loads]]
node = "Q"
direction = [{0:.17g}, {1:.17g}]
amplitude = {2}
{6}
)",
      c, s, way, -s, drawing.dashpot, drawing.friction, drawing.history);
}

}  // namespace

TEST_CASE("static friction lets go of a point without mass: it jumps by (fs - fk) N / k") {
  // Stuck: u = 12 t/(k + kt), T = kt u = 5 N at t = 0.5, where the load is 6 N; sliding: T = 3 N, u = (12 t - 3)/k.
  constexpr double k = 40.0, kt = 200.0;
  for (const double degrees : {0.0, 33.7, 161.3})
    for (const double way : {1.0, -1.0})
      for (const std::string engine : {"exact", "ida"}) {
        CAPTURE(degrees);
        CAPTURE(way);
        CAPTURE(engine);
        const Scene scene = parse_scene(drawn_point(degrees, way), "test.toml", {{"run.engine", engine}});
        const Result result = simulate(scene);
        INFO(result.report.outcome.reason);
        REQUIRE(result.events.size() == 1);
        CHECK(result.events[0].t == doctest::Approx(0.5).epsilon(1e-9));
        CHECK(result.events[0].T * way == doctest::Approx(5.0).epsilon(1e-9));
        CHECK(result.events[0].T_after * way == doctest::Approx(3.0).epsilon(1e-9));
        CHECK(result.report.law_checks.violations.empty());
        CHECK(result.report.audit.energy.value < 1e-9 * result.report.audit.energy_scale);
        CHECK(result.rows.back().contacts[0].T * way == doctest::Approx(3.0).epsilon(1e-9));
        // The jump from 0.025 to 0.075 m: 6 N times its length, less what the spring takes up, and what kt gives back.
        const double jump =
            6.0 * 0.05 - 0.5 * k * (0.075 * 0.075 - 0.025 * 0.025) + (25.0 - 9.0) / (2.0 * kt);
        const double slide = 3.0 * (0.225 - 0.075);
        CHECK(result.rows.back().energy.friction == doctest::Approx(jump + slide).epsilon(1e-8));
        // The load's work: 12 t along u, and 6 N over the jump.
        const double stuck = 0.5 * 6.0 * 0.025, sliding = 0.5 * (6.0 + 12.0) * (0.225 - 0.075);
        CHECK(result.rows.back().energy.loads == doctest::Approx(stuck + 6.0 * 0.05 + sliding).epsilon(1e-8));
      }
}

TEST_CASE(
    "a point without mass beside a dashpot jumps as static friction lets go, and friction takes what that "
    "releases") {
  // Stuck: 12 t = (k + kt) u + ct u', T = 12 t - k u. At T = 5 N u jumps to (12 t - 3)/k; the element e = u - p stays, and
  // then relaxes from u to 3 N / kt as exp(-kt t/ct).
  constexpr double k = 40.0, kt = 200.0, ct = 10.0, tau = ct / (k + kt);
  const auto stuck = [&](double t) { return 12.0 / (k + kt) * (t - tau * (1.0 - std::exp(-t / tau))); };
  double t = 0.1, above = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (t + above);
    (12.0 * middle - k * stuck(middle) < 5.0 ? t : above) = middle;
  }
  const double from = stuck(t), load = 12.0 * t, to = (load - 3.0) / k;
  const double jump = load * (to - from) - 0.5 * k * (to * to - from * from);
  const double relaxed = (from - 3.0 / kt) * (1.0 - std::exp(-kt * (1.0 - t) / ct));
  const double slide = 3.0 * ((12.0 - 3.0) / k - to + relaxed);
  REQUIRE(jump > 0.05);
  for (const double degrees : {0.0, 33.7, 161.3})
    for (const double way : {1.0, -1.0})
      for (const std::string engine : {"exact", "ida"}) {
        CAPTURE(degrees);
        CAPTURE(way);
        CAPTURE(engine);
        const Scene scene = parse_scene(drawn_point(degrees, way, {ct}), "test.toml",
                                        {{"run.engine", engine}, {"run.rtol", "1e-10"}});
        const Result result = simulate(scene);
        INFO(result.report.outcome.reason);
        REQUIRE(result.events.size() == 1);
        CHECK(result.events[0].t == doctest::Approx(t).epsilon(1e-8));
        CHECK(result.events[0].T_after * way == doctest::Approx(3.0).epsilon(1e-9));
        CHECK(result.report.law_checks.violations.empty());
        CHECK(result.report.audit.energy.value < 1e-8 * result.report.audit.energy_scale);
        CHECK(result.rows.back().energy.friction == doctest::Approx(jump + slide).epsilon(1e-7));
      }
}

TEST_CASE(
    "a load that jumps on a point without mass beside a dashpot: it slides at once, stops there and creeps") {
  // 7 N: u jumps to (7 - f N)/k and the dashpot takes over; then 7 = k u + kt (u - p) + ct u' with p where it stopped.
  constexpr double k = 40.0, kt = 200.0, ct = 10.0, P = 7.0;
  for (const double kinetic : {0.3, 0.5})
    for (const double begins : {0.0, 0.1})
      for (const double degrees : {0.0, 33.7, 161.3})
        for (const double way : {1.0, -1.0})
          for (const std::string engine : {"exact", "ida"}) {
            CAPTURE(kinetic);
            CAPTURE(begins);
            CAPTURE(degrees);
            CAPTURE(way);
            CAPTURE(engine);
            const double p = (P - 10.0 * kinetic) / k, rest = (P + kt * p) / (k + kt);
            const Drawing drawing{
                ct, fmt::format("{{ static = 0.5, kinetic = {} }}", kinetic),
                begins > 0.0 ? fmt::format("history = {{ type = \"step\", start = {} }}", begins) : ""};
            const Scene scene = parse_scene(drawn_point(degrees, way * P, drawing), "test.toml",
                                            {{"run.engine", engine}, {"run.rtol", "1e-10"}});
            const Result result = simulate(scene);
            INFO(result.report.outcome.reason);
            REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
            CHECK(result.report.law_checks.violations.empty());
            CHECK(result.report.audit.energy.value < 1e-8 * result.report.audit.energy_scale);
            if (begins > 0.0) {
              const double lost = 10.0 * kinetic * p;
              CHECK(result.rows.back().energy.friction == doctest::Approx(lost).epsilon(1e-8));
            }
            for (const auto& row : result.rows) {
              if (row.t < begins + 1e-9) continue;
              const double u = rest + (p - rest) * std::exp(-(k + kt) * (row.t - begins) / ct);
              CHECK(row.contacts[0].state == State::stick);
              CHECK(row.contacts[0].T * way == doctest::Approx(P - k * u).epsilon(1e-7));
            }
          }
}

TEST_CASE("the loss of a point without mass that static friction lets go, and its derivatives") {
  // As above, by fs and fk.
  const auto loss = [](double fs, double fk) {
    constexpr double k = 40.0, kt = 200.0, N = 10.0;
    const double load = fs * N * (k + kt) / kt, from = fs * N / kt, to = (load - fk * N) / k;
    const double jump =
        load * (to - from) - 0.5 * k * (to * to - from * from) + (fs * fs - fk * fk) * N * N / (2.0 * kt);
    return jump + fk * N * ((12.0 - fk * N) / k - to);
  };
  CHECK(loss(0.5, 0.3) == doctest::Approx(0.69).epsilon(1e-12));
  const std::string text = drawn_point(33.7, 1.0);
  const SceneReader read = [&](const std::vector<Override>& changes) {
    std::vector<Override> all{{"run.engine", "exact"}};
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, "test.toml", all);
  };
  const Sensitivities s = sensitivities(
      read, {"contacts.shoe.friction.static", "contacts.shoe.friction.kinetic"}, nullptr, {true});
  const auto found = std::find_if(s.responses.begin(), s.responses.end(), [](const Response& r) {
    return r.name == "lost by friction" && r.contact < 0;
  });
  REQUIRE(found != s.responses.end());
  constexpr double h = 1e-4;  // loss is a polynomial of degree two: differences are exact
  CHECK(found->value == doctest::Approx(0.69).epsilon(1e-9));
  CHECK(found->rates[0] ==
        doctest::Approx((loss(0.5 + h, 0.3) - loss(0.5 - h, 0.3)) / (2.0 * h)).epsilon(1e-7));
  CHECK(found->rates[1] ==
        doctest::Approx((loss(0.5, 0.3 + h) - loss(0.5, 0.3 - h)) / (2.0 * h)).epsilon(1e-7));
}

TEST_SUITE_END();

}  // namespace signorini::tests
