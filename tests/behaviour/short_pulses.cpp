// Pulses that are far shorter than anything else in a scene: only their impulse counts.
//
//   m u'' + k u = f,  int f = J about t_0:   u = J sin(w (t - t_0)) / (m w)
#include <doctest/doctest.h>

#include <cmath>

#include "base/rounding.hpp"
#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::short_pulses {
namespace {

using namespace parts;

Result run_of(const std::string& text) {
  const Scene scene = parse_scene(text, "test.toml");
  return simulate(build_model(scene), scene.run);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/short_pulses");

TEST_CASE("times below the clock's resolution from the beginning are the beginning") {
  const std::string output =
      "[[output]]\nname = \"a\"\nkind = \"reaction\"\nat = \"A\"\ndirection = [0.0, 1.0]\n";
  for (const char* engine : {"ida", "exact", "newmark"})
    for (const char* history :
         {"{ type = \"rectangle\", start = 0.0, end = 0.01, period = 0.5, shift = 1e-200 }",
          "{ type = \"step\", start = 1e-30 }", "{ type = \"half_sine\", duration = 1e-200 }",
          "{ type = \"half_sine\", duration = 1e-17 }",
          "{ type = \"triangle\", start = 1e-150, end = 1e-100 }"}) {
      CAPTURE(engine);
      CAPTURE(history);
      const Result result =
          run_of(head + fmt::format("[run]\nt_end = 1.0\ndt = 1e-3\nengine = \"{}\"\n", engine) +
                 nodes({{"A", 0, 0}}) + point_mass("A", 1.0) + fixed("A", "uy, rz") +
                 spring("A", "[1.0, 0.0]", 100.0) +
                 "[[loads]]\nnode = \"A\"\ndirection = [1.0, 0.0]\namplitude = 1.0\nhistory = " + history +
                 "\n" + output);
      CHECK(result.report.outcome.kind == Outcome::Kind::done);
      if (history[10] == 's')  // the step
        CHECK(result.rows.back().u[0] == doctest::Approx(0.01 * (1.0 - std::cos(10.0))).epsilon(1e-3));
    }
  // A run that is no stretch at all.
  const Result nothing =
      run_of(head + "[run]\nt_end = 1e-150\n" + nodes({{"A", 0, 0}}) + point_mass("A", 1.0) +
             fixed("A", "uy, rz") + spring("A", "[1.0, 0.0]", 100.0) + output);
  CHECK(nothing.report.outcome.kind == Outcome::Kind::done);
}

TEST_SUITE_END();

}  // namespace signorini::tests::short_pulses
