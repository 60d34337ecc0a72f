// Static friction above the kinetic one, and a pull within some roundings of the static limit: no double tells whether the
// block slips. The run says so and certifies nothing from there on; a pull clearly above slips as the closed form says.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/engines.hpp"
#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

constexpr double at_crooked_angle = 0.6435;  // rad, of the plate

struct CertifiedBlock {
  Model model;
  Result rows;
  Certificate certificate;
  [[nodiscard]] double along() const {
    const Vector& u = rows.rows.back().u;
    return std::cos(at_crooked_angle) * u[0] + std::sin(at_crooked_angle) * u[1];
  }
};

/// A mass on a slider whose tangent has the angle; springs across, and along if k > 0.
struct DryBlock {
  double mass = 1.3, N = 10.0, fs = 0.37, fk = 0.31, k = 0.0, x0 = 0.0, t_end = 3.0;
  std::string history;  // of a load of 1 along the tangent

  [[nodiscard]] std::string text() const {
    const double c = std::cos(at_crooked_angle), s = std::sin(at_crooked_angle);
    std::string scene = fmt::format(
        "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
        "[run]\nt_end = {}\noutput_dt = {}\ninitial = {{ a = {{ ux = {:.17g}, uy = {:.17g} }} }}\n"
        "[nodes]\na = [0.0, 0.0]\n[[masses]]\nnode = \"a\"\nmass = {:.17g}\n"
        "[[springs]]\nnode = \"a\"\ndirection = [{:.17g}, {:.17g}]\nstiffness = 1000.0\n",
        t_end, t_end, c * x0, s * x0, mass, -s, c);
    if (k > 0.0)
      scene += fmt::format("[[springs]]\nnode = \"a\"\ndirection = [{:.17g}, {:.17g}]\nstiffness = {:.17g}\n",
                           c, s, k);
    scene += fmt::format(
        "[[contacts]]\nname = \"pad\"\nnode = \"a\"\nlaw = \"slider\"\ntangent = [{:.17g}, {:.17g}]\n"
        "normal_force = {:.17g}\nfriction = {{ static = {:.17g}, kinetic = {:.17g} }}\n",
        c, s, N, fs, fk);
    if (!history.empty())
      scene += fmt::format(
          "[[loads]]\nnode = \"a\"\ndirection = [{:.17g}, {:.17g}]\namplitude = 1.0\nhistory = {}\n", c, s,
          history);
    return scene;
  }
};

CertifiedBlock certified_block(const DryBlock& block, const std::string& engine) {
  const Scene scene = parse_scene(block.text(), "test.toml",
                                  {{"run.engine", engine}, {"run.rtol", "1e-10"}, {"run.certify", "true"}});
  CertifiedBlock c;
  c.model = build_model(scene);
  CertifiedReport run = simulate_certified(c.model, scene.run, c.rows);
  c.rows.report = run.report;
  REQUIRE(run.certificate);
  c.certificate = std::move(*run.certificate);
  return c;
}

/// Nothing at t or later is certain.
void check_ends(const CertifiedBlock& c, double t) {
  CHECK(c.rows.report.outcome.kind == Outcome::Kind::done);
  CHECK_FALSE(c.certificate.complete);
  CHECK(c.certificate.until <= t * (1.0 + 1e-9));
  CHECK(c.certificate.until >= t * (1.0 - 1e-6));
  CHECK(c.certificate.certain_events() == 0);
}

