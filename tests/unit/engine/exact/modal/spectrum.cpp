// Eigenvalues and vectors of a diagonal plus a few springs, against dense matrices.
#include "engine/exact/modal/spectrum.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>

#include <complex>
#include <random>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"

using namespace signorini;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Case {
  VectorXd d;
  MatrixXd u, v;
  bool symmetric;

  [[nodiscard]] MatrixXd dense() const { return MatrixXd(d.asDiagonal()) + u * v.transpose(); }
};

/// Two zero frequencies, two equal ones, springs that see neither all of them nor mode 9.
Case random_case(std::mt19937_64& random, int n, int rank, bool symmetric) {
  std::normal_distribution<double> normal;
  Case c;
  c.symmetric = symmetric;
  c.d =
      VectorXd::NullaryExpr(n, [](Eigen::Index i) { return i < 2 ? 0.0 : 10.0 * std::pow(double(i), 3.0); });
  if (n > 10) c.d[7] = c.d[6];
  c.v = MatrixXd::NullaryExpr(n, rank, [&] { return 30.0 * normal(random); });
  if (n > 10) c.v.row(9).setZero();
  c.u = c.v;
  if (!symmetric) c.u += MatrixXd::NullaryExpr(n, rank, [&] { return 15.0 * normal(random); });
  return c;
}

std::vector<std::complex<double>> values_of(const modal::Spectrum& spectrum) {
  std::vector<std::complex<double>> all(spectrum.real().begin(), spectrum.real().end());
  for (const modal::Complex l : spectrum.pairs()) {
    all.emplace_back(l.re, l.im);
    all.emplace_back(l.re, -l.im);
  }
  return all;
}

/// Two like systems of a spring each, the other's a share stiffer, which the contacts see mixed.
Case twin_case(std::mt19937_64& random, double stiffer, bool symmetric) {
  constexpr int n = 8;
  std::normal_distribution<double> normal;
  Case c;
  c.symmetric = symmetric;
  c.d.resize(2 * n);
  c.u = MatrixXd::Zero(2 * n, 2);
  c.v = c.u;
  for (int i = 0; i < n; ++i) {
    const double u = 30.0 * normal(random), v = symmetric ? u : u * (1.0 + 0.3 * normal(random));
    for (int twin = 0; twin < 2; ++twin) {
      c.d[2 * i + twin] = 10.0 * std::pow(1.0 + i, 3.0);
      c.u(2 * i + twin, twin) = u * (1.0 + twin * stiffer);
      c.v(2 * i + twin, twin) = v;
    }
  }
  const double turn = 0.7;
  MatrixXd mixed(2, 2);
  mixed << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
  if (!symmetric) mixed(0, 1) += 0.4;
  c.u = (c.u * mixed).eval();
  c.v = (c.v * base::solve_dense(mixed, MatrixXd::Identity(2, 2)).transpose()).eval();
  return c;
}

/// A matrix with two equal eigenvalues, less two springs.
Case split_case(std::mt19937_64& random) {
  constexpr int n = 16;
  std::normal_distribution<double> normal;
  const MatrixXd turn = base::orthonormal(MatrixXd::NullaryExpr(n, n, [&] { return normal(random); }));
  VectorXd l = VectorXd::NullaryExpr(n, [](Eigen::Index i) { return 10.0 * std::pow(1.0 + double(i), 2.0); });
  l[9] = l[8];
  const MatrixXd w = MatrixXd::NullaryExpr(n, 2, [&] { return 3.0 * normal(random); });
  const base::EigenPairs open =
      base::symmetric_eigen(turn * l.asDiagonal() * turn.transpose() - w * w.transpose());
  const MatrixXd u = open.vectors.transpose() * w;
  return {open.values, u, u, true};
}

