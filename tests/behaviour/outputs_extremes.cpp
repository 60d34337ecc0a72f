// Extremes of outputs: closed forms, finer grids, however rows are spaced.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/engines.hpp"
#include "behaviour/outputs.hpp"

namespace signorini::tests::outputs {

TEST_SUITE_BEGIN("behaviour/outputs_extremes");

TEST_CASE("outputs: extremes between rows are those of a grid a thousand times finer") {
  const std::string wanted = reactions + cut("M", "M", 0.63) + cut("V", "V", 1.0) +
                             output("aC", "acceleration", "at = \"C\"\ndirection = [1.0, 1.0]") +
                             output("uB", "displacement", "at = \"B\"\ndirection = [1.0, 0.0]") +
                             output("turn", "displacement", "at = \"B\"\nrotation = true") +
                             output("T", "contact", "at = \"floor\"\nquantity = \"T\"") +
                             output("N", "contact", "at = \"floor\"\nquantity = \"N\"") +
                             output("gap", "contact", "at = \"floor\"\nquantity = \"gap\"") +
                             output("slip", "contact", "at = \"floor\"\nquantity = \"slip\"");
  // Without histories, so that modes can follow it.
  const std::string tapping =
      beam(clamped_at_A, R"([[contacts]]
name = "tip"
node = "B"
law = "compliant"
normal = [0.0, 1.0]
gap = 0.01
normal_stiffness = 1e4
[[loads]]
node = "B"
direction = [0.0, -1.0]
amplitude = 20.0
[damping]
alpha = 0.5
)" + cut("M", "M", 0.0) + cut("V", "V", 1.0 / 3.0) +
                             output("aB", "acceleration", "at = \"B\"\ndirection = [0.0, 1.0]") +
                             output("N", "contact", "at = \"tip\"\nquantity = \"N\""));
  struct Way {
    const char *engine, *flow;
    const std::string& text;
    double eps;
  };
  const std::string shaken = frame(wanted);
  for (const Way& way : {Way{"exact", "taylor", shaken, 1e-9}, Way{"exact", "modal", tapping, 1e-9},
                         Way{"ida", "auto", shaken, 1e-6}}) {
    CAPTURE(std::string(way.engine));
    CAPTURE(std::string(way.flow));
    std::vector<Override> changes{{"run.flow", way.flow}};
    if (std::string(way.flow) == "modal") changes.push_back({"run.initial", "{}"});
    changes.push_back({"run.output_dt", "0.1"});
    const Computed coarse = compute(way.text, way.engine, changes);
    changes.back().value = "1e-4";
    const Computed fine = compute(way.text, way.engine, changes);
    for (std::size_t i = 0; i < coarse.model.outputs.size(); ++i) {
      CAPTURE(coarse.model.outputs[i].name);
      double greatest = -1e300, least = 1e300;
      for (const auto& row : fine.result.responses) {
        greatest = std::max(greatest, row.values[i]);
        least = std::min(least, row.values[i]);
      }
      const OutputExtremes& e = coarse.result.report.response[i];
      const double size = std::max(std::abs(greatest), std::abs(least));
      // A grid sees less than the extreme, by its spacing squared at most.
      CHECK(e.maximum >= greatest - way.eps * size);
      CHECK(e.minimum <= least + way.eps * size);
      CHECK(e.maximum <= greatest + 1e-3 * size);
      CHECK(e.minimum >= least - 1e-3 * size);
      CHECK(e.t_maximum >= 0.0);
      CHECK(e.t_minimum <= 0.4);
      CHECK(e.maximum > e.minimum);
    }
  }
}

