#include "decide/cycle_fallback.hpp"

#include <doctest/doctest.h>

#include "behaviour/one_mass.hpp"

namespace signorini::tests::circles {
namespace {

/// A scene of one contact that just touches; its guard of separation fails in turns with another.
struct Circle {
  explicit Circle(const std::string& text)
      : model(build_model(parse_scene(text, "circle.toml"))),
        structure(model),
        systems(model, structure),
        jets(systems),
        blocks(model),
        forcing(model, 0.0, motion::Side::after),
        course{{}, forcing, {}, {}, {}, {}, {}, {}, decide::ImpactResult(1), {}} {
    course.instant.u = model.u0;
    course.instant.v = model.v0;
    course.instant.resolution = 1e-15;
    course.states = course.instant.states = {{State::open, 0.0}};
    course.tried_states = {course.states, course.states};
    course.failed = {{0, Guard::closing}};
    course.impact_result.known[0].touches = true;
    course.impact_result.known[0].closing.zeros = 2;
    course.decision.visited = {true};
  }
  [[nodiscard]] Refusal leave() { return decide::CycleFallback(systems, jets, blocks).next_step(course); }

  Model model;
  linear::SystemMatrices structure;
  motion::StateSystems systems;
  motion::JetMaker jets;
  decide::ContactBlocks blocks;
  motion::Forcing forcing;
  decide::SolverState course;
};

const char* const rod =  // Painleve's: sliding, it may press or let go
    "mass = [[0.34847735667203295, 0.2532986927066816], [0.2532986927066816, 0.9015226433279672]]\n"
    "stiffness = [[0.0, 0.0], [0.0, 0.0]]";

}  // namespace

TEST_SUITE_BEGIN("unit/decide/cycle_fallback");

TEST_CASE(
    "first zeros are blurred, then sliders join, then combinations are weighed; several motions are "
    "refused") {
  Circle circle(
      matrix_scene("t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [1.0, 0.0] }", rod,
                   "law = \"rigid\"\nnormal = { d1 = -1.0 }\ntangent = { d0 = 1.0 }\nfriction = 4.0",
                   "[[loads]]\ndirection = { d0 = 0.2532986927066816, d1 = 0.9015226433279672 }\n"
                   "amplitude = -10.0\n"));
  decide::SolverState& course = circle.course;
  CHECK_FALSE(circle.leave());
  CHECK(course.noise_increased);
  CHECK(course.instant.noise_factor == decide::retry_noise_factor);
  CHECK(course.instant.resolution == decide::retry_noise_factor * 1e-15);
  CHECK(course.tried_states.empty());  // blurred, the same mode may hold
  CHECK_FALSE(course.impact_result.sliders);
  CHECK_FALSE(course.increase_noise());
  CHECK(course.instant.noise_factor == decide::retry_noise_factor);
  CHECK_FALSE(circle.leave());
  CHECK(course.impact_result.sliders);
  decide::Participant who{0};
  who.slipping = true;
  who.sign = 1;
  course.impact_result.participants = {who};
  const Refusal why = circle.leave();
  REQUIRE(why);
  CHECK(why.kind == Refusal::Kind::ambiguous);
  CHECK(why.contacts == std::vector<std::size_t>{0});
  CHECK(why.reason.find("several motions continue from this instant") != std::string::npos);
  CHECK(course.undecided.empty());
}

TEST_CASE("a combination that holds is taken, and its block stays as it is") {
  Circle circle(matrix_scene("t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
                             "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
                             "law = \"rigid\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nfriction = 0.5",
                             "[[loads]]\ndirection = { d0 = 4.0, d1 = -10.0 }\namplitude = 1.0\n"));
  decide::SolverState& course = circle.course;
  course.noise_increased = course.impact_result.sliders = true;
  course.impact_result.known[0].slip_plus.zeros = 1;
  course.impact_result.participants = {decide::Participant{0}};
  CHECK_FALSE(circle.leave());
  CHECK(course.states[0].state == State::stick);  // 4 N below 5
  CHECK(course.undecided == std::vector<std::size_t>{0});
  CHECK(course.decision.undecided);
  CHECK(course.impact_result.known[0].slip_plus.zeros == 0);  // of the motion only
  CHECK(course.impact_result.known[0].closing.zeros == 2);
}

TEST_SUITE_END();

}  // namespace signorini::tests::circles
