// What closes rigidly faster than capture_velocity is hit, however long it has flown and however stiff the structure:
//
//   g = 0, g' < -capture_velocity:   an impulse, g'+ >= -e g'-
//
// A stiff bar that is thrown up and drops late, and a block on stiff beams that rocks.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "differential/landings.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::rigid_landings {
namespace {

constexpr double pi = 3.14159265358979323846;

std::string head(double t_end, const std::string& run) {
  return fmt::format(
      "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\ngravity = [0.0, "
      "-9.81]\n[run]\nt_end = {:.17g}\n{}",
      t_end, run);
}

/// Thrown up at `speed`, it lands after 2 speed/g, and once more.
std::string bar(double speed, double stiffness, double restitution, double t_end) {
  return head(t_end,
              fmt::format("initial = {{ a = {{ vy = {0:.17g} }}, b = {{ vy = {0:.17g} }} }}\n", speed)) +
         fmt::format("[sections.s]\nEA = {:.17g}\nmass_per_length = 1.0\n", stiffness) +
         "[nodes]\na = [0.0, 0.0]\nb = [0.0, 0.4]\n[[members]]\nnodes = [\"a\", \"b\"]\nsection = "
         "\"s\"\ntype = "
         "\"bar\"\n[[supports]]\nnodes = [\"a\", \"b\"]\nfix = [\"ux\"]\n[[contacts]]\nname = "
         "\"floor\"\nnode = "
         "\"a\"\nlaw = \"rigid\"\nnormal = [0.0, 1.0]\n" +
         fmt::format("restitution = {:.17g}\n", restitution);
}

std::string block(double half_width, double stiffness, double shake, double period, double t_end) {
  return head(t_end, "initial = \"static\"\n") +
         fmt::format(
             "[sections.stiff]\nEA = {0:.17g}\nEI = {1:.17g}\nmass_per_length = 1.0\n[nodes]\nL = "
             "[-{2:.17g}, "
             "0.0]\nR = [{2:.17g}, 0.0]\nG = [0.0, 1.0]\n",
             stiffness, 0.1 * stiffness, half_width) +
         "[[masses]]\nnode = \"G\"\nmass = 800.0\ninertia = 277.0\n[[members]]\nnodes = [\"L\", \"G\", "
         "\"R\"]\nsection "
         "= \"stiff\"\n[[base_motion]]\ndirection = [1.0, 0.0]\n" +
         fmt::format("acceleration = {{ type = \"harmonic\", omega = {:.17g}, amplitude = {:.17g} }}\n",
                     2.0 * pi / period, shake) +
         "[[contacts]]\nname = \"foot\"\nnodes = [\"L\", \"R\"]\nlaw = \"rigid\"\nnormal = [0.0, "
         "1.0]\nfriction = "
         "0.7\nrestitution = 0.0\n";
}

struct Landings {
  int hits = 0, swallowed = 0;
};

/// swallowed: closed faster than capture_velocity, without an impulse.
Landings landings(const std::string& text, const std::string& engine, double capture) {
  const Scene scene = parse_scene(text + fmt::format("capture_velocity = {:.17g}\n", capture), "test.toml",
                                  {{"run.engine", engine}, {"run.certify", "false"}});
  const Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.reason == "");
  if (engine == "exact") CHECK(result.report.audit.energy.value < 1e-5 * result.report.audit.energy_scale);
  Landings sum;
  for (const Event& event : result.events) {
    if (event.type == EventType::impact) ++sum.hits;
    if (event.type == EventType::contact && event.vn < -capture) ++sum.swallowed;
  }
  return sum;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/rigid_landings");

TEST_CASE("a stiff bar that lands late is hit, again and again") {
  std::mt19937 random(5);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  for (int variant = 0; variant < 30; ++variant) {
    const double speed = uniform(1.0, 12.0), stiffness = std::pow(10.0, uniform(6.0, 8.5)),
                 e = uniform(0.2, 0.8);
    CAPTURE(speed);
    CAPTURE(stiffness);
    CAPTURE(e);
    const Landings result = landings(bar(speed, stiffness, e, 2.0 * speed / 9.81 + 0.2),
                                     variant % 5 == 0 ? "ida" : "exact", 1e-7);
    CHECK(result.hits >= 2);  // its other end throws it down again at once
    CHECK(result.swallowed == 0);
  }
}

TEST_CASE("a block on stiff beams that rocks: each landing is a hit") {
  std::mt19937 random(7);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int hits = 0;
  for (int variant = 0; variant < 20; ++variant) {
    const double half_width = uniform(0.15, 0.3), stiffness = std::pow(10.0, uniform(7.0, 8.5)),
                 shake = uniform(2.0, 5.0), period = uniform(0.4, 1.0);
    CAPTURE(half_width);
    CAPTURE(stiffness);
    CAPTURE(shake);
    CAPTURE(period);
    const Landings result = landings(block(half_width, stiffness, shake, period, 0.8), "exact", 1e-9);
    hits += result.hits;
    CHECK(result.swallowed == 0);
  }
  CHECK(hits > 100);
}

TEST_CASE("random bodies: no landing is swallowed, no energy lost") {
  differential::LandingsTally tally;
  for (std::uint64_t seed = 1; seed <= 16; ++seed)
    differential::look_at_landings("drawn", differential::draw_landing_scene(seed), tally);
  CHECK(tally.runs == 16);
  CHECK(tally.bars == 8);
  CHECK(tally.hits > 100);
  CHECK(tally.exit_code() == 0);
}

TEST_CASE(
    "a slider reaches its limit while a mass beside it makes its last bounces: ida knows the flights up to "
    "there") {
  // The slider sticks within 1e-8 of its limit as the mass comes to rest at the stop. It reached the limit before a flight
  // that was lower than the steps of ida see was over; the mass then fell through the stop, and bounced forever.
  for (const double degrees : {0.0, -38.0}) {
    CAPTURE(degrees);
    const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
    const std::string along = fmt::format("[{:.17g}, {:.17g}]", c, s);
    const std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 13.0, engine = "exact", rtol = 1e-10 }}
nodes = {{ A = [0.0, 0.0], B = {0} }}
masses = [{{ node = "A", mass = 1.2191735681825078 }}, {{ node = "B", mass = 1.9558194702035978 }}]
springs = [
  {{ node = "A", direction = {0}, stiffness = 3.196795403293946, damping = 0.021030887161741542 }},
  {{ node = "A", against = "B", direction = {0}, stiffness = 1.3810418086767273, damping = 0.1880899519144558 }},
  {{ node = "B", direction = {0}, stiffness = 2.242663341242831, damping = 0.18795051049876224 }},
  {{ node = "A", direction = {1}, stiffness = 3.0 }},
  {{ node = "B", direction = {1}, stiffness = 5.0 }},
]
loads = [{{ node = "A", direction = {0}, amplitude = 1.9029208691263053, history = {{ type = "harmonic", omega = 0.84, phase = 0.26295718782699895 }} }}]
[[contacts]]
name = "c0"
node = "A"
law = "slider"
tangent = {0}
normal_force = 1.1078427526148562
friction = 0.18592753087614378
tangential_stiffness = 19.812026949045826
[[contacts]]
name = "c1"
node = "A"
law = "rigid"
normal = {0}
gap = 0.3035215396722907
restitution = 0.42123524928218664
)",
                                         along, fmt::format("[{:.17g}, {:.17g}]", -s, c));
    const Result exact = simulate(parse_scene(text, "last bounces")),
                 ida = simulate(parse_scene(text, "last bounces", {{"run.engine", "ida"}}));
    CHECK(exact.events.size() > 40);
    REQUIRE(ida.events.size() == exact.events.size());
    for (std::size_t i = 0; i < ida.events.size(); ++i) {
      CHECK(ida.events[i].contact == exact.events[i].contact);
      CHECK(ida.events[i].to == exact.events[i].to);
      CHECK(std::abs(ida.events[i].t - exact.events[i].t) < 1e-7);
    }
    CHECK(ida.report.law_checks.violated == 0);
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::rigid_landings