TEST_CASE("outputs: the peak of a free oscillation and its time in closed form") {
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 5.0
output_dt = 5.0
initial = { u = [0.3], v = [2.0] }
[matrices]
mass = [[2.0]]
stiffness = [[50.0]]
damping = [[0.8]]
)" + output("u", "displacement", "direction = { d0 = 1.0 }") +
                           output("a", "acceleration", "direction = { d0 = -2.0 }");
  // u = exp(-z t) (0.3 cos w t + b sin w t)
  const double z = 0.2, w = std::sqrt(25.0 - z * z), b = (2.0 + z * 0.3) / w;
  // u' = 0: tan w t = (b w - 0.3 z) / (0.3 w + b z)
  const double t = std::atan2(b * w - 0.3 * z, 0.3 * w + b * z) / w;
  const double peak = std::exp(-z * t) * (0.3 * std::cos(w * t) + b * std::sin(w * t));
  for (const char* flow : {"\"taylor\"", "\"modal\""}) {
    CAPTURE(flow);
    const Computed c = compute(text, "exact", {{"run.flow", flow}});
    CHECK(std::abs(c.extremes("u").maximum - peak) < 1e-14);
    CHECK(std::abs(c.extremes("u").t_maximum - t) < 1e-11);
    CHECK(c.result.responses.size() == 2);  // none of it in a row
    CHECK(c.extremes("a").t_maximum > 0.0);
  }
  const Computed ida = compute(text, "ida", {{"run.rtol", "1e-9"}});
  CHECK(std::abs(ida.extremes("u").maximum - peak) < 1e-7);
  CHECK(std::abs(ida.extremes("u").t_maximum - t) < 1e-6);
  const Computed steps = compute(text, "newmark", {{"run.dt", "1e-3"}});
  CHECK(std::abs(steps.extremes("u").maximum - peak) < 1e-5);
  CHECK(std::abs(steps.extremes("u").t_maximum - t) < 1e-5);
}

// Two oscillators of 3 and 1e4 rad/s: the fast one is followed where it shows, and not where it is rounding.
TEST_CASE("outputs: the peaks of a fast mode count down to the rounding of the output") {
  for (const double fast : {1e-6, 1e-14}) {
    CAPTURE(fast);
    const std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = 2.0
output_dt = 2.0
initial = {{ u = [1.0, {:.17g}], v = [0.0, 0.0] }}
[matrices]
mass = [[1.0, 0.0], [0.0, 1.0]]
stiffness = [[9.0, 0.0], [0.0, 1e8]]
)",
                                         fast) +
                             output("sum", "displacement", "direction = { d0 = 1.0, d1 = -1.0 }");
    const double w = 1e4;
    // Near the slow one's least value: all turns of the fast one, each made sharp.
    double least = 0.0;
    for (int k = -4; k <= 4; ++k) {
      double t = (std::round(std::numbers::pi / 3.0 * w / (2.0 * std::numbers::pi)) + k) * 2.0 *
                 std::numbers::pi / w;
      for (int i = 0; i < 4; ++i)
        t -= (-3.0 * std::sin(3.0 * t) + fast * w * std::sin(w * t)) /
             (-9.0 * std::cos(3.0 * t) + fast * w * w * std::cos(w * t));
      least = std::min(least, std::cos(3.0 * t) - fast * std::cos(w * t));
    }
    if (fast < 1e-12) least = -1.0;  // the slow one alone
    const Computed c = compute(text, "exact", {{"run.flow", "modal"}});
    CHECK(std::abs(c.extremes("sum").minimum - least) < 2e-13);
    CHECK(c.extremes("sum").t_minimum == doctest::Approx(std::numbers::pi / 3.0).epsilon(1e-3));
  }
}

TEST_CASE("outputs: a ripple of a billionth that dies at once has its peak on a large value") {
  // d0 = -0.19 - 0.025 t^2; d1 = v/w exp(-z t) sin w t, damped at three tenths of its critical rate
  constexpr double omega = 2e4, v = 1.6e-5, z = 0.3 * omega, fall = 0.05;
  const double w = std::sqrt(omega * omega - z * z);
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 0.01
output_dt = 0.01
engine = "exact"
certify = false
initial = { u = [-0.19, 0.0], v = [0.0, 1.6e-5] }
[matrices]
mass = [[1.0, 0.0], [0.0, 1.0]]
stiffness = [[0.0, 0.0], [0.0, 4.0e8]]
damping = [[0.0, 0.0], [0.0, 1.2e4]]
[[loads]]
direction = { d0 = 1.0 }
amplitude = -0.05
history = { type = "constant" }
)" + output("sum", "displacement", "direction = { d0 = 1.0, d1 = 1.0 }");
  const auto rate = [&](double t) {
    return v * std::exp(-z * t) * (std::cos(w * t) - z / w * std::sin(w * t)) - fall * t;
  };
  double a = 0.0, b = 1.0 / omega * 2.0;
  REQUIRE(rate(a) > 0.0);
  REQUIRE(rate(b) < 0.0);
  for (int i = 0; i < 100; ++i) (rate(0.5 * (a + b)) > 0.0 ? a : b) = 0.5 * (a + b);
  const double peak = -0.19 - 0.5 * fall * a * a + v / w * std::exp(-z * a) * std::sin(w * a);
  for (const char* flow : {"taylor", "modal"})
    for (const char* t_end : {"0.01", "0.001", "0.0037"}) {
      CAPTURE(std::string(flow));
      CAPTURE(std::string(t_end));
      const Computed c = compute(text, "exact", {{"run.flow", flow}, {"run.t_end", t_end}});
      CHECK(std::abs(c.extremes("sum").maximum - peak) < 2e-12 * 0.19);
    }
}

