// law = "yielding": a pad that yields, against closed forms.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "scene/quantities.hpp"
#include "signorini/error.hpp"
#include "signorini/sensitivity.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

// A block of 2 kg that flies at 3 m/s to a pad 0.1 m away, without gravity; pushed back at t = 0.15 s.
constexpr double m = 2.0, v = 3.0, gap = 0.1, kn = 1e4, Y = 150.0, F = 40.0, t_push = 0.15;

struct Given {
  double degrees = 0.0;  // by which the scene is turned
  bool small = false;    // in kN, kg, mm, ms
  double speed = v;
  double t_end = 0.4;
  double push = F;
  std::string engine = "ida";
};

std::string block_text(const Given& given) {
  const double angle = given.degrees * std::numbers::pi / 180.0, nx = -std::sin(angle), ny = std::cos(angle);
  const double force = given.small ? 1e-3 : 1.0, length = given.small ? 1e3 : 1.0, time = length;
  return fmt::format(
      R"(schema = 1
units = {units}
[run]
t_end = {t_end}
engine = "{engine}"
rtol = 1e-11
dt = {dt}
initial = {{ block = {{ vx = {vx}, vy = {vy} }} }}
[nodes]
block = [0.0, 0.0]
[[masses]]
node = "block"
mass = {m}
[[contacts]]
name = "pad"
node = "block"
law = "yielding"
normal = [{nx}, {ny}]
gap = {gap}
normal_stiffness = {kn}
yield_force = {Y}
[[loads]]
node = "block"
direction = [{fx}, {fy}]
amplitude = {F}
history = {{ type = "rectangle", start = {start}, end = {end} }}
)",
      fmt::arg("units", given.small ? R"({ force = "kN", mass = "kg", length = "mm", time = "ms" })"
                                    : R"({ force = "N", mass = "kg", length = "m", time = "s" })"),
      fmt::arg("t_end", given.t_end * time), fmt::arg("engine", given.engine), fmt::arg("dt", 1e-4 * time),
      fmt::arg("vx", -given.speed * nx), fmt::arg("vy", -given.speed * ny), fmt::arg("m", m),
      fmt::arg("nx", nx), fmt::arg("ny", ny), fmt::arg("gap", gap * length),
      fmt::arg("kn", kn * force / length), fmt::arg("Y", Y * force), fmt::arg("fx", -nx), fmt::arg("fy", -ny),
      fmt::arg("F", given.push * force), fmt::arg("start", t_push * time), fmt::arg("end", 10.0 * time));
}

Scene block(const Given& given) { return parse_scene(block_text(given), "yielding.toml"); }

std::vector<Event> events_of_pad(const Result& result) {
  std::vector<Event> events;
  for (const Event& e : result.events)
    if (e.contact >= 0) events.push_back(e);
  return events;
}

struct Expected {
  EventType type;
  double t, gap, vn;
};

/// Two landings: elastic to Y, crushed, unloaded, off; then once more from the dent, under the load F.
std::vector<Expected> closed_form() {
  const double w = std::sqrt(kn / m), deflection = Y / kn;
  const double dent = (0.5 * m * v * v - 0.5 * Y * deflection) / Y, rebound = Y / std::sqrt(kn * m);
  std::vector<Expected> all;
  double t = gap / v;
  all.push_back({EventType::contact, t, 0.0, -v});
  t += std::asin(Y * w / (kn * v)) / w;
  const double v_yield = std::sqrt(v * v - Y * Y / (kn * m));
  all.push_back({EventType::slip, t, -deflection, -v_yield});
  t += m * v_yield / Y;
  all.push_back({EventType::stick, t, -dent - deflection, 0.0});
  t += 0.5 * std::numbers::pi / w;
  all.push_back({EventType::separation, t, -dent, rebound});
  // h + rebound tau - F tau^2 / (2 m) = 0
  const double h = rebound * (t_push - t), a = F / m;
  const double tau = (rebound + std::sqrt(rebound * rebound + 2.0 * a * h)) / a, v2 = a * tau - rebound;
  t = t_push + tau;
  all.push_back({EventType::contact, t, -dent, -v2});
  // x = F/kn + A sin(w s - phi), A sin(phi) = F/kn, A w cos(phi) = v2; yields at x = Y/kn
  const double A = std::hypot(F / kn, v2 / w), phi = std::asin(F / kn / A);
  const double phase = std::asin((Y - F) / kn / A);
  t += (phase + phi) / w;
  const double v_yield2 = A * w * std::cos(phase);
  all.push_back({EventType::slip, t, -dent - deflection, -v_yield2});
  const double further = 0.5 * m * v_yield2 * v_yield2 / (Y - F);
  t += m * v_yield2 / (Y - F);
  all.push_back({EventType::stick, t, -dent - deflection - further, 0.0});
  // From rest at N = -Y about N = -F: off at x = 0.
  t += (std::numbers::pi - std::acos(F / (Y - F))) / w;
  all.push_back({EventType::separation, t, -dent - further, std::sqrt(Y * (Y - 2.0 * F) / (kn * m))});
  return all;
}

