// Forces, lengths and times in units that are powers of two of others: the same bytes, scaled.
#include <doctest/doctest.h>

#include <cmath>

#include "run/scene_units.hpp"
#include "scene/quantities.hpp"
#include "signorini/simulate.hpp"
#include "signorini/trace.hpp"

using namespace signorini;

namespace {

/// All that a run tells: rows, the record for pictures, rounds of decisions.
class Told : public Result {
 public:
  [[nodiscard]] bool wants_motion() const override { return true; }
  void motion(int /*contact*/, const std::vector<MotionRow>& track) override { drawn.push_back(track); }

  std::vector<std::vector<MotionRow>> drawn;
  std::vector<DecisionRound> rounds;
};

Told run_scene(const Model& model, const RunSpec& spec) {
  Told told;
  told.report =
      simulate(model, spec, told, [&](const DecisionRound& round) { told.rounds.push_back(round); });
  return told;
}

/// Of the guard that falls at an event.
Unit guard_of(EventType type) {
  switch (type) {
    case EventType::slip:
    case EventType::separation:
      return unit::force;
    case EventType::contact:
      return unit::length;
    default:
      return unit::velocity;
  }
}

void check_same(const Event& a, const Event& b, const Factors& factors) {
  CHECK(a.t == b.t);
  CHECK(a.contact == b.contact);
  CHECK(a.type == b.type);
  CHECK(a.from == b.from);
  CHECK(a.to == b.to);
  CHECK(a.gap == b.gap);
  CHECK(a.N == b.N);
  CHECK(a.T == b.T);
  CHECK(a.N_after == b.N_after);
  CHECK(a.T_after == b.T_after);
  CHECK(a.vn == b.vn);
  CHECK(a.vn_after == b.vn_after);
  CHECK(a.vt == b.vt);
  CHECK(a.vt_after == b.vt_after);
  CHECK(a.impulse_n == b.impulse_n);
  CHECK(a.impulse_t == b.impulse_t);
  CHECK(a.t_uncertainty == b.t_uncertainty);
  REQUIRE(a.guard_rate.has_value() == b.guard_rate.has_value());
  if (a.guard_rate && a.type != EventType::impact && a.type != EventType::time)
    CHECK(*a.guard_rate * scene::factor_of(guard_of(a.type), factors) / factors.time == *b.guard_rate);
}

void check_same(const Energy& a, const Energy& b) {
  CHECK(a.kinetic == b.kinetic);
  CHECK(a.elastic == b.elastic);
  CHECK(a.contact == b.contact);
  CHECK(a.damping == b.damping);
  CHECK(a.friction == b.friction);
  CHECK(a.impact == b.impact);
  CHECK(a.loads == b.loads);
  CHECK(a.surface == b.surface);
}

void check_same(const ContactSample& a, const ContactSample& b) {
  CHECK(a.state == b.state);
  CHECK(a.gap == b.gap);
  CHECK(a.ut == b.ut);
  CHECK(a.vt == b.vt);
  CHECK(a.slip == b.slip);
  CHECK(a.N == b.N);
  CHECK(a.T == b.T);
}

void check_rows(const Model& model, const Told& here, const Told& there, const Factors& factors) {
  REQUIRE(here.rows.size() == there.rows.size());
  for (std::size_t i = 0; i < here.rows.size(); ++i) {
    const Result::Row& row = there.rows[i];
    CHECK(row.u == run::to_scene_units(here.rows[i].u, model.physical_dofs(), 0, factors));
    CHECK(row.v == run::to_scene_units(here.rows[i].v, model.physical_dofs(), 1, factors));
    Sample sample{here.rows[i].t, nullptr, nullptr, here.rows[i].contacts, here.rows[i].energy};
    sample = run::to_scene_units(sample, factors);
    CHECK(row.t == sample.t);
    check_same(sample.energy, row.energy);
    for (std::size_t k = 0; k < row.contacts.size(); ++k) check_same(sample.contacts[k], row.contacts[k]);
  }
  REQUIRE(here.drawn.size() == there.drawn.size());
  for (std::size_t k = 0; k < here.drawn.size(); ++k) {
    REQUIRE(here.drawn[k].size() == there.drawn[k].size());
    for (std::size_t i = 0; i < here.drawn[k].size(); ++i) {
      const Sample sample = run::to_scene_units(
          Sample{here.drawn[k][i].t, nullptr, nullptr, {here.drawn[k][i].sample}, {}}, factors);
      CHECK(there.drawn[k][i].t == sample.t);
      check_same(sample.contacts[0], there.drawn[k][i].sample);
    }
  }
}

void check_rounds(const Told& here, const Told& there, const Factors& factors) {
  REQUIRE(here.rounds.size() == there.rounds.size());
  for (std::size_t i = 0; i < here.rounds.size(); ++i) {
    const DecisionRound &a = here.rounds[i], &b = there.rounds[i];
    CHECK(a.t * factors.time == b.t);
    CHECK(a.number == b.number);
    REQUIRE(a.failed.size() == b.failed.size());
    for (std::size_t j = 0; j < a.failed.size(); ++j) CHECK(a.failed[j].excess == b.failed[j].excess);
  }
}

/// The run in other units, and the run scaled to them.
void check_bytes(const Scene& scene, const Factors& factors) {
  CAPTURE(scene.file);
  CAPTURE(to_string(scene.run.engine));
  CAPTURE(factors.force);
  CAPTURE(factors.length);
  CAPTURE(factors.time);
  const Scene other = scene::rescaled(scene, factors);
  const Model model = build_model(scene);
  const Told here = run_scene(model, scene.run), there = run_scene(build_model(other), other.run);
  CHECK(here.report.outcome.reason == there.report.outcome.reason);
  REQUIRE(here.events.size() == there.events.size());
  for (std::size_t i = 0; i < here.events.size(); ++i)
    check_same(run::to_scene_units(here.events[i], factors), there.events[i], factors);
  check_rows(model, here, there, factors);
  check_rounds(here, there, factors);
  const Report report = run::to_scene_units(here.report, factors);
  CHECK(report.outcome.t == there.report.outcome.t);
  check_same(report.audit.final, there.report.audit.final);
  CHECK(report.audit.energy.value == there.report.audit.energy.value);
  CHECK(report.audit.equilibrium.value == there.report.audit.equilibrium.value);
  for (std::size_t k = 0; k < report.peaks.size(); ++k) {
    CHECK(report.peaks[k].normal == there.report.peaks[k].normal);
    CHECK(report.peaks[k].N == there.report.peaks[k].N);
  }
  CHECK(here.report.warnings.size() == there.report.warnings.size());
}

Scene scene_of(const std::string& file, const std::string& engine, const std::string& t_end,
               const std::vector<Override>& more = {}) {
  std::vector<Override> changes{{"run.engine", engine},
                                {"run.rtol", "1e-8"},
                                {"run.dt", "1e-3"},
                                {"run.t_end", t_end},
                                {"run.output_dt", t_end + "e-2"}};
  if (file != "matrices") changes.push_back({"run.frames", "[]"});
  changes.insert(changes.end(), more.begin(), more.end());
  return read_scene(std::string(SIGNORINI_MODELS) + "/" + file + ".toml", changes);
}

const std::vector<Factors> powers_of_two{
    {0x1p-30, 1.0, 1.0}, {1.0, 0x1p10, 1.0}, {1.0, 1.0, 0x1p13}, {0x1p60, 0x1p-50, 0x1p-40}};

}  // namespace

