// Orbits with rests of two masses, one of which rubs, after Pascal 2014.
//
//   slides up:  u1'' + 2 u1 - u2 = 2 sin(b t) - 1,  u2'' + u2 - u1 = 0      two modes and a forced swing
//   rests:      u1 fixed, u2'' + u2 - u1 = 0, until 2 sin(b t) - 2 u1 + u2 = -1
//
// Symmetric: half a cycle later all has changed sign. The map of half a cycle contracts, because the rest
// takes a mode away; it is repeated until it stands still.
#include <fmt/format.h>

#include "published/formulas.hpp"
#include "published/runs.hpp"

namespace signorini::published {
namespace {

constexpr Real b = 0.4L, P = 2, F = 1;

/// Both masses where mass 1 breaks away upwards, and b t there.
struct Start {
  Point first, second;
  Real phase;
};

struct Orbit {
  Start start;
  Real slides, rests;  ///< times
};

/// Sliding up from `s` for a time t.
Start slide(const Start& s, Real t) {
  Start end{{0, 0}, {0, 0}, s.phase + b * t};
  for (const Real sign : {-1.0L, 1.0L}) {
    const Real w2 = (3 + sign * std::sqrt(5.0L)) / 2, y = 2 - w2, norm = 1 + y * y;  // shape (1, y)
    const Real forced = P / norm / (w2 - b * b), w = std::sqrt(w2);
    const Point q{(s.first.u + y * s.second.u) / norm - forced * std::sin(s.phase),
                  (s.first.v + y * s.second.v) / norm - forced * b * std::cos(s.phase)};
    Point at = swing(q, w, -F / norm / w2, t);
    at.u += forced * std::sin(end.phase);
    at.v += forced * b * std::cos(end.phase);
    end.first.u += at.u;
    end.first.v += at.v;
    end.second.u += y * at.u;
    end.second.v += y * at.v;
  }
  return end;
}

/// Half a cycle, from breaking away upwards to breaking away downwards.
Orbit half_cycle(const Start& s) {
  const Real slides = first_root([&](Real t) { return slide(s, t).first.v; }, 0.0L, 1e-2L);
  const Start stopped = slide(s, slides);
  const Real held = stopped.first.u;
  const auto second = [&](Real t) { return swing(stopped.second, 1, held, t); };
  const auto above = [&](Real t) { return P * std::sin(stopped.phase + b * t) - 2 * held + second(t).u + F; };
  const Real rests = first_root(above, 0.0L, 1e-2L);
  const Point p = second(rests);
  return {{{-held, 0}, {-p.u, -p.v}, stopped.phase + b * rests - pi}, slides, rests};
}

Orbit orbit() {
  const Start at_the_limit{{-1, 0}, {-1, 0}, 0};  // 2 sin(b t) - 2 u1 + u2 = 1
  Orbit o{at_the_limit, 0, 0};
  for (int i = 0; i < 400; ++i) o = half_cycle(o.start);
  return o;
}

std::vector<Figure> figures() {
  const Orbit o = orbit();
  return {{"mass 1 rests at, m", "", std::abs(o.start.first.u)},
          {"a slide lasts, s", "", o.slides},
          {"a rest lasts, s", "", o.rests}};
}

std::vector<double> ours(const Settings& settings) {
  const double rests = static_cast<double>((orbit().start.phase + 2 * pi * 57) / b - 0.1L);
  const Result r = run("pascal.toml", settings, {{"run.output_times", list({rests})}});
  double slip = missing, stick = missing, slides = missing, rest = missing;
  for (const Event& e : r.events) {
    if (e.type == EventType::slip) {
      rest = e.t - stick;
      slip = e.t;
    } else if (e.type == EventType::stick) {
      slides = e.t - slip;
      stick = e.t;
    }
  }
  return {std::abs(row_at(r, rests).u[0]), slides, rest};
}

}  // namespace

std::vector<Case> pascal() {
  return {{"Pascal, orbit with rests", "after Pascal, Nonlinear Dynamics 77 (2014) 267-276", 2e-3, 2e-6, 3e-5,
           figures, ours}};
}

}  // namespace signorini::published
