// Outputs of the same scene seen otherwise, at both sides of an instant, and what is refused.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/engines.hpp"
#include "behaviour/outputs.hpp"

namespace signorini::tests::outputs {

TEST_SUITE_BEGIN("behaviour/outputs_seen_otherwise");

TEST_CASE("outputs: a scene turned, or in other units, has the same member forces") {
  const std::string wanted = cut("N", "N", 0.4) + cut("V", "V", 0.4) + cut("M", "M", 0.4);
  const auto scene = [&](const std::string& units, double L, double F, double c, double s) {
    const double cosine = c, sine = s;
    return fmt::format(R"(schema = 1
units = {}
gravity = [{:.17g}, {:.17g}]
[run]
t_end = 0.2
output_dt = 0.01
[sections.s]
EA = {:.17g}
EI = {:.17g}
mass_per_length = {:.17g}
[nodes]
A = [0.0, 0.0]
B = [{:.17g}, {:.17g}]
[[members]]
nodes = ["A", "B"]
section = "s"
elements = 3
[[supports]]
node = "A"
fix = ["ux", "uy", "rz"]
[[loads]]
node = "B"
direction = [{:.17g}, {:.17g}]
amplitude = {:.17g}
)",
                       units, 10.0 * L * sine, -10.0 * L * cosine, 2e4 * F, 3e3 * F * L * L,
                       0.4 * F / (L * L), 4.0 * L * cosine, 4.0 * L * sine, 0.6 * cosine - 0.8 * sine,
                       0.6 * sine + 0.8 * cosine, 5.0 * F) +
           wanted;
  };
  const std::string metres = "{ force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }";
  const Computed level = compute(scene(metres, 1.0, 1.0, 1.0, 0.0));
  const Computed turned = compute(scene(metres, 1.0, 1.0, 0.28, 0.96));
  const Computed fine =
      compute(scene("{ force = \"N\", mass = \"t\", length = \"mm\", time = \"s\" }", 1e3, 1e3, 1.0, 0.0));
  REQUIRE(level.result.responses.size() == turned.result.responses.size());
  REQUIRE(level.result.responses.size() == fine.result.responses.size());
  double greatest = 0.0;
  for (std::size_t r = 0; r < level.result.responses.size(); ++r)
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = level.result.responses[r].values[i];
      const double factor = i == 2 ? 1e6 : 1e3;
      greatest = std::max(greatest, std::abs(x));
      CHECK(std::abs(turned.result.responses[r].values[i] - x) < 1e-9 * 20.0);
      CHECK(std::abs(fine.result.responses[r].values[i] / factor - x) < 1e-9 * 20.0);
    }
  CHECK(greatest > 5.0);
}

TEST_CASE("outputs: a reduced model and one with undamped massless parts give what the full one gives") {
  const std::string wanted = cut("M", "M", 0.5) +
                             output("u", "displacement", "at = \"B\"\ndirection = [0.0, 1.0]") +
                             output("loss", "contact", "at = \"tip\"\nquantity = \"loss\"");
  const std::string contact = R"([[contacts]]
name = "tip"
node = "B"
law = "compliant"
normal = [0.0, 1.0]
gap = 0.002
normal_stiffness = 1e4
tangential_stiffness = 1e4
friction = 0.3
[[loads]]
node = "B"
direction = [3.0, -4.0]
amplitude = 20.0
history = { type = "half_sine", start = 0.0, duration = 0.08 }
)";
  const Computed full = compute(beam(clamped_at_A, contact + wanted));
  const Computed reduced =
      compute(beam(clamped_at_A, contact + "[reduction]\ncutoff_omega = 1e5\n" + wanted));
  for (const char* name : {"M", "u", "loss"}) {
    CAPTURE(name);
    CHECK(reduced.extremes(name).maximum == doctest::Approx(full.extremes(name).maximum).epsilon(1e-8));
    CHECK(reduced.extremes(name).minimum == doctest::Approx(full.extremes(name).minimum).epsilon(1e-8));
  }
  CHECK(full.last("loss") == doctest::Approx(full.result.report.audit.friction_work[0]).epsilon(1e-12));
  CHECK(full.last("loss") > 0.0);
}

