// Housner 1963: a slender block rocks, I0 th'' = m g (h th -+ b), p^2 = m g h/I0, a = b/h.
//
//   released at th0:  first impact at acosh(1/(1 - th0/a))/p
//   later ones        2/p atanh(sqrt(r^n (1 - (1 - th0/a)^2))) after the n-th, r = (1 - 2 m b^2/I0)^2
//   overturned by a constant acceleration A for a time t:  cosh(p t) = 1 + 1/(2 R (R - 1)),  R = A/(g a)
#include <fmt/format.h>

#include "published/formulas.hpp"
#include "published/runs.hpp"

namespace signorini::published {
namespace {

constexpr Real m = 1, g = 9.81L, half_width = 0.2L, half_height = 1;
constexpr Real I0 = 4 * m * (half_width * half_width + half_height * half_height) / 3;
const Real p = std::sqrt(m * g * half_height / I0);
constexpr Real pulse = 1.5L;  // R

Real impact(int n) {
  const Real tilt = 1 - 0.5L, r = 1 - 2 * m * half_width * half_width / I0;  // of th', so squared below
  Real t = std::acosh(1 / tilt) / p, kept = 1 - tilt * tilt;
  for (int i = 1; i < n; ++i) {
    kept *= r * r;
    t += 2 / p * std::atanh(std::sqrt(kept));
  }
  return t;
}

Real shortest_pulse() { return std::acosh(1 + 1 / (2 * pulse * (pulse - 1))) / p; }

std::vector<Figure> figures() {
  return {{"impact 1, s", "", impact(1)},
          {"impact 2, s", "", impact(2)},
          {"impact 5, s", "", impact(5)},
          {"shortest pulse of 1.5 g b/h that overturns, s", "", shortest_pulse()}};
}

bool overturns(const Settings& settings, double t) {
  const double moment = static_cast<double>(pulse * m * g * half_width);
  const Result r = run("housner.toml", settings,
                       {{"run.initial", "{ u = [0.0, 0.0], v = [0.0, 0.0] }"},
                        {"run.t_end", "3.0"},
                        {"run.output_times", "[3.0]"},
                        {"loads.2.amplitude", fmt::format("{}", moment)},
                        {"loads.2.history.end", fmt::format("{}", t)}});
  // th - a is a sum of exp(p t), whose sign decides, and exp(-p t)
  const double beyond = r.rows.back().u[1] - static_cast<double>(half_width / half_height);
  return r.rows.back().v[1] + static_cast<double>(p) * beyond > 0.0;
}

/// By halving, to 1e-13 s.
double found_pulse(const Settings& settings) {
  double low = 0.9 * static_cast<double>(shortest_pulse()),
         high = 1.1 * static_cast<double>(shortest_pulse());
  if (overturns(settings, low) || !overturns(settings, high)) return missing;
  while (high - low > 1e-13) {
    const double middle = (low + high) / 2;
    (overturns(settings, middle) ? high : low) = middle;
  }
  return (low + high) / 2;
}

std::vector<double> ours(const Settings& settings) {
  const Result r = run("housner.toml", settings);
  return {time_of(r, EventType::impact, 0), time_of(r, EventType::impact, 1),
          time_of(r, EventType::impact, 4), found_pulse(settings)};
}

}  // namespace

std::vector<Case> housner() {
  return {{"Housner, rocking block", "Housner, Bull. Seismol. Soc. Am. 53 (1963) 403-417", 1e-3, 1e-6, 1e-5,
           figures, ours}};
}

}  // namespace signorini::published
