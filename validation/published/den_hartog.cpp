// Den Hartog 1931: u'' + u + F sign(u') = cos(b t), all in units of the spring, the mass and the force.
//
//   V = 1/(1 - b^2),  U = sin(pi/b)/(b (1 + cos(pi/b)))
//   no stops: amplitude X = sqrt(V^2 - F^2 U^2), turned where cos(b t) = X/V, sin(b t) = -F U/V
//   it holds while spring and force together exceed friction where it turns, b^2 X >= F:
//       F <= V/sqrt(U^2 + b^-4)
#include <fmt/format.h>
#include <algorithm>

#include "published/formulas.hpp"
#include "published/runs.hpp"

namespace signorini::published {
namespace {

constexpr Real b = 0.8L, F = 0.5L;
const Real V = 1 / (1 - b * b), U = std::sin(pi / b) / (b * (1 + std::cos(pi / b)));

Real boundary() { return V / std::sqrt(U * U + 1 / (b * b * b * b)); }

// two stops: rests at -X until sin(b t) + X = F, slides up to X with u'' + u = sin(b t) - F

struct TwoStops {
  Real X, phase, slides;  ///< rest position, b t of breaking away, time of a slide
};

TwoStops two_stops() {
  const Real beta = 0.5L, f = 0.8L, v = 1 / (1 - beta * beta);
  Real slides = 0;
  const auto phase = [&](Real x) { return std::asin(f - x); };
  const auto beyond = [&](Real x) {
    const Real p = phase(x);
    const Point rest{-x - v * std::sin(p), -v * beta * std::cos(p)};
    const auto at = [&](Real t) -> Point {
      const Point free = swing(rest, 1, -f, t);
      return {free.u + v * std::sin(beta * t + p), free.v + v * beta * std::cos(beta * t + p)};
    };
    slides = first_root([&](Real t) { return at(t).v; }, 0.0L, 1e-2L);
    return at(slides).u - x;
  };
  const Real X = root(beyond, 0.1L, 1.7L);
  static_cast<void>(beyond(X));
  return {X, phase(X), slides};
}

std::vector<Figure> amplitude_figures() {
  return {{"amplitude, F = 0.5", "", std::sqrt(V * V - F * F * U * U)},
          {"stops a cycle, F 1 % below V/sqrt(U^2 + b^-4)", "", 0.0L},
          {"stops a cycle, F 1 % above it", "", 2.0L}};
}

double stops_a_cycle(const Settings& settings, Real friction) {
  const Result r = run("den-hartog.toml", settings,
                       {{"contacts.floor.friction", fmt::format("{:.17g}", static_cast<double>(friction))}});
  const double from = r.report.outcome.t - 10.0 * static_cast<double>(2 * pi / b);
  return static_cast<double>(
             std::count_if(r.events.begin(), r.events.end(),
                           [&](const Event& e) { return e.t > from && e.type == EventType::stick; })) /
         10.0;
}

std::vector<double> amplitude(const Settings& settings) {
  const Real X = std::sqrt(V * V - F * F * U * U);
  const double turns = static_cast<double>((std::atan2(-F * U / V, X / V) + 2 * pi * 58) / b);
  const Result r = run("den-hartog.toml", settings, {{"run.output_times", list({turns})}});
  return {row_at(r, turns).u[0], stops_a_cycle(settings, boundary() * (1 - 1e-2L)),
          stops_a_cycle(settings, boundary() * (1 + 1e-2L))};
}

std::vector<Figure> stops_figures() {
  const TwoStops s = two_stops();
  return {{"rests at", "", s.X}, {"time of a slide", "", s.slides}};
}

std::vector<double> stops(const Settings& settings) {
  const TwoStops s = two_stops();
  const double rests = static_cast<double>((2 * pi * 20 + s.phase) / 0.5L - 0.1L);
  const Result r = run(SIGNORINI_MODELS "/den-hartog.toml", settings,
                       {{"run.t_end", fmt::format("{}", rests)}, {"run.output_times", list({rests})}});
  double begin = missing, slid = missing;  // of the last slide
  for (const Event& e : r.events) {
    if (e.type == EventType::slip) begin = e.t;
    if (e.type == EventType::stick) slid = e.t - begin;
  }
  return {-row_at(r, rests).u[0], slid};
}

}  // namespace

std::vector<Case> den_hartog() {
  return {{"Den Hartog, no stops", "Den Hartog, Phil. Mag. 9 (1930) and Trans. ASME 53 (1931)", 2e-3, 1e-7,
           4e-6, amplitude_figures, amplitude},
          {"Den Hartog, two stops", "the same equations with stops", 1e-3, 2e-7, 1e-6, stops_figures, stops}};
}

}  // namespace signorini::published
