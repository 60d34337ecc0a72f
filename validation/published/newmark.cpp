// Newmark 1965: a block on ground with the acceleration a(t); v' = -a - s N while it slips along s, N = f g.
//
//   rectangular pulse A, ground velocity V after it:  slip V^2/(2 N) (1 - N/A), stops at V/N
//   straight pieces of a(t): v is a parabola on each, u a cubic
#include "published/formulas.hpp"
#include "published/runs.hpp"

namespace signorini::published {
namespace {

constexpr Real N = 1;
const std::string synthetic = "newmark-accelerogram.toml";

std::vector<Figure> pulse_figures() {
  const Real A = 5, V = A * 0.2L;
  return {{"slip against the ground, m", "", V * V / (2 * N) * (1 - N / A)}, {"stops, s", "", V / N}};
}

std::vector<double> pulse(const Settings& settings) {
  const Result r = run("newmark-block.toml", settings);
  return {std::abs(r.rows.back().u[0]), time_of(r, EventType::stick, 0)};
}

struct Slide {
  Real u = 0, v = 0, s = 0;  ///< s: -1, 0 (stuck), 1
  Real stops = 0;
  int slips = 0, reversals = 0;
};

/// The least x in (0, width] with v + (c1 + c2 x) x = 0; more than width where there is none.
Real zero(Real v, Real c1, Real c2, Real width) {
  Real least = 2 * width;
  const auto offer = [&](Real x) {
    if (x > 1e-17L && x <= width && x < least) least = x;
  };
  if (v == 0) {
    offer(-c1 / c2);
    return least;
  }
  const Real disc = c1 * c1 - 4 * c2 * v;
  if (disc < 0) return least;
  const Real q = -(c1 + (c1 < 0 ? -1 : 1) * std::sqrt(disc)) / 2;  // no cancellation
  offer(v / q);
  if (c2 != 0) offer(q / c2);
  return least;
}

/// Through one straight piece, from t on, with the acceleration a at its start and its slope.
void through(Slide& block, Real t, Real a, Real slope, Real width) {
  while (width > 0) {
    if (block.s == 0) {
      const Real limit = slope > 0 ? N : -N, wait = slope == 0 ? 2 * width : (limit - a) / slope;
      if (wait < 0 || wait >= width) return;
      a = limit;
      t += wait;
      width -= wait;
      block.s = limit > 0 ? -1 : 1;
      ++block.slips;
    }
    const Real c1 = -(a + block.s * N), c2 = -slope / 2, x = std::min(zero(block.v, c1, c2, width), width);
    block.u += (block.v + (c1 / 2 + c2 / 3 * x) * x) * x;
    const bool stops = x < width;
    block.v = stops ? 0 : block.v + (c1 + c2 * x) * x;
    a += slope * x;
    t += x;
    width -= x;
    if (!stops) return;
    if (std::abs(a) > N) {
      block.s = a > 0 ? -1 : 1;
      ++block.reversals;
    } else {
      block.s = 0;
      block.stops = t;
    }
  }
}

Slide slide() {
  const HistorySpec a = read_scene(SIGNORINI_PUBLISHED "/" + synthetic).base_motion.at(0).acceleration;
  Slide block;
  for (std::size_t i = 0; i + 1 < a.times.size(); ++i) {
    const Real width = static_cast<Real>(a.times[i + 1]) - static_cast<Real>(a.times[i]);
    const Real from = a.values[i], to = a.values[i + 1];
    through(block, a.times[i], from, (to - from) / width, width);
  }
  return block;
}

std::vector<Figure> record_figures() {
  const Slide block = slide();
  return {{"slip that stays, m", "", block.u},
          {"stops for good, s", "", block.stops},
          {"breaks away, times", "", static_cast<Real>(block.slips)},
          {"turns without a rest, times", "", static_cast<Real>(block.reversals)}};
}

std::vector<double> record(const Settings& settings) {
  const Result r = run(synthetic, settings);
  double stops = missing;
  int slips = 0, reversals = 0;
  for (const Event& e : r.events) {
    if (e.type == EventType::stick) stops = e.t;
    slips += e.type == EventType::slip;
    reversals += e.type == EventType::reversal;
  }
  return {r.rows.back().u[0], stops, static_cast<double>(slips), static_cast<double>(reversals)};
}

}  // namespace

std::vector<Case> newmark() {
  const std::string source = "Newmark, Geotechnique 15 (1965) 139-160";
  return {{"Newmark, pulse", source, 1e-4, 1e-7, 1e-9, pulse_figures, pulse},
          {"Newmark, synthetic record", source, 1e-4, 5e-6, 1e-7, record_figures, record}};
}

}  // namespace signorini::published
