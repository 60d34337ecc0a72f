// Runs that no scene file can ask for: functions as loads, user-defined laws, loads that are changed on the way.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "scene/quantities.hpp"
#include "signorini/certify.hpp"
#include "signorini/error.hpp"
#include "signorini/simulate.hpp"
#include "signorini/smooth.hpp"

using namespace signorini;

namespace {

Scene reference_case(const std::string& name, const std::vector<Override>& overrides = {}) {
  return read_scene(SIGNORINI_TEST_DATA "/cases/" + name + ".toml", overrides);
}

Result result_of(const Scene& scene) { return simulate(build_model(scene), scene.run); }

std::string objection_to(const Scene& scene) {
  try {
    static_cast<void>(result_of(scene));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

/// The compliant law with friction, as data.
std::shared_ptr<UserContactLaw> compliant_law(double kn, double kt, double f) {
  using enum State;
  const UserLawForm spring{{.N = 1.0, .gap = -kn}};
  const UserLawGuard lets_go{{{.N = -1.0}}, 0};
  auto law = std::make_shared<UserContactLaw>();
  law->states.push_back({"off", open, {{.N = 1.0}}, {{.T = 1.0}}, {{{{.gap = 1.0}}, 1, Form{.ut = 1.0}}}});
  law->states.push_back({"rests",
                         stick,
                         spring,
                         {{.T = 1.0, .ut = -kt}, kt},
                         {lets_go, {{{.N = -f, .T = -1.0}}, 2}, {{{.N = -f, .T = 1.0}}, 3}}});
  for (const double s : {1.0, -1.0})
    law->states.push_back({"slides",
                           s > 0.0 ? slip_plus : slip_minus,
                           spring,
                           {{.N = s * f, .T = 1.0}},
                           {lets_go, {{{.vn = f * kn / kt, .vt = s}}, 1, Form{.T = -1.0 / kt, .ut = 1.0}}}});
  return law;
}

const std::string pushed_block = R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
run = { t_end = 3.0, rtol = 1e-10, output_dt = 0.1 }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 1.0 }]
supports = [{ node = "block", fix = ["uy"] }]
contacts = [{ node = "block", law = "slider", tangent = [1.0, 0.0], normal_force = 10.0, friction = 0.3 }]
loads = [{ name = "push", node = "block", direction = [1.0, 0.0], amplitude = 6.0 }]
)";

const std::string hopping_block = R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
gravity = [0.0, -9.81]
run = { t_end = 0.6, engine = "ida", rtol = 1e-10, output_dt = 0.1 }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 1.0 }]
springs = [{ node = "block", direction = [1.0, 0.0], stiffness = 40.0 }]
contacts = [{ name = "p", node = "block", law = "compliant", normal = [0.0, 1.0], gap = 0.01, normal_stiffness = 1e5, tangential_stiffness = 5e4, friction = 0.4 }]
loads = [{ node = "block", direction = [1.0, 0.0], amplitude = 6.0, history = { type = "harmonic", omega = 31.0, start = 0.0, end = 0.5 } }]
)";

/// Changes "push" once.
struct Hand : Result {
  double when = 0.0, changed = -1.0;
  History next = History::constant(0.0);
  std::string load = "push";
  long calls = 0;
  bool go_on = true;
  bool steers() const override { return true; }
  bool steer(const Sample& now, Steering& run) override {
    ++calls;
    if (changed < 0.0 && now.t >= when) {
      run.set_load(load, next);
      changed = now.t;
    }
    return go_on;
  }
};

