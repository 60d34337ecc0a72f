// Starts at rest of structures that the loads do not hold in one place only: whatever the angle, the start is the same, or
// is refused in the same words. What decides is no rounding of zero: not the sign of a reaction that is none, not the
// stiffness that an elimination leaves to a motion that nothing resists.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <string>

#include "differential/transform.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::turned_starts {
namespace {

using differential::turned;

const std::string opening =
    "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n";

Scene at_angle(const std::string& text, double degrees) {
  const Scene scene = parse_scene(text, "start.toml");
  return degrees == 0.0 ? scene : turned(scene, degrees)->scene;
}

std::string refusal(const Scene& scene) {
  try {
    static_cast<void>(build_model(scene));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

std::size_t named(const Model& model, const std::string& name) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (model.contacts[k].name == name) return k;
  REQUIRE(false);
  return 0;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/turned_starts");

TEST_CASE("a stop that carries nothing holds nothing: the floors share the motion by their forces") {
  // Nothing resists a and b sideways. b is on a rigid floor, that of a gives by m g/kn = w, and the spring between them,
  // which has no force, keeps b aside by 0.2 w: least 3 ut_a^2 + 1.4 (ut_a + 0.2 w)^2, by the masses.
  const std::string text = opening + R"(gravity = [0.0, -10.0]
[run]
t_end = 0.1
initial = "static"
[nodes]
a = [0.0, 0.0]
b = [1.0, 0.0]
[[masses]]
node = "a"
mass = 3.0
[[masses]]
node = "b"
mass = 1.4
[[springs]]
node = "b"
against = "a"
direction = [1.0, 0.2]
stiffness = 626.0
[[contacts]]
name = "floor_a"
node = "a"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e5
tangential_stiffness = 1e5
friction = 0.8
[[stops]]
name = "guide"
node = "a"
law = "rigid"
direction = [1.0, 0.1]
gap = 0.05
[[contacts]]
name = "floor_b"
node = "b"
law = "rigid"
normal = [0.0, 1.0]
friction = 0.5
)";
  const double w = 3e-4, across = std::sqrt(1.01);
  for (int i = 0; i < 24; ++i) {
    const double degrees = 15.0 * i + (i % 2 == 0 ? 0.0 : 3.7);
    CAPTURE(degrees);
    const Model model = build_model(at_angle(text, degrees));
    const auto gap = [&](const char* name) { return model.contacts[named(model, name)].gap_at(model.u0); };
    CHECK(gap("floor_a") == doctest::Approx(-w).epsilon(1e-9));
    CHECK(std::abs(gap("floor_b")) < 1e-15);
    const double a = model.contacts[named(model, "floor_a")].tangent.dot(model.u0);
    const double b = model.contacts[named(model, "floor_b")].tangent.dot(model.u0);
    CHECK(std::abs(a) == doctest::Approx(1.4 / 4.4 * 0.2 * w).epsilon(1e-9));
    CHECK(std::abs(b) == doctest::Approx(3.0 / 4.4 * 0.2 * w).epsilon(1e-9));
    CHECK(a * b < 0.0);
    // b moves by 0.2 w against a, along the spring, which is inclined: so a moves along (1, 0) by -+ 1.4 / 4.4 of it.
    const double along = gap("guide+") - 0.05;
    CHECK(gap("guide-") - 0.05 == doctest::Approx(-along).epsilon(1e-9));
    CHECK(std::abs(along) == doctest::Approx((0.1 - 1.4 / 4.4 * 0.2) * w / across).epsilon(1e-9));
    CHECK(model.statics.reactions[named(model, "guide+")] == 0.0);
    CHECK(model.statics.reactions[named(model, "guide-")] == 0.0);
  }
}

TEST_CASE("a stop that the structure reaches only since it is there stays closed, without a force") {
  // The wall stands 0.01 inside of the body, which nothing else holds along it.
  const std::string text = opening + R"(gravity = [0.0, -10.0]
[run]
t_end = 0.1
initial = "static"
[nodes]
a = [0.0, 0.0]
[[masses]]
node = "a"
mass = 3.0
[[contacts]]
name = "floor"
node = "a"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e5
[[contacts]]
name = "wall"
node = "a"
law = "rigid"
normal = [1.0, 0.0]
gap = -0.01
)";
  for (const double degrees : {0.0, 33.0, 90.0, 212.0}) {
    CAPTURE(degrees);
    const Model model = build_model(at_angle(text, degrees));
    CHECK(std::abs(model.contacts[named(model, "wall")].gap_at(model.u0)) < 1e-15);
    CHECK(model.statics.reactions[named(model, "wall")] < 1e-9 * 30.0);
  }
}

TEST_CASE("a motion that nothing holds and nothing drives stays at zero, at every angle") {
  // A spring and a load along it; square to it an open contact, whose tangent is the spring's direction.
  const std::string text = opening + R"([run]
t_end = 0.1
initial = "static"
[nodes]
a = [0.0, 0.0]
[[masses]]
node = "a"
mass = 3.0
[[springs]]
node = "a"
direction = [1.0, 0.0]
stiffness = 500.0
[[contacts]]
name = "floor"
node = "a"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e5
gap = 0.3
[[loads]]
node = "a"
direction = [1.0, 0.0]
amplitude = 5.0
)";
  for (int i = 0; i < 24; ++i) {
    const double degrees = 15.0 * i + 4.1;
    CAPTURE(degrees);
    const Model model = build_model(at_angle(text, degrees));
    // A support of 1e-10 of the stiffness leaves six digits.
    CHECK(model.u0.norm() == doctest::Approx(0.01).epsilon(1e-6));
    CHECK(std::abs(model.contacts[0].gap_at(model.u0) - 0.3) < 1e-6 * 0.01);
  }
}