TEST_CASE("outputs: both sides of an instant stand in rows, and nothing twice") {
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 2.0
output_dt = 1.0
initial = { u = [0.0], v = [0.0] }
[matrices]
mass = [[1.0]]
stiffness = [[4.0]]
[[loads]]
direction = { d0 = 1.0 }
amplitude = 3.0
history = { type = "step", start = 0.5 }
)" + output("a", "acceleration", "direction = { d0 = 1.0 }");
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Computed c = compute(text, engine);
    const auto& rows = c.result.responses;
    REQUIRE(rows.size() == 5);
    CHECK(rows[1].t == 0.5);
    CHECK(rows[2].t == 0.5);
    CHECK(std::abs(rows[1].values[0]) < 1e-6);
    CHECK(rows[2].values[0] == doctest::Approx(3.0));
    CHECK(c.extremes("a").maximum == doctest::Approx(3.0));
    CHECK(c.extremes("a").t_maximum == 0.5);
    CHECK(c.extremes("a").last == rows.back().values[0]);
  }
}

TEST_CASE("outputs: what is wrong is said with its place") {
  const auto refusal = [](const std::string& what) -> std::string {
    const std::string text =
        frame("") + output("first", "velocity", "at = \"B\"\ndirection = [1.0, 0.0]") + what;
    try {
      (void)build_model(parse_scene(text, "test.toml", {}));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const std::string& part) {
    CAPTURE(text);
    CHECK(text.find(part) != std::string::npos);
  };
  CHECK(refusal("").empty());
  has(refusal(output("first", "velocity", "at = \"B\"\ndirection = [1.0, 0.0]")), "found \"first\" twice");
  has(refusal(output("t", "velocity", "at = \"B\"\ndirection = [1.0, 0.0]")), "the column of times");
  has(refusal(output("x", "velocity", "direction = [1.0, 0.0]")),
      "output.x.at: missing, expected the name of a node");
  has(refusal(output("x", "velocity", "at = \"Q\"\ndirection = [1.0, 0.0]")), "unknown node \"Q\"");
  has(refusal(output("x", "velocity", "at = \"B\"")), "required without rotation = true");
  has(refusal(output("x", "velocity", "at = \"B\"\nrotation = true\ndirection = [1.0, 0.0]")),
      "cannot be combined with rotation");
  has(refusal(output("x", "member_force", "at = [\"A\", \"C\"]\nquantity = \"M\"")), "no member has nodes");
  has(refusal(output("x", "member_force", "at = [\"A\", \"A\"]\nquantity = \"M\"")), "found \"A\" twice");
  has(refusal(output("x", "member_force", "at = [\"A\", \"B\"]")), "expected one of \"N\", \"V\", \"M\"");
  has(refusal(output("x", "member_force", "at = [\"A\", \"B\"]\nquantity = \"gap\"")), "found");
  has(refusal(output("x", "member_force", "at = [\"A\", \"B\"]\nquantity = \"M\"\nstation = 1.5")),
      "from 0 to 1");
  has(refusal(output("x", "reaction", "at = \"B\"\ndirection = [1.0, 0.0]")),
      "no support fixes node 'B' in this direction");
  has(refusal(output("x", "reaction", "at = \"A\"\nrotation = true")),
      "no support fixes node 'A' in this direction");
  has(refusal(output("x", "spring", "spring = 3")), "from 1 to 2");
  has(refusal(output("x", "contact", "at = \"flor\"\nquantity = \"N\"")), "did you mean \"floor\"");
  has(refusal(output("x", "contact", "at = \"floor\"\nquantity = \"V\"")), "expected one of \"N\", \"T\"");
  has(refusal(output("x", "combination", "terms = { second = 1.0 }")), "unknown output \"second\"");
  has(refusal(output("l", "contact", "at = \"floor\"\nquantity = \"loss\"") +
              output("x", "combination", "terms = { l = 1.0 }")),
      "is a loss");
  has(refusal(output("g", "contact", "at = \"floor\"\nquantity = \"gap\"") +
              output("x", "combination", "terms = { first = 1.0, g = 1.0 }")),
      "output.x.terms.g: terms 'g' [m] and 'first' [m/s] have different units");
  has(refusal(output("x", "velocity", "at = \"B\"\ndirection = [1.0, 0.0]\nstation = 0.5")),
      "has no meaning with kind = \"velocity\"");
  const Scene scene = parse_scene(frame(reactions + cut("M", "M", 0.3)), "test.toml", {});
  CHECK(parse_scene(scene.resolved, "test.toml", {}).resolved == scene.resolved);
  CHECK(parse_scene(scene.resolved, "test.toml", {}).outputs.size() == 5);
}

TEST_SUITE_END();

}  // namespace signorini::tests::outputs
