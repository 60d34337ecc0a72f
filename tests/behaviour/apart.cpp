// Parts that nothing couples run apart: what is told is what running together tells.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "behaviour/one_mass.hpp"
#include "engines.hpp"
#include "unit/run/drawn.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// Keeps what pictures need, too.
class Drawn : public Result {
 public:
  [[nodiscard]] bool wants_motion() const override { return true; }
  void motion(int contact, const std::vector<MotionRow>& track) override {
    CHECK(contact == static_cast<int>(motions.size()));
    motions.push_back(track);
  }
  void curves(const Curves& curves) override { drawn = curves; }
  std::vector<std::vector<MotionRow>> motions;
  Curves drawn;
};

/// Ends the run when it is told to have come so far.
class Impatient : public Result {
 public:
  bool progress(double t) override { return t < 1.0; }
};

/// Three bodies on springs of their own that bounce and slide, turned by an odd angle, the last two tied by a bar; a
/// mass that nothing touches; a load that jumps on the first two, another on the third.
std::string bodies() {
  constexpr double angle = 0.37;
  const double c = std::cos(angle), s = std::sin(angle);
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "1.2\n"
      "output_dt = 0.05\nframes = [0.3, 1.2]\ninitial = {}\n[nodes]\nfree = [-5.0, 1.0]\n";
  for (int i = 0; i < 4; ++i) text += fmt::format("b{} = [{}, {}]\n", i, i * c, i * s);
  text += "[[masses]]\nnode = \"free\"\nmass = 2.0\n";
  for (int i = 0; i < 4; ++i)
    text += fmt::format(
        "[[masses]]\nnode = \"b{0}\"\nmass = {1}\n[[contacts]]\nname = \"c{0}\"\nnode = \"b{0}\"\nlaw = "
        "\"compliant\"\n"
        "normal = [{2}, {3}]\nnormal_stiffness = {4}\nnormal_damping = 1.5\ntangential_stiffness = 700.0\n"
        "friction = 0.25\ngap = {5}\n",
        i, 1.0 + 0.3 * i, -s, c, 1000.0 + 170.0 * i, 0.03 * i);
  text +=
      "[sections.bar]\nEA = 900.0\nmass_per_length = 0.0\n[[members]]\nnodes = [\"b2\", \"b3\"]\nsection = "
      "\"bar\"\ntype = \"bar\"\n";
  const auto load = [&](const char* nodes, double x, double y, double amplitude, const char* history) {
    text += fmt::format("[[loads]]\nnode = {}\ndirection = [{}, {}]\namplitude = {}\nhistory = {}\n", nodes,
                        x, y, amplitude, history);
  };
  const char* jumps = "{ type = \"step\", start = 0.4 }";
  for (int i = 0; i < 4; ++i)
    load(fmt::format("\"b{}\"", i).c_str(), s, -c, 9.81 * (1.0 + 0.3 * i), "{ type = \"constant\" }");
  load("\"b0\"", c, s, 4.0, jumps);
  load("\"b1\"", c, s, 5.0, jumps);
  load("\"b3\"", -c, -s, 6.0, "{ type = \"step\", start = 0.7 }");
  load("\"free\"", 0.6, 0.8, 1.0, "{ type = \"step\", start = 0.4 }");
  return text;
}

struct Both {
  Model model;
  Drawn apart, together;
};

Both both(const std::string& engine) {
  const Scene scene = parse_scene(bodies(), "bodies.toml",
                                  {{"run.engine", engine}, {"run.rtol", "1e-11"}, {"run.dt", "1e-5"}});
  Both result;
  result.model = build_model(scene);
  result.apart.report = simulate(result.model, scene.run, result.apart);
  bool heard = false;
  // Whoever hears of rounds hears of all contacts: these run together.
  result.together.report =
      simulate(result.model, scene.run, result.together, [&](const DecisionRound& round) {
        heard = true;
        CHECK(round.states.size() == 4);
      });
  CHECK(heard);
  REQUIRE(result.apart.report.outcome.kind == Outcome::Kind::done);
  REQUIRE(result.together.report.outcome.kind == Outcome::Kind::done);
  return result;
}

void check_near(double value, double expected, double scale, double part) {
  CHECK(std::abs(value - expected) <= part * scale);
}