std::string objection_to(const Scene& scene) {
  try {
    static_cast<void>(simulate(scene));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/yielding");

TEST_CASE("yielding: two landings are those of the closed form, at odd angles and in other units") {
  const std::vector<Expected> expected = closed_form();
  for (const Given& given : {Given{}, Given{.degrees = 37.3}, Given{.degrees = -141.9}, Given{.small = true},
                             Given{.degrees = 68.7, .small = true}}) {
    CAPTURE(given.degrees);
    CAPTURE(given.small);
    const double force = given.small ? 1e-3 : 1.0, length = given.small ? 1e3 : 1.0, time = length;
    const Result result = simulate(block(given));
    CHECK(result.report.outcome.kind == Outcome::Kind::done);
    const std::vector<Event> events = events_of_pad(result);
    REQUIRE(events.size() == expected.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      CAPTURE(i);
      CHECK(events[i].type == expected[i].type);
      CHECK(std::abs(events[i].t / time - expected[i].t) < 1e-8);
      CHECK(std::abs(*events[i].gap / length - expected[i].gap) < 1e-8);
      CHECK(std::abs(events[i].vn * time / length - expected[i].vn) < 1e-6);
    }
    const double dents = -expected.back().gap;
    CHECK(result.rows.back().contacts[0].memory / length == doctest::Approx(-dents).epsilon(1e-7));
    CHECK(result.report.peaks[0].N / force == doctest::Approx(Y).epsilon(1e-9));
    CHECK(std::abs(result.rows.back().contacts[0].ut) < 1e-9 * length);
    for (const Result::Row& row : result.rows) CHECK(row.contacts[0].T == 0.0);
    // Off again, it has taken Y times the dent.
    const Energy& energy = result.rows.back().energy;
    CHECK(energy.friction / (force * length) == doctest::Approx(Y * dents).epsilon(1e-7));
    CHECK(result.report.audit.energy.value < 1e-7 * result.report.audit.energy_scale);
  }
}

TEST_CASE("yielding: a slow block only compresses the pad, which gives back all") {
  const double slow = 0.99 * Y / std::sqrt(kn * m);
  const Result result = simulate(block({.degrees = 12.6, .speed = slow, .push = 0.0}));
  const std::vector<Event> events = events_of_pad(result);
  REQUIRE(events.size() == 2);
  CHECK(events[1].type == EventType::separation);
  CHECK(events[1].t - events[0].t == doctest::Approx(std::numbers::pi * std::sqrt(m / kn)).epsilon(1e-8));
  CHECK(events[1].vn_after == doctest::Approx(slow).epsilon(1e-8));
  CHECK(result.report.peaks[0].N == doctest::Approx(0.99 * Y).epsilon(1e-8));
  CHECK(result.rows.back().contacts[0].memory == 0.0);
}

TEST_CASE("yielding: a start deeper than the pad can bear has dented it") {
  // 0.03 m deep at rest: of these Y / kn = 0.015 m come back.
  std::string text = block_text({.degrees = 0.0, .t_end = 0.1, .push = 0.0});
  const std::string moves = "vx = 0, vy = -3";
  const std::size_t at = text.find("vx = ");
  REQUIRE(at != std::string::npos);
  text.replace(at, text.find(" }", at) - at, "uy = -0.13");
  const Result result = simulate(parse_scene(text, "yielding.toml"));
  const std::vector<Event> events = events_of_pad(result);
  REQUIRE(!events.empty());
  CHECK(events.back().type == EventType::separation);
  CHECK(events.back().t == doctest::Approx(0.5 * std::numbers::pi * std::sqrt(m / kn)).epsilon(1e-7));
  CHECK(events.back().vn_after == doctest::Approx(Y / std::sqrt(kn * m)).epsilon(1e-7));
  CHECK(result.rows.back().contacts[0].memory == doctest::Approx(-0.015).epsilon(1e-9));
}

TEST_CASE("yielding: behind a spring at a node that moves along the normal alone, without mass") {
  const double k = 2.5e4, both = k * kn / (k + kn);
  const Result result = simulate(parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 0.2, engine = "ida", rtol = 1e-11, initial = {{ block = {{ vy = -3.0 }}, foot = {{ vy = -3.0 }} }} }}
nodes = {{ block = [0.0, 1.0], foot = [0.0, 0.0] }}
masses = [{{ node = "block", mass = 2.0 }}]
springs = [{{ node = "block", against = "foot", direction = [0.0, 1.0], stiffness = {} }}]
contacts = [{{ name = "pad", node = "foot", law = "yielding", normal = [0.0, 1.0], gap = 0.1, normal_stiffness = 1e4, yield_force = 150.0 }}]
)",
                                                         k),
                                             "spring.toml"));
  const std::vector<Event> events = events_of_pad(result);
  REQUIRE(events.size() == 4);
  CHECK(events[3].type == EventType::separation);
  const double dent = (0.5 * m * v * v - 0.5 * Y * Y / both) / Y;
  CHECK(result.rows.back().contacts[0].memory == doctest::Approx(-dent).epsilon(1e-7));
  CHECK(result.rows.back().v[1] == doctest::Approx(Y / std::sqrt(both * m)).epsilon(1e-7));
}

