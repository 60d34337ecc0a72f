// Engine exact in modes against its Taylor series: the same events at the same times, and a balance that
// closes.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

Result run(double f, bool modal) {
  const Scene scene =
      read_scene(SIGNORINI_MODELS "/pipeline.toml", {{"contacts.*.friction", fmt::format("{}", f)},
                                                     {"run.engine", "exact"},
                                                     {"run.output_dt", "1e-2"},
                                                     {"run.flow", modal ? "modal" : "taylor"}});
  return simulate(build_model(scene), scene.run);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/modal_flow");

TEST_CASE(
    "pipeline: both flows find the same events at the same times, forces and peaks; their balances close") {
  for (const double f : {0.0, 0.1, 0.3, 0.9, 1.3}) {
    CAPTURE(f);
    const Result modes = run(f, true), series = run(f, false);
    REQUIRE(modes.report.outcome.kind == Outcome::Kind::done);
    CHECK(modes.report.warnings == series.report.warnings);
    CHECK(modes.report.counters.fallbacks == 0);
    // Steps of the flow in modes end at events; those of the series are 5 radians of the fastest motion.
    CHECK(modes.report.counters.steps < 500);
    CHECK(series.report.counters.steps > 10000);
    REQUIRE(modes.events.size() == series.events.size());
    for (std::size_t i = 0; i < modes.events.size(); ++i) {
      const Event &a = modes.events[i], &b = series.events[i];
      CAPTURE(b.t);
      REQUIRE(a.contact == b.contact);
      REQUIRE(a.type == b.type);
      REQUIRE(a.to == b.to);
      // What one rounding of the state makes of a time is in t_uncertainty; it adds up over hundreds of
      // events.
      CHECK(std::abs(a.t - b.t) < 1e-10);
      CHECK(std::abs(a.N - b.N) < 1e-5);
    }
    // 4e-13 to 1.5e-11 with friction; written so that NaN fails
    REQUIRE(std::isfinite(modes.report.audit.final.balance()));
    CHECK(modes.report.audit.energy.value < 5e-11 * modes.report.audit.energy_scale);
    CHECK(modes.report.audit.equilibrium.value < 1e-9 * modes.report.audit.force_scale);
    REQUIRE(modes.rows.size() == series.rows.size());
    for (std::size_t i = 0; i < modes.rows.size(); ++i) {
      const auto &a = modes.rows[i], &b = series.rows[i];
      CHECK((a.u - b.u).cwiseAbs().maxCoeff() < 1e-9);
      CHECK(a.energy.damping == doctest::Approx(b.energy.damping).epsilon(1e-8));
      CHECK(a.energy.friction == doctest::Approx(b.energy.friction).epsilon(1e-8));
      CHECK(a.energy.loads == doctest::Approx(b.energy.loads).epsilon(1e-8));
    }
    for (std::size_t c = 0; c < 2; ++c) {
      const Peak &a = modes.report.peaks[c], &b = series.report.peaks[c];
      CHECK(a.horizontal == doctest::Approx(b.horizontal).epsilon(1e-5));
      CHECK(a.vertical == doctest::Approx(b.vertical).epsilon(1e-5));
      CHECK(a.N == doctest::Approx(b.N).epsilon(1e-5));
      CHECK(a.T == doctest::Approx(b.T).epsilon(1e-5));
    }
  }
}