void check_rows(const Both& runs, double part) {
  REQUIRE(runs.apart.rows.size() == runs.together.rows.size());
  for (std::size_t i = 0; i < runs.apart.rows.size(); ++i) {
    const Result::Row &a = runs.apart.rows[i], &b = runs.together.rows[i];
    CAPTURE(a.t);
    REQUIRE(a.t == b.t);
    check_near((a.u - b.u).lpNorm<Eigen::Infinity>(), 0.0, 1.0, part);
    check_near((a.v - b.v).lpNorm<Eigen::Infinity>(), 0.0, 10.0, part);
    for (const EnergyColumn& e : energy_columns) check_near(a.energy.*e.value, b.energy.*e.value, 10.0, part);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(a.contacts[k].state == b.contacts[k].state);
      check_near(a.contacts[k].N, b.contacts[k].N, 100.0, part);
      check_near(a.contacts[k].T, b.contacts[k].T, 100.0, part);
      check_near(a.contacts[k].gap, b.contacts[k].gap, 1.0, part);
    }
  }
}

void check_reports(const Report& a, const Report& b, double part) {
  CHECK(a.events_by_type == b.events_by_type);
  CHECK(a.counters.time_events == b.counters.time_events);
  CHECK(a.outcome.t == b.outcome.t);
  for (std::size_t k = 0; k < 4; ++k) {
    CAPTURE(k);
    check_near(a.audit.friction_work[k], b.audit.friction_work[k], 10.0, part);
    check_near(a.peaks[k].N, b.peaks[k].N, 100.0, part);
    check_near(a.peaks[k].T, b.peaks[k].T, 100.0, part);
    check_near(a.peaks[k].normal, b.peaks[k].normal, 1.0, part);
    check_near(a.peaks[k].tangential, b.peaks[k].tangential, 1.0, part);
    REQUIRE(a.landings[k].size() == b.landings[k].size());
    for (std::size_t i = 0; i < a.landings[k].size(); ++i)
      check_near(a.landings[k][i].impulse, b.landings[k][i].impulse, 10.0, part);
  }
  for (const EnergyColumn& e : energy_columns) {
    check_near(a.audit.initial.*e.value, b.audit.initial.*e.value, 10.0, part);
    check_near(a.audit.final.*e.value, b.audit.final.*e.value, 10.0, part);
  }
  CHECK(a.audit.force_scale == b.audit.force_scale);
  CHECK(a.audit.length_scale == b.audit.length_scale);
  CHECK(a.audit.power_scale == b.audit.power_scale);
  CHECK(a.audit.energy_scale >= b.audit.energy_scale * (1.0 - part));
  CHECK(a.audit.work_of_loads >= b.audit.work_of_loads * (1.0 - part));
  CHECK(a.law_checks.violated == 0);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/apart");

TEST_CASE(
    "parts that nothing couples: events, rows and reports of running apart are those of running together") {
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const double part = engine == "exact" ? 1e-11 : engine == "ida" ? 1e-7 : 1e-5;
    const Both runs = both(engine);
    const std::vector<Event>&a = runs.apart.events, &b = runs.together.events;
    CHECK(a.size() > 20);
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      CAPTURE(b[i].t);
      CHECK(a[i].t == doctest::Approx(b[i].t).epsilon(part));
      CHECK(a[i].contact == b[i].contact);
      CHECK(a[i].type == b[i].type);
      CHECK(a[i].from == b[i].from);
      CHECK(a[i].to == b[i].to);
      check_near(a[i].N_after, b[i].N_after, 100.0, part);
      check_near(a[i].T_after, b[i].T_after, 100.0, part);
    }
    // The jump that acts on three parts is one row.
    CHECK(std::count_if(a.begin(), a.end(), [](const Event& e) { return e.contact < 0; }) == 2);
    CHECK(runs.apart.report.counters.time_events == 2);
    check_rows(runs, part);
    check_reports(runs.apart.report, runs.together.report, part);
  }
}

TEST_CASE("a part has its own clock: steps of one are not steps of the others") {
  const Both runs = both("exact");
  // Solves of short systems in place of long ones; steps are counted for each part.
  CHECK(runs.apart.report.counters.steps < 4 * runs.together.report.counters.steps);
  long longest = 0;
  for (const std::vector<MotionRow>& rows : runs.apart.motions)
    longest = std::max(longest, static_cast<long>(rows.size()));
  CHECK(longest > 0);
}

