#include "model/element/line_elements.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/eigen_dense.hpp"
#include "model/assembly/springs.hpp"
#include "model/modes/modes.hpp"
#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

constexpr double pi = 3.14159265358979323846;

Eigen::Matrix<double, 6, 1> rigid_rotation(double dx, double dy) {
  Eigen::Matrix<double, 6, 1> r;
  r << 0.0, 0.0, 1.0, -dy, dx, 1.0;
  return r;
}

double first_frequency(Scene s) { return build_model(s).omega1; }

double order(double coarse, double fine, double exact) {
  return std::log2(std::abs(coarse - exact) / std::abs(fine - exact));
}

}  // namespace

TEST_SUITE("unit/model/element/beam") {
  TEST_CASE("a beam element resists no rigid motion and carries the inertia of a rod") {
    const double dx = 1.2, dy = -0.7, l = std::hypot(dx, dy), rho = 0.4;
    const element::BeamMatrix k = element::beam_stiffness(dx, dy, 9e6, 2e6);
    const element::BeamMatrix m = element::beam_mass(dx, dy, rho, MassKind::consistent);
    Eigen::Matrix<double, 6, 1> x, y;
    x << 1, 0, 0, 1, 0, 0;
    y << 0, 1, 0, 0, 1, 0;
    const auto r = rigid_rotation(dx, dy);
    for (const auto& motion : {x, y, r})
      CHECK((k * motion).norm() <= 1e-14 * k.cwiseAbs().maxCoeff() * motion.norm());
    CHECK(x.dot(m * x) == doctest::Approx(rho * l));
    CHECK(y.dot(m * y) == doctest::Approx(rho * l));
    CHECK(r.dot(m * r) == doctest::Approx(rho * l * l * l / 3.0));
    CHECK(k == k.transpose());
    CHECK(m == m.transpose());
    CHECK(base::symmetric_eigen(k).values[3] > 0.0);
    CHECK(base::symmetric_eigen(m).values[0] > 0.0);
    const element::BeamMatrix lumped = element::beam_mass(dx, dy, rho, MassKind::lumped);
    CHECK(x.dot(lumped * x) == doctest::Approx(rho * l));
    CHECK(lumped.row(2).isZero());
  }

  TEST_CASE("a cantilever's tip moves by P L^3 / (3 EI), whatever the number of elements") {
    for (int elements : {1, 7}) {
      Scene s = beam(3.0, elements, 9e6, 2e6, 0.4);
      s.supports = {support("L", true, true, true)};
      s.loads = {node_load("R", {0.0, 1.0}, -5.0)};
      s.initial.is_static = true;
      const Model model = build_model(s);
      CHECK(model.u0[dof(model, "R.uy")] == doctest::Approx(-5.0 * 27.0 / (3.0 * 2e6)).epsilon(1e-10));
      CHECK(model.u0[dof(model, "R.rz")] == doctest::Approx(-5.0 * 9.0 / (2.0 * 2e6)).epsilon(1e-10));
    }
  }

  TEST_CASE("the first frequency of beams converges with order 4") {
    const double l = 4.0, ei = 2e3, rho = 0.5;
    const double unit = std::sqrt(ei / (rho * std::pow(l, 4)));
    auto simple = [&](int n) {
      Scene s = beam(l, n, 9e6, ei, rho);
      s.supports = {support("L", true, true, false), support("R", false, true, false)};
      return first_frequency(s);
    };
    auto cantilever = [&](int n) {
      Scene s = beam(l, n, 9e6, ei, rho);
      s.supports = {support("L", true, true, true)};
      return first_frequency(s);
    };
    const double exact_simple = pi * pi * unit, exact_cantilever = std::pow(1.8751040687119611, 2) * unit;
    CHECK(order(simple(2), simple(4), exact_simple) == doctest::Approx(4.0).epsilon(0.05));
    CHECK(order(simple(4), simple(8), exact_simple) == doctest::Approx(4.0).epsilon(0.05));
    CHECK(order(cantilever(2), cantilever(4), exact_cantilever) == doctest::Approx(4.0).epsilon(0.05));
    CHECK(cantilever(16) == doctest::Approx(exact_cantilever).epsilon(1e-6));
  }

  TEST_CASE("large structures get the same frequencies from the sparse solver") {
    const double l = 4.0, ei = 2e3, rho = 0.5;
    Scene s = beam(l, 100, 9e6, ei, rho);
    s.supports = {support("L", true, true, false), support("R", false, true, false)};
    const Model model = build_model(s);
    REQUIRE(model.size() > 200);
    CHECK(model.omega1 == doctest::Approx(pi * pi * std::sqrt(ei / (rho * std::pow(l, 4)))).epsilon(1e-6));
    const Eigen::VectorXd values =
        base::generalized_eigenvalues(Eigen::MatrixXd(model.stiffness), Eigen::MatrixXd(model.mass));
    CHECK(model.omega_max == doctest::Approx(std::sqrt(values[values.size() - 1])).epsilon(0.02));
    CHECK(model.omega1 == doctest::Approx(std::sqrt(values[0])).epsilon(1e-6));
    s.members[0].mass = MassKind::lumped;
    const Model lumped = build_model(s);
    CHECK(lumped.omega1 == doctest::Approx(model.omega1).epsilon(1e-3));
    CHECK(lumped.dofs[static_cast<std::size_t>(dof(lumped, "L-R.50.rz"))].massless);
    CHECK_FALSE(lumped.dofs[static_cast<std::size_t>(dof(lumped, "L-R.50.ux"))].massless);
  }

  TEST_CASE("the weight of a structure adds up, next to supports too") {
    for (MassKind kind : {MassKind::consistent, MassKind::lumped}) {
      Scene s = beam(5.0, 3, 9e6, 2e6, 0.4);
      s.members[0].mass = kind;
      s.nodes[1].y = 2.0;
      s.gravity = {1.0, -9.81};
      s.masses = {{"R", 0.7, 0.0, {}}};
      const double mass = 0.4 * std::hypot(5.0, 2.0) + 0.7;
      Model model = build_model(s);
      double x = 0.0, y = 0.0;
      for (const auto& [i, p] : model.loads.at(0).direction.terms) {
        const std::string name = model.dofs[static_cast<std::size_t>(i)].displacement;
        if (contains(name, ".ux")) x += p;
        if (contains(name, ".uy")) y += p;
      }
      CHECK(x == doctest::Approx(mass));
      CHECK(y == doctest::Approx(-9.81 * mass));
      // The moment that a clamp feels is that of the whole weight: q L^2 / 8 at the far prop's side.
      Scene clamped = beam(6.0, 4, 9e6, 2e6, 0.4);
      clamped.gravity = {0.0, -9.81};
      clamped.supports = {support("L", true, true, true)};
      clamped.initial.is_static = true;
      clamped.members[0].mass = MassKind::consistent;
      const Model c = build_model(clamped);
      CHECK(c.u0[dof(c, "R.uy")] ==
            doctest::Approx(-0.4 * 9.81 * std::pow(6.0, 4) / (8.0 * 2e6)).epsilon(1e-9));
    }
  }
}
