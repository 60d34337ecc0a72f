// Functions of time in one basis: what histories are in it, what answers them, their integrals and series.
#include "engine/exact/modal/time_basis.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

/// A model with one load: 2 - t + 3 t^2 about 0.5, and a sine.
Model driven() {
  Model model;
  Load load;
  load.history = History(Piece{0.5, {2.0, -1.0, 3.0}, 1.5, 4.0, 0.3});
  model.loads.push_back(load);
  return model;
}

double history_text(double t) {
  const double s = t - 0.5;
  return 2.0 - s + 3.0 * s * s + 1.5 * std::sin(4.0 * s + 0.3);
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/exact/modal/time_basis");

TEST_CASE("a history in the basis, its derivative and its series") {
  const Model model = driven();
  const modal::TimeBasis basis(model, 1.25);
  const modal::TimeCoefficients c = basis.of(model.loads[0].history.piece(1.25)), rate = basis.derivative(c);
  CHECK(basis.degree() == 3);
  for (const double x : {0.0, 0.4, 2.0}) {
    CHECK(c.dot(basis.at(x)) == doctest::Approx(history_text(1.25 + x)).epsilon(1e-13));
    const double slope = (history_text(1.25 + x + 1e-5) - history_text(1.25 + x - 1e-5)) / 2e-5;
    CHECK(rate.dot(basis.at(x)) == doctest::Approx(slope).epsilon(1e-8));
  }
  std::vector<double> p(31);
  const modal::TimeBasis::FastWaveBound slow = basis.taylor(c, 0.4, 0.7, 4.0, p);
  CHECK(slow.value == 0.0);
  CHECK(slow.rest < 1e-12);
  for (const double x : {0.0, 0.3, 1.0}) {
    double sum = 0.0;
    for (std::size_t k = p.size(); k-- > 0;) sum = sum * x + p[k];
    CHECK(sum == doctest::Approx(history_text(1.25 + 0.4 + 0.7 * x)).epsilon(1e-13));
  }
  // A shorter polynomial is off by no more than it says, and not by much less, whatever the wave's size.
  for (const double size : {1e-6, 1.0, 1e6}) {
    CAPTURE(size);
    std::vector<double> few(9);
    const double rest = basis.taylor(size * c, 0.4, 0.7, 4.0, few).rest;
    double most = 0.0;
    for (const double x : {0.5, 0.8, 1.0}) {
      double sum = 0.0;
      for (std::size_t k = few.size(); k-- > 0;) sum = sum * x + few[k];
      most = std::max(most, std::abs(sum - size * history_text(1.25 + 0.4 + 0.7 * x)));
    }
    CHECK(most <= rest);
    CHECK(rest < 20.0 * most);
  }
  // A wave that turns too far is left out, and bounded.
  const modal::TimeBasis::FastWaveBound fast = basis.taylor(c, 0.4, 2.0, 4.0, p);
  CHECK(fast.value == doctest::Approx(1.5).epsilon(1e-13));
  CHECK(fast.rate == doctest::Approx(6.0).epsilon(1e-13));
  double sum = 0.0;
  for (std::size_t k = p.size(); k-- > 0;) sum = sum * 0.5 + p[k];
  CHECK(std::abs(sum - history_text(1.25 + 1.4)) < 1.5);
  CHECK(std::abs(sum - (history_text(1.25 + 1.4) - 1.5 * std::sin(4.0 * 2.15 + 0.3))) < 1e-12);
}

TEST_CASE("answers solve z' = l z + p, with frequency and without") {
  const Model model = driven();
  const modal::TimeBasis basis(model, 0.0);
  const modal::TimeCoefficients c = basis.of(model.loads[0].history.piece(0.0));
  const std::complex<double> factor(0.7, -0.2);
  const modal::ComplexTimeCoefficients p = factor * c.cast<std::complex<double>>();
  for (const std::complex<double> l : {std::complex<double>(-0.5, 3.0), {-2.0, 0.0}, {0.0, 0.0}}) {
    const modal::ComplexTimeCoefficients z = basis.response(l, p);
    const modal::TimeCoefficients re = z.real(), im = z.imag();
    for (const double x : {0.0, 0.8, 2.5}) {
      const auto b = basis.at(x);
      const std::complex<double> rate(basis.derivative(re).dot(b), basis.derivative(im).dot(b));
      const std::complex<double> value(re.dot(b), im.dot(b));
      CHECK(std::abs(rate - l * value - factor * c.dot(b)) < 1e-11);
    }
  }
}

TEST_CASE("answers of slow roots are small where the motion is, to rounding") {
  // z' = l z + 3 x on [0, 0.01], z(0) = 0: z = 3 (e^(l x) - 1 - l x) / l^2 = 3 x^2 (1/2 + l x/6 + (l x)^2/24 + ...)
  Model model;
  Load load;
  load.history = History(Piece{0.0, {0.0, 3.0}, 0.0, 0.0, 0.0});
  model.loads.push_back(load);
  modal::TimeBasis basis(model, 0.0);
  const modal::TimeCoefficients ramp = basis.of(model.loads[0].history.piece(0.0));
  const double x = 0.01;
  const auto slow_series = [&](std::complex<double> l) {
    std::complex<double> sum = 0.0, term = 0.5;
    for (int m = 3; std::abs(term) > 1e-20; ++m) {
      sum += term;
      term *= l * x / static_cast<double>(m);
    }
    return 3.0 * x * x * sum;
  };
  Eigen::VectorXcd roots(4);
  roots << std::complex<double>(-2.0, 0.0), std::complex<double>(0.3, 40.0), 0.0,
      std::complex<double>(-9.0, 800.0);
  basis.reserve_slow_roots(roots, x);
  CHECK(basis.degree() > 12);  // 0.4^13 / 13! = 1e-15
  const Eigen::VectorXd b = basis.at(x);
  modal::TimeCoefficients c = modal::TimeCoefficients::Zero(basis.size());
  c.head(ramp.size()) = ramp;
  for (Eigen::Index k = 0; k < roots.size(); ++k) {
    const modal::ComplexTimeCoefficients z = basis.response(roots[k], c.cast<std::complex<double>>());
    const std::complex<double> value = (z.transpose() * b)(0);
    const double terms = (z.cwiseAbs().transpose() * b)(0);
    const bool slow = std::abs(roots[k]) * x < 0.5;
    if (slow) {
      CHECK(z[0] == 0.0);
      CHECK(std::abs(value - slow_series(roots[k])) < 1e-15 * std::abs(value));  // backwards 1e-12 of it
      CHECK(terms < 1.5 * std::abs(value));
    } else {  // backwards: what answers alone, without e^(l x)
      CHECK(std::abs(value - (-3.0 * x / roots[k] - 3.0 / (roots[k] * roots[k]))) < 1e-15 * terms);
      CHECK(z.tail(z.size() - 2).isZero(0.0));
    }
  }
  // Room for a longer stretch is found anew; constants need none.
  basis.reserve_slow_roots(roots, 1.0);
  CHECK(basis.degree() == 2);
  CHECK(std::abs(basis.response(-2.0, ramp.cast<std::complex<double>>())[0] - (-0.75)) < 1e-15);
  modal::TimeBasis still(Model{}, 0.0);
  still.reserve_slow_roots(roots, x);
  CHECK(still.is_constant());
}

TEST_CASE("integrals of products") {
  const Model model = driven();
  const modal::TimeBasis basis(model, 0.0);
  const modal::TimeCoefficients c = basis.of(model.loads[0].history.piece(0.0));
  double sum = 0.0;  // Simpson
  const int n = 20000;
  for (int i = 0; i <= n; ++i) {
    const double f = history_text(0.2 + 3.0 * i / n);
    sum += (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * f * f;
  }
  CHECK(c.dot(basis.products(0.2, 3.2) * c) == doctest::Approx(sum * 3.0 / n / 3.0).epsilon(1e-11));
}

TEST_CASE("what answers lose to rounding") {
  const modal::TimeBasis still(Model{}, 0.0);
  CHECK(still.cancellation(0.0, 2.0) == 0.0);
  CHECK(still.cancellation({-0.01, 0.0}, 2.0) == doctest::Approx(50.0));
  CHECK(still.cancellation({0.01, 0.0}, 2.0) == doctest::Approx(2500.0));  // beside -0.01: cosh 0.02 - 1
  CHECK(still.cancellation({0.0, 0.01}, 2.0) == doctest::Approx(2500.0));  // cos 0.02 - 1, twice
  const modal::TimeBasis waves(driven(), 0.0);
  CHECK(waves.cancellation({0.0, 4.0}, 2.0) > 1e12);   // resonance
  CHECK(waves.cancellation({-0.4, 4.0}, 2.0) < 10.0);  // with damping
}

TEST_SUITE_END();
