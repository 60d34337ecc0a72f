// Kernels in four lanes against plain loops, at sizes that are no multiple of four.
#include <doctest/doctest.h>

#include <random>

#include "engine/exact/modal/complex_lanes.hpp"
#include "engine/exact/modal/mode_pairs.hpp"
#include "engine/exact/modal/small_matrices.hpp"

using namespace signorini;
using Eigen::VectorXd;

namespace {

VectorXd random_list(std::mt19937_64& random, Eigen::Index n) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return VectorXd::NullaryExpr(n, [&] { return uniform(random); });
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/exact/modal/complex_lanes");

TEST_CASE("lanes: a great matrix times a few vectors, row by row the same whatever the rows beside") {
  std::mt19937_64 random(1);
  for (const Eigen::Index rows : {1, 3, 4, 9})
    for (const Eigen::Index columns : {1, 2, 3, 4, 5, 8, 11})
      for (const std::size_t count : {1U, 2U, 3U, 4U, 7U}) {
        modal::RowMatrix a(rows, columns);
        for (Eigen::Index i = 0; i < rows; ++i) a.row(i) = random_list(random, columns).transpose();
        std::vector<VectorXd> x, y(count);
        for (std::size_t s = 0; s < count; ++s) x.push_back(random_list(random, columns));
        std::vector<const VectorXd*> from;
        std::vector<VectorXd*> to;
        for (std::size_t s = 0; s < count; ++s) {
          from.push_back(&x[s]);
          to.push_back(&y[s]);
        }
        modal::thin_product(a, from, to);
        for (std::size_t s = 0; s < count; ++s) {
          REQUIRE(y[s].size() == rows);
          for (Eigen::Index i = 0; i < rows; ++i) {
            double plain = 0.0, part[4] = {};
            for (Eigen::Index k = 0; k < columns; ++k) {
              plain += a(i, k) * x[s][k];
              part[k % 4] += a(i, k) * x[s][k];
            }
            CHECK(std::abs(y[s][i] - plain) < 1e-14);
            CHECK(y[s][i] == (part[0] + part[1]) + (part[2] + part[3]));
            const modal::RowMatrix alone = a.row(i);
            VectorXd one;
            modal::thin_product(alone, {&x[s]}, {&one});
            CHECK(one[0] == y[s][i]);
          }
        }
      }
}

TEST_CASE("lanes: pairs of modes against their formula") {
  std::mt19937_64 random(2);
  const double alpha = 0.7;
  for (const Eigen::Index n : {1, 2, 3, 4, 5, 6, 9, 14}) {
    const VectorXd l = (random_list(random, n).array() * 5.0 + 20.0).matrix();
    const VectorXd y0 = random_list(random, n), r0 = random_list(random, n), y1 = random_list(random, n),
                   r1 = random_list(random, n), shared = random_list(random, n),
                   normal = random_list(random, n), tangent = random_list(random, n);
    const modal::ModeEnds ends{l.data(), y0.data(), r0.data(), y1.data(), r1.data()};
    const Eigen::Index k = n - 1;
    VectorXd yy = VectorXd::Zero(n), mixed = yy;
    const double lost = modal::pair_integrals(ends, alpha, k, shared.data(), yy.data(), mixed.data());
    double expected = 0.0, crossed = 0.0;
    for (Eigen::Index i = 0; i < k; ++i) {
      const double d = l[i] - l[k], e = 1.0 / (d * d + 2.0 * alpha * alpha * (l[k] + l[i]));
      const double both = y1[k] * y1[i] - y0[k] * y0[i], rr = r1[k] * r1[i] - r0[k] * r0[i];
      const double yr = y1[k] * r1[i] - y0[k] * r0[i], ry = r1[k] * y1[i] - r0[k] * y0[i];
      const double rates =
          -e * (2.0 * alpha * l[k] * l[i] * both + alpha * (l[k] + l[i]) * rr + d * (l[k] * yr - l[i] * ry));
      const double mix =
          e * (l[i] * (d + 2.0 * alpha * alpha) * both + d * rr - 2.0 * alpha * (l[k] * yr - l[i] * ry));
      expected -= shared[i] / e * rates;
      CHECK(yy[i] == doctest::Approx(both).epsilon(1e-13));
      CHECK(mixed[i] == doctest::Approx(mix).epsilon(1e-11));
      crossed += normal[k] * tangent[i] * mix + tangent[k] * normal[i] * (both - mix);
    }
    CHECK(std::abs(lost - expected) < 1e-10);
    CHECK(std::abs(modal::cross_integral(normal.data(), tangent.data(), k, yy.data(), mixed.data()) -
                   crossed) < 1e-12);
    CHECK(yy[k] == 0.0);  // nothing is written beyond
    CHECK(mixed[k] == 0.0);
  }
}

TEST_CASE("lanes: sums over poles against plain loops") {
  std::mt19937_64 random(3);
  for (const Eigen::Index n : {1, 3, 4, 7, 12}) {
    const VectorXd base = VectorXd::LinSpaced(n, 1.0, 9.0), tiny = 1e-3 * random_list(random, n),
                   w = random_list(random, n), small = random_list(random, 2);
    const Eigen::MatrixXd side = random_list(random, 2 * n).reshaped(n, 2);
    const modal::Complex own(0.3, 0.2);
    const double home = 4.5, home_tiny = 1e-4;
    VectorXd re(n), im(n), re2(n), im2(n), cauchy(n);
    modal::inverse_distances(base.data(), tiny.data(), n, home, home_tiny, own, re.data(), im.data());
    modal::square_all(re.data(), im.data(), n, re2.data(), im2.data());
    modal::cauchy_vector(base.data(), tiny.data(), n, home, home_tiny, own.re, small.data(), side.data(), 2,
                         cauchy.data());
    modal::Complex sum, all;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double pole = base[i] - home + tiny[i] - home_tiny;
      const modal::Complex one = modal::inverse(own - modal::Complex(pole)), two = one * one;
      CHECK(modal::size_of(one - modal::Complex(re[i], im[i])) < 1e-14 * modal::size_of(one));
      CHECK(modal::size_of(two - modal::Complex(re2[i], im2[i])) < 1e-14 * modal::size_of(two));
      CHECK(cauchy[i] == doctest::Approx(side.row(i).dot(small) / (pole - own.re)).epsilon(1e-12));
      sum += one * w[i];
      all += one;
    }
    CHECK(modal::size_of(modal::weighted_sum(re.data(), im.data(), w.data(), n) - sum) <
          1e-13 * (1.0 + modal::size_of(sum)));
    CHECK(modal::size_of(modal::complex_sum(re.data(), im.data(), n) - all) <
          1e-13 * (1.0 + modal::size_of(all)));
  }
}
