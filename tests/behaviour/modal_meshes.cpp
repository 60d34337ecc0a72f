// Engine exact in modes on finer meshes of the pipeline: elements of one length, and a balance that their stiffness
// does not blur.
#include <doctest/doctest.h>

#include <cmath>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

Result pipeline(const char* elements, const char* t_end, const char* flow) {
  const Scene scene = read_scene(SIGNORINI_MODELS "/pipeline.toml", {{"members.1.elements", elements},
                                                                     {"run.engine", "exact"},
                                                                     {"run.flow", flow},
                                                                     {"run.t_end", t_end},
                                                                     {"run.output_dt", "1e-3"}});
  return simulate(build_model(scene), scene.run);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/modal meshes");

TEST_CASE("modes: elements of one length, whose states have equal frequencies, stay in modes") {
  const Result modes = pipeline("[33, 99]", "0.0045", "modal"),
               series = pipeline("[33, 99]", "0.0045", "taylor");
  CHECK(modes.report.counters.fallbacks == 0);
  REQUIRE(modes.events.size() == series.events.size());
  CHECK(modes.events.size() >= 3);
  for (std::size_t i = 0; i < modes.events.size(); ++i) {
    CHECK(modes.events[i].type == series.events[i].type);
    CHECK(std::abs(modes.events[i].t - series.events[i].t) < 1e-12);
  }
}

TEST_CASE("modes: the balance closes on a fine mesh, where u^T K u has lost six digits") {
  const Audit audit = pipeline("[34, 98]", "0.1", "modal").report.audit;
  CHECK(audit.energy.value < 1e-12 * audit.energy_scale);
}

TEST_CASE("modes: with next to no damping works are those of the series, in other modes") {
  for (const char* share : {"0", "1e-8", "1e-6", "1e-3", "0.01"}) {
    CAPTURE(share);
    const auto run = [&](const char* flow) {
      const Scene scene = read_scene(SIGNORINI_MODELS "/pipeline.toml", {{"damping.alpha_over_omega1", share},
                                                                         {"run.engine", "exact"},
                                                                         {"run.flow", flow},
                                                                         {"run.t_end", "0.03"}});
      return simulate(build_model(scene), scene.run);
    };
    const Result modes = run("modal"), series = run("taylor");
    CHECK(modes.report.method.flow_reason == "as given: complex modes");
    const Audit &a = modes.report.audit, &b = series.report.audit;
    CHECK(a.energy.value < 1e-9 * a.energy_scale);  // most, 7.6e-10, at 1e-3: roots 0 and -alpha lie close
    CHECK(std::abs(a.final.friction - b.final.friction) < 1e-9 * a.energy_scale);
    CHECK(std::abs(a.final.damping - b.final.damping) < 1e-9 * a.energy_scale);
  }
}
