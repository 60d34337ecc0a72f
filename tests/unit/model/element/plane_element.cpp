// Plane elements: patches, rigid motions, mass, heat, orders of convergence.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "unit/model/element/plane_parts.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

element::PlaneMaterial material_of(bool strain) { return {7e4, 0.29, 2.7, 0.8, strain}; }

std::vector<bool> boundary_unknowns(const PlaneSystem& system) {
  std::vector<bool> held(static_cast<std::size_t>(system.size()), false);
  for (const auto& group : system.mesh.groups)
    for (const int n : group.nodes)
      for (const int c : {0, 1}) held[static_cast<std::size_t>(2 * n + c)] = true;
  return held;
}

/// Hooke's law in its inverse form: strains of stresses, heat aside.
Eigen::Vector3d strains_of(const element::PlaneMaterial& m, const Eigen::Vector3d& s) {
  const double z = m.plane_strain ? m.nu * (s[0] + s[1]) : 0.0;  // stress out of the plane
  return {(s[0] - m.nu * (s[1] + z)) / m.E, (s[1] - m.nu * (s[0] + z)) / m.E,
          2.0 * (1.0 + m.nu) / m.E * s[2]};
}

void check_patch(PlaneShape shape, bool curved, bool strain) {
  const element::PlaneMaterial material = material_of(strain);
  const PlaneSystem system(distorted_grid(shape, curved), material);
  const Eigen::Vector3d stress(31.0, -17.0, 9.0), e = strains_of(material, stress);
  const Eigen::VectorXd exact = system.sampled([&](double x, double y) {
    return element::PlaneVector{2e-3 + e[0] * x + (0.5 * e[2] - 1e-3) * y,
                                -1e-3 + (0.5 * e[2] + 1e-3) * x + e[1] * y};
  });
  const Eigen::VectorXd u =
      system.solve(Eigen::VectorXd::Zero(system.size()), boundary_unknowns(system), exact);
  CHECK((u - exact).lpNorm<Eigen::Infinity>() <= 1e-12 * exact.lpNorm<Eigen::Infinity>());
  for (std::size_t i = 0; i < system.elements.size(); ++i) {
    const Eigen::VectorXd found = system.elements[i]->stress_rows(0.21, 0.13) * system.of_element(i, u);
    CHECK((found - stress).norm() <= 1e-11 * stress.norm());
  }
}

/// Lame's ring under inner pressure p: radial displacement.
double lame(const element::PlaneMaterial& m, double a, double b, double p, double r) {
  const double A = p * a * a / (b * b - a * a), B = A * b * b;
  if (m.plane_strain) return (1.0 + m.nu) / m.E * ((1.0 - 2.0 * m.nu) * A * r + B / r);
  return ((1.0 - m.nu) * A * r + (1.0 + m.nu) * B / r) / m.E;
}

struct RingErrors {
  double place, energy;  // L2 of the displacement; of the strain energy: square of the energy norm's error
};

