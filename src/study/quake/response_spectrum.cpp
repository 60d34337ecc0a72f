#include "study/quake/response_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace signorini {

namespace {

/// One step h of the oscillator: from the state (u, v) and the accelerations at both ends to the next state.
struct Step {
  double uu = 0.0, uv = 0.0, vu = 0.0, vv = 0.0;  // free motion
  double ua = 0.0, ub = 0.0, va = 0.0, vb = 0.0;  // response to a at the beginning and at the end

  Step(double w, double z, double h) {
    const double d = w * std::sqrt(1.0 - z * z), e = std::exp(-z * w * h);
    const double c = e * std::cos(d * h), s = e * std::sin(d * h) / d;
    uu = c + z * w * s;
    uv = s;
    vu = -w * w * s;
    vv = c - z * w * s;
    // Particular solution for a = p + q t: u = -(p - 2 z q / w) / w^2 - q t / w^2, starting from rest.
    const auto driven = [&](double p, double q, double& u, double& v) {
      const double u0 = -(p - 2.0 * z * q / w) / (w * w), v0 = -q / (w * w);
      u = u0 + v0 * h - uu * u0 - uv * v0;
      v = v0 - vu * u0 - vv * v0;
    };
    driven(1.0, -1.0 / h, ua, va);
    driven(0.0, 1.0 / h, ub, vb);
  }
};

}  // namespace

double pseudo_acceleration(const std::vector<double>& a, double dt, double T, double z) {
  constexpr double a_period = 40.0;
  const double w = 2.0 * std::numbers::pi / T;
  const auto parts = static_cast<std::size_t>(std::ceil(a_period * dt / T));
  const double h = dt / static_cast<double>(parts);
  const Step step(w, z, h);
  double u = 0.0, v = 0.0, greatest = 0.0;
  const auto advance = [&](double from, double to) {
    const double next = step.uu * u + step.uv * v + step.ua * from + step.ub * to;
    v = step.vu * u + step.vv * v + step.va * from + step.vb * to;
    u = next;
    greatest = std::max(greatest, std::abs(u));
  };
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    const double slope = (a[i + 1] - a[i]) / static_cast<double>(parts);
    for (std::size_t k = 0; k < parts; ++k)
      advance(a[i] + slope * static_cast<double>(k), a[i] + slope * static_cast<double>(k + 1));
  }
  for (double t = 0.0; t < T; t += h) advance(0.0, 0.0);
  return w * w * greatest;
}

}  // namespace signorini
