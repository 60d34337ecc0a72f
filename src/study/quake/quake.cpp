#include "study/quake/quake.hpp"

#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "study/quake/spectra.hpp"

namespace signorini::quake {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

double envelope(double s) {
  constexpr double rise = 0.15, fall = 0.5, decay = 3.0;
  if (s < rise) return s * s / (rise * rise);
  if (s <= fall) return 1.0;
  const double left = std::exp(-decay);
  return std::max(0.0, (std::exp(-decay * (s - fall) / (1.0 - fall)) - left) / (1.0 - left));
}

double amplitude(const QuakeSpec& spec, double frequency) {
  const double r = frequency / spec.ground_frequency, q = frequency / spec.low_frequency;
  const auto square = [](double x) { return x * x; };
  const double ground = 4.0 * square(spec.ground_damping * r), low = 4.0 * square(spec.low_damping * q);
  return std::sqrt((1.0 + ground) / (square(1.0 - r * r) + ground) * square(q * q) /
                   (square(1.0 - q * q) + low));
}

/// A sum of cosines with adjustable amplitudes and constant phases.
class Waves {
 public:
  explicit Waves(const QuakeSpec& spec) : spec_(spec) {
    const auto steps = static_cast<std::size_t>(std::llround(spec.duration / spec.dt));
    samples_ = steps + 1;
    const std::unique_ptr<gsl_rng, void (*)(gsl_rng*)> random(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
    gsl_rng_set(random.get(), spec.seed);
    // Frequencies up to 1 / (3 dt), three samples per wave: high enough to match the spectrum down to periods of
    // 0.05 s. Linear interpolation between samples attenuates the fastest waves; the spectrum is computed with the
    // same interpolation, and so includes this effect.
    const double most = 1.0 / (3.0 * spec.dt);
    for (double f = 1.0 / spec.duration; f <= most; f += 1.0 / spec.duration) {
      frequencies.push_back(f);
      amplitudes.push_back(amplitude(spec, f));
      phases_.push_back(two_pi * gsl_rng_uniform(random.get()));
    }
  }
  [[nodiscard]] std::vector<double> sum() const {
    std::vector<double> a(samples_, 0.0);
    for (std::size_t k = 0; k < frequencies.size(); ++k) {
      // cos(w t + phi) from sample to sample by rotation: error 1e-13 after 1000 samples.
      const double turn = two_pi * frequencies[k] * spec_.dt, c = std::cos(turn), s = std::sin(turn);
      double x = amplitudes[k] * std::cos(phases_[k]), y = amplitudes[k] * std::sin(phases_[k]);
      for (double& value : a) {
        value += x;
        const double next = c * x - s * y;
        y = s * x + c * y;
        x = next;
      }
    }
    for (std::size_t i = 0; i < samples_; ++i)
      a[i] *= envelope(static_cast<double>(i) / static_cast<double>(samples_ - 1));
    return a;
  }

  std::vector<double> frequencies, amplitudes;

 private:
  QuakeSpec spec_;
  std::size_t samples_ = 0;
  std::vector<double> phases_;
};

double greatest(const std::vector<double>& a) {
  double most = 0.0;
  for (const double value : a) most = std::max(most, std::abs(value));
  return most;
}

void scale(std::vector<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

/// Adds the terms with c1 and c2 (quake.hpp), which make the ground's final velocity and displacement zero.
void come_to_rest(std::vector<double>& a, double dt) {
  std::vector<double> first(a.size()), second(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(a.size() - 1);
    first[i] = s * (1.0 - s);
    second[i] = first[i] * (1.0 - 2.0 * s);
  }
  for (int turn = 0; turn < 2; ++turn) {  // the second iteration removes the rounding of the first
    const GroundMotion g = ground_motion(a, dt), p = ground_motion(first, dt), q = ground_motion(second, dt);
    const double det = p.end_velocity * q.end_displacement - q.end_velocity * p.end_displacement;
    const double c1 = (g.end_velocity * q.end_displacement - q.end_velocity * g.end_displacement) / det;
    const double c2 = (p.end_velocity * g.end_displacement - g.end_velocity * p.end_displacement) / det;
    for (std::size_t i = 0; i < a.size(); ++i) a[i] -= c1 * first[i] + c2 * second[i];
  }
}

/// Scales A_k by the ratio of target and spectrum, at periods equally spaced on a logarithmic scale. The iteration does
/// not converge, since a peak of the motion may move; the best iterate is kept.
void match(Waves& waves, const QuakeSpec& spec) {
  constexpr int turns = 20, periods = 120;
  const double low = std::log(0.6 * min_matched_period), high = std::log(2.0 * max_matched_period);
  std::vector<double> best = waves.amplitudes;
  double least_off = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn <= turns; ++turn) {
    std::vector<double> a = waves.sum();
    come_to_rest(a, spec.dt);
    std::vector<double> quotient;
    double off = 0.0;
    for (int i = 0; i < periods; ++i) {
      const double T = std::exp(low + (high - low) * i / (periods - 1));
      quotient.push_back(spec.target(T) / pseudo_acceleration(a, spec.dt, T, spectrum_damping));
      if (T >= min_matched_period && T <= max_matched_period)
        off = std::max(off, std::abs(std::log(quotient.back())));
    }
    if (off < least_off) {
      least_off = off;
      best = waves.amplitudes;
    }
    for (std::size_t k = 0; k < waves.frequencies.size(); ++k) {
      const double at = (-std::log(waves.frequencies[k]) - low) / (high - low) * (periods - 1);
      const double within = std::clamp(at, 0.0, periods - 1.0);
      const auto i = std::min(static_cast<std::size_t>(within), quotient.size() - 2);
      const double part = within - static_cast<double>(i);
      waves.amplitudes[k] *= quotient[i] + part * (quotient[i + 1] - quotient[i]);
    }
  }
  waves.amplitudes = best;
}

}  // namespace

GroundMotion ground_motion(const std::vector<double>& a, double dt) {
  GroundMotion g;
  double u = 0.0, v = 0.0;
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    u += dt * v + dt * dt * (a[i] / 3.0 + a[i + 1] / 6.0);
    v += 0.5 * dt * (a[i] + a[i + 1]);
    g.velocity = std::max(g.velocity, std::abs(v));
    g.displacement = std::max(g.displacement, std::abs(u));
  }
  g.end_velocity = v;
  g.end_displacement = u;
  return g;
}

std::vector<double> quake(const QuakeSpec& spec) {
  Waves waves(spec);
  if (spec.target) match(waves, spec);
  std::vector<double> a = waves.sum();
  come_to_rest(a, spec.dt);
  if (!spec.target) scale(a, spec.pga / greatest(a));
  return a;
}

}  // namespace signorini::quake