TEST_CASE(
    "what a slider at its limit no longer holds is refused at the same part of the weight, at every angle") {
  // The spring's force F and T along the slider carry the part l of the weight: F s + T t = l W (0, 1) with s along (-0.1, 1)
  // and t along (1, -0.3); T = 0.3 * 6 at l = 0.698669. A stop that waits aside is reached by a motion only.
  const std::string text = opening + R"(gravity = [0.0, -9.81]
[run]
t_end = 0.1
initial = "frictional"
[[run.stages]]
name = "weight"
loads = ["gravity"]
[nodes]
b = [1.0, 0.0]
[[masses]]
node = "b"
mass = 2.44
[[springs]]
node = "b"
direction = [-0.1, 1.0]
stiffness = 271.0
[[stops]]
name = "guide"
node = "b"
law = "compliant"
direction = [1.0, 0.0]
gap = 0.048
normal_stiffness = 1000.0
[[contacts]]
name = "brake"
node = "b"
law = "slider"
tangent = [1.0, -0.3]
normal_force = 6.0
friction = 0.3
)";
  for (int i = 0; i < 48; ++i) {
    const double degrees = i < 4 ? 90.0 * i : 7.7 * i;
    CAPTURE(degrees);
    const std::string said = refusal(at_angle(text, degrees));
    CAPTURE(said);
    CHECK(said.find("no frictional start: at load factor 0.6987 of stage 'weight', contact 'brake' can "
                    "neither stick nor slip") != std::string::npos);
  }
}

TEST_CASE("a structure that nothing holds when the loads begin is refused at every angle") {
  // Two parallel springs; the floor_below waits.
  const std::string text = opening + R"(gravity = [0.0, -9.81]
[run]
t_end = 0.1
initial = "frictional"
[nodes]
a = [0.0, 0.0]
b = [1.0, 0.0]
[[masses]]
node = "a"
mass = 1.11
[[masses]]
node = "b"
mass = 1.75
[[springs]]
node = "a"
direction = [-0.1, 1.0]
stiffness = 797.0
[[springs]]
node = "b"
direction = [1.0, 0.2]
stiffness = 129.0
[[springs]]
node = "b"
against = "a"
direction = [-0.1, 1.0]
stiffness = 310.0
[[contacts]]
name = "floor_a"
node = "a"
law = "compliant"
normal = [0.0, 1.0]
gap = 0.159
normal_stiffness = 1e5
tangential_stiffness = 1e5
friction = 0.8
[[contacts]]
name = "floor_b"
node = "b"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e4
tangential_stiffness = 3e3
friction = 0.34
)";
  for (int i = 0; i < 48; ++i) {
    const double degrees = 7.7 * i;
    CAPTURE(degrees);
    const std::string said = refusal(at_angle(text, degrees));
    CAPTURE(said);
    CHECK(said.find("no frictional start: at load factor 0 of stage 'loads', nothing restrains the motion") !=
          std::string::npos);
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::turned_starts