/// A sector from 0 to pi/2, held by symmetry.
RingErrors ring_errors(PlaneShape shape, int n, bool strain) {
  const double a = 1.0, b = 2.0, p = 3.0;
  const element::PlaneMaterial material = material_of(strain);
  const PlaneSystem system(
      mesh::ring_mesh({{0.0, 0.0}, a, b, 0.0, std::numbers::pi / 2.0}, {shape, {n, 2 * n}, {1.0, 1.0}}),
      material);
  std::vector<bool> held(static_cast<std::size_t>(system.size()), false);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(system.size());
  for (const auto& group : system.mesh.groups) {
    for (const int k : group.nodes) {
      if (group.name == "start") held[static_cast<std::size_t>(2 * k + 1)] = true;
      if (group.name == "end") held[static_cast<std::size_t>(2 * k)] = true;
    }
    if (group.name != "inner") continue;
    for (const auto& edge : group.edges)
      for (const mesh::EdgePoint& point : mesh::edge_points()) {
        const mesh::EdgeValues v = mesh::edge_shape_functions(edge.nodes.size(), point.s);
        double dx = 0.0, dy = 0.0;
        for (std::size_t i = 0; i < edge.nodes.size(); ++i) {
          dx += v.derivatives[i] * system.node(edge.nodes[i]).x;
          dy += v.derivatives[i] * system.node(edge.nodes[i]).y;
        }
        for (std::size_t i = 0; i < edge.nodes.size(); ++i) {  // into the body: (-dy, dx)
          f[2 * edge.nodes[i]] -= p * material.thickness * point.weight * v.values[i] * dy;
          f[2 * edge.nodes[i] + 1] += p * material.thickness * point.weight * v.values[i] * dx;
        }
      }
  }
  const Eigen::VectorXd u = system.solve(f, held, Eigen::VectorXd::Zero(system.size()));
  double square = 0.0;
  for (std::size_t i = 0; i < system.elements.size(); ++i) {
    const auto& e = system.mesh.elements[i];
    const Eigen::VectorXd own = system.of_element(i, u);
    for (const mesh::IntegrationPoint& q : mesh::integration_points(e.shape)) {
      const mesh::ShapeValues v = mesh::shape_functions(e.shape, q.a, q.b);
      Eigen::Vector2d x(0.0, 0.0), w(0.0, 0.0);
      for (std::size_t k = 0; k < e.nodes.size(); ++k) {
        const auto j = static_cast<Eigen::Index>(k);
        x += v.values[j] * Eigen::Vector2d(system.node(e.nodes[k]).x, system.node(e.nodes[k]).y);
        w += v.values[j] * own.segment<2>(2 * j);
      }
      square += (w - x / x.norm() * lame(material, a, b, p, x.norm())).squaredNorm() * q.weight;
    }
  }
  const double exact = 0.25 * std::numbers::pi * a * p * material.thickness * lame(material, a, b, p, a);
  return {std::sqrt(square / static_cast<double>(system.elements.size())),
          std::abs(0.5 * f.dot(u) - exact) / exact};
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/element/plane_element");

TEST_CASE("a patch of distorted elements holds any constant stress") {
  for (const PlaneShape shape : all_plane_shapes)
    for (const bool strain : {false, true}) {
      CAPTURE(name_of(shape));
      CAPTURE(strain);
      check_patch(shape, false, strain);
      if (mesh::has_midside_nodes(shape)) check_patch(shape, true, strain);
    }
}

TEST_CASE("rigid motions, weight, area, mass, inertia and heat are those of the body") {
  for (const PlaneShape shape : all_plane_shapes)
    for (const MassKind kind : {MassKind::consistent, MassKind::lumped}) {
      CAPTURE(name_of(shape));
      const element::PlaneMaterial material = material_of(true);
      const PlaneSystem system(distorted_grid(shape, false), material, kind);
      const double area = 2.1 * 1.7, mass = material.density * material.thickness * area;
      const auto ux = system.sampled([](double, double) { return element::PlaneVector{1.0, 0.0}; });
      const auto turn = system.sampled([](double x, double y) { return element::PlaneVector{-y, x}; });
      const double size = Eigen::MatrixXd(system.stiffness).norm();
      CHECK((system.stiffness * ux).norm() <= 1e-13 * size);
      CHECK((system.stiffness * turn).norm() <= 1e-12 * size);
      CHECK(ux.dot(system.mass * ux) == doctest::Approx(mass).epsilon(1e-13));
      for (const auto& e : system.elements) CHECK(e->mass().diagonal().minCoeff() > 0.0);
      if (kind == MassKind::consistent) {
        // About the origin: that about the middle and the middle's distance.
        const double c = std::cos(0.41), s = std::sin(0.41);
        const double x = 0.3 + 0.5 * (2.1 * c - 1.7 * s), y = -0.2 + 0.5 * (2.1 * s + 1.7 * c);
        const double inertia = mass * ((2.1 * 2.1 + 1.7 * 1.7) / 12.0 + x * x + y * y);
        CHECK(turn.dot(system.mass * turn) == doctest::Approx(inertia).epsilon(1e-13));
      }
      double spread = 0.0, heat = 0.0;
      const auto swell = system.sampled([](double px, double py) { return element::PlaneVector{px, py}; });
      for (std::size_t i = 0; i < system.elements.size(); ++i) {
        spread += system.of_element(i, ux).dot(system.elements[i]->load_vector({3.0, 5.0}));
        heat += system.elements[i]->strain_work(system.of_element(i, swell));
        CHECK(std::abs(system.elements[i]->strain_work(system.of_element(i, turn))) <= 1e-11 * material.E);
      }
      CHECK(spread == doctest::Approx(3.0 * area).epsilon(1e-13));
      // All held, a strain of one presses with E / ((1 + nu)(1 - 2 nu)) (1 + nu) in both directions.
      const double pressure = material.E / (1.0 - 2.0 * material.nu);
      CHECK(heat == doctest::Approx(2.0 * pressure * material.thickness * area).epsilon(1e-12));
    }
}

TEST_CASE("a ring under pressure: displacements of order 2 and 3, energies of order 2 and 4") {
  for (const PlaneShape shape : all_plane_shapes)
    for (const bool strain : {false, true}) {
      CAPTURE(name_of(shape));
      const int degree = mesh::has_midside_nodes(shape) ? 2 : 1;
      const RingErrors coarse = ring_errors(shape, 6, strain), fine = ring_errors(shape, 12, strain);
      const double place = std::log2(coarse.place / fine.place);
      const double energy = std::log2(coarse.energy / fine.energy);
      CHECK(place >= degree + 0.85);
      CHECK(energy >= 2.0 * degree - 0.3);
    }
}

TEST_SUITE_END();
