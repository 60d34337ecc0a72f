// Code_Aster SDND100, SDND104, SDND106: Coulomb friction on one and two masses; SSNV128, SDNV104: on bodies.
#include <array>

#include "published/formulas.hpp"
#include "published/runs.hpp"

namespace signorini::published {
namespace {

// --- SDND100: each half swing, pi/omega long, is about +-f N/k

std::vector<Figure> pad_figures() {
  const Real lost = 2 * 0.1L * 10 / 1e4L, cos45 = 1 / std::sqrt(2.0L), u0 = 0.85e-3L;
  const std::array<const char*, 4> printed{"-4.596e-4", "3.182e-4", "-1.768e-4", "3.536e-5"};
  std::vector<Figure> figures;
  for (int n = 1; n <= 4; ++n) {
    const Real turn = (n % 2 == 0 ? 1 : -1) * (u0 - static_cast<Real>(n) * lost);
    figures.push_back({"uy after half swing " + std::to_string(n) + ", m",
                       printed[static_cast<std::size_t>(n - 1)], turn * cos45});
  }
  figures.push_back({"comes to rest, s", "", 4 * pi / 100});
  return figures;
}

std::vector<double> pad(const Settings& settings) {
  const Result r = run("sdnd100.toml", settings);
  std::vector<double> ours;
  for (std::size_t n = 0; n < 4; ++n) ours.push_back(r.rows.at(n).u[1]);
  ours.push_back(r.events.size() == 4 && r.events[3].to == State::stick ? r.events[3].t : missing);
  return ours;
}

// --- SDND104: slip rate v against the plane, v' = -a sin(w t) - s f g while it slides along s

/// Power of wear from 4 to 12 s: N times the mean slip rate.
Real wear(Real a) {
  const Real w = 2 * pi, limit = 1, force = 10, from = 4, to = 12;
  if (a <= limit) return 0;
  Real slid = 0, t = std::asin(limit / a) / w;  // breaks away
  Real s = -1;
  while (t < to) {
    const auto rate = [&](Real x) {
      return a / w * (std::cos(w * x) - std::cos(w * t)) - s * limit * (x - t);
    };
    const auto distance = [&](Real x) {
      return a / (w * w) * (std::sin(w * x) - std::sin(w * t)) - a / w * std::cos(w * t) * (x - t) -
             s * limit * (x - t) * (x - t) / 2;
    };
    const Real stop = first_root(rate, t, 1e-3L), lo = std::max(t, from), hi = std::min(stop, to);
    if (hi > lo) slid += std::abs(distance(hi) - distance(lo));
    t = stop;
    const Real pull = -a * std::sin(w * t);
    if (std::abs(pull) > limit) {  // slides on, the other way
      s = pull > 0 ? 1.0L : -1.0L;
      continue;
    }
    const Real phase = std::asin(limit / a) / w;  // sticks until a |sin| is at the limit again, rising
    Real n = std::ceil((t - phase) * 2);
    t = phase + n / 2;
    s = std::fmod(n, 2.0L) == 0 ? -1.0L : 1.0L;
  }
  return force * slid / (to - from);
}

const std::array<const char*, 4> amplitudes{"15.0", "1.5", "1.01", "0.99"};

std::vector<Figure> wear_figures() {
  return {{"power of wear, a = 15 m/s^2, W", "15.2671", wear(15)},
          {"power of wear, a = 1.5 m/s^2, W", "0.409062", wear(1.5L)},
          {"power of wear, a = 1.01 m/s^2, W", "2.26164e-4", wear(1.01L)},
          {"power of wear, a = 0.99 m/s^2, W", "0.0", wear(0.99L)}};
}

std::vector<double> wears(const Settings& settings) {
  std::vector<double> ours;
  for (const char* a : amplitudes) {
    const Result r = run("sdnd104.toml", settings, {{"base_motion.acceleration.amplitude", a}});
    const double lost = row_at(r, 12.0).energy.friction - row_at(r, 4.0).energy.friction;
    ours.push_back(lost / 0.1 / 8.0);  // f N |v| is lost, N |v| is wear
  }
  return ours;
}

// --- SDND106: while mass 1 slides, its centre with mass 2 and their distance move apart from each other

struct Pair {
  Point first, second;
};

/// Sliding under the force F on mass 2 and -T on mass 1, for a time t.
Pair slide(const Pair& p, Real F, Real T, Real t) {
  const Real m = 5, k = 1e4L;
  const Point centre =
      fall({(p.first.u + p.second.u) / 2, (p.first.v + p.second.v) / 2}, (F - T) / (2 * m), t);
  const Point apart =
      swing({p.second.u - p.first.u, p.second.v - p.first.v}, std::sqrt(2 * k / m), (F + T) / (2 * k), t);
  return {{centre.u - apart.u / 2, centre.v - apart.v / 2}, {centre.u + apart.u / 2, centre.v + apart.v / 2}};
}

std::vector<Figure> pair_figures() {
  const Real k = 1e4L, F = 3000, T = 2000, w = std::sqrt(k / 5);
  const Real breaks = pi / 2 / w;  // k u2 = 3000 (1 - cos w t) has grown to the static limit, 3000
  const Pair broken{{0, 0}, swing({0, 0}, w, F / k, breaks)};
  const Pair at15 = slide(broken, F, T, 0.15L - breaks), unloaded = slide(broken, F, T, 0.2L - breaks);
  const Real sticks =
      0.2L + first_root([&](Real t) { return slide(unloaded, 0, T, t).first.v; }, 0.0L, 1e-3L);
  const Pair stuck = slide(unloaded, 0, T, sticks - 0.2L);
  const Real end = 0.339965L;
  return {{"u1 at 0.02 s, m", "0.0", 0.0L},
          {"u2 at 0.02 s, m", "0.11221", swing({0, 0}, w, F / k, 0.02L).u},
          {"mass 1 breaks away, s", "", breaks},
          {"u1 at 0.15 s, m", "1.35332", at15.first.u},
          {"u2 at 0.15 s, m", "1.80751", at15.second.u},
          {"mass 1 sticks, s", "", sticks},
          {"v1 at 0.339965 s, m/s", "0.0", 0.0L},
          {"u2 at 0.339965 s, m", "3.96813", swing(stuck.second, w, stuck.first.u, end - sticks).u}};
}

std::vector<double> pair(const Settings& settings) {
  const Result r = run("sdnd106.toml", settings);
  const auto &early = row_at(r, 0.02), &middle = row_at(r, 0.15), &late = row_at(r, 0.339965);
  return {early.u[0],  early.u[1],  time_of(r, EventType::slip, 0),
          middle.u[0], middle.u[1], time_of(r, EventType::stick, 0),
          late.v[0],   late.u[1]};
}

// --- SSNV128: no closed form; the reference is that of GRECO as printed, to 5 %

std::vector<Figure> plate_figures() {
  std::vector<Figure> figures;
  const std::pair<const char*, const char*> printed[] = {{"ux of A, m", "2.86e-5"},
                                                         {"ux of B, m", "2.72e-5"},
                                                         {"ux of C, m", "2.28e-5"},
                                                         {"ux of D, m", "1.98e-5"}};
  for (const auto& [what, value] : printed) figures.push_back({what, value, std::stold(value), true, 0.05});
  return figures;
}

std::vector<double> plate(const Settings& settings) {
  const Result::Row row = run("ssnv128.toml", settings).rows.back();
  return {row.u[0], row.u[2], row.u[8], row.u[12]};  // nodes 1, 2, 5, 7 of the lowest row
}

// --- SDNV104: m x'' + c x' + k x = a + b t of a rigid pad, c = beta k of the scene

struct Swing {
  Real m, c, k;
  struct State {
    Real x, v;
  };
  /// After t, from s, under a force a + b t.
  [[nodiscard]] State after(Real t, State s, Real a, Real b) const {
    const Real mean = (a - b * c / k) / k, d = c / (2 * m), w = std::sqrt(k / m - d * d);
    const Real p = s.x - mean, q = (s.v - b / k + d * p) / w, e = std::exp(-d * t);
    const Real cos = std::cos(w * t), sin = std::sin(w * t);
    return {mean + b / k * t + e * (p * cos + q * sin),
            b / k + e * ((q * w - d * p) * cos - (p * w + d * q) * sin)};
  }
};

std::vector<Figure> pushed_figures() {
  const Real F = 200e3, friction = 0.3L * 70e3, T = 0.07L, forward = F - friction, back = F + friction;
  const Swing pad{7000, 1e-3L * 24e3L, 24e3};
  const Swing::State loaded = pad.after(T, {0, 0}, 0, forward / T);
  const auto there = [&](Real t) { return pad.after(t - T, loaded, forward, 0); };
  const Real turn = first_root([&](Real t) { return there(t).v; }, 1.0L, 1e-2L);
  // The pad of the scene is elastic: its strains of 1e-6 beside 15 m, and its stick of 1e-5 s at the turn.
  return {{"ux at 1.7 s, m", "14.91", there(1.7L).x, true, 1e-6},
          {"ux at 3.4 s, m", "3.5", pad.after(3.4L - turn, {there(turn).x, 0}, back, 0).x, true, 1e-6}};
}

std::vector<double> pushed(const Settings& settings) {
  const Result r = run("sdnv104.toml", settings);
  return {row_at(r, 1.7).u[0], row_at(r, 3.4).u[0]};
}

}  // namespace

std::vector<Case> code_aster_friction() {
  return {{"SDND100, pad", "Code_Aster V5.01.100, astest/sdnd100a.comm", 1e-5, 5e-6, 1e-6, pad_figures, pad},
          {"SDND104, shaken plane", "Code_Aster V5.01.104, astest/sdnd104a.comm", 1e-4, 5e-4, 1e-4,
           wear_figures, wears},
          {"SDND106, two masses", "Code_Aster V5.01.106, astest/sdnd106a.comm", 1e-5, 3e-7, 3e-7,
           pair_figures, pair},
          {"SSNV128, plate on a plane", "Code_Aster V6.04.128", 1e-4, 0.05, 0.05, plate_figures, plate},
          {"SDNV104, pad against springs", "Code_Aster V5.03.104, astest/sdnv104a.comm", 1e-3, 1e-6, 1e-5,
           pushed_figures, pushed}};
}

}  // namespace signorini::published
