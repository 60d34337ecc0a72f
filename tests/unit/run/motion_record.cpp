#include "run/motion_record.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "signorini/simulate.hpp"
#include "unit/run/drawn.hpp"

using namespace signorini;

namespace {

/// Keeps the rows for pictures.
class Keeper : public Result {
 public:
  [[nodiscard]] bool wants_motion() const override { return true; }
  void motion(int contact, const std::vector<MotionRow>& track) override {
    CHECK(contact == static_cast<int>(tracks.size()));
    tracks.push_back(track);
  }
  std::vector<std::vector<MotionRow>> tracks;
};

Keeper kept(const std::string& file, std::vector<Override> changes) {
  const Scene scene = read_scene(file, changes);
  const Model model = build_model(scene);
  Keeper keeper;
  keeper.report = simulate(model, scene.run, keeper);
  return keeper;
}

const std::string pipeline = SIGNORINI_MODELS "/pipeline.toml";

/// N, T, gap, ut and slip of the contacts with a picture of their own beside their rows at 20000 times.
void check_contacts(const std::string& name, std::vector<Override> changes = {}) {
  CAPTURE(name);
  const std::string file = SIGNORINI_MODELS "/" + name + ".toml";
  changes.push_back({"run.output_dt", std::to_string(read_scene(file, changes).run.t_end / 20000.0)});
  const Keeper run = kept(file, changes);
  REQUIRE(!run.tracks.empty());
  for (const auto& [quantity, member] :
       {std::pair{"N", &ContactSample::N}, std::pair{"T", &ContactSample::T},
        std::pair{"gap", &ContactSample::gap}, std::pair{"ut", &ContactSample::ut},
        std::pair{"slip", &ContactSample::slip}}) {
    CAPTURE(quantity);
    const bool force = member == &ContactSample::N || member == &ContactSample::T;
    double size = 0.0;
    for (const Result::Row& row : run.rows)
      for (const ContactSample& c : row.contacts)
        size = std::max({size, std::abs(force ? c.N : c.gap), std::abs(force ? c.T : c.ut)});
    for (std::size_t k = 0; k < std::min<std::size_t>(run.tracks.size(), 24); ++k) {
      CAPTURE(k);
      tests::drawn::Line line, motion;
      for (const MotionRow& row : run.tracks[k]) line.add(row.t, row.sample.*member);
      for (const Result::Row& row : run.rows) motion.add(row.t, row.contacts[k].*member);
      CHECK(tests::drawn::off(line, motion, size) <= 0.01);
    }
  }
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/motion_record");

TEST_CASE("bodies that turn at one time but for its rounding are one moment") {
  const Model model = build_model(read_scene(pipeline));
  const Result recorder;
  run::MotionRecord record(model, 1.0, recorder);
  std::vector<double> turns;
  for (int i = 0; i < 1000; ++i) turns.push_back(0.25 * (1.0 + 1e-17 * i));
  for (int i = 0; i < 1000; ++i) turns.push_back(0.5 * (1.0 + 1e-16 * i));
  turns.push_back(0.75);
  long found = 0;
  record.step(0.0, 1.0, turns);
  while (const auto moment = record.next()) found += moment->is_turning_point ? 1 : 0;
  CHECK(found >= 3);
  CHECK(found <= 10);  // 1e-13 are some few times a hundred roundings
}

TEST_CASE("no peak is lost, however coarse the output times") {
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Keeper run =
        kept(pipeline,
             {{"run.engine", engine}, {"run.rtol", "1e-6"}, {"run.t_end", "0.2"}, {"run.output_dt", "0.2"}});
    REQUIRE(run.tracks.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
      double N = 0.0, T = 0.0;
      for (const MotionRow& row : run.tracks[k]) {
        N = std::max(N, std::abs(row.sample.N));
        T = std::max(T, std::abs(row.sample.T));
      }
      CHECK(N == doctest::Approx(run.report.peaks[k].N).epsilon(1e-3));
      CHECK(T == doctest::Approx(run.report.peaks[k].T).epsilon(1e-3));
    }
  }
}

TEST_CASE("both sides of every event are there, in the order of time") {
  const Keeper run = kept(pipeline, {{"run.engine", "exact"}, {"run.t_end", "0.02"}});
  for (const Event& event : run.events) {
    if (event.contact < 0) continue;
    const auto& rows = run.tracks[static_cast<std::size_t>(event.contact)];
    const auto at =
        std::count_if(rows.begin(), rows.end(), [&](const MotionRow& r) { return r.t == event.t; });
    CHECK(at >= 2);
  }
  for (const auto& rows : run.tracks)
    CHECK(std::is_sorted(rows.begin(), rows.end(),
                         [](const MotionRow& a, const MotionRow& b) { return a.t < b.t; }));
}

TEST_CASE("the record does not depend on the output times, and is bounded") {
  const Keeper coarse = kept(SIGNORINI_MODELS "/belt.toml", {{"run.output_dt", "5.0"}});
  const Keeper fine = kept(SIGNORINI_MODELS "/belt.toml", {{"run.output_dt", "0.01"}});
  REQUIRE(coarse.tracks[0].size() == fine.tracks[0].size());
  for (std::size_t i = 0; i < coarse.tracks[0].size(); ++i) {
    CHECK(coarse.tracks[0][i].t == fine.tracks[0][i].t);
    CHECK(coarse.tracks[0][i].sample.T == fine.tracks[0][i].sample.T);
  }
  const Keeper longer =
      kept(SIGNORINI_MODELS "/belt.toml", {{"run.t_end", "5000.0"}, {"run.output_dt", "5000.0"}});
  CHECK(longer.tracks[0].size() <= 8000);
  CHECK(longer.tracks[0].size() > 1000);
  CHECK(longer.tracks[0].front().t == 0.0);
  CHECK(longer.tracks[0].back().t == 5000.0);
}

TEST_CASE("a run of many steps is kept evenly: no part of it is thinned more than the rest") {
  const Keeper run = kept(SIGNORINI_MODELS "/oscillator.toml",
                          {{"run.engine", "newmark"}, {"run.dt", "1e-4"}, {"run.output_dt", "12.0"}});
  CHECK(run.report.counters.steps > 100000);
  const std::vector<MotionRow>& rows = run.tracks[0];
  CHECK(rows.size() <= 8000);
  double widest = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) widest = std::max(widest, rows[i].t - rows[i - 1].t);
  CHECK(widest < 12.0 / 200.0);
}

