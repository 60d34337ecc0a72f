// Only ForceLayout knows where the forces and the guards of a contact stand: with unused places and slots after those of
// each contact, a different number for each, runs, orbits and derivatives are the same.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "behaviour/orbit_scenes.hpp"
#include "run/engines.hpp"
#include "signorini/modified_law.hpp"
#include "signorini/sensitivity.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// Unused places and slots after the contacts in turn: N of contact c is no multiple of its number, nor is its first
/// guard.
constexpr std::uint32_t unused_forces[] = {0, 2, 1}, unused_guards[] = {2, 0, 1};

Scene spread_out(Scene scene) {
  for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
    scene.contacts[k].unused_forces = unused_forces[k % 3];
    scene.contacts[k].unused_guards = unused_guards[k % 3];
  }
  return scene;
}

SceneReader spread_out(const SceneReader& read) {
  return [read](const std::vector<Override>& changes) { return spread_out(read(changes)); };
}

/// The compliant law without a place for T.
class FrictionlessLaw final : public ModifiedLaw {
 public:
  FrictionlessLaw() : ModifiedLaw(Law::compliant, true, 0) {}
};

/// Removes the friction of every second compliant contact, the first one included.
void make_frictionless(Scene& scene) {
  for (std::size_t k = 0; k < scene.contacts.size(); k += 2) {
    ContactSpec& contact = scene.contacts[k];
    if (contact.law != Law::compliant || contact.pendulum_surface) continue;
    contact.friction = {};
    contact.tangential_stiffness.reset();
    contact.initial_shear = contact.tangential_damping = 0.0;
  }
}

Scene without_tangents(Scene scene) {
  const auto law = std::make_shared<FrictionlessLaw>();
  for (ContactSpec& contact : scene.contacts)
    if (contact.law == Law::compliant && !contact.friction.any() && !contact.user_law) contact.user_law = law;
  return scene;
}

struct Case {
  std::string file;
  std::vector<Override> changes = {};
};

/// Scenes of more than one contact: with the first one alone, places are the same.
const std::vector<Case> cases{
    {SIGNORINI_MODELS "/pipeline.toml", {{"run.t_end", "0.6"}}},
    {SIGNORINI_MODELS "/lift-off.toml"},
    {SIGNORINI_MODELS "/matrices.toml"},
    {SIGNORINI_MODELS "/rigid-frame.toml"},
    {SIGNORINI_MODELS "/chain.toml", {{"run.t_end", "3.0"}, {"run.frames", "[0.0]"}}},
    {SIGNORINI_TEST_DATA "/cases/05b_two_mass_symmetric.toml"},
    {SIGNORINI_TEST_DATA "/cases/05g_two_mass_compliant.toml"},
    {SIGNORINI_TEST_DATA "/cases/08b_lumped_singular_M.toml"},
};

struct Run {
  Result result;
  Report report;
};

/// nullopt: the engine does not take the scene.
std::optional<Run> run_with(const Scene& scene, Engine engine) {
  const Model model = build_model(scene);
  RunSpec spec = scene.run;
  spec.engine = engine;
  if (engine == Engine::newmark && !spec.dt)
    spec.dt = 1e-4 * spec.t_end;  // longer steps of the pipeline amplify one rounding to 1e-7 s
  try {
    run::engine_row(spec.engine).refuse(model, spec);
  } catch (const SceneError&) {
    return std::nullopt;
  }
  Run run;
  run.report = simulate(model, spec, run.result);
  return run;
}

/// A mass between a spring and a harmonic load, with a stop on either side, on a rough floor, and a second mass that
/// rubs on the first one's side.
std::string between_stops() {
  return matrix_scene(
      "t_end = 9.0",
      "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[2.0, -1.0], [-1.0, 2.0]]\n"
      "damping = [[0.3, -0.1], [-0.1, 0.3]]",
      "law = \"compliant\"\nnormal = { d0 = -1.0 }\ngap = 0.4\nnormal_stiffness = 50.0",
      "[[contacts]]\nname = \"left\"\nlaw = \"compliant\"\nnormal = { d0 = 1.0 }\ngap = 0.3\n"
      "normal_stiffness = 70.0\n"
      "[[contacts]]\nname = \"pad\"\nlaw = \"slider\"\ntangent = { d1 = 1.0 }\nnormal_force = 1.0\n"
      "friction = 0.1\ntangential_stiffness = 20.0\n"
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1.5\n"
      "history = { type = \"harmonic\", omega = 1.3 }\n"
      "[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = { d0 = 1.0 }\n");
}