/// Nor is it, and the run says so of 'pad'.
void check_said(const CertifiedBlock& c, double t) {
  check_ends(c, t);
  REQUIRE(!c.rows.report.warnings.empty());
  CHECK(c.rows.report.warnings[0].find("contact 'pad' sticks at its friction limit from t = ") == 0);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/rounding/static_limit");

TEST_CASE("a force within some roundings of the static limit ends the certificate where it begins") {
  for (const std::string& engine : engines)
    for (const double excess : {0.0, 3e-14, -2e-14, 1e-15}) {
      CAPTURE(engine);
      CAPTURE(excess);
      DryBlock block;
      block.history = fmt::format("{{ type = \"polynomial\", coefficients = [{:.17g}] }}",
                                  block.fs * block.N * (1.0 + excess));
      const CertifiedBlock c = certified_block(block, engine);
      check_said(c, 0.0);
      CHECK(c.rows.report.undecided == 1);
    }
}

TEST_CASE("rest at the limit of a single coefficient is counted by the audit, and no warning") {
  for (const std::string& engine : engines)
    for (const double excess : {0.0, 3e-14, -2e-14}) {
      CAPTURE(engine);
      CAPTURE(excess);
      DryBlock block;
      block.fk = block.fs;
      block.history = fmt::format("{{ type = \"polynomial\", coefficients = [{:.17g}] }}",
                                  block.fs * block.N * (1.0 + excess));
      const CertifiedBlock c = certified_block(block, engine);
      CHECK(c.rows.report.outcome.kind == Outcome::Kind::done);
      CHECK(c.rows.report.warnings.empty());
      const Audit& audit = c.rows.report.audit;
      CHECK(audit.contacts_at_limit == 1);
      CHECK(audit.at_limit.contact == 0);
      CHECK(audit.at_limit.t == 0.0);
      CHECK(audit.at_limit.value <= 1e-12 * block.N);
    }
  DryBlock below;
  below.fk = below.fs;
  below.history =
      fmt::format("{{ type = \"polynomial\", coefficients = [{:.17g}] }}", 0.5 * below.fs * below.N);
  CHECK(certified_block(below, "exact").rows.report.audit.contacts_at_limit == 0);
}

TEST_CASE("a force clearly above the static limit slips, and is certified") {
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    DryBlock block;
    const double force = block.fs * block.N * (1.0 + 1e-11);
    block.history = fmt::format("{{ type = \"polynomial\", coefficients = [{:.17g}] }}", force);
    const CertifiedBlock c = certified_block(block, engine);
    CHECK(c.certificate.complete);
    CHECK(c.rows.report.warnings.empty());
    const double expected = (force - block.fk * block.N) / (2.0 * block.mass) * 9.0;
    CHECK(c.along() == doctest::Approx(expected).epsilon(1e-8));
  }
}

TEST_CASE("a turn whose pull is within some roundings of the static limit ends the certificate there") {
  // From x0 at rest it slides to x1 = 2 fk N / k - x0, where the spring pulls with k |x1|.
  DryBlock block;
  block.mass = 1.37;
  block.N = 7.7;
  block.fs = 0.36;
  block.fk = 0.3;
  block.k = 83.0;
  const double t = M_PI / std::sqrt(block.k / block.mass);
  for (const std::string& engine : engines)
    for (const double excess : {0.0, 1e-14, 3e-14, -3e-14, 1e-11}) {
      CAPTURE(engine);
      CAPTURE(excess);
      block.x0 = (2.0 * block.fk + block.fs * (1.0 + excess)) * block.N / block.k;
      const CertifiedBlock c = certified_block(block, engine);
      if (engine == "ida") {  // its place is off by more than rounding; its companion sees the limit
        if (excess < 1e-12) check_ends(c, t);
        continue;
      }
      if (excess < 1e-12) {
        check_said(c, t);
        continue;
      }
      CHECK(c.certificate.complete);  // back to x2 = x0 - 4 fk N / k, where the pull is below the limit
      CHECK(c.along() == doctest::Approx(block.x0 - 4.0 * block.fk * block.N / block.k).epsilon(1e-9));
    }
}

TEST_CASE("it does so where a load then takes the pull down, too") {
  // x = A cos w t - c/(k w) sin w t + (fk N + c t)/k up to the turn; fs is the pull there, to a rounding.
  DryBlock block;
  block.mass = 1.0503885638038444;
  block.N = 8.633699434803598;
  block.fk = 0.1;
  block.k = 327.14007804266015;
  block.x0 = 0.03;
  const long double k = block.k, w = std::sqrt(k / block.mass), load = -0.107L,
                    fkN = 1.0L * block.fk * block.N;
  const long double a = block.x0 - fkN / k;
  const auto rate = [&](long double t) {
    return -a * w * std::sin(w * t) - load / k * std::cos(w * t) + load / k;
  };
  long double low = 0.6L * static_cast<long double>(M_PI) / w,
              high = 1.4L * static_cast<long double>(M_PI) / w;
  for (int i = 0; i < 100; ++i) {
    const long double mid = (low + high) / 2;
    (rate(mid) < 0 ? low : high) = mid;
  }
  const long double x = a * std::cos(w * low) - load / (k * w) * std::sin(w * low) + (fkN + load * low) / k;
  const long double pull = load * low - k * x;  // upwards: it came down
  REQUIRE(pull > fkN);
  block.history =
      fmt::format("{{ type = \"polynomial\", coefficients = [0.0, {:.17g}] }}", static_cast<double>(load));
  for (const long double excess : {0.0L, 1e-14L, -1e-14L}) {
    CAPTURE(static_cast<double>(excess));
    block.fs = static_cast<double>(pull / (1.0L * block.N) * (1 - excess));
    const CertifiedBlock c = certified_block(block, "exact");
    check_said(c, static_cast<double>(low));
    CHECK(c.rows.report.undecided == 0);  // its first derivative tells that it sticks, if it does
  }
}

TEST_SUITE_END();
