// Derivatives of one scene by every engine and flow.
#include <doctest/doctest.h>

#include <cmath>

#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"

using namespace signorini;
using namespace signorini::tests;

TEST_SUITE_BEGIN("behaviour/sensitivity_engines");

TEST_CASE("the pipeline by friction: event times that differences of `exact` gave") {
  const Sensitivities s = rates_of_model("pipeline", {"contacts.*.friction"});
  REQUIRE(s.events.size() == 251);
  // central differences, plateau of their steps: docs/theory-checks.md (Sensitivities)
  CHECK(std::abs(s.event_rates.front()[0].t - 6.4399031e-4) <= 1e-10);
  CHECK(std::abs(s.event_rates.back()[0].t + 2.12704e-2) <= 1e-6 * 2.12704e-2 + 5e-8);
  double greatest = 0.0;
  for (const auto& rates : s.event_rates) greatest = std::max(greatest, std::abs(rates[0].t));
  CHECK(std::abs(greatest - 0.189) < 1e-3);
}

TEST_CASE("the pipeline in modes, along the series and with `ida`: the same derivatives") {
  const std::vector<std::string> paths{"contacts.*.friction",
                                       "loads.1.amplitude",
                                       "gravity.2",
                                       "sections.pipe.EI",
                                       "sections.pipe.mass_per_length",
                                       "contacts.first.normal_stiffness",
                                       "contacts.second.tangential_stiffness",
                                       "nodes.D.1",
                                       "damping.alpha_over_omega1",
                                       "loads.1.history.end"};
  const auto with = [&](const std::string& engine, const std::string& flow) {
    return rates_of_model("pipeline", paths,
                          {{"run.engine", engine},
                           {"run.flow", flow},
                           {"run.rtol", "1e-8"},
                           {"run.t_end", "0.19"},
                           {"run.output_dt", "0.01"}});
  };
  const Sensitivities modes = with("exact", "modal"), series = with("exact", "taylor"),
                      ida = with("ida", "auto");
  std::size_t peaks = 0;
  const auto agree = [&](const Sensitivities& a, double part) {
    REQUIRE(a.events.size() == series.events.size());
    for (std::size_t p = 0; p < paths.size(); ++p) {
      CAPTURE(paths[p]);
      double greatest = 0.0;
      for (const auto& rates : series.event_rates) greatest = std::max(greatest, std::abs(rates[p].t));
      CHECK(greatest > 0.0);
      for (std::size_t i = 0; i < a.events.size(); ++i)
        CHECK(std::abs(a.event_rates[i][p].t - series.event_rates[i][p].t) <= part * greatest);
      REQUIRE(a.value_rates[p].size() == series.value_rates[p].size());
      for (std::size_t i = 0; i < series.times.size(); ++i)
        for (std::size_t c = 0; c < series.columns.size(); ++c) {
          double size = 0.0;
          for (const auto& row : series.value_rates[p]) size = std::max(size, std::abs(row[c]));
          CHECK(std::abs(a.value_rates[p][i][c] - series.value_rates[p][i][c]) <= part * size);
        }
      REQUIRE(a.responses.size() == series.responses.size());
      for (std::size_t i = 0; i < a.responses.size(); ++i) {
        CAPTURE(a.responses[i].name);
        const Response &found = a.responses[i], &expected = series.responses[i];
        // a modal flow sees turns of what is slow: another crest of a ripple may be its peak
        if (std::abs(found.t - expected.t) > 1e-7) continue;
        ++peaks;
        CHECK(found.rates[p] == doctest::Approx(expected.rates[p]).epsilon(1e2 * part));
      }
    }
  };
  agree(modes, 1e-7);
  CHECK(peaks > 6 * paths.size());
  agree(ida, 1e-7);
}

TEST_CASE("the gap of one of two supports turns the frame as a whole, and moves no event and no force") {
  // Two supports under a frame are statically determinate, so the lower one goes down by 1 and turns it by 1/18 about D.
  // A gap is felt as a force k g: that nothing is left of it is k's rounding, 1e6 * 1e-15 and less.
  constexpr double eps = 1e-9;
  for (const auto& [engine, flow] :
       {std::pair{"exact", "modal"}, std::pair{"exact", "taylor"}, std::pair{"ida", "auto"}}) {
    CAPTURE(std::string(engine));
    CAPTURE(std::string(flow));
    const Sensitivities s = rates_of_model(
        "pipeline", {"contacts.first.gap"},
        {{"run.engine", engine}, {"run.flow", flow}, {"run.t_end", "0.05"}, {"run.output_dt", "0.01"}});
    REQUIRE(s.events.size() > 2);
    for (const auto& rates : s.event_rates) CHECK(std::abs(rates[0].t) <= eps);
    const auto rate = [&](std::size_t row, const std::string& name) {
      for (std::size_t c = 0; c < s.columns.size(); ++c)
        if (s.columns[c] == name) return s.value_rates[0][row][c];
      return std::nan("");
    };
    for (std::size_t row = 0; row < s.times.size(); ++row) {
      CAPTURE(row);
      CHECK(std::abs(rate(row, "A.uy") + 1.0) <= eps);
      CHECK(std::abs(rate(row, "B.uy") + 1.0) <= eps);
      CHECK(std::abs(rate(row, "D.uy")) <= eps);
      CHECK(std::abs(rate(row, "A.rz") - 1.0 / 18.0) <= eps);
      CHECK(std::abs(rate(row, "A.ux") - rate(row, "B.ux") - 6.0 / 18.0) <= eps);
      CHECK(std::abs(rate(row, "D.ux") - rate(row, "B.ux")) <= eps);
    }
  }
}

