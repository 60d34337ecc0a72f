#include "model/statics/mechanisms.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

/// Three masses; supports decide what they may do.
Scene three_masses() {
  Scene s = empty_scene();
  s.nodes = {{"A", 0.0, 0.0, {}}, {"B", 1.0, 0.0, {}}, {"C", 2.0, 1.0, {}}};
  s.masses = {{"A", 1.0, 0.0, {}}, {"B", 1.0, 0.0, {}}, {"C", 1.0, 0.0, {}}};
  return s;
}

}  // namespace

TEST_SUITE("unit/model/statics/mechanisms") {
  TEST_CASE("a rotation that two translations already give is not counted again") {
    // A and B move along x at one height, C along y: turning is both translations at once.
    Scene s = three_masses();
    s.supports = {support("A", false, true, false), support("B", false, true, false),
                  support("C", true, false, false)};
    const Eigen::MatrixXd simple =
        statics::simple_motions(Eigen::MatrixXd::Identity(3, 3), assembly::number_nodes(s));
    REQUIRE(simple.cols() == 3);
    CHECK((simple.col(0) - Eigen::Vector3d(1.0, 1.0, 0.0)).norm() < 1e-14);
    CHECK((simple.col(1) - Eigen::Vector3d(0.0, 0.0, 1.0)).norm() < 1e-14);
    CHECK(std::abs(simple.col(2).dot(Eigen::Vector3d(1.0, -1.0, 0.0))) == doctest::Approx(std::sqrt(2.0)));
    CHECK(simple.col(2).norm() == doctest::Approx(1.0));
  }

  TEST_CASE("of a translation that is not free no part is taken for one") {
    // Free are the translation along x, and B and C along y, each for itself: no translation along y.
    Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(6, 3);
    motions(0, 0) = motions(2, 0) = motions(4, 0) = 1.0;
    motions(3, 1) = motions(5, 2) = 1.0;
    const Eigen::MatrixXd simple = statics::simple_motions(motions, assembly::number_nodes(three_masses()));
    REQUIRE(simple.cols() == 3);
    CHECK((simple.col(0) - motions.col(0)).norm() < 1e-14);
    for (const int j : {1, 2}) {
      CHECK(simple.col(j).norm() == doctest::Approx(1.0));
      CHECK(std::abs(simple.col(j).dot(motions.col(0))) < 1e-14);
    }
    CHECK(std::abs(simple.col(1).dot(simple.col(2))) < 1e-14);
  }
}
