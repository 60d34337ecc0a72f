// Contacts that parts without mass leave at once, where no continuous motion goes on.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "signorini/simulate.hpp"

namespace signorini::tests {
namespace {

struct ReleasedScene {
  const char* number;
  double t_end;       // before a second release would do the same
  const char* heavy;  // the nodes that have mass
  double release;     // about when
};
// Random scenes, and what is known of them from the same scenes with a damper of 1e-2, 1e-3 and 1e-4 on all parts
// without mass: c2 of 40030 is left at the start; c0 of 40092 slips by itself until N = 0, opens and is pressed
// again; so does c1 of 40154; c2 of 40216 is left as its friction drops.
constexpr ReleasedScene released_scenes[] = {{"40030", 0.3, "n0", 0.0},
                                             {"40092", 0.22, "n1", 0.19834},
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
        [](const std::string& warning) { return warning.find("let go at t = ") != std::string::npos; }));
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

TEST_SUITE_END();

}  // namespace signorini::tests
