// Random scenes through all engines (validation/differential), a handful; and those on which they once
// disagreed.
#include <doctest/doctest.h>

#include <filesystem>

#include "differential/continuations.hpp"
#include "differential/coupled.hpp"
#include "differential/generator.hpp"
#include "differential/judge.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;
using namespace signorini::differential;

namespace {

/// No clock: a slow machine is no other verdict.
Judgement judged(const Scene& scene) {
  JudgeSettings settings;
  settings.seconds = settings.scene_seconds = 1e6;
  return judge(scene, settings);
}

}  // namespace

TEST_SUITE("behaviour/differential") {
  TEST_CASE("random scenes: engines agree as far as they promise") {
    int agree = 0, events = 0;
    for (std::uint64_t seed = 51; seed <= 80; ++seed) {
      const Judgement j = judged(parse_scene(draw_scene(seed), "drawn.toml"));
      CAPTURE(seed);
      CAPTURE(j.what);
      CHECK(j.verdict != Verdict::disagree);
      agree += j.verdict == Verdict::agree ? 1 : 0;
      events += static_cast<int>(j.events);
    }
    CHECK(agree >= 25);
    CHECK(events > 300);
  }

  TEST_CASE("heat, moments, supports that move, stops and stages: engines agree as far as they promise") {
    int agree = 0, events = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const Judgement j = judged(parse_scene(draw_loaded_scene(seed), "drawn.toml"));
      CAPTURE(seed);
      CAPTURE(j.what);
      CHECK(j.verdict != Verdict::disagree);
      agree += j.verdict == Verdict::agree ? 1 : 0;
      events += static_cast<int>(j.events);
    }
    CHECK(agree >= 5);
    CHECK(events > 100);
  }

  TEST_CASE("coupled rigid contacts: each decision is the only motion that goes on") {
    long confirmed = 0, instants = 0, stopped = 0;
    for (std::uint64_t seed = 101; seed <= 500; ++seed) {
      const CoupledFinding found = examine_coupled(parse_scene(draw_coupled_scene(seed), "drawn.toml"), 6);
      CAPTURE(seed);
      CAPTURE(found.cause);
      CAPTURE(found.what);
      CHECK(found.verdict != CoupledFinding::Verdict::refused);
      CHECK(found.verdict != CoupledFinding::Verdict::unlike);
      CHECK(found.verdict != CoupledFinding::Verdict::forbidden);
      stopped += found.cause.empty() ? 0 : 1;
      instants += found.instants;
      confirmed += found.confirmed;
    }
    CHECK(stopped < 80);
    CHECK(instants > 1000);
    CHECK(confirmed > instants / 2);
  }

  TEST_CASE("speeds that a hit leaves below the drift of rest are speeds: flights and slips of 1e-13 m/s") {
    for (const std::uint64_t seed : {359U, 1701U, 4360U}) {
      const CoupledFinding found = examine_coupled(parse_scene(draw_coupled_scene(seed), "drawn.toml"));
      CAPTURE(seed);
      CAPTURE(found.what);
      CHECK(found.verdict == CoupledFinding::Verdict::agrees);
      CHECK(found.as_told > 0);
    }
  }

  TEST_CASE("a chatter of three contacts ends in the one motion that goes on when all of them rest") {
    // Each flight that the clock resolves is flown, a thousand of them; after the last, at 0.17102 s, all three press.
    const Scene scene = parse_scene(draw_coupled_scene(50498), "drawn.toml");
    const CoupledFinding found = examine_coupled(scene, 5000);
    CAPTURE(found.what);
    CHECK(found.verdict == CoupledFinding::Verdict::agrees);
    CHECK(found.instants > 900);
    Scene after = scene;
    after.run.output_dt.reset();
    after.run.output_times = std::vector<double>{0.18};
    const Result run = simulate(build_model(after), after.run);
    REQUIRE(!run.rows.empty());
    REQUIRE(run.rows.front().t == 0.18);
    const auto& contacts = run.rows.front().contacts;
    CHECK(contacts[2].state == State::stick);
    CHECK(contacts[3].state == State::slip_plus);
    CHECK(contacts[4].state == State::stick);
    for (const std::size_t c : {2U, 3U, 4U}) CHECK(contacts[c].N < -1.0);
  }

  TEST_CASE("eight rows on seven degrees of freedom: the forces are shared, none is noise or pulls") {
    const Scene scene = parse_scene(draw_coupled_scene(19), "drawn.toml");
    const Result run = simulate(build_model(scene), scene.run);
    CHECK(run.report.outcome.kind == Outcome::Kind::done);
    CHECK(run.report.law_checks.violations.empty());
    for (const Result::Row& row : run.rows)
      for (const ContactSample& contact : row.contacts)
        CHECK(contact.N < 1e-9 * run.report.audit.force_scale);
    const CoupledFinding found = examine_coupled(scene);
    CAPTURE(found.what);
    CHECK(found.verdict == CoupledFinding::Verdict::agrees);
  }

  TEST_CASE("continuations of Painleve's rod: one, none, two") {
    // gn'' = b + w l with w = 1 - mu 0.9 s while it slides along s.
    Question q{ExtendedMatrix(2, 2), Extended(2), Extended::Constant(2, 3.0L), {0.5}, {1}};
    q.W << 1.0L, 0.9L, 0.9L, 1.0L;
    q.b << -3.0L, 0.0L;
    CHECK(continuations(q).responses.size() == 1);
    CHECK(continuations(q).condition == doctest::Approx(19.0));
    q.friction = {2.0};
    CHECK(continuations(q).responses.empty());
    q.b << 3.0L, 0.0L;
    CHECK(continuations(q).responses.size() == 2);
    q.friction = {0.5};
    CHECK(continuations(q).responses.size() == 1);
    // At rest and drawn aside by less than mu 3: it stays, and nothing else does.
    q.sliding = {0};
    q.W << 1.0L, 0.0L, 0.0L, 1.0L;
    q.b << -3.0L, 1.4L;
    REQUIRE(continuations(q).responses.size() == 1);
    CHECK(continuations(q).responses[0].cwiseAbs().maxCoeff() < 1e-15L);
    q.b << -3.0L, 1.6L;
    REQUIRE(continuations(q).responses.size() == 1);
    CHECK(static_cast<double>(continuations(q).responses[0][1]) == doctest::Approx(0.1));
  }

  TEST_CASE("scenes on which engines once disagreed") {
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(SIGNORINI_TEST_DATA "/scenes/differential")) {
      const Judgement j = judged(read_scene(entry.path().string()));
      CAPTURE(entry.path().filename().string());
      CAPTURE(j.what);
      CHECK(j.verdict != Verdict::disagree);
      CHECK(j.verdict != Verdict::refused);
      ++count;
    }
    CHECK(count >= 2);
  }
}
