// Balls in a row whose hits follow each other within less than a double's clock tells apart, and a little more.
//
//   b0 -> <- b1 (- spring - d) <- b2       all on one line; hits c0, c1, c0, c1, each by Newton's law
//
// The answer is a sum of single hits in long double: between them the centre of b1 and d moves evenly, and their
// distance is a cosine. Along an axis and turned.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::hits_in_turn {
namespace {

using Long = long double;

struct Row {
  double second_gap = 0.0, stiffness = 0.0;  // no stiffness: no d
  double t_end = 0.617101;
};

struct Hit {
  std::size_t contact;
  Long t;
};

/// The row by itself.
struct Sum {
  Row row;
  Long m0 = 1.3L, m1 = 0.7L, m2 = 2.9L, md = 0.5L;
  Long t = 0.0L, w = 0.0L;
  std::array<Long, 2> gap;  // c0, c1, at t
  Long v0 = 0.9L, v2 = -0.83L, vc = -0.1L, r = 0.0L,
       dr = 0.0L;  // centre of b1 and d; r = u1 - uc and its rate
  std::vector<Hit> hits;

  explicit Sum(const Row& given) : row(given), gap{Long(0.6171), Long(given.second_gap)} {
    v0 = Long(0.9), v2 = Long(-0.83), vc = Long(-0.1), m0 = Long(1.3), m1 = Long(0.7), m2 = Long(2.9);
    if (row.stiffness > 0.0) w = std::sqrt(Long(row.stiffness) * (m1 + md) / (m1 * md));
    run_scene();
  }
  [[nodiscard]] Long v1() const { return vc + dr; }
  [[nodiscard]] Long moved(Long h) const {  // of b1
    return w > 0.0L ? vc * h + r * (std::cos(w * h) - 1.0L) + dr / w * std::sin(w * h) : (vc + dr) * h;
  }
  [[nodiscard]] Long gap_after(std::size_t c, Long h) const {
    return gap[c] + (c == 0 ? moved(h) - v0 * h : v2 * h - moved(h));
  }
  void move(Long h) {
    const std::array<Long, 2> then{gap_after(0, h), gap_after(1, h)};
    if (w > 0.0L) {
      const Long a = r;
      r = a * std::cos(w * h) + dr / w * std::sin(w * h);
      dr = dr * std::cos(w * h) - a * w * std::sin(w * h);
    }
    gap = then;
    t += h;
  }
  void strike(std::size_t c) {
    const Long e = c == 0 ? Long(0.9) : Long(0.8), other = c == 0 ? m0 : m2,
               vn = c == 0 ? v1() - v0 : v2 - v1();
    const Long p = -(1.0L + e) * vn / (1.0L / m1 + 1.0L / other);
    (c == 0 ? v0 : v2) += (c == 0 ? -p : p) / other;
    const Long push = c == 0 ? p : -p, mass = w > 0.0L ? m1 + md : m1;
    vc += push / mass;
    if (w > 0.0L) dr += push / m1 - push / mass;
    gap[c] = 0.0L;
    hits.push_back({c, t});
  }
  /// The first fall of a gap within h, which is short beside the vibration.
  [[nodiscard]] Long fall(std::size_t c, Long h) const {
    if (!(gap_after(c, h) < 0.0L)) return 2.0L * h;
    Long a = 0.0L, b = h;
    for (int i = 0; i < 200; ++i) {
      const Long mid = 0.5L * (a + b);
      (gap_after(c, mid) < 0.0L || (mid == 0.0L && gap[c] < 0.0L) ? b : a) = mid;
    }
    return b;
  }
  void run_scene() {
    while (t < Long(row.t_end)) {
      const bool still = r == 0.0L && dr == 0.0L;
      const Long left = Long(row.t_end) - t, h = std::min(left, still ? 0.7L : w > 0.0L ? 0.02L / w : left);
      const Long to0 = fall(0, h), to1 = fall(1, h);
      if (to0 > h && to1 > h) {
        move(h);
        continue;
      }
      move(std::min(to0, to1));
      strike(to0 <= to1 ? 0 : 1);
    }
  }
};

std::string text(const Row& row, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  const auto along = [&](double x) { return fmt::format("[{:.17g}, {:.17g}]", x * c, x * s); };
  const auto speed = [&](double v) { return fmt::format("{{ vx = {:.17g}, vy = {:.17g} }}", v * c, v * s); };
  std::string scene = fmt::format(
      "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n[run]\nt_end = "
      "{:.17g}\n[run.initial]\nb0 = {}\nb1 = {}\nb2 = {}\n",
      row.t_end, speed(0.9), speed(-0.1), speed(-0.83));
  const bool spring = row.stiffness > 0.0;
  if (spring) scene += fmt::format("d = {}\n", speed(-0.1));
  scene += fmt::format("[nodes]\nb0 = {}\nb1 = {}\nb2 = {}\n", along(0.0), along(1.0), along(2.0));
  if (spring)
    scene += fmt::format(
        "d = {0}\n[[springs]]\nnode = \"b1\"\nagainst = \"d\"\ndirection = {1}\nstiffness = {3:.17g}\n"
        "[[springs]]\nnode = \"b1\"\nagainst = \"d\"\ndirection = {2}\nstiffness = {3:.17g}\n",
        along(0.5), along(1.0), fmt::format("[{:.17g}, {:.17g}]", -s, c), row.stiffness);
  const auto mass = [&](const char* node, double m) {
    scene += fmt::format("[[masses]]\nnode = \"{}\"\nmass = {}\n", node, m);
  };
  mass("b0", 1.3);
  mass("b1", 0.7);
  mass("b2", 2.9);
  if (spring) mass("d", 0.5);
  const auto contact = [&](const char* name, const char* node, const char* against, double gap, double e) {
    scene += fmt::format(
        "[[contacts]]\nname = \"{}\"\nnode = \"{}\"\nagainst = \"{}\"\nlaw = \"rigid\"\nnormal = {}\ngap = "
        "{:.17g}\nrestitution = {}\n",
        name, node, against, along(1.0), gap, e);
  };
  contact("c0", "b1", "b0", 0.6171, 0.9);
  contact("c1", "b2", "b1", row.second_gap, 0.8);
  return scene;
}

struct Found {
  Model model;
  Scene scene;
  Result result;
  std::optional<Certificate> certificate;
  std::array<double, 3> v{};  // at the end, along the row
};

Found run_scene(const Row& row, double degrees, std::vector<Override> overrides) {
  Found found;
  found.scene = parse_scene(text(row, degrees), "row.toml", overrides);
  found.model = build_model(found.scene);
  CertifiedReport report = simulate_certified(found.model, found.scene.run, found.result);
  found.certificate = std::move(report.certificate);
  CHECK(report.report.outcome.reason == "");
  CHECK(report.report.law_checks.violations.empty());
  const double a = degrees * std::numbers::pi / 180.0;
  const Vector& v = found.result.rows.back().v;
  for (int i = 0; i < 3; ++i)
    found.v[static_cast<std::size_t>(i)] = v[2 * i] * std::cos(a) + v[2 * i + 1] * std::sin(a);
  return found;
}

void check_end(const Found& found, const Sum& sum, double off) {
  CHECK(std::abs(found.v[0] - static_cast<double>(sum.v0)) < off);
  CHECK(std::abs(found.v[1] - static_cast<double>(sum.v1())) < off);
  CHECK(std::abs(found.v[2] - static_cast<double>(sum.v2)) < off);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/hits_in_turn");

TEST_CASE("hits that the clock does not tell apart come one after the other, and gain no energy") {
  // 3.7e-14 s, 1.7e-14 s and 3.3e-14 s apart at t = 0.6 s.
  const Row row{0.450483000000073};
  const Sum sum(row);
  REQUIRE(sum.hits.size() == 4);
  for (const double degrees : {0.0, 62.97, -151.3})
    for (const char* engine : {"exact", "ida"}) {
      CAPTURE(degrees);
      CAPTURE(engine);
      const Found found = run_scene(row, degrees, {{"run.engine", engine}, {"run.certify", "true"}});
      check_end(found, sum, 1e-12);
    }
}

TEST_CASE("hits that nothing but rounding tells apart are not certain") {
  const Row row{0.450483000000008};  // 1e-14 s
  for (const double degrees : {0.0, 62.97}) {
    CAPTURE(degrees);
    const Found found = run_scene(row, degrees, {{"run.engine", "exact"}, {"run.certify", "true"}});
    REQUIRE(found.certificate);
    CHECK_FALSE(found.certificate->complete);
  }
}

TEST_CASE("hits that the clock tells apart are events of their own, however stiff the structure") {
  struct Case {
    double gap, stiffness;
  };
  for (const Case& c :
       {Case{0.45048300000072994, 1e4}, Case{0.45048300000072994, 1e8}, Case{0.45048300072999997, 1e10}})
    for (const double degrees : {0.0, 62.97})
      for (const char* engine : {"exact", "ida"}) {
        CAPTURE(c.stiffness);
        CAPTURE(degrees);
        CAPTURE(engine);
        const Row row{c.gap, c.stiffness};
        const Sum sum(row);
        REQUIRE(sum.hits.size() == 4);
        const Found found = run_scene(row, degrees, {{"run.engine", engine}});
        REQUIRE(found.result.events.size() == sum.hits.size());
        for (std::size_t i = 0; i < sum.hits.size(); ++i) {
          const Event& event = found.result.events[i];
          CHECK(static_cast<std::size_t>(event.contact) == sum.hits[i].contact);
          CHECK(std::abs(event.t - static_cast<double>(sum.hits[i].t)) < 2e-13);
        }
      }
}

TEST_CASE("rtol moves no hit of exact") {
  const Row row{0.45049029999999995, 1e10, 0.62};
  const Sum sum(row);
  REQUIRE(sum.hits.size() == 4);
  for (const char* rtol : {"1e-4", "1e-6", "1e-8"})
    for (const double degrees : {0.0, 62.97}) {
      CAPTURE(rtol);
      CAPTURE(degrees);
      const Found found = run_scene(row, degrees, {{"run.engine", "exact"}, {"run.rtol", rtol}});
      REQUIRE(found.result.events.size() == sum.hits.size());
      for (std::size_t i = 0; i < sum.hits.size(); ++i)
        CHECK(std::abs(found.result.events[i].t - static_cast<double>(sum.hits[i].t)) < 1e-11);
      CHECK(found.result.report.audit.energy.value < 1e-9 * found.result.report.audit.energy_scale);
    }
}

TEST_SUITE_END();

}  // namespace signorini::tests::hits_in_turn