Scene pushed_scene(const std::string& engine) {
  return parse_scene(pushed_block, "pushed", {{"run.engine", engine}, {"run.dt", "1e-3"}});
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/in_code");

TEST_CASE("a load that is a function of one's own moves as its closed form does") {
  Scene closed = reference_case("06_point_compliant_kn1e+06"), own = closed;
  for (std::size_t i = 1; i < 3; ++i) {
    own.loads[i].history = HistorySpec{};
    own.loads[i].history.in_code = History(
        {0.0, 0.1}, {Piece{}, Piece::of(smooth([](auto t) { return sin(31.41592653589793 * t); })), Piece{}});
  }
  for (const Engine engine : {Engine::ida, Engine::newmark}) {
    closed.run.engine = own.run.engine = engine;
    closed.run.dt = own.run.dt = 1e-4;
    const Result a = result_of(closed), b = result_of(own);
    CHECK(a.events.size() > 5);
    REQUIRE(a.events.size() == b.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
      CHECK(a.events[i].type == b.events[i].type);
      CHECK(a.events[i].t == doctest::Approx(b.events[i].t).epsilon(1e-9));
    }
    CHECK((a.rows.back().u - b.rows.back().u).norm() < 1e-10);
  }
}

TEST_CASE("engines that need a closed form refuse functions by name") {
  Scene scene = reference_case("06_point_compliant_kn1e+06");
  scene.loads[1].history.in_code = History(Piece::of([](double t, int) { return t; }));
  for (const Engine engine : {Engine::exact, Engine::friction_iteration}) {
    scene.run.engine = engine;
    scene.run.dt = 1e-3;
    CHECK(objection_to(scene).find("load 2 is a user function; use \"ida\" or \"newmark\"") !=
          std::string::npos);
  }
  Scene belt = parse_scene(pushed_block, "pushed");
  belt.contacts[0].surface_velocity.in_code = scene.loads[1].history.in_code;
  CHECK(objection_to(belt).find("expected a history whose integral is known") != std::string::npos);
}

TEST_CASE("the compliant law as data moves as the built-in one, in any units") {
  for (const double length : {1.0, 1e3}) {  // metres, millimetres
    const Factors factors{1.0, length, 1.0};
    Scene built = parse_scene(hopping_block, "hopping");
    built = scene::rescaled(built, factors);
    Scene own = built;
    own.contacts[0].friction = {};
    own.contacts[0].user_law = compliant_law(1e5 / length, 5e4 / length, 0.4);
    const Result a = result_of(built), b = result_of(own);
    CHECK(b.report.outcome.kind == Outcome::Kind::done);
    CHECK(a.events.size() > 5);
    REQUIRE(a.events.size() == b.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
      CHECK(a.events[i].type == b.events[i].type);
      CHECK(a.events[i].to == kind_of(b.events[i].to));
      CHECK(std::abs(a.events[i].t - b.events[i].t) < 1e-8);
      CHECK(a.events[i].guard_rate.value_or(0.0) ==
            doctest::Approx(b.events[i].guard_rate.value_or(0.0)).epsilon(1e-3));
    }
    CHECK(is_user_law_state(b.events[0].to));
    CHECK((a.rows.back().u - b.rows.back().u).norm() < 1e-7 * length);
    // What it stores and what it loses is all taken from the structure.
    CHECK(b.report.audit.energy.value < 1e-6 * b.report.audit.energy_scale);
  }
}

TEST_CASE("what a law of one's own may not be is told with its state") {
  const Scene good = reference_case("06_point_compliant_kn1e+06");
  const auto message = [&](const auto& spoil) {
    Scene scene = good;
    scene.contacts[0].friction = {};
    auto law = compliant_law(1e6, 1e6, 0.4);
    spoil(*law, scene);
    scene.contacts[0].user_law = law;
    return objection_to(scene);
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(message([](UserContactLaw&, Scene&) {}).empty());
  CHECK(has(message([](UserContactLaw& l, Scene&) { l.states[1].guards[0].next = 9; }),
            "'rests': found next state 9"));
  CHECK(has(message([](UserContactLaw& l, Scene&) { l.states[2].normal.form.N = 0.0; }),
            "'slides': expected N"));
  CHECK(has(message([](UserContactLaw& l, Scene&) { l.states[0].guards.resize(4); }), "found 4 guards"));
  CHECK(has(message([](UserContactLaw& l, Scene&) { l.states[0].tangent.form.at = 1.0; }), "expected forms"));
  CHECK(
      has(message([](UserContactLaw& l, Scene&) { l.states[0].kind = State::inside; }), "expected the kind"));
  CHECK(has(message([](UserContactLaw& l, Scene&) { l.states.clear(); }), "found 0 states"));
  CHECK(has(message([](UserContactLaw&, Scene& s) { s.contacts[0].friction.static_ = 0.4; }),
            "in addition to a user-defined law"));
  CHECK(has(message([](UserContactLaw&, Scene& s) { s.initial = {}, s.initial.is_static = true; }),
            "static start"));
  for (const Engine engine : {Engine::newmark, Engine::friction_iteration})
    CHECK(has(message([&](UserContactLaw&, Scene& s) { s.run.engine = engine, s.run.dt = 1e-3; }),
              "contact 'p' has a user law; use \"ida\""));
}

TEST_CASE("a load is changed on the way, and the motion is that of both loads") {
  for (const std::string engine : {"ida", "newmark"}) {
    CAPTURE(engine);
    const Scene scene = pushed_scene(engine);
    Hand hand;
    hand.when = 0.5;
    hand.report = simulate(build_model(scene), scene.run, hand);
    const double t = hand.changed, v = 3.0 * t;
    CHECK(t >= 0.5);
    CHECK(t < 3.0);
    CHECK(hand.rows.back().u[0] ==
          doctest::Approx(0.5 * v * t + v * v / 6.0).epsilon(engine == "newmark" ? 1e-5 : 1e-9));
    CHECK(hand.report.counters.time_events == 1);
    CHECK(hand.report.audit.energy.value < 1e-6 * hand.report.audit.energy_scale);
    CHECK(hand.calls > 2);
  }
}

TEST_CASE("exact, whose steps are long, is steered at breakpoints") {
  Scene scene = pushed_scene("exact");
  LoadSpec nudge = scene.loads[0];
  nudge.name = "nudge";
  nudge.amplitude = 0.5;
  nudge.history.type = HistoryType::rectangle;
  nudge.history.start = 0.5;
  nudge.history.end = 2.9;
  nudge.history.start_given = true;
  scene.loads.push_back(nudge);
  Hand hand;
  hand.when = 0.5;
  hand.report = simulate(build_model(scene), scene.run, hand);
  CHECK(hand.changed == 0.5);
  // 3 m/s^2 for 0.5 s, then 0.5 N against 3
  CHECK(hand.rows.back().u[0] == doctest::Approx(0.375 + 1.5 * 1.5 / 5.0).epsilon(1e-12));
}

TEST_CASE("what is asked to be certified is steered all the same, and has no certificate") {
  Scene scene = pushed_scene("exact");
  scene.run.certify = Certify::yes;
  Hand hand;
  hand.next = History({0.5}, {History::constant(6.0).piece(0.0), Piece{}});
  const CertifiedReport run = simulate_certified(build_model(scene), scene.run, hand);
  CHECK(hand.changed == 0.0);
  CHECK_FALSE(run.certificate);
  CHECK(run.reason == "loads change during the run through an observer, which a companion run cannot follow");
  // 3 m/s^2 for 0.5 s, then friction alone takes the 1.5 m/s, at 3 m/s^2
  CHECK(hand.rows.back().u[0] == doctest::Approx(0.375 + 0.375).epsilon(1e-12));
}

TEST_CASE(
    "a run that its observer stops at a row or at an event has no later row, whatever the engine's steps") {
  // A mass on a spring, x = sin t, hits a stop at t = 1 and again at 3 + pi: rows between them lie within steps of exact.
  const auto scene = [](const char* engine) {
    return parse_scene(
        fmt::format(
            "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
            "[run]\nt_end = 9.0\noutput_dt = 0.05\nengine = \"{}\"\ninitial = {{ A = {{ vx = 1.0 }} }}\n"
            "[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = 1.0\n[[supports]]\nnode = "
            "\"A\"\nfix = [\"uy\"]\n[[springs]]\nnode = \"A\"\ndirection = [1.0, 0.0]\nstiffness = "
            "1.0\n[[contacts]]\nname = \"stop\"\nnode = \"A\"\nlaw = \"rigid\"\nnormal = [-1.0, "
            "0.0]\ngap = {:.17g}\nrestitution = 1.0\n",
            engine, std::sin(1.0)),
        "test.toml");
  };
  struct Observer final : Result {
    double last = 1e9;        // ends the run at this time
    std::size_t hits = 1000;  // or after so many events
    bool progress(double t) override { return t < last && events.size() < hits; }
  };
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Scene of = scene(engine);
    const Model model = build_model(of);
    Observer by_time;
    by_time.last = 2.55;
    by_time.report = simulate(model, of.run, by_time);
    CHECK(by_time.report.outcome.kind == Outcome::Kind::interrupted);
    CHECK(by_time.report.outcome.t <= 2.55 + 1e-9);
    REQUIRE(!by_time.rows.empty());
    CHECK(by_time.rows.back().t == doctest::Approx(2.55).epsilon(1e-12));
    // The audit ends with the run: energies of the row and of the end are equal.
    CHECK(by_time.report.audit.energy.value < 1e-6);
    Observer by_event;
    by_event.hits = 1;
    by_event.report = simulate(model, of.run, by_event);
    CHECK(by_event.report.outcome.kind == Outcome::Kind::interrupted);
    CHECK(by_event.report.outcome.t == doctest::Approx(1.0).epsilon(1e-6));
    REQUIRE(!by_event.rows.empty());
    CHECK(by_event.rows.back().t <= 1.0 + 1e-6);
    REQUIRE(!by_event.events.empty());
    CHECK(by_event.events.back().t <= 1.0 + 1e-6);
  }
}

TEST_CASE("a change at the start, a history that goes on changing, and a stop") {
  const Scene scene = pushed_scene("ida");
  Hand hand;
  hand.next = History({1.0}, {History::constant(4.0).piece(0.0), Piece{}});
  hand.report = simulate(build_model(scene), scene.run, hand);
  CHECK(hand.changed == 0.0);
  CHECK(hand.rows.back().u[0] ==
        doctest::Approx(0.5 + 1.0 / 6.0).epsilon(1e-8));  // 1 N for a second, then 3 N back
  Hand stops;
  stops.go_on = false;
  CHECK(simulate(build_model(scene), scene.run, stops).outcome.kind == Outcome::Kind::interrupted);
  CHECK(stops.calls == 1);
  Hand wrong;
  wrong.load = "pull";
  CHECK_THROWS_WITH_AS(static_cast<void>(simulate(build_model(scene), scene.run, wrong)),
                       doctest::Contains("found \"pull\", expected a force or a moment of the scene"),
                       SceneError);
}

TEST_CASE("reactions and forces in members follow loads that are changed on the way") {
  Scene scene = parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 2.0, engine = "ida", rtol = 1e-9, output_dt = 0.25, initial = "static" }
damping = { beta = 0.01 }
nodes = { A = [0.0, 0.0], B = [2.0, 0.0] }
sections = { pipe = { EA = 1e4, EI = 1e3, mass_per_length = 0.0 } }
members = [{ nodes = ["A", "B"], section = "pipe" }]
masses = [{ node = "B", mass = 1.0, inertia = 1e-3 }]
supports = [{ node = "A", fix = ["ux", "uy", "rz"] }, { node = "B", fix = ["ux", "uy"] }]
loads = [
  { name = "push", node = "B", direction = [0.6, 0.8], amplitude = 5.0 },
  { name = "lean", nodes = ["A", "B"], direction = [0.0, -1.0], distributed = 3.0 },
]
output = [
  { name = "up", kind = "reaction", at = "B", direction = [0.0, 1.0] },
  { name = "cut", kind = "member_force", at = ["A", "B"], quantity = "M", station = 1.0 },
  { name = "clamp", kind = "member_force", at = ["A", "B"], quantity = "M", station = 0.0 },
  { name = "at-A", kind = "reaction", at = "A", direction = [0.0, 1.0] },
  { name = "both", kind = "combination", terms = { up = 2.0, "at-A" = -1.0 } },
]
)",
                            "held");
  const auto values = [&](const std::string& load, double to) {
    Hand hand;
    hand.load = load;  // at t = 0: at rest one step of ida is the run
    hand.next = History::constant(to);
    hand.report = simulate(scene, hand);
    CHECK(hand.changed == 0.0);
    CHECK(hand.report.audit.reactions->value < 1e-9);
    CHECK(hand.report.response[0].last == hand.responses.back().values[0]);
    return std::pair(hand.responses.front().values, hand.responses.back().values);
  };
  // A beam held at A, propped at B, under q: 3/8 q l at the prop, q l^2 / 8 at the clamp.
  const auto [before, unpushed] = values("push", 0.0);
  CHECK(before[0] == doctest::Approx(3.0 / 8.0 * 6.0 - 4.0));
  CHECK(std::abs(before[2]) == doctest::Approx(12.0 / 8.0));
  CHECK(before[4] == doctest::Approx(2.0 * before[0] - 5.0 / 8.0 * 6.0));
  CHECK(unpushed[0] == doctest::Approx(3.0 / 8.0 * 6.0));
  CHECK(unpushed[2] == doctest::Approx(before[2]));
  const auto [same, unleaned] = values("lean", 1.0);
  CHECK(same == before);
  CHECK(unleaned[0] == doctest::Approx(3.0 / 8.0 * 2.0 - 4.0));
  CHECK(unleaned[1] == doctest::Approx(0.0).epsilon(1e-12));
  CHECK(unleaned[2] == doctest::Approx(before[2] / 3.0));
  CHECK(unleaned[4] == doctest::Approx(2.0 * unleaned[0] - 5.0 / 8.0 * 2.0));
}

