#include "study/quake/quake.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/quake/spectra.hpp"

using namespace signorini;

namespace {

/// The ground by the trapezoidal rule on a fine grid: independent of the closed form of ground_motion().
quake::GroundMotion by_small_steps(const std::vector<double>& a, double dt) {
  constexpr int parts = 64;
  quake::GroundMotion g;
  double u = 0.0, v = 0.0;
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    for (int k = 0; k < parts; ++k) {
      const double h = dt / parts, x = (k + 0.5) / parts, middle = a[i] + x * (a[i + 1] - a[i]);
      u += h * v + 0.5 * h * h * middle;
      v += h * middle;
    }
  g.end_velocity = v;
  g.end_displacement = u;
  return g;
}

}  // namespace

TEST_SUITE("unit/study/quake/quake") {
  TEST_CASE("response spectrum: a base that suddenly accelerates, undamped and damped") {
    // From rest under a constant a0: u is greatest after half a damped period, a0 (1 + exp(-z pi / sqrt(1 - z^2))) / w^2.
    const std::vector<double> a(4001, 3.0);
    for (const double T : {0.37, 1.0, 2.3})
      for (const double z : {0.0, 0.05, 0.2}) {
        CAPTURE(T);
        CAPTURE(z);
        const double exact = 3.0 * (1.0 + std::exp(-z * std::numbers::pi / std::sqrt(1.0 - z * z)));
        CHECK(quake::pseudo_acceleration(a, 1e-3, T, z) == doctest::Approx(exact).epsilon(3e-3));
        CHECK(quake::pseudo_acceleration(a, 1e-3, T, z) <= exact * (1.0 + 1e-12));
      }
  }

  TEST_CASE("response spectrum: a ramp between samples is followed exactly, whatever their distance") {
    // a = t: u = -(t - sin(w t) / w) / w^2 without damping; it grows as far as a does, and the free motion behind it.
    const double w = 2.0 * std::numbers::pi / 0.8, end = 5.0;
    std::vector<double> coarse(11), fine(2001);
    for (std::size_t i = 0; i < coarse.size(); ++i) coarse[i] = 0.5 * static_cast<double>(i);
    for (std::size_t i = 0; i < fine.size(); ++i) fine[i] = 0.0025 * static_cast<double>(i);
    const double u = (end - std::sin(w * end) / w) / (w * w), v = (1.0 - std::cos(w * end)) / (w * w);
    const double exact = w * w * std::hypot(u, v / w);
    CHECK(quake::pseudo_acceleration(coarse, 0.5, 0.8, 0.0) == doctest::Approx(exact).epsilon(3.1e-3));
    // A greatest value between two samples is (w dt)^2 / 8 = 4.8e-5 of it above them.
    CHECK(quake::pseudo_acceleration(fine, 0.0025, 0.8, 0.0) == doctest::Approx(exact).epsilon(4.9e-5));
  }

  TEST_CASE("quake: the ground comes to rest where it was, has its peak, and follows its seed") {
    quake::QuakeSpec spec;
    spec.pga = 2.5;
    spec.duration = 17.3;
    const std::vector<double> a = quake::quake(spec);
    CHECK(a.size() == 1731);
    CHECK(a.front() == 0.0);
    CHECK(std::abs(a.back()) < 1e-15);
    double most = 0.0;
    for (const double value : a) most = std::max(most, std::abs(value));
    CHECK(most == doctest::Approx(2.5).epsilon(1e-14));
    // Rounding: 1731 samples of 2.5 at eps, times 0.01 s and 17.3 s.
    const quake::GroundMotion g = by_small_steps(a, spec.dt);
    CHECK(std::abs(g.end_velocity) < 1e-12);
    CHECK(std::abs(g.end_displacement) < 1e-11);
    CHECK(quake::ground_motion(a, spec.dt).velocity > 0.05);
    CHECK(quake::quake(spec) == a);
    spec.seed = 2;
    CHECK(quake::quake(spec) != a);
  }

  TEST_CASE("quake: the ground's filter is felt: twice its frequency, and the spectrum's peak moves") {
    const auto center = [](double frequency) {
      double sum = 0.0, weighted = 0.0;
      for (unsigned long seed = 1; seed <= 4; ++seed) {
        quake::QuakeSpec spec;
        spec.pga = 1.0;
        spec.seed = seed;
        spec.ground_frequency = frequency;
        spec.ground_damping = 0.2;
        const std::vector<double> a = quake::quake(spec);
        for (double T = 0.1; T < 2.0; T *= 1.1) {
          const double s = quake::pseudo_acceleration(a, spec.dt, T, 0.05);
          sum += s * s;
          weighted += s * s * std::log(T);
        }
      }
      return std::exp(weighted / sum);
    };
    CHECK(center(1.5) / center(3.0) > 1.4);
  }

  TEST_CASE("quake: the spectrum of EN 1998-1, ground B and D, within 20 % everywhere and 3 % on average") {
    for (const char* name : {"ec8-B", "ec8-D"}) {
      CAPTURE(name);
      quake::QuakeSpec spec;
      spec.pga = 2.0;
      spec.target = quake::TargetSpectrum::read(name, spec.pga);
      const std::vector<double> a = quake::quake(spec);
      // Closed forms of the standard, at other periods than those of the iteration.
      const bool b = name[4] == 'B';
      const double S = b ? 1.2 : 1.35, TB = b ? 0.15 : 0.2, TC = b ? 0.5 : 0.8;
      double sum = 0.0;
      int count = 0;
      for (double T = 0.06; T < 2.0; T *= 1.083) {
        const double exact = 2.0 * S * (T < TB ? 1.0 + 1.5 * T / TB : T < TC ? 2.5 : 2.5 * TC / T);
        const double is = quake::pseudo_acceleration(a, spec.dt, T, 0.05);
        CAPTURE(T);
        CHECK(std::abs(is / exact - 1.0) < 0.2);
        sum += is / exact;
        ++count;
      }
      CHECK(std::abs(sum / count - 1.0) < 0.03);
      CHECK(std::abs(by_small_steps(a, spec.dt).end_displacement) < 1e-11);
    }
  }
}
