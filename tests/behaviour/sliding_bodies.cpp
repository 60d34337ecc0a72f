// Elastic blocks on ground that jerks, beside the closed form of rigid ones (Newmark 1965).
//
//   ground: acceleration A for a time T, then V = A T;   slip V^2/(2 N) (1 - N/A),  N = f g
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

double newmark_slip(double A, double T, double N) { return A * T * A * T / (2.0 * N) * (1.0 - N / A); }

/// A block 0.4 x 0.1 of Q4 on the ground, and one of 0.3 x 0.1 on it; turned. friction: below, between.
std::string jerked(double degrees, double A, double T, const std::string& law, double below, double between) {
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  const auto block = [&](const char* name, double x, double y, double width, int n) {
    return fmt::format(R"([[bodies]]
name = "{}"
rectangle = {{ from = [{:.17g}, {:.17g}], size = [{}, 0.1], degrees = {} }}
elements = [{}, 2]
E = 1.0e8
nu = 0.2
density = 2000.0
plane = "stress"
)",
                       name, c * x - s * y, s * x + c * y, width, degrees, n);
  };
  const auto seam = [&](const char* name, const char* slave, const char* master, double f) {
    return fmt::format(
        "[[seams]]\nname = \"{}\"\nslave = \"{}\"\nmaster = \"{}\"\nfriction = {}\ncontact_mass = "
        "\"none\"\n{}\n",
        name, slave, master, f, law);
  };
  std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
gravity = [{:.17g}, {:.17g}]
run = {{ t_end = {:.17g}, engine = "exact", initial = "static", output_times = [{:.17g}], certify = false }}
)",
                                 10.0 * s, -10.0 * c, 1.2 * A * T, 1.2 * A * T);
  text += block("low", 0.0, 0.0, 0.4, 4);
  if (between > 0.0) text += block("high", 0.05, 0.1, 0.3, 5);
  text += seam("foot", "low.bottom", "ground", below);
  if (between > 0.0) text += seam("joint", "high.bottom", "low.top", between);
  text += fmt::format(
      "[[base_motion]]\ndirection = [{:.17g}, {:.17g}]\nacceleration = {{ type = \"rectangle\", amplitude = "
      "{}, start = "
      "0.0, end = {} }}\n",
      c, s, A, T);
  return text;
}

const char* const stiff_layer_law =
    "law = \"compliant\"\nnormal_stiffness = 1.0e11\ntangential_stiffness = 1.0e11";
const char* const bare_law = "law = \"rigid\"";

}  // namespace

TEST_SUITE_BEGIN("slow/behaviour/sliding_bodies");

TEST_CASE("a sliding block of Q4 slips as far as the rigid block") {
  const double A = 5.0, T = 0.05, slip = newmark_slip(A, T, 1.0);
  for (const char* law : {stiff_layer_law, bare_law})
    for (const double degrees : {0.0, 33.7}) {
      CAPTURE(law);
      CAPTURE(degrees);
      const Scene scene = parse_scene(jerked(degrees, A, T, law, 0.1, 0.0), "block.toml");
      const Result result = simulate(scene);
      REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
      for (const ContactSample& c : result.rows.back().contacts)
        CHECK(std::abs(-c.slip / slip - 1.0) <= 1e-3);
    }
}

TEST_CASE("a stack under base motion: the upper block slips as a rigid one, the lower one stays") {
  const double A = 2.0, T = 0.1, slip = newmark_slip(A, T, 1.0);
  for (const char* law : {stiff_layer_law, bare_law}) {
    CAPTURE(law);
    const Scene scene = parse_scene(jerked(-21.0, A, T, law, 0.3, 0.1), "stack.toml");
    const Result result = simulate(scene);
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    const auto& contacts = result.rows.back().contacts;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      CAPTURE(k);
      const bool joint = k >= scene.seams[1].first_contact;
      CHECK(std::abs(-contacts[k].slip - (joint ? slip : 0.0)) <= 1e-3 * slip);
    }
  }
}

TEST_SUITE_END();
