// Complex modes of a few springs, dashpots and constraints: closed forms, and the equations that they solve.
#include "engine/exact/modal/damped_modes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "base/eigen_dense.hpp"

using namespace signorini;
using Eigen::Index;

namespace {

Eigen::VectorXd vector_of(std::initializer_list<double> list) {
  Eigen::VectorXd v(static_cast<Index>(list.size()));
  std::copy(list.begin(), list.end(), v.data());
  return v;
}

/// K, C and constraints as matrices.
struct Whole {
  Eigen::MatrixXd k, c, forces, forms;
};

Whole whole_of(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
               const std::vector<modal::ModalTerm>& terms) {
  Whole w{square.asDiagonal(), decay.asDiagonal(), {}, {}};
  std::vector<const modal::ModalTerm*> rigid;
  for (const modal::ModalTerm& term : terms) {
    if (term.rigid) rigid.push_back(&term);
    w.k += term.stiffness * term.u * term.v.transpose();
    w.c += term.damping * term.u * term.v.transpose();
  }
  w.forces.resize(square.size(), static_cast<Index>(rigid.size()));
  w.forms = w.forces;
  for (std::size_t a = 0; a < rigid.size(); ++a) {
    w.forces.col(static_cast<Index>(a)) = rigid[a]->u;
    w.forms.col(static_cast<Index>(a)) = rigid[a]->v;
  }
  return w;
}

/// Every root with its shape and its forces solves the equations; y of x is 1, of the others 0.
void check_equations(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
                     const std::vector<modal::ModalTerm>& terms) {
  const modal::DampedModes modes = modal::damped_modes(square, decay, terms);
  CAPTURE(modes.failure);
  REQUIRE(modes.failure.empty());
  const Whole w = whole_of(square, decay, terms);
  const Index n = square.size();
  std::size_t rigid = 0;
  for (const modal::ModalTerm& term : terms) rigid += term.rigid ? 1 : 0;
  Index count = 0;
  for (Index k = 0; k < modes.root.size(); ++k) {
    const std::complex<double> l = modes.root[k];
    count += l.imag() > 0.0 ? 2 : 1;
    const double share = l.imag() > 0.0 ? 2.0 : 1.0;
    const Eigen::VectorXcd x = modes.shape.col(k) / share;
    Eigen::VectorXcd left = (l * l) * x + l * (w.c * x) + w.k * x;
    double terms_of = std::norm(l) * x.norm() + std::abs(l) * (w.c * x).norm() + (w.k * x).norm();
    Index a = 0;
    for (std::size_t i = 0; i < terms.size(); ++i)
      if (terms[i].rigid) {
        const Eigen::VectorXcd force = terms[i].u * (modes.force(static_cast<Index>(i), k) / share);
        left += force;
        terms_of += force.norm();
        CHECK(std::abs((w.forms.col(a++).transpose() * x).value()) < 1e-12 * terms[i].v.norm());
      } else {
        const std::complex<double> force =
            (terms[i].stiffness + l * terms[i].damping) * (terms[i].v.transpose() * x).value();
        CHECK(std::abs(modes.force(static_cast<Index>(i), k) / share - force) <=
              1e-10 * (std::abs(force) + 1e-6 * terms[i].stiffness));
      }
    CHECK(left.norm() <= 1e-11 * terms_of);
    for (Index j = 0; j < modes.root.size(); ++j) {
      const std::complex<double> y = (modes.from_q.row(j) * x + l * (modes.from_rate.row(j) * x)).value();
      CHECK(std::abs(y - (j == k ? 1.0 : 0.0)) < 1e-10);
    }
  }
  CHECK(count == 2 * (n - static_cast<Index>(rigid)));
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/exact/modal/damped_modes");

TEST_CASE("a mass with a spring and a dashpot: l^2 + c l + k = 0") {
  const Eigen::VectorXd one = vector_of({1.0});
  const modal::DampedModes modes =
      modal::damped_modes(vector_of({4.0}), vector_of({0.5}), {{one, one, 12.0, 1.5, false}});
  REQUIRE(modes.failure.empty());
  REQUIRE(modes.root.size() == 1);
  CHECK(modes.root[0].real() == doctest::Approx(-1.0).epsilon(1e-15));
  CHECK(modes.root[0].imag() == doctest::Approx(std::sqrt(15.0)).epsilon(1e-15));
  // Overdamped: two real roots, -1 and -4.
  const modal::DampedModes slow =
      modal::damped_modes(vector_of({0.0}), vector_of({1.0}), {{one, one, 4.0, 4.0, false}});
  REQUIRE(slow.root.size() == 2);
  CHECK(slow.root[0].real() == doctest::Approx(-1.0).epsilon(1e-15));
  CHECK(slow.root[1].real() == doctest::Approx(-4.0).epsilon(1e-15));
  // A free motion with damping alone: 0 exactly, and -c.
  const modal::DampedModes free = modal::damped_modes(vector_of({0.0}), vector_of({0.25}), {});
  CHECK(free.root[0] == 0.0);
  CHECK(free.root[1].real() == -0.25);
}

TEST_CASE("what cannot be told apart fails and says so") {
  const Eigen::VectorXd one = vector_of({1.0});
  CHECK_FALSE(modal::damped_modes(vector_of({0.0}), vector_of({0.0}), {}).failure.empty());
  CHECK_FALSE(modal::damped_modes(vector_of({4.0}), vector_of({4.0}), {}).failure.empty());
  // critical by its dashpot
  CHECK_FALSE(
      modal::damped_modes(vector_of({1.0}), vector_of({0.0}), {{one, one, 3.0, 4.0, false}}).failure.empty());
}

TEST_CASE("a constraint leaves n - 1 modes: two masses held together") {
  const modal::DampedModes modes = modal::damped_modes(
      vector_of({1.0, 3.0}), vector_of({0.0, 0.0}), {{vector_of({1, -1}), vector_of({1, -1}), 0, 0, true}});
  REQUIRE(modes.failure.empty());
  REQUIRE(modes.root.size() == 1);
  CHECK(modes.root[0].imag() == doctest::Approx(std::sqrt(2.0)).epsilon(1e-14));
  // the force that holds the stiffer mass back: (l^2 + 3) x_2 = lambda, x = (1, 1) / sqrt(2)
  CHECK(std::abs(modes.force(0, 0)) == doctest::Approx(2.0 / std::sqrt(2.0)).epsilon(1e-13));
}

TEST_CASE(
    "roots, shapes and forces solve the equations: springs, dashpots, slip, constraints, free motions") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto any = [&](Index n) {
    Eigen::VectorXd v(n);
    for (double& entry : v) entry = uniform(random);
    return v;
  };
  for (const Index n : {3, 12, 30})
    for (int kind = 0; kind < 8; ++kind) {
      CAPTURE(n);
      CAPTURE(kind);
      Eigen::VectorXd square(n), decay(n);
      for (Index j = 0; j < n; ++j) square[j] = 100.0 * std::pow(1.0 + static_cast<double>(j), 4.0);
      if (kind % 2 == 1) square[0] = 0.0;
      for (Index j = 0; j < n; ++j) decay[j] = kind < 4 ? 0.3 : 0.1 + 1e-5 * square[j];
      std::vector<modal::ModalTerm> terms;
      const Eigen::VectorXd a = any(n), b = any(n), c = any(n);
      if (kind != 2) terms.push_back({a + 0.4 * c, a, 1e4, kind % 3 == 0 ? 20.0 : 0.0, false});
      if (kind > 1) terms.push_back({b, b, 0.0, 7.0, false});
      if (kind > 4) terms.push_back({c + 0.3 * b, c, 0.0, 0.0, true});
      check_equations(square, decay, terms);
    }
}

TEST_CASE("equal frequencies: bodies that do not know of each other, seen or not") {
  const Eigen::VectorXd square = vector_of({4.0, 4.0, 4.0, 9.0}), decay = Eigen::VectorXd::Constant(4, 0.1);
  const Eigen::VectorXd first = vector_of({1, 0, 0, 0.5}), second = vector_of({0, 1, 0, 0});
  check_equations(square, decay, {{first, first, 5.0, 0.2, false}});
  check_equations(square, decay, {{first, first, 5.0, 0.2, false}, {second, second, 5.0, 0.0, false}});
  // in the same state: a double root with two shapes
  const Eigen::VectorXd one = vector_of({1, 0}), other = vector_of({0, 1});
  check_equations(vector_of({4.0, 4.0}), vector_of({0.1, 0.1}),
                  {{one, one, 5.0, 0.2, false}, {other, other, 5.0, 0.2, false}});
  // two free motions, one of which drives the other, beside a stiff mode with a damper that sees neither
  check_equations(vector_of({0.0, 0.0, 1e6}), vector_of({2.0, 2.0, 2.0}),
                  {{vector_of({0, 0, 1}), vector_of({0, 0, 1}), 0.0, 6.0, false},
                   {vector_of({1, 0.4, 0.3}), vector_of({1, 0, 0.3}), 1e5, 0.0, false}});
  // driven by what it does not drive
  check_equations(vector_of({4.0, 9.0}), vector_of({0.1, 0.1}),
                  {{vector_of({1, 0.5}), vector_of({1, 0}), 6.0, 0.0, false}});
  // in resonance with it: no basis of modes
  CHECK_FALSE(modal::damped_modes(vector_of({4.0, 9.0}), vector_of({0.1, 0.1}),
                                  {{vector_of({1, 0.5}), vector_of({1, 0}), 5.0, 0.0, false}})
                  .failure.empty());
}

TEST_SUITE_END();
