// Code_Aster SDND101, SDND108, SDND121, SDNV100: elastic stops, and a bar against a wall.
#include <array>

#include "published/formulas.hpp"
#include "published/runs.hpp"

namespace signorini::published {
namespace {

// --- SDND101: half a period on the stop, half a period away from it

std::vector<Figure> stop_figures() {
  const Real m = 100, k = 1e4L, kn = 1e6L, v = 1, w = std::sqrt((k + kn) / m), stay = pi / w;
  const Real second = stay + pi * std::sqrt(m / k), force = kn * v / w;
  return {{"greatest force of stay 1 at, s", "0.01563", stay / 2},
          {"greatest force of stay 1, N", "9950.", force},
          {"velocity that hits, stay 2, m/s", "-1.0", -v},
          {"greatest force of stay 2 at, s", "0.361", second + stay / 2},
          {"greatest force of stay 2, N", "9950.", force},
          {"stay 2 lasts, s", "0.03126", stay},
          {"impulse of stay 2, N s", "198.05", 2 * force / w}};
}

std::vector<double> stop(const Settings& settings) {
  const std::vector<Figure> figures = stop_figures();
  const double first = static_cast<double>(figures[0].exact), second = static_cast<double>(figures[3].exact);
  const Result r = run("sdnd101.toml", settings, {{"run.output_times", list({first, second})}});
  const std::vector<Landing>& stays = r.report.landings.at(0);
  const Event* hit = nth(r, EventType::contact, 0);
  if (stays.size() != 2 || !hit) return std::vector<double>(figures.size(), missing);
  // half a sine: its middle is where it is greatest
  return {(stays[0].start + stays[0].end) / 2,
          -row_at(r, first).contacts[0].N,
          hit->vn,
          (stays[1].start + stays[1].end) / 2,
          -row_at(r, second).contacts[0].N,
          stays[1].end - stays[1].start,
          stays[1].impulse};
}

// --- SDND108: a throw, a damped swing on the ground, a throw

struct Bounce {
  Real lands, leaves, at10, at11;  ///< s, s, and uy at 1.0 and 1.1 s
};

/// pulls: the dashpot may hold the mass until it is back at the ground; else it leaves where N = 0.
Bounce bounce(Real c, bool pulls) {
  const Real m = 1, g = 10, k = 100, v0 = -1, h = -2, d = c / (2 * m), w = std::sqrt(k / m - d * d);
  const Real hit = -std::sqrt(v0 * v0 - 2 * g * h), lands = (v0 - hit) / g;
  const Real sag = -m * g / k, b = (hit - d * sag) / w;
  const auto on_ground = [&](Real t) -> Point {
    const Real e = std::exp(-d * t), co = std::cos(w * t), si = std::sin(w * t);
    return {sag + e * (-sag * co + b * si), e * ((d * sag + b * w) * co + (w * sag - d * b) * si)};
  };
  const auto held = [&](Real t) {
    const Point p = on_ground(t);
    return pulls || c == 0 ? p.u : k * p.u + c * p.v;
  };
  const Real stay = first_root(held, 0.0L, 0.01L), leaves = lands + stay;
  Point off = on_ground(stay);
  off.u += h;
  return {lands, leaves, fall(off, -g, 1.0L - leaves).u, fall(off, -g, 1.1L - leaves).u};
}

std::vector<Figure> bounce_figures() {
  const Bounce a = bounce(0, false), b = bounce(5, false), held = bounce(5, true);
  return {{"A lands, s", "0.54031242374329", a.lands},
          {"A leaves, s", "0.88545615307643", a.leaves},
          {"A, u at 1 s, m", "-1.332162981855", a.at10},
          {"A, u at 1.1 s, m", "-0.856394405035", a.at11},
          {"B back at the ground, held by its dashpot, s", "0.92403882542", held.leaves, false},
          {"B, u at 1 s, held, m", "-1.88214079833", held.at10, false},
          {"B, u at 1.1 s, held, m", "-1.81496422497", held.at11, false},
          {"B leaves where N = 0, s", "", b.leaves},
          {"B, u at 1 s, not held, m", "", b.at10},
          {"B, u at 1.1 s, not held, m", "", b.at11}};
}

std::vector<double> bounces(const Settings& settings) {
  const Result a = run("sdnd108.toml", settings);
  const Result b = run("sdnd108.toml", settings, {{"contacts.ground.normal_damping", "5.0"}});
  return {time_of(a, EventType::contact, 0),
          time_of(a, EventType::separation, 0),
          row_at(a, 1.0).u[0],
          row_at(a, 1.1).u[0],
          missing,
          missing,
          missing,
          time_of(b, EventType::separation, 0),
          row_at(b, 1.0).u[0],
          row_at(b, 1.1).u[0]};
}

// --- SDND121: forced swings with two frequencies in turn

/// Times of the first n changes between flight and stop.
std::vector<Real> hits(std::size_t n) {
  const Real m = 156, k = 2e6L, kn = 1e10L, gap = 1e-3L, F = 3000, omega = 10 * pi;
  std::vector<Real> times;
  Point p{0, 0};
  Real t0 = 0;
  bool touches = false;
  while (times.size() < n) {
    const Real stiffness = touches ? k + kn : k, w = std::sqrt(stiffness / m);
    const Real centre = touches ? kn * gap / stiffness : 0, forced = F / (stiffness - m * omega * omega);
    // u = forced swing + free swing
    const Point rest{p.u - forced * std::sin(omega * t0), p.v - forced * omega * std::cos(omega * t0)};
    const auto at = [&](Real t) -> Point {
      const Point f = swing(rest, w, centre, t - t0);
      return {f.u + forced * std::sin(omega * t), f.v + forced * omega * std::cos(omega * t)};
    };
    const Real t = first_root([&](Real x) { return at(x).u - gap; }, t0, touches ? 1e-5L : 1e-4L);
    p = {gap, at(t).v};
    t0 = t;
    touches = !touches;
    times.push_back(t);
  }
  return times;
}

const std::array<std::size_t, 4> shown{0, 1, 10, 19};

std::vector<Figure> forced_figures() {
  const std::vector<Real> times = hits(20);
  std::vector<Figure> figures;
  for (const std::size_t i : shown)
    figures.push_back(
        {(i % 2 == 0 ? "hits the stop, hit " : "leaves the stop, hit ") + std::to_string(i / 2 + 1) + ", s",
         "", times[i]});
  return figures;
}

std::vector<double> forced(const Settings& settings) {
  const Result r = run("sdnd121.toml", settings);
  std::vector<double> ours;
  for (const std::size_t i : shown) ours.push_back(i < r.events.size() ? r.events[i].t : missing);
  return ours;
}

// --- SDNV100: the bar of St Venant, and the lumped chain that stands for it

/// Force of the wall on the chain of n elements: all of it but the first node runs on at speed v when that
/// stops, so u_i = -v sum_j a_j sin(i th_j) sin(w_j t)/w_j with th_j = (2 j - 1) pi/(2 n).
Real wall_force(int n, Real stiffness, Real mass, Real v, Real t) {
  Real force = 0;
  for (int j = 1; j <= n; ++j) {
    const Real th = static_cast<Real>(2 * j - 1) * pi / static_cast<Real>(2 * n);
    const Real w = 2 * std::sqrt(stiffness / mass) * std::sin(th / 2);
    force += stiffness * v / (static_cast<Real>(n) * std::tan(th / 2)) * std::sin(th) * std::sin(w * t) / w;
  }
  return force;
}

/// Its integral from 0 to t.
Real wall_impulse(int n, Real stiffness, Real mass, Real v, Real t) {
  Real impulse = 0;
  for (int j = 1; j <= n; ++j) {
    const Real th = static_cast<Real>(2 * j - 1) * pi / static_cast<Real>(2 * n);
    const Real w = 2 * std::sqrt(stiffness / mass) * std::sin(th / 2), half = std::sin(w * t / 2);
    impulse +=
        stiffness * v / (static_cast<Real>(n) * std::tan(th / 2)) * std::sin(th) * 2 * half * half / (w * w);
  }
  return impulse;
}

std::vector<Figure> bar_figures() {
  const int n = 40;
  const Real E = 2e11L, rho = 8000, L = 0.2L, A = 0.0025L, v = 100, c = std::sqrt(E / rho), h = L / n;
  const Real k = E * A / h, m = rho * A * h, wave = 2 * L / c;
  const Real stay = root([&](Real t) { return wall_force(n, k, m, v, t); }, 0.95L * wave, 1.1L * wave);
  return {{"strikes, s", "", 2e-3L / v},
          {"stay of the continuous bar, 2 L/c, s", "", wave, true, 1.1e-2},
          {"stay of the chain of 40, s", "", stay},
          {"impulse on the continuous bar, N s", "", 2 * rho * A * L * v, true, 1.3e-2},
          {"impulse on the chain of 40, N s", "", m / 2 * v + wall_impulse(n, k, m, v, stay)}};
}

std::vector<double> bar(const Settings& settings) {
  const Result r = run("sdnv100.toml", settings);
  if (r.report.landings.at(0).size() != 1) return std::vector<double>(5, missing);
  const Landing& stay = r.report.landings[0][0];
  return {time_of(r, EventType::impact, 0), stay.end - stay.start, stay.end - stay.start, stay.impulse,
          stay.impulse};
}

}  // namespace

std::vector<Case> code_aster_impact() {
  return {{"SDND101, elastic stop", "Code_Aster V5.01.101, astest/sdnd101a.comm", 1e-5, 3e-7, 1e-6,
           stop_figures, stop},
          {"SDND108, bounce", "Code_Aster V5.01.108, astest/sdnd108a.comm and b", 1e-4, 1e-6, 1e-6,
           bounce_figures, bounces},
          {"SDND121, stiff stop", "Code_Aster V5.01.121, astest/sdnd121a.comm", 2e-6, 3e-7, 3e-6,
           forced_figures, forced},
          {"SDNV100, bar", "Code_Aster V5.03.100, astest/sdnv100a.comm", 1e-8, 1e-8, 1e-5, bar_figures, bar}};
}

}  // namespace signorini::published
