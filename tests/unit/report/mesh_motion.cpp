// Motions of meshes as sums of shapes.
#include "report/mesh_motion.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

Eigen::MatrixXd put_together(const report::MeshMotion& motion) {
  return motion.shapes * motion.parts.transpose();
}

/// A line of nodes that moves by three shapes of very different sizes, at uneven times.
Eigen::MatrixXd wavy(int nodes, int times) {
  Eigen::MatrixXd u(2 * nodes, times);
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < times; ++j) {
      const double x = static_cast<double>(i) / nodes, t = 0.01 * j * j;
      u(2 * i, j) = 5.0 * t + 0.2 * std::sin(3.0 * x) * std::cos(7.0 * t);
      u(2 * i + 1, j) = 0.2 * x * x * std::sin(11.0 * t);
    }
  return u;
}

}  // namespace

TEST_SUITE_BEGIN("unit/report/mesh_motion");

TEST_CASE("mesh motion: few shapes give every displacement back within a thousandth of the greatest") {
  const Eigen::MatrixXd u = wavy(40, 33);
  report::MeshMotion motion;
  report::decompose_motion(u, 100000, motion);
  CHECK(motion.greatest == u.cwiseAbs().maxCoeff());
  CHECK(motion.shapes.cols() <= 3);
  CHECK((put_together(motion) - u).cwiseAbs().maxCoeff() <= 1e-3 * motion.greatest);
  for (Eigen::Index k = 0; k < motion.shapes.cols(); ++k)
    CHECK(motion.shapes.col(k).cwiseAbs().maxCoeff() == doctest::Approx(1.0));
}

TEST_CASE("mesh motion: a full page has one shape, the one that leaves least; nothing moves without any") {
  const Eigen::MatrixXd u = wavy(40, 33);
  report::MeshMotion motion;
  report::decompose_motion(u, 1, motion);
  REQUIRE(motion.shapes.cols() == 1);
  // No sum of one shape leaves less: the rest is at right angles to it.
  const Eigen::MatrixXd rest = u - put_together(motion);
  CHECK((motion.shapes.col(0).transpose() * rest).cwiseAbs().maxCoeff() <= 1e-9 * u.norm());
  CHECK(rest.norm() < 0.5 * u.norm());
  report::decompose_motion(Eigen::MatrixXd::Zero(6, 4), 1000, motion);
  CHECK(motion.greatest == 0.0);
  CHECK(motion.shapes.cols() == 0);
  CHECK(report::mesh_motion_json({}).is_null());
}

TEST_SUITE_END();
