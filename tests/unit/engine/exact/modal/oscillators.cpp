// Uncoupled modes in closed form, against their differential equation.
#include "engine/exact/modal/oscillators.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

/// Runge and Kutta's fourth order, so many steps that rounding rules: (omega h)^4 is 4e-14 at most.
void integrate(double l, double alpha, double p, double time, double& z, double& rate, double& area) {
  const int steps = 100000;
  const double h = time / steps;
  const auto f = [&](double place, double velocity) { return p - alpha * velocity - l * place; };
  for (int i = 0; i < steps; ++i) {
    const double a1 = f(z, rate), v2 = rate + 0.5 * h * a1, a2 = f(z + 0.5 * h * rate, v2);
    const double v3 = rate + 0.5 * h * a2, a3 = f(z + 0.5 * h * v2, v3), v4 = rate + h * a3;
    const double a4 = f(z + h * v3, v4), before = z, slope = rate;
    z += h / 6.0 * (rate + 2.0 * v2 + 2.0 * v3 + v4);
    rate += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    area += 0.5 * h * (before + z) + h * h / 12.0 * (slope - rate);
  }
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/exact/modal/oscillators");

TEST_CASE("oscillators: free, slow, critically damped, overdamped and fast modes under a constant force") {
  const double alpha = 2.0, p = 3.0, time = 0.7;
  const std::vector<double> squares{0.0, 1e-9, 0.5, 1.0, 1.0 + 1e-9, 2.5, 40.0, 4000.0};
  const Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(squares.data(), 8);
  const modal::Poles poles(d);
  const modal::Spectrum spectrum(poles, Eigen::MatrixXd(8, 0), Eigen::MatrixXd(8, 0), true);
  const modal::Oscillators modes(spectrum, alpha);
  modal::ModalPoint from, to;
  from.z.real.assign(8, 0.4);
  from.rate.real.assign(8, -1.5);
  modal::Amplitudes force, area;
  force.real.assign(8, p);
  modes.advance(from, force, time, to);
  modes.integrate(from, to, force, time, area);
  for (std::size_t k = 0; k < squares.size(); ++k) {
    CAPTURE(squares[k]);
    double z = 0.4, rate = -1.5, sum = 0.0;
    integrate(squares[k], alpha, p, time, z, rate, sum);
    CHECK(to.z.real[k] == doctest::Approx(z).epsilon(1e-11));
    CHECK(to.rate.real[k] == doctest::Approx(rate).epsilon(1e-11));
    CHECK(area.real[k] == doctest::Approx(sum).epsilon(1e-9));
  }
}

TEST_CASE("oscillators: coefficients of the series sum up to the motion") {
  const double alpha = 0.3, p = -2.0, l = 9.0, time = 1.2;
  Eigen::VectorXd d(1);
  d << l;
  const modal::Poles poles(d);
  const modal::Spectrum spectrum(poles, Eigen::MatrixXd(1, 0), Eigen::MatrixXd(1, 0), true);
  modal::ModalPoint from{{{0.7}, {}}, {{1.1}, {}}, {}}, to;
  modal::Oscillators(spectrum, alpha).advance(from, {{p}, {}}, time, to);
  std::vector<double> c(33);
  modal::taylor_of_mode(0.7, 1.1, p, l, alpha, time, c.size(), 1, c.data());
  double sum = 0.0, slope = 0.0;
  for (std::size_t j = 0; j < c.size(); ++j) {
    sum += c[j];
    slope += static_cast<double>(j) * c[j] / time;
  }
  CHECK(sum == doctest::Approx(to.z.real[0]).epsilon(1e-13));
  CHECK(slope == doctest::Approx(to.rate.real[0]).epsilon(1e-13));
}