TEST_CASE(
    "`ida` of little accuracy: derivatives are those of the motion, in its sequence, at times of their own") {
  const auto with = [](const char* engine) {
    return rates_of_model(
        "pipeline", {"contacts.*.friction"},
        {{"run.engine", engine}, {"run.rtol", "1e-6"}, {"run.t_end", "0.285"}, {"run.output_dt", "0.01"}});
  };
  const Sensitivities exact = with("exact"), ida = with("ida");
  REQUIRE(ida.events.size() == exact.events.size());
  REQUIRE(exact.events.size() > 180);
  double greatest = 0.0, error = 0.0, off = 0.0;
  for (std::size_t i = 0; i < exact.events.size(); ++i) {
    greatest = std::max(greatest, std::abs(exact.event_rates[i][0].t));
    error = std::max(error, std::abs(ida.event_rates[i][0].t - exact.event_rates[i][0].t));
    off = std::max(off, std::abs(ida.events[i].t - exact.events[i].t));
  }
  // at the states of `ida` itself they would be off by 0.025: a change of friction by 1e-8 moves event 147's by 4e-5
  CHECK(error <= 1e-7 * greatest);
  CHECK(off > 1e-8);
  CHECK(ida.stretches.taken == 0);
  CHECK(ida.stretches.correction == doctest::Approx(off).epsilon(0.2));
}

TEST_CASE("steps so long that states differ: on from the engine's own state, which is counted") {
  const auto with = [](const char* engine) {
    return rates_of_model("pipeline", {"contacts.*.friction"},
                          {{"run.engine", engine}, {"run.dt", "1e-3"}, {"run.t_end", "0.2"}});
  };
  const Sensitivities exact = with("exact"), steps = with("newmark");
  CHECK(steps.stretches.taken > 0);
  REQUIRE(steps.events.size() > 20);
  CHECK(steps.events.size() != exact.events.size());
  for (std::size_t i = 0; i < 3; ++i)  // up to there the sequence is that of the motion
    CHECK(std::abs(steps.event_rates[i][0].t - exact.event_rates[i][0].t) <= 1e-9);
  for (std::size_t i = 0; i < 20; ++i) CHECK(std::isfinite(steps.event_rates[i][0].t));
}

TEST_CASE("an engine without series, followed along series: a ball, a belt and a load that begins") {
  const std::string falls = matrix_scene(
      "t_end = 1.9\nrtol = 1e-6\noutput_dt = 0.5\ninitial = { u = [1.0], v = [0.0] }",
      "mass = [[1.0]]\nstiffness = [[0.0]]", "law = \"rigid\"\nnormal = { d0 = 1.0 }\nrestitution = 0.5",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -10.0\n");
  const std::string rubbed = matrix_scene(
      "t_end = 12.0\nrtol = 1e-6\noutput_dt = 3.0\ninitial = { u = [1.03], v = [0.0] }",
      "mass = [[1.0]]\nstiffness = [[4.0]]",
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = { static = "
      "0.45, kinetic = 0.4 }",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 2.0\nhistory = { type = \"triangle\", start "
      "= 5.0, end = 9.0 }\n");
  for (const auto& [text, path] :
       {std::pair{falls, "contacts.c.restitution"}, std::pair{falls, "loads.1.amplitude"},
        std::pair{rubbed, "contacts.c.friction.kinetic"}, std::pair{rubbed, "loads.1.history.start"}}) {
    CAPTURE(path);
    const Sensitivities exact = rates_of(text, {path});
    const auto with = [&, text = text](const std::string& engine) {
      return sensitivities(
          [&](const std::vector<Override>& changes) {
            std::vector<Override> all{{"run.engine", engine}, {"run.dt", "1e-3"}};
            all.insert(all.end(), changes.begin(), changes.end());
            return parse_scene(text, "test.toml", all);
          },
          {path});
    };
    for (const char* engine : {"ida", "newmark"}) {
      CAPTURE(engine);
      const Sensitivities found = with(engine);
      REQUIRE(found.events.size() == exact.events.size());
      REQUIRE(found.events.size() > 3);
      CHECK(found.stretches.taken == 0);
      for (std::size_t i = 0; i < exact.events.size(); ++i) {
        CAPTURE(i);
        CHECK(std::abs(found.event_rates[i][0].t - exact.event_rates[i][0].t) <= 1e-9);
        CHECK(std::abs(found.event_rates[i][0].T_after - exact.event_rates[i][0].T_after) <= 1e-9);
      }
      CHECK(found.stretches.correction > 0.0);
      REQUIRE(found.value_rates[0].size() == exact.value_rates[0].size());
      for (std::size_t i = 0; i < exact.times.size(); ++i)
        for (std::size_t c = 0; c < exact.columns.size(); ++c)
          CHECK(std::abs(found.value_rates[0][i][c] - exact.value_rates[0][i][c]) <= 1e-8);
    }
  }
}