TEST_CASE("a run goes on from the last state of another") {
  const Scene whole = reference_case("06_point_compliant_kn1e+06");
  Scene first = whole, second = whole;
  for (Scene* scene : {&first, &second}) scene->run.output_times.reset();
  first.run.t_end = 0.3;
  const Model model = build_model(first);
  const Result a = simulate(model, first.run);
  second.initial = {};
  second.initial.saved = last_state(model, a);
  second.run.t_end = 0.3;
  for (LoadSpec& load : second.loads) load.history.shift = load.history.start_given ? -0.3 : 0.0;
  const Result b = result_of(second), c = result_of(whole);
  CHECK((b.rows.back().u - c.rows.back().u).norm() < 1e-8);
  CHECK((a.rows.back().u - c.rows.back().u).norm() > 1e-6);
  CHECK_THROWS_AS(static_cast<void>(last_state(model, Result{})), std::invalid_argument);
}

TEST_CASE("a run goes on with the states and memories of user-defined laws, in any units") {
  using enum State;
  for (const double length : {1.0, 1e3}) {  // metres, millimetres
    CAPTURE(length);
    Scene whole = parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [0.0, -9.81]
run = { t_end = 0.9, engine = "ida", rtol = 1e-10, initial = { ball = { vy = -3.0 } } }
nodes = { ball = [0.0, 0.0] }
masses = [{ node = "ball", mass = 2.0 }]
supports = [{ node = "ball", fix = ["ux"] }]
contacts = [{ name = "pad", node = "ball", law = "compliant", normal = [0.0, 1.0], gap = 0.1, normal_stiffness = 1e4 }]
)",
                              "crushed");
    whole = scene::rescaled(whole, {1.0, length, 1.0});
    // Elastic up to Y, crushed there; keeps its dent p.
    const double kn = 1e4 / length, Y = 150.0;
    auto pad = std::make_shared<UserContactLaw>();
    const UserLawForm elastic{{.N = 1.0, .gap = -kn}, kn}, smooth{{.T = 1.0}};
    pad->states = {{"off", open, {{.N = 1.0}}, smooth, {{{{.gap = 1.0}, -1.0}, 1}}},
                   {"on", closed, elastic, smooth, {{{{.N = -1.0}}, 0}, {{{.N = 1.0, .constant = Y}}, 2}}},
                   {"crushed",
                    slip_minus,
                    {{.N = 1.0, .constant = Y}},
                    smooth,
                    {{{{.vn = -1.0}}, 1, Form{.gap = 1.0, .constant = Y / kn}}}}};
    whole.contacts[0].user_law = pad;
    const Result c = simulate(whole);
    REQUIRE(c.events.size() > 5);  // on, crushed, back, off; with less speed on and off again
    // In flight over the dent, and while the pad is being crushed.
    for (const double at : {0.5 * (c.events[3].t + c.events[4].t), 0.5 * (c.events[1].t + c.events[2].t)}) {
      CAPTURE(at);
      Scene first = whole, second = whole;
      first.run.t_end = at;
      second.run.t_end = whole.run.t_end - at;
      const Model model = build_model(first);
      const Result a = simulate(model, first.run);
      second.initial = {};
      second.initial.saved = last_state(model, a);
      const Result b = simulate(second);
      REQUIRE(a.events.size() + b.events.size() == c.events.size());
      for (std::size_t i = 0; i < b.events.size(); ++i)
        CHECK(std::abs(at + b.events[i].t - c.events[a.events.size() + i].t) < 1e-7);
      CHECK(std::abs(b.rows.back().u[0] - c.rows.back().u[0]) < 1e-7 * length);
      CHECK(b.rows.back().contacts[0].memory == doctest::Approx(c.rows.back().contacts[0].memory));
      CHECK(std::abs(c.rows.back().contacts[0].memory) > 0.01 * length);
      second.contacts[0].user_law = {};
      CHECK(objection_to(second).find("of a user-defined law, but the scene has no such contact or state") !=
            std::string::npos);
    }
  }
}

TEST_SUITE_END();