TEST_CASE("outputs: extremes are those of the motion, however rows are spaced") {
  // u = exp(-z t) (cos w t + z/w sin w t), u' = -exp(-z t)/w sin w t: extremes of u' where tan w t = w/z.
  const double z = 0.01, w = std::sqrt(1.0 - z * z), t = std::atan2(w, z) / w;
  const double least = -std::exp(-z * t) / w * std::sin(w * t);
  const double lowest = -std::exp(-z * std::numbers::pi / w);
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 10.0
initial = { u = [1.0], v = [0.0] }
[matrices]
mass = [[1.0]]
stiffness = [[1.0]]
damping = [[0.02]]
)" + output("u", "displacement", "direction = { d0 = 1.0 }") +
                           output("v", "velocity", "direction = { d0 = 1.0 }");
  for (const char* dt : {"10", "0.1", "0.01", "0.0007"}) {
    CAPTURE(std::string(dt));
    for (const char* flow : {"taylor", "modal"}) {
      CAPTURE(std::string(flow));
      const Computed c = compute(text, "exact", {{"run.flow", flow}, {"run.output_dt", dt}});
      CHECK(std::abs(c.extremes("v").minimum - least) < 1e-14);
      CHECK(std::abs(c.extremes("v").t_minimum - t) < 1e-7);
      CHECK(std::abs(c.extremes("u").minimum - lowest) < 1e-14);
      CHECK(std::abs(c.extremes("u").t_minimum - std::numbers::pi / w) < 1e-7);
    }
    const Computed ida = compute(text, "ida", {{"run.output_dt", dt}});
    CHECK(std::abs(ida.extremes("v").minimum - least) < 1e-8);
    CHECK(std::abs(ida.extremes("v").t_minimum - t) < 1e-4);
  }
}

TEST_CASE("outputs: of many equal peaks the greatest is found, of beats, in one step and in many") {
  // Expected: the closed form on a grid of 1e-4, which sees peaks to some 1e-8.
  for (const double k : {8.052433795271492, 3.3, 27.1}) {
    CAPTURE(k);
    const double w = std::sqrt(k), p = 0.6317071082430643, q = -0.9945229996597038 / w;
    const std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = 60.0
initial = {{ u = [1.0, {:.17g}], v = [0.0, {:.17g}] }}
[matrices]
mass = [[1.0, 0.0], [0.0, 1.0]]
stiffness = [[1.0, 0.0], [0.0, {:.17g}]]
)",
                                         p, q * w, k) +
                             output("rel", "displacement", "direction = { d0 = 1.0, d1 = -1.0 }");
    const auto at = [&](double t) { return std::cos(t) - p * std::cos(w * t) - q * std::sin(w * t); };
    double greatest = -10.0, least = 10.0;
    for (double t = 0.0; t <= 60.0; t += 1e-4) {
      greatest = std::max(greatest, at(t));
      least = std::min(least, at(t));
    }
    for (const char* dt : {"60", "0.05"}) {
      CAPTURE(std::string(dt));
      const Computed c = compute(text, "exact", {{"run.output_dt", dt}});
      CHECK(c.extremes("rel").maximum == doctest::Approx(greatest).epsilon(1e-7));
      CHECK(c.extremes("rel").maximum >= greatest - 1e-13);
      CHECK(c.extremes("rel").minimum == doctest::Approx(least).epsilon(1e-7));
      CHECK(c.extremes("rel").minimum <= least + 1e-13);
      CHECK(std::abs(at(c.extremes("rel").t_maximum) - c.extremes("rel").maximum) < 1e-12);
    }
  }
}

