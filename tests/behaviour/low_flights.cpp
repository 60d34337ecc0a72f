// Flights of a rigid contact that are too low for the steps of `ida`, beside
// contacts that only `ida` knows: the series that follows such a flight takes
// their energies, and leaves alone what is no series to it.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "signorini/simulate.hpp"

namespace signorini::tests::low_flights {
namespace {

/// Vectors of a scene that is turned by an angle.
struct Turn {
  double angle = 0.0;
  [[nodiscard]] std::string vector(double x, double y) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y);
  }
  [[nodiscard]] std::string velocity(double x, double y) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return fmt::format("{{ vx = {:.17g}, vy = {:.17g} }}", c * x - s * y, s * x + c * y);
  }
};

/// Two bodies of 1 kg on a weak spring between them; B hops on a rigid floor,
/// by a tenth of a micrometre at first.
std::string two_bodies(const Turn& turn, const std::string& run, double stiffness,
                       const std::string& contacts) {
  return fmt::format(
             "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", "
             "length = \"m\", time = \"s\" }}\ngravity = {}\n"
             "[run]\n{}\n[nodes]\nA = {}\nB = {}\n[[masses]]\nnode = "
             "\"A\"\nmass = 1.0\n[[masses]]\nnode = "
             "\"B\"\nmass = 1.0\n[[springs]]\nnode = \"A\"\nagainst = "
             "\"B\"\ndirection = {}\nstiffness = {}\n"
             "[[contacts]]\nname = \"floor\"\nnode = \"B\"\nlaw = "
             "\"rigid\"\nnormal = {}\nrestitution = 0.98\n",
             turn.vector(0.0, -10.0), run, turn.vector(0.0, 0.0), turn.vector(1.0, 0.0),
             turn.vector(0.6, 0.8), stiffness, turn.vector(0.0, 1.0)) +
         contacts;
}

Result simulate_text(const std::string& text, const char* engine, const char* rtol) {
  const Scene scene = parse_scene(text, "test.toml", {{"run.engine", engine}, {"run.rtol", rtol}});
  return simulate(build_model(scene), scene.run);
}

long hits_of(const Result& result, int contact) {
  long hits = 0;
  for (const Event& event : result.events)
    hits += event.contact == contact && event.type == EventType::impact ? 1 : 0;
  return hits;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/low_flights");

// A lands at 1 m/s on a pad and crushes it: up to the depth d it takes Y d less
// the triangle Y^2 / 2 kn.
TEST_CASE(
    "what a pad that yields takes while another body hops is its force "
    "times its depth") {
  constexpr double kn = 1e5, Y = 14.0;
  for (const double angle : {0.0, 0.83, -2.1}) {
    CAPTURE(angle);
    const Turn turn{angle};
    const Result result =
        simulate_text(two_bodies(turn,
                                 fmt::format("t_end = 0.2\ninitial = {{ A = {}, B = {} }}",
                                             turn.velocity(0.0, -1.0), turn.velocity(0.0, 1e-3)),
                                 1.0,
                                 fmt::format("[[contacts]]\nname = \"pad\"\nnode = "
                                             "\"A\"\nlaw = \"yielding\"\nnormal = "
                                             "{}\nnormal_stiffness = {}\nyield_force = {}\n",
                                             turn.vector(0.0, 1.0), kn, Y)),
                      "ida", "1e-9");
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(hits_of(result, 0) >= 5);
    const ContactSample& pad = result.rows.back().contacts[1];
    REQUIRE(pad.state != State::open);
    REQUIRE(pad.N == doctest::Approx(-Y));
    CHECK(std::abs(result.report.audit.friction_work[1] - (-Y * pad.gap - 0.5 * Y * Y / kn)) < 1e-7);
    CHECK(result.report.audit.energy.value < 1e-7 * result.report.audit.energy_scale);
  }
}

// A slides in a bowl without friction, under a force that the spring varies:
// all energy stays.
TEST_CASE(
    "a pendulum beside a body that hops keeps its energy, off its "
    "surface too") {
  for (const double up : {0.0, 0.3}) {
    CAPTURE(up);
    for (const double angle : {0.0, 0.83, -2.1}) {
      CAPTURE(angle);
      const Turn turn{angle};
      const Result result =
          simulate_text(two_bodies(turn,
                                   fmt::format("t_end = 0.2\ninitial = {{ A = {}, B = {} }}",
                                               turn.velocity(3.0, up), turn.velocity(0.0, 1e-3)),
                                   300.0,
                                   fmt::format("[[pendulums]]\nname = \"p\"\nnode = "
                                               "\"A\"\nradius = 0.5\nnormal = {}\nfriction = "
                                               "0.0\ntangential_stiffness = "
                                               "500.0\nnormal_stiffness = 2000.0\n",
                                               turn.vector(0.0, 1.0))),
                        "ida", "1e-9");
      REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
      REQUIRE(hits_of(result, 0) >= 5);
      CHECK(result.report.audit.energy.value < 1e-7 * result.report.audit.energy_scale);
    }
  }
}

// Under a force far above all of these friction is the coefficient of light
// loads.
TEST_CASE(
    "a pad whose friction depends on N lands and sticks while another "
    "body rests or hops") {
  for (const double angle : {0.0, 0.83, -2.1}) {
    CAPTURE(angle);
    const Turn turn{angle};
    const auto text = [&](const char* friction) {
      return two_bodies(turn, "t_end = 0.3", 100.0,
                        fmt::format("[[contacts]]\nname = \"pad\"\nnode = \"A\"\nlaw = "
                                    "\"compliant\"\nnormal = "
                                    "{}\nnormal_stiffness = 3000.0\ntangential_stiffness = "
                                    "3000.0\nfriction = "
                                    "{}\n[[loads]]\nnode = \"B\"\ndirection = {}\namplitude = 30.0\n",
                                    turn.vector(-0.4, 0.9), friction, turn.vector(0.0, 1.0)));
    };
    const Result expected = simulate_text(text("0.5"), "exact", "1e-10");
    const Result result = simulate_text(text("{ light = 0.5, heavy = 0.1, force = 1e11 }"), "ida", "1e-10");
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(result.events.size() == expected.events.size());
    for (std::size_t i = 0; i < expected.events.size(); ++i) {
      CAPTURE(i);
      CHECK(result.events[i].to == expected.events[i].to);
      CHECK(std::abs(result.events[i].t - expected.events[i].t) < 1e-7);
    }
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::low_flights
