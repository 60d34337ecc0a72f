// Rigid contacts that move each other through the structure: scenes on which earlier versions stopped, span
// or went wrong. All must run to their end, keep their conditions and their energy, by both engines.
#include <doctest/doctest.h>

#include <filesystem>

#include "behaviour/engines.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;
using namespace signorini::tests;

TEST_SUITE("behaviour/coupled") {
  TEST_CASE("coupled hits, accumulation points and lifts end, and nothing is gained") {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(SIGNORINI_TEST_DATA "/scenes/coupled"))
      for (const std::string& engine : engines) {
        CAPTURE(entry.path().filename().string());
        CAPTURE(engine);
        ++count;
        const Scene scene = read_scene(entry.path().string(), {{"run.engine", engine}});
        const Result r = simulate(build_model(scene), scene.run);
        INFO(r.report.outcome.reason);
        CHECK(r.report.outcome.kind == Outcome::Kind::done);
        const Audit& a = r.report.audit;
        CHECK(a.penetration.value <= 1e-12 * a.length_scale);
        CHECK(a.tension.value <= 1e-7 * a.force_scale);
        CHECK(a.friction.value <= 1e-7 * a.force_scale);
        CHECK(a.energy.value <= 1e-6 * a.energy_scale + 1e-12 * a.force_scale * a.length_scale);
      }
    CHECK(count >= 30);
  }
}