namespace {

/// Two loads that are faster than every mode.
std::string shaken(const std::string& node, const std::string& direction) {
  std::string text;
  for (const char* course : {"omega = 100.0", "omega = 101.3, phase = 1.0"})
    text += fmt::format(
        "[[loads]]\nnode = \"{}\"\ndirection = {}\namplitude = 1.0\nhistory = {{ type = \"harmonic\", {} "
        "}}\n",
        node, direction, course);
  return text;
}

}  // namespace

TEST_CASE("outputs: extremes that a load makes which is faster than every mode") {
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 10.0
output_dt = 10.0
[nodes]
A = [0.0, 0.0]
B = [1.0, 0.0]
[[masses]]
node = "A"
mass = 1.0
[[masses]]
node = "B"
mass = 1.0
[[supports]]
node = "A"
fix = ["ux", "uy"]
[[supports]]
node = "B"
fix = ["uy"]
[[springs]]
node = "B"
direction = [1.0, 0.0]
stiffness = 1.0
)" + shaken("A", "[0.0, 1.0]") +
                           shaken("B", "[1.0, 0.0]") +
                           output("R", "reaction", "at = \"A\"\ndirection = [0.0, 1.0]") +
                           output("a", "acceleration", "at = \"B\"\ndirection = [1.0, 0.0]");
  // u'' + u = sin(w t + p) from rest: c (sin(w t + p) - sin p cos t - w cos p sin t), c = 1 / (1 - w^2)
  const auto at = [](double t, double w, double p) {
    return (std::sin(p) * std::cos(t) + w * std::cos(p) * std::sin(t) - w * w * std::sin(w * t + p)) /
           (1.0 - w * w);
  };
  double greatest = -10.0, fastest = -10.0;
  for (double t = 0.0; t <= 10.0; t += 1e-5) {
    greatest = std::max(greatest, -std::sin(100.0 * t) - std::sin(101.3 * t + 1.0));
    fastest = std::max(fastest, at(t, 100.0, 0.0) + at(t, 101.3, 1.0));
  }
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Computed c = compute(text, engine);
    CHECK(std::abs(c.extremes("R").maximum - greatest) < 1e-6);  // the grid's own spacing squared
    // newmark's stand at the ends of its steps: w^2 dt^2 / 8 of each load may be missed.
    CHECK(std::abs(c.extremes("a").maximum - fastest) < (engine == "newmark" ? 3e-5 : 1e-6));
  }
}

TEST_CASE(
    "outputs: with newmark, too, a free end has no moment, and its extremes are those of rows at all steps") {
  const std::string text = beam(clamped_at_A,
                                "[[loads]]\nnode = \"B\"\ndirection = [0.0, -1.0]\namplitude = 7.0\n"
                                "history = { type = \"half_sine\", start = 0.0, duration = 0.03 }\n" +
                                    cut("end", "M", 1.0) + cut("M", "M", 0.4) +
                                    output("u", "displacement", "at = \"B\"\ndirection = [0.0, 1.0]"));
  const Computed c = compute(text, "newmark", {{"run.dt", "1e-4"}});
  const Computed all = compute(text, "newmark", {{"run.dt", "1e-4"}, {"run.output_dt", "1e-4"}});
  CHECK(c.extremes("M").minimum < -40.0);  // some of it
  CHECK(std::abs(c.extremes("end").maximum) < 1e-9);
  CHECK(std::abs(c.extremes("end").minimum) < 1e-9);
  double least = 0.0;
  for (const auto& row : all.result.responses) least = std::min(least, row.values[all.index("M")]);
  CHECK(c.extremes("M").minimum == doctest::Approx(least).epsilon(1e-10));
}

TEST_SUITE_END();

}  // namespace signorini::tests::outputs