TEST_CASE("pictures of parts that run apart: contacts, displacements and sums of energies are the motion") {
  const Scene scene =
      parse_scene(bodies(), "bodies.toml", {{"run.engine", "exact"}, {"run.output_dt", "1e-4"}});
  const Model model = build_model(scene);
  Drawn run;
  run.report = simulate(model, scene.run, run);
  REQUIRE(run.motions.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    drawn::Line line, motion;
    for (const MotionRow& row : run.motions[k]) line.add(row.t, row.sample.N);
    for (const Result::Row& row : run.rows) motion.add(row.t, row.contacts[k].N);
    CHECK(drawn::off(line, motion) <= 0.01);
  }
  const auto look = [&](const std::string& name, const auto& value) {
    CAPTURE(name);
    const auto found = std::find(run.drawn.names.begin(), run.drawn.names.end(), name);
    REQUIRE(found != run.drawn.names.end());
    drawn::Line line, motion;
    for (const CurvePoint& p : run.drawn.points[static_cast<std::size_t>(found - run.drawn.names.begin())])
      line.add(p.t, p.value);
    for (const Result::Row& row : run.rows) motion.add(row.t, value(row));
    CHECK(line.t.back() == doctest::Approx(1.2));
    CHECK(drawn::off(line, motion) <= 0.01);
  };
  for (const Column& column : model.columns)
    if (!column.velocity && column.dof >= 0)
      look(column.name, [&](const Result::Row& row) { return row.u[column.dof]; });
  for (const EnergyColumn& column : energy_columns)
    look(column.name, [&](const Result::Row& row) { return row.energy.*column.value; });
  CHECK(run.drawn.names.back() == balance_column);
}

namespace {

constexpr const char* later =
    "surface_velocity = { type = \"rectangle\", start = 50.0, end = 60.0, amplitude = 1.0 }\n";

/// Unit masses with Coulomb friction. One, free, of velocity 2.4, has two sliders, one of them on a belt that starts later: their
/// shares are not told when it comes to rest, at 2.4 / 0.8; the other, of stiffness 5 and first displacement 10, turns at k pi / sqrt(5).
std::string oscillators(bool twice_first, const std::string& run = "output_dt = 0.01") {
  const std::string stops = twice_first ? "d0" : "d1", turns = twice_first ? "d1" : "d0";
  std::string text = fmt::format(
      "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n[run]\nt_end = "
      "6.0\n"
      "initial = {{ u = {0}, v = {3} }}\n{1}\n[matrices]\nmass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness "
      "= {2}\n",
      twice_first ? "[0.0, 10.0]" : "[10.0, 0.0]", run,
      twice_first ? "[[0.0, 0.0], [0.0, 5.0]]" : "[[5.0, 0.0], [0.0, 0.0]]",
      twice_first ? "[2.4, 0.0]" : "[0.0, 2.4]");
  for (const auto& [name, dof] : {std::pair{"one", stops}, {"swings", turns}, {"other", stops}})
    text += fmt::format(
        "[[contacts]]\nname = \"{}\"\nlaw = \"slider\"\ntangent = {{ {} = 1.0 }}\nnormal_force = "
        "1.0\nfriction = 0.4\n{}",
        name, dof, std::string(name) == "other" ? later : "");
  return text;
}

}  // namespace