void check_alike(double a, double b, double part) {
  CHECK((std::isnan(a) == std::isnan(b)));
  if (!std::isnan(a)) CHECK(std::abs(b - a) <= part * std::max(1.0, std::abs(a)));
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/force_layout");

TEST_CASE(
    "Each contact has its numbers of places and slots, and a part of the contacts has a layout of its own") {
  const ForceLayout layout({{1, 3, 0, 2}, {0, 1, 2, 0}, {2, 2, 1, 1}});
  CHECK(layout.contacts() == 3);
  CHECK(layout.size() == 2 + 3 + 4 + 1);  // the second contact has no tangential force
  CHECK(layout.guard_count() == 5 + 1 + 3);
  CHECK(layout.normal(1) == 2);
  CHECK(layout.normal(2) == 5);
  CHECK(layout.tangent(2, 1) == 7);
  CHECK(layout.tangents(1) == 0);
  CHECK(layout.guard(2, 1) == 7);
  CHECK(layout.guards(1) == 1);
  CHECK(layout.guard_end(0) == layout.guard(1));
  const std::vector<std::size_t> contacts{0, 0, 1, 1, 1, 2, 2, 2, 2}, of_guards{0, 0, 0, 0, 0, 1, 2, 2, 2},
      within{0, 1, 2, 3, 4, 0, 0, 1, 2};
  const std::vector<bool> used{true, true, true, false, false, true, true, true, false};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    CAPTURE(i);
    CHECK(layout.contact_of(i) == contacts[i]);
    CHECK(layout.is_normal(i) == (i == 0 || i == 2 || i == 5));
    CHECK(layout.is_used(i) == used[i]);
    CHECK(layout.contact_of_guard(i) == of_guards[i]);
    CHECK(layout.guard_within(i) == within[i]);
  }
  const ForceLayout part = layout.part({2, 0});
  CHECK(part.size() == 6);
  CHECK(part.normal(1) == 4);
  CHECK(part.guard(1) == 3);
  CHECK(part.tangents(0) == 2);
  // All contacts without a tangential force share the place after all others.
  const ForceLayout some({{0, 1, 0, 0}, {1, 3, 1, 0}, {0, 1, 0, 0}}), one = some.part({1}),
                                                                      two = some.part({2, 1});
  CHECK(some.size() == 1 + 3 + 1 + 1);
  CHECK(some.tangent(0) == 5);
  CHECK(some.tangent(1) == 2);
  CHECK(some.tangent(2) == 5);
  CHECK_FALSE(some.is_used(5));
  CHECK(some.is_used(4));
  CHECK_FALSE(some.is_normal(5));
  CHECK(one.size() == 3);
  CHECK(two.tangent(0) == 4);
  CHECK(two.size() == 5);
  CHECK(ForceLayout().size() == 0);
  CHECK(ForceLayout().guard_count() == 0);
}

TEST_CASE("Results do not depend on where forces and guards stand") {
  int runs = 0;
  std::size_t events = 0;
  for (const Case& c : cases)
    for (const Engine engine : {Engine::exact, Engine::ida, Engine::newmark}) {
      CAPTURE(c.file);
      CAPTURE(std::string(to_string(engine)));
      const Scene scene = read_scene(c.file, c.changes);
      const auto is = run_with(scene, engine), spread = run_with(spread_out(scene), engine);
      REQUIRE(is.has_value() == spread.has_value());
      if (!is) continue;
      ++runs;
      CHECK(spread->report.outcome.kind == is->report.outcome.kind);
      CHECK(spread->report.law_checks.violated == is->report.law_checks.violated);
      const double near = (engine == Engine::ida ? 1e2 * scene.run.rtol : 1e-9) * scene.run.t_end;
      REQUIRE(spread->result.events.size() == is->result.events.size());
      events += is->result.events.size();
      for (std::size_t i = 0; i < is->result.events.size(); ++i) {
        const Event &a = is->result.events[i], &b = spread->result.events[i];
        CHECK(b.type == a.type);
        CHECK(b.contact == a.contact);
        CHECK(std::abs(b.t - a.t) <= near);
      }
    }
  CHECK(runs >= 15);
  CHECK(events >= 100);
}

TEST_CASE("A contact without a place for T moves as one without friction") {
  int runs = 0;
  std::size_t events = 0, contacts = 0;
  std::vector<Scene> scenes;
  for (const Case& c : cases) scenes.push_back(read_scene(c.file, c.changes));
  scenes.push_back(reader_of_text(between_stops())({}));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    Scene& scene = scenes[i];
    make_frictionless(scene);
    const Scene lean = without_tangents(scene);
    const std::ptrdiff_t frictionless =
        std::count_if(lean.contacts.begin(), lean.contacts.end(),
                      [](const ContactSpec& c) { return c.user_law.has_value(); });
    if (frictionless == 0) continue;
    contacts += static_cast<std::size_t>(frictionless);
    CHECK(build_model(lean).force_count() == build_model(scene).force_count() + 1 - frictionless);
    for (const Engine engine : {Engine::exact, Engine::ida, Engine::newmark}) {
      CAPTURE(i);
      CAPTURE(std::string(to_string(engine)));
      const auto is = run_with(scene, engine), without = run_with(lean, engine);
      REQUIRE(is.has_value() == without.has_value());
      if (!is) continue;
      ++runs;
      CHECK(without->report.outcome.kind == is->report.outcome.kind);
      CHECK(without->report.law_checks.violated == is->report.law_checks.violated);
      const double near = (engine == Engine::ida ? 1e2 * scene.run.rtol : 1e-9) * scene.run.t_end;
      REQUIRE(without->result.events.size() == is->result.events.size());
      events += is->result.events.size();
      for (std::size_t e = 0; e < is->result.events.size(); ++e) {
        const Event &a = is->result.events[e], &b = without->result.events[e];
        CHECK(b.type == a.type);
        CHECK(b.contact == a.contact);
        CHECK(std::abs(b.t - a.t) <= near);
      }
      CHECK((without->result.rows.back().u - is->result.rows.back().u).norm() <=
            near * (1.0 + is->result.rows.back().v.norm()));
    }
  }
  CHECK(contacts >= 4);
  CHECK(runs >= 6);
  CHECK(events >= 30);
}