TEST_CASE("what pictures draw of contacts is the motion, within 1 % or a pixel") {
  for (const char* model : {"oscillator", "matrices", "pipeline", "rigid-frame", "chain", "belt", "lift-off"})
    check_contacts(model);
}

TEST_CASE("what pictures draw of contacts is the motion, whatever the engine's steps are") {
  for (const char* engine : {"exact", "ida", "newmark"}) {
    CAPTURE(engine);
    check_contacts("matrices", {{"run.engine", engine}, {"run.dt", "5e-4"}, {"run.t_end", "3.0"}});
    check_contacts("pipeline", {{"run.engine", engine}, {"run.dt", "2e-5"}, {"run.t_end", "0.3"}});
  }
}

TEST_CASE("an event of one body is no row of another; a jump of a load is one of all that run together") {
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [0.0, -10.0]
[run]
t_end = 10.0
engine = "exact"
[nodes]
bouncing = [0.0, 0.0]
sliding = [1.0, 0.0]
[run.initial]
sliding = { vx = 100.0 }
[[masses]]
node = "bouncing"
mass = 1.0
[[masses]]
node = "sliding"
mass = 1.0
[[contacts]]
name = "bouncing"
node = "bouncing"
law = "rigid"
normal = [0.0, 1.0]
gap = 1.0
restitution = 0.9
[[contacts]]
name = "sliding"
node = "sliding"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 10.0
friction = 0.3
[[loads]]
node = "sliding"
direction = [1.0, 0.0]
amplitude = 1.0
history = { type = "step", start = 4.5 }
)";
  const Scene scene = parse_scene(text, "two.toml");
  const Model model = build_model(scene);
  for (const bool together : {false, true}) {
    CAPTURE(together);
    Keeper run;
    run.report = together ? simulate(model, scene.run, run, [](const DecisionRound&) {})
                          : simulate(model, scene.run, run);
    const auto at = [&](std::size_t k, double t) {
      return std::count_if(run.tracks[k].begin(), run.tracks[k].end(),
                           [&](const MotionRow& row) { return row.t == t; });
    };
    int hits = 0, beside = 0;
    for (const Event& event : run.events) {
      if (event.type != EventType::impact) continue;
      ++hits;
      CHECK(at(0, event.t) == 2);
      CHECK(at(1, event.t) <= 1);  // where a line needs one
      beside += at(1, event.t) > 0;
    }
    REQUIRE(hits > 50);
    CHECK(beside < hits);
    // Nothing acts on the first; but a jump of the forcing is one instant of a motion.
    CHECK((together ? at(0, 4.5) == 2 : at(0, 4.5) <= 1));
    CHECK(at(1, 4.5) == 2);
  }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/run/motion_record");

TEST_CASE("what pictures draw of contacts is the motion, within 1 % or a pixel: a rack in an earthquake") {
  check_contacts("piping");
}

TEST_SUITE_END();
