#include "study/quake/spectra.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "scene/time_table.hpp"
#include "signorini/error.hpp"

namespace signorini::quake {
namespace {

/// Coefficients of one step h of the oscillator, from the state (u, v) and the accelerations at both ends to
/// the next state.
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

namespace {

struct Ground {
  char letter;
  double soil, TB, TC, TD;
};
// EN 1998-1:2004, table 3.2.
constexpr Ground grounds[] = {{'A', 1.0, 0.15, 0.4, 2.0},
                              {'B', 1.2, 0.15, 0.5, 2.0},
                              {'C', 1.15, 0.2, 0.6, 2.0},
                              {'D', 1.35, 0.2, 0.8, 2.0},
                              {'E', 1.4, 0.15, 0.5, 2.0}};

}  // namespace

TargetSpectrum TargetSpectrum::read(const std::string& name_or_file, double ag) {
  TargetSpectrum target;
  target.ag_ = ag;
  if (name_or_file.starts_with("ec8-")) {
    for (const Ground& g : grounds) {
      if (name_or_file.substr(4) != std::string(1, g.letter)) continue;
      target.soil_ = g.soil;
      target.TB_ = g.TB;
      target.TC_ = g.TC;
      target.TD_ = g.TD;
      return target;
    }
    throw UsageError("--spectrum: found \"" + name_or_file + "\", expected ec8-A to ec8-E, or a file");
  }
  std::ifstream file(name_or_file, std::ios::binary);
  if (!file)
    throw FileError(name_or_file, "cannot be read; --spectrum takes ec8-A to ec8-E, or a file of rows T,PSA");
  const scene::TimeTable table = scene::read_time_table(file, name_or_file, "--spectrum");
  for (std::size_t i = 0; i < table.times.size(); ++i) {
    const double T = table.times[i], value = table.values[i];
    if (!(T > 0.0) || !(value > 0.0) || (i > 0 && T == table.times[i - 1]))
      throw FileError(name_or_file,
                      fmt::format("row {} has T = {} and PSA = {}, expected {}", i + 1, T, value,
                                  T > 0.0 && value > 0.0 ? "each T only once" : "both above 0"));
    target.rows_.emplace_back(T, value);
  }
  if (target.rows_.empty()) throw FileError(name_or_file, "has no row, expected rows T,PSA");
  return target;
}

double TargetSpectrum::operator()(double T) const {
  if (!rows_.empty()) {
    if (T <= rows_.front().first) return rows_.front().second;
    if (T >= rows_.back().first) return rows_.back().second;
    const auto after = std::upper_bound(rows_.begin(), rows_.end(), T,
                                        [](double value, const auto& row) { return value < row.first; });
    const auto& [T0, s0] = *(after - 1);
    const auto& [T1, s1] = *after;
    return s0 * std::pow(s1 / s0, std::log(T / T0) / std::log(T1 / T0));
  }
  const double ground = ag_ * soil_;
  if (T < TB_) return ground * (1.0 + 1.5 * T / TB_);
  if (T < TC_) return 2.5 * ground;
  return T < TD_ ? 2.5 * ground * TC_ / T : 2.5 * ground * TC_ * TD_ / (T * T);
}

}  // namespace signorini::quake
