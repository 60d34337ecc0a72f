#include "decide/delassus.hpp"
#include "base/eigen_dense.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <random>

#include "behaviour/one_mass.hpp"
#include "motion/state_systems.hpp"

namespace signorini::tests::delassus_tests {
namespace {

/// Three masses, coupled by their mass, on two rigid contacts on slopes and one along axes; the fourth has no mass.
Model on_slopes() {
  const std::string foot = "law = \"rigid\"\nrestitution = 0.0\nfriction = 0.3\n";
  return build_model(parse_scene(
      matrix_scene(
          "t_end = 1.0",
          "mass = [[2.0, 0.3, 0.1, 0.0], [0.3, 1.0, 0.2, 0.0], [0.1, 0.2, 1.5, 0.0], [0.0, 0.0, 0.0, 0.0]]\n"
          "stiffness = [[9.0, -1.0, 0.0, -2.0], [-1.0, 5.0, -1.0, 0.0], [0.0, -1.0, 4.0, -1.0], "
          "[-2.0, 0.0, -1.0, 6.0]]",
          foot + "normal = { d0 = 0.8, d1 = -0.6 }\ntangent = { d0 = 0.6, d1 = 0.8 }",
          "[[contacts]]\nname = \"e\"\n" + foot +
              "normal = { d2 = 1.0 }\ntangent = { d1 = 0.3, d2 = 0.1 }\n"),
      "test.toml"));
}

}  // namespace

TEST_SUITE_BEGIN("unit/decide/delassus");

TEST_CASE("forces at contacts move all of them by H^T M^-1 H, and parts without mass not at all") {
  const Model model = on_slopes();
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const motion::StateSystemPtr open = systems.system_of({{State::open, 0.0}, {State::open, 0.0}});
  REQUIRE(open);
  const decide::Delassus d = decide::delassus(model, *open, {0, 1});
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, 4);
  H.col(0) << 0.8, -0.6, 0.0;
  H.col(1) << 0.6, 0.8, 0.0;
  H.col(2) << 0.0, 0.0, 1.0;
  H.col(3) << 0.0, 0.3, 0.1;
  const Eigen::MatrixXd mass = Eigen::MatrixXd(model.mass).topLeftCorner(3, 3),
                        effect = base::solve_dense(mass, H);
  // The solver has the equations' signs: a force that acts on the body is a load.
  CHECK((d.effect.topRows(3) - effect).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(d.effect.row(3).cwiseAbs().maxCoeff() == 0.0);
  CHECK((d.W - H.transpose() * effect).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("impulses and what a contact that sticks gives against them make the whole change of momentum") {
  const Model model = on_slopes();
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const Eigen::MatrixXd mass = Eigen::MatrixXd(model.mass).topLeftCorner(3, 3);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, 4);
  H.col(0) << 0.8, -0.6, 0.0;
  H.col(1) << 0.6, 0.8, 0.0;
  H.col(2) << 0.0, 0.0, 1.0;
  H.col(3) << 0.0, 0.3, 0.1;
  for (const State second : {State::open, State::stick}) {
    const motion::StateSystemPtr system = systems.system_of({{State::open, 0.0}, {second, 0.0}});
    REQUIRE(system);
    const Eigen::Vector2d impulses(0.7, -1.9);
    const Eigen::VectorXd all = decide::with_reactions(model, *system, {0}, impulses);
    REQUIRE(all.size() == 4);
    CHECK(all[0] == 0.7);
    CHECK(all[1] == -1.9);
    CHECK((all[2] != 0.0) == (second == State::stick));
    CHECK((all[3] != 0.0) == (second == State::stick));
    const Eigen::VectorXd dv = decide::delassus(model, *system, {0}).effect * impulses;
    CHECK((mass * dv.head(3) - H * all).cwiseAbs().maxCoeff() < 1e-14);
    CHECK(decide::with_reactions(model, *system, {0}, {}).size() == 0);
  }
}

TEST_CASE("velocities are set to the last digit, by the least change of kinetic energy") {
  const Model model = on_slopes();
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const decide::Delassus d =
      decide::delassus(model, *systems.system_of({{State::open, 0.0}, {State::open, 0.0}}), {0, 1});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Eigen::MatrixXd mass(model.mass);
  for (int round = 0; round < 50; ++round) {
    CAPTURE(round);
    Vector v(4);
    for (int i = 0; i < 4; ++i) v[i] = uniform(random);
    const Vector before = v;
    const double slide = uniform(random);
    const std::vector<decide::FixedVelocity> fixed{{0, &model.contacts[0].normal, 0.0},
                                                   {1, &model.contacts[0].tangent, 0.0},
                                                   {2, &model.contacts[1].normal, slide}};
    CHECK_FALSE(decide::has_velocities(fixed, v));
    decide::impose_velocities(d, fixed, v);
    // n and t of the first are of the same two entries, n of the second of one: exact, not to rounding
    CHECK(v[0] == 0.0);
    CHECK(v[1] == 0.0);
    CHECK(v[2] == slide);
    CHECK(v[3] == before[3]);
    CHECK(decide::has_velocities(fixed, v));
    // One held alone: the change is M^-1 n, so M (v - before) has no part but along n.
    Vector one = before;
    decide::impose_velocities(d, {{0, &model.contacts[0].normal, 0.0}}, one);
    const Vector impulse = mass * (one - before);
    CHECK(std::abs(0.8 * one[0] - 0.6 * one[1]) < 1e-15);
    CHECK(std::abs(0.6 * impulse[0] + 0.8 * impulse[1]) < 1e-14);
    CHECK(std::abs(impulse[2]) < 1e-14);
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::delassus_tests
