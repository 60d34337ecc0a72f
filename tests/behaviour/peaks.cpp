// Peaks and landings of contacts that lie inside of a step, where no end and no event sees them.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <random>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

struct Way {
  const char *engine, *flow;
  double eps;
};
const Way ways[] = {{"exact", "taylor", 1e-11}, {"exact", "modal", 1e-11}, {"ida", "auto", 1e-7}};

Scene read(const std::string& text, const Way& way) {
  return parse_scene(
      text, "test.toml",
      {{"run.engine", way.engine}, {"run.flow", way.flow}, {"run.rtol", "1e-11"}, {"run.certify", "false"}});
}

/// 1 kg flies at 1 m/s against a spring of 1e4 N/m, at an angle; a load of nothing begins at `start`, and with it a step.
std::string against_wall(double start, double angle) {
  const double x = std::cos(angle), y = std::sin(angle);
  return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 0.1, initial = {{ A = {{ vx = {0:.17g}, vy = {1:.17g} }} }} }}
nodes = {{ A = [0.0, 0.0] }}
masses = [{{ node = "A", mass = 1.0 }}]
[[contacts]]
name = "wall"
node = "A"
law = "compliant"
normal = [{2:.17g}, {3:.17g}]
gap = 0.01
normal_stiffness = 1e4
[[loads]]
node = "A"
direction = [{0:.17g}, {1:.17g}]
amplitude = 1e-12
history = {{ type = "step", start = {4:.17g} }}
[[output]]
name = "N"
kind = "contact"
at = "wall"
quantity = "N"
)",
                     x, y, -x, -y, start);
}

/// Two masses on springs that rub on a floor and rest on it, under steps of loads at random times. damping: of springs,
/// which takes complex modes; of_masses: alpha, which real modes follow. EA: of the bars between them, 1 m long; where it is
/// great, T has a ripple.
std::string rubbing(std::mt19937& random, double damping, double of_masses, double EA) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const double angle = 6.28 * part(random), x = std::cos(angle), y = std::sin(angle);
  std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 2.0, output_dt = 0.5 }}
damping = {{ alpha = {5} }}
nodes = {{ A = [0.0, 0.0], B = [{0:.17g}, {1:.17g}], W = [{2:.17g}, {3:.17g}] }}
masses = [{{ node = "A", mass = 1.0 }}, {{ node = "B", mass = {4:.17g} }}]
[[supports]]
node = "W"
fix = ["ux", "uy"]
[sections.bar]
EA = {6}
mass_per_length = 0.0
[[members]]
nodes = ["A", "B", "W"]
section = "bar"
type = "bar"
)",
                                 x, y, 2.0 * x, 2.0 * y, 0.5 + part(random), of_masses, EA);
  for (const char* node : {"A", "B"}) {
    text += fmt::format(R"([[springs]]
node = "{0}"
direction = [{1:.17g}, {2:.17g}]
stiffness = 300.0
damping = {3}
[[contacts]]
name = "floor-{0}"
node = "{0}"
law = "compliant"
normal = [{1:.17g}, {2:.17g}]
normal_stiffness = 2e3
tangential_stiffness = 1e3
friction = 0.4
[[loads]]
node = "{0}"
direction = [{1:.17g}, {2:.17g}]
amplitude = -20.0
)",
                        node, -y, x, damping);
    for (int i = 0; i < 3; ++i)
      text += fmt::format(
          "[[loads]]\nnode = \"{}\"\ndirection = [{:.17g}, {:.17g}]\namplitude = {:.17g}\nhistory = {{ type "
          "= "
          "\"step\", start = {:.17g} }}\n",
          node, part(random) - 0.5, part(random) - 0.5, 30.0 * part(random), 2.0 * part(random));
    for (const char* quantity : {"N", "T", "gap"})
      text += fmt::format(
          "[[output]]\nname = \"{0}-{1}\"\nkind = \"contact\"\nat = \"floor-{1}\"\nquantity = \"{0}\"\n",
          quantity, node);
  }
  return text;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/peaks");

TEST_CASE("the greatest force on a spring is v sqrt(k m), wherever a step begins before it") {
  // from 0.01 s on; at its peak at 0.01 + pi/200 = 0.0257080 s
  for (const Way& way : ways)
    for (const double start : {0.003, 0.0101, 0.02, 0.0249, 0.025, 0.02507, 0.02553, 0.0257, 0.025707})
      for (const double angle : {0.0, 0.7, 2.9}) {
        CAPTURE(std::string(way.engine));
        CAPTURE(std::string(way.flow));
        CAPTURE(start);
        CAPTURE(angle);
        const Scene scene = read(against_wall(start, angle), way);
        const Report report = simulate(scene).report;
        REQUIRE(report.landings[0].size() == 1);
        CHECK(std::abs(report.peaks[0].N - 100.0) < 100.0 * way.eps);
        CHECK(std::abs(report.landings[0][0].peak_force - 100.0) < 100.0 * way.eps);
        CHECK(std::abs(-report.response[0].minimum - report.peaks[0].N) < 100.0 * way.eps);
      }
}

