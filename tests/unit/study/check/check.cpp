#include "study/check/check.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

check::CheckReport checked(const Scene& scene) { return check::check(scene, build_model(scene)); }

std::string why_not(const Scene& scene) {
  try {
    (void)checked(scene);
  } catch (const SceneError& e) {
    return e.what();
  }
  return {};
}

}  // namespace

TEST_SUITE("unit/study/check/check") {
  TEST_CASE("the pipeline: mass, contacts, breakpoints, cost") {
    const check::CheckReport r = checked(pipeline());
    REQUIRE(r.mass);
    CHECK(r.mass->total == doctest::Approx(9.6));
    CHECK(r.mass->x == doctest::Approx((7.2 * 9.0) / 9.6));
    CHECK(r.mass->y == doctest::Approx((2.4 * 3.0 + 7.2 * 6.0) / 9.6));
    CHECK(r.mass->moving_x == doctest::Approx(9.6));
    CHECK(r.mass->moving_y == doctest::Approx(9.6));
    REQUIRE(r.contacts.size() == 2);
    CHECK(r.contacts[0].state == State::stick);
    CHECK(r.contacts[0].N == doctest::Approx(-58.86));
    CHECK(r.contacts[1].N == doctest::Approx(-35.316));
    CHECK(r.free_motions ==
          std::vector<std::string>{"horizontal motion held at contacts 'first' and 'second'"});
    REQUIRE(r.discontinuities.size() == 2);
    CHECK(r.discontinuities[0].t == 0.0);
    CHECK(r.discontinuities[1].t == doctest::Approx(0.1));
    CHECK(r.discontinuities[1].jump);
    CHECK(r.discontinuities[1].description == "load 1");
    CHECK(r.cost.unknowns == 106);
    CHECK(r.method.engine == Engine::ida);
    CHECK(r.cost.estimate.steps > 5e5);  // 67 in the period of a frequency that stays quiet
    CHECK(r.cost.estimate.steps < 1e6);
    REQUIRE(r.cost.exact);
    CHECK(*r.cost.exact < 0.5 * r.cost.estimate.seconds);
    CHECK(r.massless == 0);
    CHECK(r.stiffness.size() == 4);
  }

  TEST_CASE("a cutoff that leaves out most of the compliance of contact nodes is pointed out") {
    const auto warned = [](const char* cutoff) {
      const check::CheckReport r =
          checked(read_scene(SIGNORINI_MODELS "/dry-joint.toml", {{"reduction.cutoff_omega", cutoff}}));
      return std::any_of(r.warnings.begin(), r.warnings.end(), [](const std::string& warning) {
        return warning.find("[reduction] leaves out up to") == 0;
      });
    };
    CHECK(warned("2000.0"));  // one mode above the two rigid bodies
    CHECK_FALSE(warned("60000.0"));
  }

  TEST_CASE("stiffness of a contact against the rest: a spring beside it, and another contact") {
    Scene s = empty_scene();
    s.nodes = {{"a", 0.0, 0.0, {}}};
    s.masses = {{"a", 2.0, 0.0, {}}};
    Spring x, y;
    x.node = y.node = "a";
    x.stiffness = 8.0;
    y.direction = {0.0, 1.0};
    y.stiffness = 3.0;
    s.springs = {x, y};
    s.contacts = {support_contact("one", "a", 50.0), support_contact("two", "a", 7.0)};
    const check::CheckReport r = checked(s);
    REQUIRE(r.stiffness.size() == 4);
    CHECK(r.stiffness[0].normal);
    CHECK(r.stiffness[0].rest == doctest::Approx(3.0 + 7.0));
    CHECK(r.stiffness[1].rest == doctest::Approx(8.0 + 7.0));
    CHECK(r.stiffness[2].contact == 1);
    CHECK(r.stiffness[2].rest == doctest::Approx(3.0 + 50.0));
    s.contacts.pop_back();
    s.springs.pop_back();
    const check::CheckReport alone = checked(s);
    CHECK(alone.stiffness.at(0).rest == 0.0);
  }

  TEST_CASE("the stiffness of a cantilever's tip is 3 EI / L^3") {
    Scene s = beam(4.0, 6, 1e5, 1e3, 0.3);
    s.supports = {support("L", true, true, true)};
    s.contacts = {support_contact("tip", "R", 1e6)};
    s.contacts[0].gap = 0.01;
    const check::CheckReport r = checked(s);
    CHECK(r.contacts[0].state == State::open);
    CHECK(r.stiffness.at(0).rest == doctest::Approx(3.0 * 1e3 / 64.0).epsilon(1e-6));
    CHECK(r.stiffness.at(1).rest == doctest::Approx(1e5 / 4.0).epsilon(1e-6));
    CHECK(r.mass->total == doctest::Approx(1.2));
    CHECK(r.mass->moving_y < 1.2);
  }

  TEST_CASE("free motions of what stands on points that slide are those of the structure") {
    // Two masses that nothing couples, each on a pad with slow and fast friction beside a spring; and with a dashpot.
    for (const std::string pad : {"friction = { slow = 0.04, fast = 0.1, velocity = 0.02 }\n",
                                  "friction = 0.1\ntangential_damping = 3.0\n"}) {
      CAPTURE(pad);
      std::string text =
          "schema = 1\nunits = { force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }\n[run]\nt_end "
          "= "
          "1.0\nengine = \"ida\"\n[nodes]\na = [0.0, 0.0]\nb = [1.0, 0.3]\n";
      for (const std::string node : {"a", "b"})
        text += "[[masses]]\nnode = \"" + node + "\"\nmass = 1.0\n[[supports]]\nnode = \"" + node +
                "\"\nfix = [\"uy\"]\n[[contacts]]\nname = \"on " + node + "\"\nnode = \"" + node +
                "\"\nlaw = \"slider\"\ntangent = [1.0, 0.0]\nnormal_force = 10.0\ntangential_stiffness = "
                "4000.0\n" +
                pad;
      CHECK(checked(parse_scene(text, "test.toml")).free_motions ==
            std::vector<std::string>{
                "horizontal motion of node 'a', restrained only by friction at contact 'on a'",
                "horizontal motion of node 'b', restrained only by friction at contact 'on b'"});
    }
  }

  TEST_CASE("free motions of a given start, and what holds them") {
    Scene s = empty_scene();
    s.nodes = {{"a", 0.0, 0.0, {}}};
    s.masses = {{"a", 2.0, 0.0, {}}};
    s.gravity = {0.0, -9.81};
    s.contacts = {support_contact("floor", "a", 50.0)};
    s.initial.components = {{"a", "uy", -0.1, {}}};
    CHECK(checked(s).free_motions ==
          std::vector<std::string>{
              "horizontal motion of node 'a', restrained only by friction at contact 'floor'"});
    s.contacts[0].friction = {0.0, 0.0};
    CHECK(checked(s).free_motions ==
          std::vector<std::string>{"horizontal motion of node 'a', not restrained"});

    s = pipeline();
    s.initial.is_static = false;
    s.damping = {};
    s.initial.components = {{"D", "uy", -1e-4, {}}, {"A", "uy", 1e-3, {}}};
    CHECK(checked(s).free_motions ==
          std::vector<std::string>{"horizontal motion, restrained only by friction at contact 'second'",
                                   "rotation about (18, 6), not restrained"});
  }

  TEST_CASE("breakpoints: jumps and kinks of loads, compressions and surfaces, within the run") {
    Scene s = matrices({{1}}, {{0}}, {{4}});
    s.contacts = {slider("pad", Direction{"", {}, {{"d0", 1.0}}, {}}, 1.0, 0.4)};
    s.contacts[0].tangential_stiffness = 1e4;
    s.contacts[0].surface_velocity = {};
    s.contacts[0].surface_velocity.type = HistoryType::step;
    s.contacts[0].surface_velocity.start = 0.5;
    s.contacts[0].surface_velocity.amplitude = 0.1;
    LoadSpec load;
    load.direction.dofs = {{"d0", 1.0}};
    load.amplitude = 2.0;
    load.history.type = HistoryType::triangle;
    load.history.start = 0.2;
    load.history.end = 5.0;
    s.loads = {load};
    const check::CheckReport r = checked(s);
    REQUIRE(r.discontinuities.size() == 2);
    CHECK(r.discontinuities[0].t == doctest::Approx(0.2));
    CHECK_FALSE(r.discontinuities[0].jump);
    CHECK(r.discontinuities[1].t == doctest::Approx(0.5));
    CHECK(r.discontinuities[1].jump);
    CHECK(r.discontinuities[1].description == "surface_velocity of contact 'pad'");
    CHECK_FALSE(r.mass);
  }

  TEST_CASE("rigid sliders on one motion share forces on ground that stands; one without mass is refused") {
    Scene s = matrices({{1, 0}, {0, 1}}, {{0, 0}, {0, 0}}, {{4, 0}, {0, 4}});
    const Direction first{"", {}, {{"d0", 1.0}}, {}};
    s.contacts = {slider("left", first, 1.0, 0.3),
                  slider("other", Direction{"", {}, {{"d1", 1.0}}, {}}, 1.0, 0.3),
                  slider("right", first, 1.0, 0.3)};
    CHECK(why_not(s).empty());
    Scene sliding = s;  // on belts they share nothing: no trouble until they stick, which is warned of
    sliding.contacts[0].surface_velocity.amplitude = sliding.contacts[2].surface_velocity.amplitude = 0.2;
    CHECK(contains(checked(sliding).warnings.at(0), "'left' and 'right'"));
    sliding.contacts[2].tangential_stiffness = 1e3;
    CHECK(checked(sliding).warnings.empty());

    Scene light = matrices({{1, 0}, {0, 0}}, {{0, 0}, {0, 0}}, {{4, -1}, {-1, 4}});
    light.contacts = {slider("pad", Direction{"", {}, {{"d1", 1.0}}, {}}, 1.0, 0.3)};
    CHECK(contains(why_not(light), "'pad' sticks rigidly to a massless point"));
  }

  TEST_CASE("nodes without anything and sections without members are pointed out") {
    Scene s = pipeline();
    s.damping.alpha_over_omega1 = 0.0;  // it drags free motions, which is said too
    CHECK(checked(s).warnings.empty());
    s.nodes.push_back({"E", 1.0, 1.0, {}});
    s.sections.push_back({"old", 1.0, 1.0, 1.0});
    s.sections.push_back({"new", 1.0, 1.0, 1.0});
    CHECK(checked(s).warnings ==
          std::vector<std::string>{"no member, mass, spring or contact is attached to node 'E'",
                                   "sections 'old' and 'new' are not used by any member"});
  }

  TEST_CASE("negative stiffness is called unstable, with the rate of the fastest motion") {
    const auto warning = [](const Scene& s) { return checked(s).warnings.at(0); };
    Scene s = matrices({{1, 0}, {0, 1}}, {{0, 0}, {0, 0}}, {{-200, 0}, {0, 100}});
    check::CheckReport r = checked(s);
    CHECK(contains(warning(s), "the motion of d0.u grows like exp(14.14 t)"));
    CHECK(r.free_motions == std::vector<std::string>{"motion of d0.u, unstable"});
    CHECK(r.open.unstable == 1);
    REQUIRE(r.open.modes.size() == 1);
    CHECK(r.open.modes[0].omega == doctest::Approx(10.0));

    // omega^2 of [[200, -300], [-300, 100]]: 150 -+ sqrt(50^2 + 300^2)
    s = matrices({{1, 0}, {0, 1}}, {{0, 0}, {0, 0}}, {{200, -300}, {-300, 100}});
    r = checked(s);
    CHECK(contains(warning(s), "grows like exp(12.42 t)"));
    CHECK(r.open.modes.at(0).omega == doctest::Approx(std::sqrt(150.0 + std::sqrt(92500.0))));

    // A free motion beside it stays one.
    s = matrices({{2, 0, 0}, {0, 1, 0}, {0, 0, 4}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                 {{0, 0, 0}, {0, -9, 0}, {0, 0, -1}});
    r = checked(s);
    CHECK(contains(warning(s), "the motion of d1.u grows like exp(3 t)"));
    CHECK(r.open.free_motions == 3);
    CHECK(r.open.unstable == 2);

    s = matrices({{1, 0}, {0, 1}}, {{0, 0}, {0, 0}}, {{1, -1}, {-1, 1}});
    CHECK(checked(s).warnings.empty());
  }

  TEST_CASE("what run refuses, check refuses") {
    Scene s = pipeline();
    s.run.engine = Engine::exact;
    const std::string message = why_not(s);
    CHECK((message.empty() || contains(message, "run.engine")));
    s = pipeline();
    s.run.output_dt = 1e-12;
    CHECK(contains(why_not(s), "output_dt"));
  }

  TEST_CASE("check_json parses and holds the same numbers") {
    const Scene s = pipeline();
    const Model model = build_model(s);
    const auto json = nlohmann::json::parse(check::check_json(s, model, check::check(s, model)));
    CHECK(json["degrees_of_freedom"] == 51);
    CHECK(json["contacts"][0]["state"] == "stick");
    CHECK(json["frequencies"]["open"]["free_motions"] == 3);
    CHECK(json["frequencies"]["stuck"]["modes"].size() == 5);
    CHECK(json["frequencies"]["stuck"]["modes"][0]["omega"].get<double>() == doctest::Approx(model.omega1));
    CHECK(json["columns"][1] == "A.ux");
  }
}
