// Angles and edges of elements, by hand.
#include "mesh/mesh_quality.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

TEST_SUITE_BEGIN("unit/mesh/mesh_quality");

TEST_CASE("angles and edges of a triangle and of a trapezium") {
  const std::vector<mesh::PlanePoint> at = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 3.0}, {1.0, 3.0}};
  const mesh::NodePosition place = [&](int n) { return at[static_cast<std::size_t>(n)]; };
  PlaneMesh::Element triangle{PlaneShape::t3, {0, 1, 2}, 7}, trapezium{PlaneShape::q4, {0, 1, 2, 3}, 9};
  const mesh::MeshQuality one = mesh::measure_quality({triangle}, place);
  CHECK(one.min_angle.value == doctest::Approx(36.8698976458).epsilon(1e-10));
  CHECK(one.max_angle.value == doctest::Approx(90.0).epsilon(1e-12));
  CHECK(one.aspect.value == doctest::Approx(5.0 / 3.0).epsilon(1e-12));
  const mesh::MeshQuality both = mesh::measure_quality({triangle, trapezium}, place);
  CHECK(both.min_angle.element == 7);
  CHECK(both.max_angle.element == 9);
  CHECK(both.max_angle.value == doctest::Approx(108.4349488229).epsilon(1e-10));
  CHECK(both.aspect.element == 7);
}

TEST_SUITE_END();