TEST_CASE("The contacts of a spread model stand where the scene puts them") {
  const Model model = build_model(spread_out(read_scene(cases[0].file)));
  REQUIRE(model.contacts.size() >= 2);
  CHECK(model.layout.normal(1) == 2);
  CHECK(model.layout.guard(1) == 5);
  CHECK(model.layout.guard_count() != 3 * model.contacts.size());
  CHECK(model.force_count() == static_cast<Eigen::Index>(2 * model.contacts.size() + 2));
}

TEST_CASE("An orbit and its multipliers do not depend on where forces and guards stand") {
  const SceneReader read = reader_of_text(between_stops());
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const SceneReader with = [&](const std::vector<Override>& changes) {
      std::vector<Override> all{{"run.engine", engine}, {"run.rtol", "1e-10"}};
      all.insert(all.end(), changes.begin(), changes.end());
      return read(all);
    };
    const Orbit is = find_orbit(with), spread = find_orbit(spread_out(with));
    REQUIRE(is.found);
    REQUIRE(spread.found);
    CHECK(spread.period == is.period);
    CHECK(spread.stable == is.stable);
    REQUIRE(is.sequence.size() >= 4);
    REQUIRE(spread.sequence.size() == is.sequence.size());
    for (std::size_t i = 0; i < is.sequence.size(); ++i) {
      CHECK(spread.sequence[i].contact == is.sequence[i].contact);
      CHECK(spread.sequence[i].type == is.sequence[i].type);
      check_alike(is.sequence[i].t, spread.sequence[i].t, 1e-7);
    }
    REQUIRE(spread.multipliers.size() == is.multipliers.size());
    for (std::size_t i = 0; i < is.multipliers.size(); ++i)
      check_alike(std::abs(is.multipliers[i]), std::abs(spread.multipliers[i]), 1e-6);
  }
}

TEST_CASE("Derivatives do not depend on where forces and guards stand") {
  const std::vector<std::string> keys{"contacts.*.friction", "loads.1.amplitude"};
  struct Way {
    const char *engine, *flow;
    SensitivityOptions options;
  };
  for (const Way& way : {Way{"exact", "auto", {}}, Way{"exact", "taylor", {true, false}},
                         Way{"ida", "auto", {}}, Way{"newmark", "auto", {false, true}}}) {
    CAPTURE(way.engine);
    CAPTURE(way.flow);
    std::vector<Override> changes{{"run.t_end", "0.25"}, {"run.engine", way.engine}};
    if (std::string(way.engine) == "exact") changes.push_back({"run.flow", way.flow});
    if (std::string(way.engine) == "newmark") changes.push_back({"run.dt", "2e-4"});
    const SceneReader read = reader_of(cases[0].file, changes);
    const Sensitivities is = sensitivities(read, keys, nullptr, way.options),
                        spread = sensitivities(spread_out(read), keys, nullptr, way.options);
    REQUIRE(is.events.size() > 10);
    REQUIRE(spread.events.size() == is.events.size());
    double largest = 0.0;
    for (std::size_t p = 0; p < keys.size(); ++p) {
      CHECK(is.parameters[p].reason == spread.parameters[p].reason);
      double size = 0.0;
      for (std::size_t i = 0; i < is.events.size(); ++i)
        if (const double rate = is.event_rates[i][p].t; !std::isnan(rate))
          size = std::max(size, std::abs(rate));
      largest = std::max(largest, size);
      const double part = std::string(way.engine) == "ida" ? 1e-3 : 1e-6;
      for (std::size_t i = 0; i < is.events.size(); ++i) {
        const double a = is.event_rates[i][p].t, b = spread.event_rates[i][p].t;
        CHECK(std::isnan(a) == std::isnan(b));
        if (!std::isnan(a)) CHECK(std::abs(b - a) <= part * size);
      }
    }
    CHECK(largest > 0.0);
  }
}

TEST_SUITE_END();
