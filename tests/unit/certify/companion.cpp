// What a run is certified by, and with which setting.
#include "certify/companion.hpp"

#include <doctest/doctest.h>

#include "certify/data_perturbation.hpp"
#include "signorini/error.hpp"

using namespace signorini;

namespace {

Scene scene_of(const std::string& run, const std::string& friction = "0.3") {
  return parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1.0
)" + run + R"(
[nodes]
A = [0.0, 0.0]
[[masses]]
node = "A"
mass = 1.0
[[springs]]
node = "A"
direction = [1.0, 0.0]
stiffness = 1e4
[[contacts]]
name = "floor"
node = "A"
law = "rigid"
normal = [0.0, 1.0]
gap = 0.1
friction = )" + friction +
                         "\n",
                     "test.toml");
}

certify::CompanionPlan plan_of(const Scene& scene) {
  return certify::plan_companion(build_model(scene), scene.run);
}

}  // namespace

TEST_SUITE_BEGIN("unit/certify/companion");

TEST_CASE("companion: the cheaper where both take the scene, and what is asked for") {
  const certify::CompanionPlan automatic = plan_of(scene_of("engine = \"ida\""));
  CHECK(automatic.name == "exact");
  CHECK(automatic.cost > 0.0);
  CHECK(automatic.cost < 0.5);
  CHECK(automatic.runs.at(0).run.engine == Engine::exact);
  const certify::CompanionPlan finer =
      plan_of(scene_of("engine = \"ida\"\nrtol = 1e-6\natol = { velocity = 1e-3 }\ncompanion = \"finer\""));
  CHECK(finer.factor == 2.0);
  CHECK(finer.local == 0.5);
  CHECK(finer.runs.at(0).run.engine == Engine::ida);
  CHECK(finer.runs.at(0).run.rtol == doctest::Approx(1e-8));
  CHECK(*finer.runs.at(0).run.atol.velocity == doctest::Approx(1e-5));
  const certify::CompanionPlan steps =
      plan_of(scene_of("engine = \"newmark\"\ndt = 1e-3\ncompanion = \"finer\""));
  CHECK(*steps.runs.at(0).run.dt == 5e-4);
  CHECK(steps.factor == 3.0);
}

TEST_CASE(
    "companion: steps are judged by another method, by half of them on demand, and then only where they "
    "resolve") {
  const certify::CompanionPlan steps = plan_of(scene_of("engine = \"newmark\"\ndt = 1e-3"));
  CHECK(steps.name == "exact");
  CHECK(steps.choice == "auto: a run with half the step may have the same error");
  CHECK(steps.limitation.empty());
  // sqrt(1e4) = 100 rad/s
  const auto half_of = [](const std::string& dt) {
    return plan_of(scene_of("engine = \"newmark\"\ncompanion = \"finer\"\ndt = " + dt)).limitation;
  };
  CHECK(half_of("0.0099").empty());
  CHECK(half_of("0.0101") ==
        "dt = 0.0101 s does not resolve the fastest oscillation, 100 rad/s, so a run with dt / 2 may have "
        "the same error; use companion = \"exact\", or a dt of 0.01");
}

TEST_CASE("companion: rebounds rest below the run's own velocity in all") {
  const Scene scene =
      scene_of("engine = \"ida\"\nrtol = 1e-6\natol = { velocity = 1e-3 }\ncompanion = \"finer\"");
  CHECK(*plan_of(scene).runs.at(0).model.contacts[0].capture_velocity == 1e-3);
}

TEST_CASE("companion: a finer one leaves those flights to the series that its run leaves") {
  const certify::CompanionPlan plan =
      plan_of(scene_of("engine = \"ida\"\nrtol = 1e-6\ncompanion = \"finer\""));
  CHECK(plan.runs.at(0).run.flight_tolerances == doctest::Approx(100.0));
}

TEST_CASE("companion: laws without a closed flow have a finer one; asking for exact is refused") {
  const std::string stribeck = "{ static = 0.4, kinetic = 0.3, stribeck_velocity = 0.1 }";
  CHECK(plan_of(scene_of("engine = \"ida\"", stribeck)).name == "ida, rtol 1e-10");
  CHECK_THROWS_WITH_AS((void)plan_of(scene_of("engine = \"ida\"\ncompanion = \"exact\"", stribeck)),
                       doctest::Contains("run.companion: \"exact\" cannot compute this scene"), SceneError);
}

TEST_CASE("companion: exact has itself, twice, disturbed; it costs twice the run") {
  const certify::CompanionPlan plan = plan_of(scene_of("engine = \"exact\""));
  REQUIRE(plan.runs.size() == 2);
  CHECK(plan.cost == doctest::Approx(2.0));
  CHECK(plan.factor == 5.0);
}

TEST_CASE("disturbed: every datum by about one rounding, symmetric, the same for the same seed") {
  const Scene scene = scene_of("engine = \"exact\"");
  const Model model = build_model(scene), near = certify::perturbed(model, 1),
              other = certify::perturbed(model, 2);
  const double k = model.stiffness.coeff(0, 0), off = near.stiffness.coeff(0, 0) / k - 1.0;
  CHECK(off != 0.0);
  CHECK(std::abs(off) < 1.2e-15);
  CHECK(near.stiffness.coeff(0, 0) == certify::perturbed(model, 1).stiffness.coeff(0, 0));
  CHECK(near.contacts[0].gap != model.contacts[0].gap);
  CHECK(near.contacts[0].friction.static_ == near.contacts[0].friction.kinetic);
  bool differs = near.mass.coeff(0, 0) != other.mass.coeff(0, 0);
  differs = differs || near.stiffness.coeff(0, 0) != other.stiffness.coeff(0, 0);
  differs = differs || near.contacts[0].gap != other.contacts[0].gap;
  CHECK(differs);
}