TEST_CASE("where one part stops the others end, with what they have done until then") {
  for (const bool first : {true, false}) {
    CAPTURE(first);
    const Result result = run_text(oscillators(first), "exact");
    const Outcome& outcome = result.report.outcome;
    CHECK(outcome.kind == Outcome::Kind::stopped);
    CHECK(outcome.t == doctest::Approx(3.0).epsilon(1e-12));
    CHECK(outcome.refusal.kind == Refusal::Kind::dependent);
    CHECK(outcome.refusal.contacts == std::vector<std::size_t>{0, 2});
    std::vector<double> turns;
    for (const Event& event : result.events) {
      CHECK(event.t <= outcome.t);
      if (event.contact == 1) turns.push_back(event.t);
    }
    REQUIRE(turns.size() == 2);
    for (std::size_t i = 0; i < 2; ++i)
      CHECK(turns[i] ==
            doctest::Approx(static_cast<double>(i + 1) * std::numbers::pi / std::sqrt(5.0)).epsilon(1e-12));
    CHECK(result.rows.back().t > 2.98);
    CHECK(result.rows.back().t <= outcome.t);
    // Swings of 2 (10 - s) and 2 (10 - 3 s), s = 0.4 / 5, then about s.
    const double s = 0.08, rest = std::sqrt(5.0) * 3.0 - 2.0 * std::numbers::pi;
    const double way = 4.0 * (10.0 - 2.0 * s) + (10.0 - 5.0 * s) * (1.0 - std::cos(rest));
    CHECK(result.report.audit.friction_work[1] == doctest::Approx(0.4 * way).epsilon(1e-11));
    CHECK(result.report.audit.final.friction == doctest::Approx(0.4 * way + 0.5 * 2.4 * 2.4).epsilon(1e-11));
    CHECK(result.report.events_by_type.at("reversal") == 2);
    CHECK(result.report.audit.initial.kinetic == doctest::Approx(0.5 * 2.4 * 2.4));
    CHECK(result.report.audit.initial.elastic == doctest::Approx(0.5 * 5.0 * 100.0));
  }
}

TEST_CASE("what is refused at the start leaves no rows and no events of other parts") {
  // The second hits its ground at 0.
  const Result result = run_text(
      matrix_scene(
          "t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [0.0, -1.0] }",
          "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
          "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.4",
          "[[contacts]]\nname = \"ground\"\nlaw = \"rigid\"\nnormal = { d1 = 1.0 }\nrestitution = 0.5\n"
          "[[contacts]]\nname = \"other\"\nlaw = \"slider\"\ntangent = { d0 = 1.0 }\n"
          "normal_force = 1.0\nfriction = 0.4\n" +
              std::string(later)),
      "exact");
  CHECK(result.report.outcome.kind == Outcome::Kind::stopped);
  CHECK(result.report.outcome.t == 0.0);
  CHECK(result.rows.empty());
  CHECK(result.events.empty());
}

TEST_CASE("a load that jumps on two parts is one row, before those of the contacts whose forces jump") {
  const Result result =
      run_text(matrix_scene("t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
                            "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
                            "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.4",
                            "[[contacts]]\nname = \"other\"\nlaw = \"slider\"\ntangent = { d1 = 1.0 }\n"
                            "normal_force = 1.0\nfriction = 0.4\n"
                            "[[loads]]\ndirection = { d0 = 1.0, d1 = -0.5 }\namplitude = 0.2\n"
                            "history = { type = \"step\", start = 0.4 }\n"),
               "exact");
  REQUIRE(result.events.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(result.events[i].t == 0.4);
    CHECK(result.events[i].type == EventType::time);
    CHECK(result.events[i].contact == static_cast<int>(i) - 1);
  }
  CHECK(result.events[1].T_after == doctest::Approx(0.2));
  CHECK(result.events[2].T_after == doctest::Approx(-0.1));
  CHECK(result.report.events_by_type.at("time") == 1);
}

TEST_CASE("an interrupted run has rows and events up to a time that all parts have reached") {
  std::string text = oscillators(true);
  text.replace(text.rfind("[[contacts]]"), std::string::npos, "");  // nothing stops
  const Scene scene = parse_scene(text, "test.toml", {{"run.engine", "exact"}});
  Impatient recorder;
  recorder.report = simulate(build_model(scene), scene.run, recorder);
  const Outcome& outcome = recorder.report.outcome;
  CHECK(outcome.kind == Outcome::Kind::interrupted);
  CHECK(outcome.t > 0.7);
  CHECK(outcome.t < 2.0);
  REQUIRE(!recorder.rows.empty());
  CHECK(recorder.rows.back().t <= outcome.t);
  CHECK(recorder.rows.back().t <= 1.0 + 1e-12);  // the row at which progress() ends the run is the last
  CHECK(recorder.rows.back().t > outcome.t - 0.01 * (1.0 + 1e-9));
  for (const Event& event : recorder.events) CHECK(event.t <= outcome.t);
  CHECK(std::is_sorted(recorder.events.begin(), recorder.events.end(),
                       [](const Event& a, const Event& b) { return a.t < b.t; }));
}

TEST_SUITE_END();
