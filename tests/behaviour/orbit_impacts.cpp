// Orbits of impact oscillators where they branch, graze and add periods, against closed forms and a return map of their own.
#include <doctest/doctest.h>

#include <fmt/core.h>

#include <array>
#include <complex>
#include <functional>
#include <numbers>
#include <optional>

#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// The zero of f between a and b.
double zero_between(const std::function<double(double)>& f, double a, double b) {
  const bool below = f(a) < 0.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (a + b);
    ((f(middle) < 0.0) == below ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

/// x'' + 2 z x' + x = F cos(w t) before a rigid wall at x = 1; without it the amplitude of x is A.
struct WallOscillator {
  double w, z, e, A;

  [[nodiscard]] double load() const { return A * std::abs(std::complex<double>(1.0 - w * w, 2.0 * z * w)); }
  /// By which the load is ahead of A cos w t.
  [[nodiscard]] double lead() const { return std::arg(std::complex<double>(1.0 - w * w, 2.0 * z * w)); }
  [[nodiscard]] double period() const { return 2.0 * std::numbers::pi / w; }
  /// exp(-z t) (c, s): x = x0 (c + z s) + v0 s of the free motion.
  [[nodiscard]] std::array<double, 2> free(double t) const {
    const std::complex<double> d = std::sqrt(std::complex<double>(1.0 - z * z));
    return {(std::exp(-z * t) * std::cos(d * t)).real(), (std::exp(-z * t) * std::sin(d * t) / d).real()};
  }
  /// Of the free motion.
  [[nodiscard]] std::array<std::array<double, 2>, 2> flow(double t) const {
    const auto [c, s] = free(t);
    return {{{c + z * s, s}, {-s, c - z * s}}};
  }

  /// One hit in n periods: its velocity before the wall; the greatest solution, without other hits.
  ///   r = 1 - X,  s = X' at the hit:  r = M11 r + M12 (-e v - s),  v - s = M21 r + M22 (-e v - s),  X^2 + (X'/w)^2 = A^2
  struct Hit {
    double velocity = 0.0, phase = 0.0;
  };
  [[nodiscard]] std::optional<Hit> one_hit(int n) const {
    const auto M = flow(n * period());
    const double a = 1.0 - M[0][0], b = M[0][1], p = -M[0][1] * e;
    const double c = -M[1][0], d = M[1][1] - 1.0, q = -1.0 - M[1][1] * e, det = a * d - b * c;
    const double r = (p * d - b * q) / det, s = (a * q - c * p) / det;  // a unit of v
    const double square = r * r + s * s / (w * w), left = r * r - square * (1.0 - A * A);
    if (left < 0.0) return std::nullopt;
    const double v = (r + std::sqrt(left)) / square;
    if (!(v > 0.0)) return std::nullopt;
    return Hit{v, std::atan2(-s * v / w, 1.0 - r * v)};
  }
  /// The greater magnitude of those of S M, M over a period: S = (-e, 0; (a+ + e a-)/v, -e), a: accelerations at the hit.
  [[nodiscard]] double multiplier(const Hit& hit) const {
    const auto M = flow(period());
    const double X = A * std::cos(hit.phase), rate = -A * w * std::sin(hit.phase);
    const double driven = X - w * w * X + 2.0 * z * rate - 1.0;  // of x'' = driven - 2 z x' at the wall
    const double before = driven - 2.0 * z * hit.velocity, after_it = driven + 2.0 * z * e * hit.velocity;
    const double s = (after_it + e * before) / hit.velocity;
    const double trace = -e * (M[0][0] + M[1][1]) + s * M[0][1];
    const double det = e * e * std::exp(-2.0 * z * period()), half = 0.5 * trace;
    return half * half < det ? std::sqrt(det) : std::abs(half) + std::sqrt(half * half - det);
  }
  /// x and v at a time after that hit.
  [[nodiscard]] std::array<double, 2> after(const Hit& hit, double t) const {
    const double r = 1.0 - A * std::cos(hit.phase), s = -e * hit.velocity + A * w * std::sin(hit.phase);
    const auto M = flow(t);
    const double phase = w * t + hit.phase;
    return {M[0][0] * r + M[0][1] * s + A * std::cos(phase),
            M[1][0] * r + M[1][1] * s - A * w * std::sin(phase)};
  }
  /// Half way between two such hits, where the load begins anew.
  [[nodiscard]] std::array<double, 2> between(const Hit& hit, int n) const {
    const double periods = std::round(0.5 * n + hit.phase / (2.0 * std::numbers::pi));
    return after(hit, periods * period() - hit.phase / w);
  }

  /// The motion from (x, v) by its return map: where it hits the wall after `from` periods, up to `to`.
  struct Strike {
    double periods, velocity;
  };
  [[nodiscard]] std::vector<Strike> strikes(std::array<double, 2> begin, int from, int to) const {
    std::vector<Strike> all;
    auto [x, v] = begin;
    double t = 0.0;
    const double h = period() / 200.0;
    while (t < to * period()) {
      const double r = x - A * std::cos(w * t), s = v + A * w * std::sin(w * t);
      const auto gap = [&](double ahead) {
        const auto M = flow(ahead);
        return M[0][0] * r + M[0][1] * s + A * std::cos(w * (t + ahead)) - 1.0;
      };
      double ahead = x >= 1.0 ? 1e-9 : 0.0;
      while (gap(ahead + h) < 0.0) ahead += h;
      ahead = zero_between(gap, ahead, ahead + h);
      const auto M = flow(ahead);
      t += ahead;
      const double hit = M[1][0] * r + M[1][1] * s - A * w * std::sin(w * t);
      x = 1.0;
      v = -e * hit;
      if (t > from * period()) all.push_back({t / period(), hit});
    }
    return all;
  }

  [[nodiscard]] std::string scene(std::array<double, 2> begin = {}) const {
    return matrix_scene(
        fmt::format("t_end = 100.0\nengine = \"exact\"\ninitial = {{ u = [{:.17g}], v = [{:.17g}] }}",
                    begin[0], begin[1]),
        fmt::format("mass = [[1.0]]\nstiffness = [[1.0]]\ndamping = [[{:.17g}]]", 2.0 * z),
        fmt::format("law = \"rigid\"\nnormal = {{ d0 = -1.0 }}\ngap = 1.0\nrestitution = {:.17g}", e),
        fmt::format("[[loads]]\ndirection = {{ d0 = 1.0 }}\namplitude = {:.17g}\nhistory = {{ type = "
                    "\"harmonic\", omega = {:.17g}, phase = {:.17g} }}\n"
                    "[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = {{ d0 = 1.0 }}\n",
                    load(), w, 0.5 * std::numbers::pi + lead()));
  }
};

/// x'' = a cos t between rigid walls at -1 and 1, one hit on each in a period.
struct TwoWalls {
  double e, a;

  struct Hit {
    double t, velocity;  // after it
  };
  /// From the wall at `side` to the other one, and back from it.
  [[nodiscard]] Hit next(const Hit& hit, double side) const {
    const auto over = [&](double t) {
      return side * (2.0 * side + hit.velocity * (t - hit.t) - a * (std::cos(t) - std::cos(hit.t)) -
                     a * std::sin(hit.t) * (t - hit.t));
    };
    double t = hit.t + 1e-6;
    while (over(t + 1e-2) > 0.0) t += 1e-2;
    t = zero_between(over, t, t + 1e-2);
    return {t, -e * (hit.velocity + a * (std::sin(t) - std::sin(hit.t)))};
  }
  /// Magnitude of the greater multiplier of the orbit of period 2 pi that this hit on the wall at -1 is near.
  [[nodiscard]] double multiplier(Hit hit) const {
    const double h = 1e-6;
    const auto map = [&](const Hit& from) {
      const Hit to = next(next(from, -1.0), 1.0);
      return std::array{to.t - 2.0 * std::numbers::pi, to.velocity};
    };
    std::array<std::array<double, 2>, 2> J{};
    for (int i = 0; i < 20; ++i) {  // Newton's method
      for (std::size_t k = 0; k < 2; ++k) {
        Hit up = hit, down = hit;
        (k == 0 ? up.t : up.velocity) += h;
        (k == 0 ? down.t : down.velocity) -= h;
        const auto plus = map(up), minus = map(down);
        for (std::size_t j = 0; j < 2; ++j) J[j][k] = (plus[j] - minus[j]) / (2.0 * h);
      }
      const auto to = map(hit);
      const double r = to[0] - hit.t, s = to[1] - hit.velocity;
      const double p = J[0][0] - 1.0, q = J[1][1] - 1.0, det = p * q - J[0][1] * J[1][0];
      hit.t -= (r * q - J[0][1] * s) / det;
      hit.velocity -= (p * s - r * J[1][0]) / det;
    }
    const double half = 0.5 * (J[0][0] + J[1][1]), det = J[0][0] * J[1][1] - J[0][1] * J[1][0];
    return half * half < det ? std::sqrt(det) : std::abs(half) + std::sqrt(half * half - det);
  }
  /// The symmetric orbit: 1/a = cos p - (pi/2) ((1 + e)/(1 - e)) sin p, p: phase of the hit on the wall at -1.
  [[nodiscard]] Hit symmetric() const {
    const double q = 0.5 * std::numbers::pi * (1.0 + e) / (1.0 - e);
    const double p = -std::atan(q) - std::acos(1.0 / (a * std::sqrt(1.0 + q * q)));
    return {p, -2.0 * e * a * std::sin(p) / (1.0 - e)};
  }
  [[nodiscard]] std::string scene() const {
    const Hit hit = symmetric();
    const double x = -1.0 - hit.velocity * hit.t - a * (1.0 - std::cos(hit.t)) + a * std::sin(hit.t) * hit.t;
    return matrix_scene(
        fmt::format("t_end = 100.0\nengine = \"exact\"\ninitial = {{ u = [{:.17g}], v = [{:.17g}] }}", x,
                    hit.velocity - a * std::sin(hit.t)),
        "mass = [[1.0]]\nstiffness = [[0.0]]",
        fmt::format("law = \"rigid\"\nnormal = {{ d0 = 1.0 }}\ngap = 1.0\nrestitution = {0}\n[[contacts]]\n"
                    "name = \"d\"\nlaw = \"rigid\"\nnormal = {{ d0 = -1.0 }}\ngap = 1.0\nrestitution = {0}",
                    e),
        fmt::format("[[loads]]\ndirection = {{ d0 = 1.0 }}\namplitude = {:.17g}\nhistory = {{ type = "
                    "\"harmonic\", omega = 1.0, phase = 1.5707963267948966 }}\n",
                    a));
  }
};

}  // namespace

TEST_SUITE_BEGIN("behaviour/orbit impacts");

TEST_CASE("a mass between two walls loses its symmetry at a pitchfork where the closed form has it") {
  // Half of the period maps the symmetric orbit onto its mirror image; that map has the multiplier -1 where
  //   1/a = (pi^2/4 - 1)/sqrt(1 + (pi/2)^2 ((1 - e)/(1 + e))^2)
  const double e = 0.8, slope = 0.5 * std::numbers::pi * (1.0 - e) / (1.0 + e);
  const double fork = std::sqrt(1.0 + slope * slope) / (0.25 * std::numbers::pi * std::numbers::pi - 1.0);
  BranchOptions options;
  options.path = "loads.1.amplitude";
  options.from = 0.65;
  options.to = 0.695;
  options.step = 0.1;
  options.switches = 1;
  const Branch branch = continue_branch(reader_of_text(TwoWalls{e, 0.65}.scene()), options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  long found = 0;
  for (const BranchPoint& p : branch.points) {
    if (p.branch != 1) continue;
    CAPTURE(p.parameter);
    CHECK(std::abs(p.amplitude - 1.0) <= 1e-12);  // it turns at the walls, at no place of a grid
    if (p.special == "branch point") {
      ++found;
      CHECK(std::abs(p.parameter - fork) <= 1e-10);
    } else {
      const TwoWalls pair{e, p.parameter};
      CHECK(std::abs(p.max_multiplier - pair.multiplier(pair.symmetric())) <= 1e-6);
      CHECK(p.stable == (p.parameter < fork));
    }
  }
  CHECK(found == 1);
  // Both branches beyond it are mirror images, stable, and those of the return map from beside the symmetric orbit.
  REQUIRE(branch.sides.size() == 2);
  const TwoWalls there{e, 0.695};
  TwoWalls::Hit beside = there.symmetric();
  beside.t += 0.1;
  for (const SideBranch& side : branch.sides) {
    CAPTURE(side.end);
    CHECK(side.kind == "branch point");
    CHECK(side.complete);
    const BranchPoint* last = nullptr;
    for (const BranchPoint& p : branch.points)
      if (p.branch == side.number) last = &p;
    REQUIRE(last != nullptr);
    CHECK(last->parameter == 0.695);
    CHECK(last->stable.value_or(false));
    CHECK(std::abs(last->max_multiplier - there.multiplier(beside)) <= 1e-6);
  }
}

TEST_CASE("where an oscillator grazes its wall the branch continues on the orbit with one hit a period") {
  // Without hits up to A = 1. The orbits with a slow hit end there, too, and lie at A < 1: it is a fold with a corner. What is
  // left beyond is the orbit with a fast hit.
  WallOscillator at{0.6, 0.05, 0.3, 0.9};
  const double first = at.load(), graze = first / 0.9, end = 1.1 * graze;
  BranchOptions options;
  options.path = "loads.1.amplitude";
  options.from = first;
  options.to = end;
  options.step = 0.1;
  options.orbit.transient = 60;
  const Branch branch = continue_branch(reader_of_text(at.scene()), options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  long restarts = 0;
  double last = first;
  for (const BranchPoint& p : branch.points) {
    CAPTURE(p.parameter);
    at.A = p.parameter / graze;
    if (p.special.find("restart") != std::string::npos) {
      ++restarts;
      CHECK(std::abs(last - graze) <= 1e-6 * (end - first));
    }
    if (restarts == 0) {
      CHECK(p.events == 0);
      CHECK(std::abs(p.maxima.front() - at.A) <= 1e-9);
    } else {
      const auto hit = at.one_hit(1);
      REQUIRE(hit);
      CHECK(p.events == 1);
      double least = 1.0;
      for (int k = 0; k <= 20000; ++k) least = std::min(least, at.after(*hit, k * at.period() / 20000.0)[0]);
      CHECK(std::abs(p.minima.front() - least) <= 1e-6);
      CHECK(std::abs(p.max_multiplier - at.multiplier(*hit)) <= 1e-8);
    }
    last = p.parameter;
  }
  CHECK(restarts == 1);
}

TEST_CASE(
    "beyond a graze periods are added: 4, 3, 2 periods of the load between two hits, as a return map has "
    "it") {
  for (const auto& [A, n] : {std::pair{1.01, 4}, {1.06, 3}, {1.3, 2}}) {
    CAPTURE(A);
    const WallOscillator oscillator{3.0, 1.2, 0.7, A};
    const std::optional<WallOscillator::Hit> hit = oscillator.one_hit(n);
    REQUIRE(hit);
    std::array<double, 2> begin = oscillator.between(*hit, n);
    begin[1] += 1e-3;  // the return map comes back
    const std::vector<WallOscillator::Strike> strikes = oscillator.strikes(begin, 200, 230);
    REQUIRE(strikes.size() > 3);
    const WallOscillator::Strike &last = strikes.back(), &before = strikes[strikes.size() - 2];
    REQUIRE(std::abs(last.periods - before.periods - n) <= 1e-6);
    OrbitOptions options;
    options.times = n;
    options.transient = 40;
    const Orbit orbit = find_orbit(reader_of_text(oscillator.scene(begin)), options);
    CAPTURE(orbit.reason);
    REQUIRE(orbit.found);
    CHECK(orbit.stable.value_or(false));
    REQUIRE(orbit.sequence.size() == 1);
    CHECK(std::abs(orbit.sequence.front().vn + last.velocity) <= 1e-8);
    const double part = orbit.sequence.front().t / oscillator.period() - last.periods;
    CHECK(std::abs(part - std::round(part)) <= 1e-8);
    CHECK(std::abs(hit->velocity - last.velocity) <= 1e-8);
  }
}

TEST_CASE(
    "where the impacting orbit meets the one that grazes, the branch goes on with the latter to the end of "
    "the range") {
  // Without impacts x = A/|k - m w^2 + i c w|, up to the gap: A <= 0.3 |...| = 0.504604. The unstable orbit with an impact ends there,
  // too: both exist below only.
  const double m = 1.3, k = 2.1, c = 0.17, w = 1.7, gap = 0.3;
  const double stiffness = std::abs(std::complex<double>(k - m * w * w, c * w)), grazes = gap * stiffness;
  const std::string text = matrix_scene(
      "t_end = 60.0\nengine = \"exact\"",
      fmt::format("mass = [[{}]]\nstiffness = [[{}]]\ndamping = [[{}]]", m, k, c),
      fmt::format("law = \"rigid\"\nnormal = {{ d0 = -1.0 }}\ngap = {}\nrestitution = 0.6", gap),
      fmt::format(
          "[[loads]]\ndirection = {{ d0 = 1.0 }}\namplitude = 0.9\nhistory = {{ type = \"harmonic\", omega = "
          "{}, "
          "phase = 0.4 }}\n[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = {{ d0 = 1.0 }}\n",
          w));
  BranchOptions options;
  options.path = "loads.1.amplitude";
  options.from = 0.9;
  options.to = 0.1;
  const Branch branch = continue_branch(reader_of_text(text), options);
  CAPTURE(branch.end);
  REQUIRE(branch.complete);
  REQUIRE(!branch.points.empty());
  CHECK(branch.points.back().parameter == 0.1);
  double least = 1.0, greatest = 0.0;
  for (const BranchPoint& p : branch.points) {
    if (p.events > 0) continue;
    CAPTURE(p.parameter);
    CHECK(p.parameter <= grazes * (1.0 + 1e-9));
    CHECK(std::abs(p.maxima.front() - p.parameter / stiffness) <= 1e-9);
    CHECK(p.stable.value_or(false));
    least = std::min(least, p.parameter);
    greatest = std::max(greatest, p.parameter);
  }
  CHECK(least == 0.1);
  // Both orbits end at the graze: it is located, and no other change of the sequence is.
  long ends = 0;
  for (const BranchPoint& p : branch.points) {
    CAPTURE(p.special);
    if (p.special == "end") ++ends;
    if (p.special == "end" || p.special == "sequence") CHECK(std::abs(p.parameter - grazes) <= 2e-7);
  }
  CHECK(ends == 1);
  CHECK(std::abs(greatest - grazes) <= 2e-7);
}

TEST_SUITE_END();