TEST_SUITE("behaviour/internal_units") {
  TEST_CASE("powers of two of forces, lengths and times: the same bytes") {
    for (const char* engine : {"exact", "ida", "newmark"})
      for (const Factors& factors : powers_of_two) {
        check_bytes(scene_of("rigid-frame", engine, "0.26"), factors);
        check_bytes(scene_of("pipeline", engine, "0.2"), factors);
        check_bytes(scene_of("belt", engine, "20.0"), factors);
        check_bytes(scene_of("oscillator", engine, "5.0"), factors);
      }
  }

  TEST_CASE("[matrices]: powers of two of forces and times") {
    for (const char* engine : {"exact", "ida", "newmark"})
      check_bytes(scene_of("matrices", engine, "1.0"), {0x1p33, 1.0, 0x1p-6});
  }

  TEST_CASE("absolute tolerances, reduction, the flow in modes and friction iteration follow the units") {
    for (const Factors& factors : powers_of_two) {
      check_bytes(scene_of("pipeline", "ida", "0.2", {{"run.atol", "{ displacement = 1e-9, force = 1e-4 }"}}),
                  factors);
      check_bytes(scene_of("pipeline", "exact", "0.2", {{"reduction.cutoff_omega", "2000.0"}}), factors);
      check_bytes(scene_of("pipeline", "exact", "0.2", {{"run.flow", "modal"}}), factors);
      check_bytes(scene_of("pipeline", "friction-iteration", "0.2"), factors);
    }
  }

  TEST_CASE("a message has its numbers in the scene's units") {
    const Scene scene = parse_scene(R"(
      schema = 1
      units = { force = "N", mass = "kg", length = "m", time = "s" }
      [run]
      t_end = 1.0
      [nodes]
      a = [0.0, 0.0]
      b = [7.0, 0.0]
      [[masses]]
      node = "a"
      mass = 3.0
      [[masses]]
      node = "b"
      mass = 3.0
      [[contacts]]
      name = "c"
      node = "a"
      normal = [0.0, 1.0]
      law = "rigid"
      gap = -0.3125
    )",
                                    "below.toml");
    CHECK_THROWS_WITH_AS(static_cast<void>(build_model(scene)), doctest::Contains("found a gap of -0.3125 m"),
                         SceneError);
  }

  TEST_CASE("forces far from one: the frame keeps its events") {
    const Result here = run_scene(build_model(scene_of("rigid-frame", "exact", "0.7")),
                                  scene_of("rigid-frame", "exact", "0.7").run);
    CHECK(here.events.size() == 614);
    for (const double force : {1e-9, 1e-13, 1e20}) {
      CAPTURE(force);
      const Scene scene = scene::rescaled(scene_of("rigid-frame", "exact", "0.7"), {force, 1.0, 1.0});
      const Result there = run_scene(build_model(scene), scene.run);
      CHECK(there.report.outcome.reason == "");
      CHECK(there.events.size() == 614);
    }
  }
}
