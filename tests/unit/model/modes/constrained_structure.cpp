// Structures that contacts hold, against what is left of K when the motions that are fixed are taken out by hand.
#include "model/modes/constrained_structure.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

using namespace signorini;

namespace {

/// Springs k_i between neighbours of a chain that nothing else holds; the springs with 0 part it.
Eigen::MatrixXd chain(const std::vector<double>& springs) {
  const auto n = static_cast<Eigen::Index>(springs.size()) + 1;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const double s = springs[static_cast<std::size_t>(i)];
    k(i, i) += s;
    k(i + 1, i + 1) += s;
    k(i, i + 1) -= s;
    k(i + 1, i) -= s;
  }
  return k;
}

/// u = Z (Z^T K Z)^-1 Z^T b, Z: a base of the motions with T^T u = 0, by hand.
Vector by_hand(const Eigen::MatrixXd& k, const Eigen::MatrixXd& z, const Vector& b) {
  const Eigen::MatrixXd left = z.transpose() * k * z;
  return z * left.partialPivLu().solve(z.transpose() * b);
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/modes/constrained_structure");

TEST_CASE("held: motions that one contact fixes, two fix in other units, or several fix together") {
  const Eigen::MatrixXd k = chain({3.0, 7.0, 0.0, 2e4});  // two parts: three nodes and two
  const SparseMatrix sparse = k.sparseView();
  const Vector b = (Vector(5) << 1.0, -2.0, 0.7, 3.0, 0.4).finished();
  const Combination first{{{0, 1.0}}}, again{{{0, -2.5e3}}}, slope{{{1, 0.6}, {2, -0.8}}}, other{{{4, 0.3}}};
  const Combination sum{{{0, 0.25}, {1, 0.6}, {2, -0.8}}};  // of first and slope: nothing new
  const auto same = [&](const std::vector<Combination>& fixed, const Eigen::MatrixXd& z) {
    const modes::ConstrainedStructure held(sparse, fixed);
    const Vector u = held.solve(b), expected = by_hand(k, z, b);
    CAPTURE(fixed.size());
    CHECK((u - expected).norm() < 1e-11 * expected.norm());
    const Vector greatest = Vector::Constant(expected.size(), expected.norm());
    for (const Combination& form : fixed) CHECK(std::abs(form.dot(u)) < 1e-11 * form.magnitude(greatest));
    CHECK(held.definite());
  };
  Eigen::MatrixXd z = Eigen::MatrixXd::Zero(5, 3);  // u0 = 0, u4 = 0
  z(1, 0) = z(2, 1) = z(3, 2) = 1.0;
  same({first, other}, z);
  same({first, again, other}, z);
  same({again, other, first, other}, z);
  // What is left of a motion that is fixed twice is rounding, of either sign.
  for (int i = 1; i <= 20; ++i) same({first, {{{0, 0.1 * i}}}, other, {{{4, -0.7 / i}}}}, z);
  Eigen::MatrixXd tight = Eigen::MatrixXd::Zero(5, 2);  // and 0.6 u1 = 0.8 u2
  tight(1, 0) = 0.8;
  tight(2, 0) = 0.6;
  tight(3, 1) = 1.0;
  same({first, slope, other}, tight);
  same({slope, other, sum, first, again}, tight);
}

TEST_SUITE_END();