TEST_CASE("peaks of contacts are the extremes of outputs of the same quantity, in random scenes") {
  std::mt19937 random(20261123);
  for (int i = 0; i < 45; ++i) {
    const bool stiff = i % 2 == 1;
    const std::string text =
        rubbing(random, i % 3 == 1 ? 2.0 : 0.0, i % 3 == 2 ? 0.8 : 0.0, stiff ? 1e7 : 400.0);
    std::vector<Peak> first;
    for (const Way& way : ways) {
      if (stiff && way.engine == std::string("ida")) continue;  // 140000 steps
      CAPTURE(i);
      CAPTURE(std::string(way.engine));
      CAPTURE(std::string(way.flow));
      const Report report = simulate(read(text, way)).report;
      REQUIRE(report.outcome.kind == Outcome::Kind::done);
      CHECK((report.method.flow == "modal") == (std::string(way.flow) == "modal"));
      if (first.empty()) first = report.peaks;
      for (std::size_t k = 0; k < 2; ++k) {
        CHECK(std::abs(report.peaks[k].N - first[k].N) <= 1e4 * way.eps * first[k].N);
        CHECK(std::abs(report.peaks[k].T - first[k].T) <= 1e4 * way.eps * first[k].N);
        const OutputExtremes &N = report.response[3 * k], &T = report.response[3 * k + 1];
        const double eps = 100.0 * way.eps * std::abs(N.minimum);
        CHECK(std::abs(report.peaks[k].N + N.minimum) <= eps);
        CHECK(std::abs(report.peaks[k].T - std::max(T.maximum, -T.minimum)) <= eps);
        double highest = 0.0;
        for (const Landing& landing : report.landings[k]) highest = std::max(highest, landing.peak_force);
        CHECK(std::abs(highest + N.minimum) <= eps);
      }
    }
  }
}

TEST_CASE("each stay of a pipe on its supports has the greatest force of its own, in modes as in series") {
  for (const char* mesh : {"[2, 6]", "[3, 7]", "[4, 12]", "[5, 16]", "[8, 24]"}) {
    CAPTURE(mesh);
    std::vector<std::vector<Landing>> in_series;
    for (const Way& way : {ways[0], ways[1]}) {
      const Scene scene = read_scene(SIGNORINI_MODELS "/pipeline.toml", {{"run.engine", way.engine},
                                                                         {"run.flow", way.flow},
                                                                         {"run.certify", "false"},
                                                                         {"members.1.elements", mesh}});
      const Report report = simulate(scene).report;
      REQUIRE(report.outcome.kind == Outcome::Kind::done);
      if (in_series.empty()) in_series = report.landings;
      for (std::size_t k = 0; k < report.landings.size(); ++k) {
        REQUIRE(report.landings[k].size() == in_series[k].size());
        for (std::size_t i = 0; i < in_series[k].size(); ++i)
          CHECK(std::abs(report.landings[k][i].peak_force - in_series[k][i].peak_force) <=
                1e-9 * report.peaks[k].N);
      }
    }
  }
}

TEST_CASE("ut peaks where a surface turns, though no step does") {
  // s turns at 0.6 s, by the area 0.5 * 0.5 * 0.6; in a wave at pi/w, by 2 V/w. The body flies away from it along n.
  const double V = 0.4, w = 3.0;
  const struct {
    std::string velocity;
    double peak;
  } surfaces[] = {{"{ type = \"table\", times = [0.0, 0.3, 0.9], values = [0.0, 0.5, -0.5] }", 0.15},
                  {fmt::format("{{ type = \"harmonic\", amplitude = {}, omega = {} }}", V, w), 2.0 * V / w}};
  for (const Way& way : ways)
    for (const auto& surface : surfaces)
      for (const double angle : {0.0, 0.7}) {
        CAPTURE(std::string(way.engine));
        CAPTURE(surface.velocity);
        const std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 1.3, output_dt = 1.3, initial = {{ A = {{ vx = {0:.17g}, vy = {1:.17g} }} }} }}
nodes = {{ A = [0.0, 0.0] }}
masses = [{{ node = "A", mass = 1.0 }}]
[[contacts]]
name = "wall"
node = "A"
law = "compliant"
normal = [{0:.17g}, {1:.17g}]
gap = 0.5
normal_stiffness = 1e4
friction = 0.3
tangential_stiffness = 1e4
surface_velocity = {2}
)",
                                             -std::sin(angle), std::cos(angle), surface.velocity);
        const Report report = simulate(read(text, way)).report;
        CHECK(std::abs(report.peaks[0].tangential - surface.peak) < 10.0 * way.eps);
        CHECK(report.law_checks.violations.empty());
      }
}

TEST_SUITE_END();
