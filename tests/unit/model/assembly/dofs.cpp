#include "model/assembly/dofs.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "model/assembly/motion_names.hpp"
#include "unit/model/scenes.hpp"

namespace signorini::tests::motion_name_tests {
using namespace signorini::test;
namespace {

/// u = x - theta (y - cy), v = y + theta (x - cx) of every node, turned by theta.
Vector moved(const assembly::DofMap& map, double x, double y, double theta, double cx, double cy) {
  Vector motion = Vector::Zero(static_cast<Eigen::Index>(map.dofs.size()));
  for (std::size_t i = 0; i < map.number.size(); ++i) {
    const element::MeshNode& node = map.mesh.nodes[i];
    const double values[] = {x - theta * (node.y - cy), y + theta * (node.x - cx), theta};
    for (std::size_t d = 0; d < 3; ++d)
      if (map.number[i][d] >= 0) motion[map.number[i][d]] = values[d];
  }
  return motion;
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/assembly/dofs");

TEST_CASE(
    "translations and rotations of a frame have their names, however small they are, and whichever way") {
  const assembly::DofMap map = assembly::number_nodes(pipeline());
  for (const double size : {-3.0, 1e-2, 1e5}) {
    CAPTURE(size);
    CHECK(assembly::describe_motion(moved(map, size, 0.0, 0.0, 0.0, 0.0), map) == "horizontal motion");
    CHECK(assembly::describe_motion(moved(map, 0.0, size, 0.0, 0.0, 0.0), map) == "vertical motion");
    CHECK(assembly::describe_motion(moved(map, 3.0 * size, -4.0 * size, 0.0, 0.0, 0.0), map) ==
          "motion along (0.6, -0.8)");
    CHECK(assembly::describe_motion(moved(map, 0.0, 0.0, size, 5.25, -2.5), map) ==
          "rotation about (5.25, -2.5)");
    CHECK(assembly::is_rigid(moved(map, 2.0 * size, size, 0.1 * size, 3.0, 4.0), map));
  }
  CHECK(assembly::max_translation(moved(map, 0.0, 0.0, 0.5, 0.0, 0.0), map) ==
        doctest::Approx(0.5 * std::hypot(18.0, 6.0)).epsilon(1e-14));
}

TEST_CASE(
    "a frame one of whose nodes turns by two hundredths less, or moves by that, does not move as one body") {
  const assembly::DofMap map = assembly::number_nodes(pipeline());
  for (const double theta : {-1e-2, 1.0, 50.0}) {
    CAPTURE(theta);
    const Vector whole = moved(map, 0.0, 0.0, theta, 5.25, -2.5);
    for (const std::size_t node : {std::size_t(0), std::size_t(5)})
      for (std::size_t d = 0; d < 3; ++d) {
        CAPTURE(d);
        Vector bent = whole;
        bent[map.number[node][d]] -= 0.02 * (d == 2 ? 1.0 : 15.0) * theta;
        CHECK_FALSE(assembly::is_rigid(bent, map));
        CHECK(assembly::describe_motion(bent, map).find("rotation") == std::string::npos);
      }
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::motion_name_tests