/// The motion that a spectrum makes of a state, and the matrix itself.
void check_against_dense(const Case& c) {
  const modal::Spectrum spectrum(modal::Poles(c.d), c.u, c.v, c.symmetric);
  REQUIRE(spectrum.failure() == "");
  const auto n = c.d.size();
  REQUIRE(values_of(spectrum).size() == static_cast<std::size_t>(n));
  const VectorXd q = VectorXd::LinSpaced(n, -1.0, 2.0);
  modal::Amplitudes z;
  spectrum.to_modes(q, z);
  for (std::size_t k = 0; k < z.real.size(); ++k) z.real[k] *= spectrum.real()[k];
  for (std::size_t k = 0; k < z.pair.size(); ++k) z.pair[k] *= spectrum.pairs()[k];
  VectorXd product;
  spectrum.from_modes({&z}, {&product});
  const MatrixXd a = c.dense();
  CHECK((product - a * q).norm() < rounding::elimination * spectrum.condition() * a.norm() * q.norm());
  for (std::size_t k = 0; k < spectrum.real().size(); ++k)
    for (std::size_t l = 0; l < k; ++l) {
      VectorXd x, y;
      modal::Amplitudes one = spectrum.zero(), other = one;
      one.real[k] = other.real[l] = 1.0;
      spectrum.from_modes({&one, &other}, {&x, &y});
      CHECK(std::abs(spectrum.product(k, l) - x.dot(y)) < 1e-9 * x.norm() * y.norm());
    }
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/exact/modal/spectrum");

TEST_CASE(
    "spectrum: eigenvalues are those of the dense matrix, complex pairs, unseen and equal modes included") {
  std::mt19937_64 random(1);
  int pairs = 0;
  for (const int n : {5, 20, 51})
    for (const int rank : {1, 2, 3, 4})
      for (const bool symmetric : {true, false})
        for (int i = 0; i < 5; ++i) {
          CAPTURE(n);
          CAPTURE(rank);
          CAPTURE(symmetric);
          const Case c = random_case(random, n, rank, symmetric);
          const modal::Poles poles(c.d);
          const modal::Spectrum spectrum(poles, c.u, c.v, symmetric);
          REQUIRE(spectrum.failure() == "");
          pairs += static_cast<int>(spectrum.pairs().size());
          const std::vector<std::complex<double>> found = values_of(spectrum);
          REQUIRE(found.size() == static_cast<std::size_t>(n));
          const MatrixXd a = c.dense();
          for (const std::complex<double> l : base::general_eigenvalues(a)) {
            double nearest = 1e300;
            for (const std::complex<double> mine : found) nearest = std::min(nearest, std::abs(mine - l));
            // The dense matrix is perturbed by rounding of its greatest entries.
            CHECK(nearest < 1e-13 * spectrum.condition() * a.norm());
          }
          CHECK(spectrum.round_trip() < 1e-9);
        }
  CHECK(pairs > 10);
}

TEST_CASE("spectrum: X L Y is the matrix, rows show what the modes show") {
  std::mt19937_64 random(2);
  for (const bool symmetric : {true, false}) {
    const Case c = random_case(random, 30, 3, symmetric);
    const modal::Poles poles(c.d);
    const modal::Spectrum spectrum(poles, c.u, c.v, symmetric);
    REQUIRE(spectrum.failure() == "");
    const VectorXd q = VectorXd::Random(30), form = VectorXd::Random(30);
    modal::Amplitudes z, row;
    spectrum.to_modes(q, z);
    spectrum.of_form(form, row);
    double shown = 0.0;
    for (std::size_t k = 0; k < z.real.size(); ++k) shown += row.real[k] * z.real[k];
    for (std::size_t k = 0; k < z.pair.size(); ++k)
      shown += modal::real_contribution(row.pair[k] * z.pair[k]);
    CHECK(shown == doctest::Approx(form.dot(q)).epsilon(1e-10));
    for (std::size_t k = 0; k < z.real.size(); ++k) z.real[k] *= spectrum.real()[k];
    for (std::size_t k = 0; k < z.pair.size(); ++k) z.pair[k] *= spectrum.pairs()[k];
    VectorXd product;
    spectrum.from_modes({&z}, {&product});
    CHECK((product - c.dense() * q).norm() < 1e-11 * c.dense().norm());
  }
}

TEST_CASE("spectrum: written out or not, the same products") {
  std::mt19937_64 random(4);
  for (const bool symmetric : {true, false})
    for (const int n : {12, 30}) {
      const Case c = random_case(random, n, 3, symmetric);
      const modal::Spectrum written(modal::Poles(c.d), c.u, c.v, symmetric),
          summed(modal::Poles(c.d), c.u, c.v, symmetric, 0);
      REQUIRE(written.failure() == "");
      REQUIRE(summed.failure() == "");
      CHECK(written.stored_bytes() == sizeof(double) * 2 * static_cast<std::size_t>(n * n));
      CHECK(summed.stored_bytes() == 0);
      const VectorXd q = VectorXd::Random(n);
      for (const bool form : {false, true}) {
        modal::Amplitudes a, b;
        form ? written.of_form(q, a) : written.to_modes(q, a);
        form ? summed.of_form(q, b) : summed.to_modes(q, b);
        REQUIRE(a.real.size() == b.real.size());
        REQUIRE(a.pair.size() == b.pair.size());
        const double size = written.condition();
        for (std::size_t k = 0; k < a.real.size(); ++k) CHECK(std::abs(a.real[k] - b.real[k]) < 1e-13 * size);
        for (std::size_t k = 0; k < a.pair.size(); ++k)
          CHECK(modal::size_of(a.pair[k] - b.pair[k]) < 1e-13 * size);
        VectorXd from_a, twice, from_b;
        written.from_modes({&a, &a}, {&from_a, &twice});
        summed.from_modes({&a}, {&from_b});
        CHECK((from_a - from_b).norm() < 1e-13 * size * from_b.norm());
        CHECK(twice == from_a);
      }
    }
}

TEST_CASE("spectrum: without springs every mode is its own") {
  const VectorXd d = VectorXd::LinSpaced(4, 0.0, 3.0), q = VectorXd::LinSpaced(4, 1.0, 2.0);
  const modal::Poles poles(d);
  const modal::Spectrum spectrum(poles, MatrixXd(4, 0), MatrixXd(4, 0), true);
  modal::Amplitudes z;
  spectrum.to_modes(q, z);
  CHECK(z.real == std::vector<double>(q.data(), q.data() + 4));
  CHECK(spectrum.real() == std::vector<double>(d.data(), d.data() + 4));
}

TEST_CASE("spectrum: products of vectors from c and h are those of the vectors") {
  std::mt19937_64 random(3);
  const Case c = random_case(random, 12, 2, false);
  const modal::Poles poles(c.d);
  const modal::Spectrum spectrum(poles, c.u, c.v, false);
  REQUIRE(spectrum.failure() == "");
  const std::size_t count = spectrum.real().size();
  std::vector<VectorXd> x(count);
  for (std::size_t k = 0; k < count; ++k) {
    modal::Amplitudes one;
    one.real.assign(count, 0.0);
    one.pair.assign(spectrum.pairs().size(), modal::Complex());
    one.real[k] = 1.0;
    spectrum.from_modes({&one}, {&x[k]});
  }
  for (std::size_t k = 0; k < count; ++k) {
    CHECK(spectrum.norm_squared(k) == doctest::Approx(x[k].squaredNorm()).epsilon(1e-12));
    for (std::size_t l = 0; l < k; ++l)
      CHECK(std::abs(spectrum.product(k, l) - x[k].dot(x[l])) < 1e-9 * x[k].norm() * x[l].norm());
  }
}

TEST_CASE("spectrum: equal roots have as many vectors, and nearly equal ones") {
  std::mt19937_64 random(5);
  for (const bool symmetric : {true, false})
    for (const double stiffer : {0.0, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-10, 1e-8, 1e-6}) {
      CAPTURE(symmetric);
      CAPTURE(stiffer);
      for (int i = 0; i < 3; ++i) check_against_dense(twin_case(random, stiffer, symmetric));
    }
}

TEST_CASE("spectrum: equal roots between unlike poles") {
  std::mt19937_64 random(6);
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    check_against_dense(split_case(random));
  }
}