TEST_CASE("yielding: pads of a stop keep their own dents") {
  // 2 kg at 3 m/s to the right, Y = 150 there; it comes back with Y / sqrt(kn m), and is crushed on the left no more.
  const Scene scene = parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 0.35, engine = "ida", rtol = 1e-11, initial = { block = { vx = 3.0 } } }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 2.0 }]
stops = [{ name = "guide", node = "block", law = "yielding", direction = [1.0, 0.0], gaps = [0.1, 0.05], normal_stiffness = 1e4, yield_force = 150.0 }]
)",
                                  "stop.toml");
  REQUIRE(scene.contacts.size() == 2);
  CHECK(scene.contacts[0].name == "guide+");
  const Result result = simulate(scene);
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
  const std::vector<ContactSample>& last = result.rows.back().contacts;
  CHECK(last[0].memory == doctest::Approx(-(9.0 - 1.125) / 150.0).epsilon(1e-7));
  // It reaches yield_force there exactly, with no speed left.
  CHECK(std::abs(last[1].memory) < 1e-8);
  CHECK(result.report.peaks[1].N == doctest::Approx(Y).epsilon(1e-7));
  CHECK(result.rows.back().v[0] == doctest::Approx(Y / std::sqrt(kn * m)).epsilon(1e-7));
}

TEST_CASE("yielding: under its weight a block bounces on without a further dent") {
  // After the first landing the motion is conservative: each bounce reaches yield_force with no speed left.
  const Result result = simulate(parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [0.0, -9.81]
run = { t_end = 3.0, engine = "ida", rtol = 1e-10, initial = { block = { vy = -3.0 } } }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 2.0 }]
contacts = [{ name = "pad", node = "block", law = "yielding", normal = [0.0, 1.0], gap = 0.1, normal_stiffness = 1e4, yield_force = 150.0 }]
)",
                                             "weight.toml"));
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
  const double W = 2.0 * 9.81, landing = 0.5 * m * v * v + W * gap;
  const double dent = (landing + W * Y / kn - 0.5 * Y * Y / kn) / (Y - W);
  CHECK(result.rows.back().contacts[0].memory == doctest::Approx(-dent).epsilon(1e-5));
  long landings = 0;
  for (const Event& e : events_of_pad(result))
    if (e.type == EventType::contact) ++landings;
  CHECK(landings > 5);
}

TEST_CASE("yielding: other engines refuse it by name, auto takes ida") {
  for (const char* engine : {"newmark", "friction-iteration"}) {
    CAPTURE(std::string(engine));
    const std::string message = objection_to(block({.engine = engine}));
    CHECK(message.find(fmt::format(
              "engine \"{}\" does not support law \"yielding\" of contact 'pad'; use \"ida\"", engine)) !=
          std::string::npos);
    CHECK(message.starts_with("yielding.toml:3:"));  // that of [run]
  }
  const Result result = simulate(block({.engine = "auto"}));
  CHECK(result.report.method.engine == Engine::ida);
  CHECK(events_of_pad(result).size() == 8);
}

TEST_CASE("yielding: sensitivities refuse it, since the derivative of the dent is not followed") {
  const SceneReader read = [](const std::vector<Override>& changes) {
    return parse_scene(block_text({}), "yielding.toml", changes);
  };
  CHECK_THROWS_WITH_AS(
      static_cast<void>(sensitivities(read, {"contacts.pad.yield_force"})),
      doctest::Contains("contacts.pad.law: sensitivities cannot differentiate a contact law with memory"),
      SceneError);
}

TEST_CASE("yielding: a scene in other units is the same motion, and a run goes on in two halves") {
  const Scene whole = block({.degrees = 21.4});
  const Result reference = simulate(whole);
  const std::vector<Event> all = events_of_pad(reference);
  const Factors odd{3.7, 0.21, 5.3};
  const std::vector<Event> other = events_of_pad(simulate(scene::rescaled(whole, odd)));
  REQUIRE(other.size() == all.size());
  for (std::size_t i = 0; i < all.size(); ++i) CHECK(std::abs(other[i].t / odd.time - all[i].t) < 1e-8);
  // While it is crushed, in flight over the dent, and while it is crushed again.
  for (const std::size_t i : {1UL, 3UL, 5UL}) {
    CAPTURE(i);
    const double at = 0.5 * (all[i].t + all[i + 1].t);
    Scene first = whole, second = whole;
    first.run.t_end = at;
    second.run.t_end = whole.run.t_end - at;
    for (LoadSpec& load : second.loads) load.history.shift = -at;
    const Model model = build_model(first);
    const Result a = simulate(model, first.run);
    second.initial = {};
    second.initial.saved = last_state(model, a);
    const Result b = simulate(second);
    REQUIRE(events_of_pad(a).size() + events_of_pad(b).size() == all.size());
    CHECK(at + b.events.back().t == doctest::Approx(all.back().t).epsilon(1e-8));
    CHECK(b.rows.back().contacts[0].memory ==
          doctest::Approx(reference.rows.back().contacts[0].memory).epsilon(1e-8));
  }
}

TEST_SUITE_END();
