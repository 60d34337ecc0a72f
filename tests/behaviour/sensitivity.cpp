// Derivatives of runs against closed forms, and where there are none.
#include "signorini/sensitivity.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

const Response& figure(const Sensitivities& s, const std::string& name, int contact = 0) {
  for (const Response& r : s.responses)
    if (r.name == name && r.contact == contact) return r;
  REQUIRE_MESSAGE(false, name);
  return s.responses.front();
}

/// Within 1e-11 of what it is, or of one.
void check_rate(double found, double expected) {
  CAPTURE(found);
  CAPTURE(expected);
  CHECK(std::abs(found - expected) <= 1e-11 * std::max(1.0, std::abs(expected)));
}

/// A ball of 1 kg that falls under 10 N.
std::string ball(const std::string& contact, const std::string& run = "t_end = 3.0") {
  return matrix_scene(run + "\ninitial = { u = [1.0], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[0.0]]",
                      "law = \"rigid\"\nnormal = { d0 = 1.0 }\n" + contact,
                      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -10.0\n");
}

/// A block on springs of 4 N/m that a slider of 1 N rubs: turns at k pi/omega, omega = 2.
std::string oscillator(const std::string& contact, const std::string& rest = "") {
  return matrix_scene("t_end = 12.0\noutput_dt = 3.0\ninitial = { u = [1.03], v = [0.0] }",
                      "mass = [[1.0]]\nstiffness = [[4.0]]",
                      "law = \"slider\"\ntangent = { d0 = 1.0 }\n" + contact, rest);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/sensitivity");

TEST_CASE("hits of a ball: times, speeds and impulses by height, weight and restitution") {
  const double h = 1.0, g = 10.0, e = 0.5;
  const Sensitivities s = rates_of(ball("restitution = 0.5", "t_end = 1.2"),
                                   {"contacts.c.restitution", "loads.1.amplitude", "run.initial.u.1"});
  REQUIRE(s.events.size() == 3);
  const double fall = std::sqrt(2.0 * h / g), v = std::sqrt(2.0 * g * h);
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(i);
    // t = fall (1 + 2 e + 2 e^2 + ...),   v = v0 e^i
    double factor = 1.0, factor_e = 0.0;
    for (std::size_t k = 1; k <= i; ++k) {
      factor += 2.0 * std::pow(e, static_cast<double>(k));
      factor_e += 2.0 * static_cast<double>(k) * std::pow(e, static_cast<double>(k) - 1.0);
    }
    const double power = std::pow(e, static_cast<double>(i));
    const double power_e = i == 0 ? 0.0 : static_cast<double>(i) * std::pow(e, static_cast<double>(i) - 1.0);
    const std::vector<EventRates>& rates = s.event_rates[i];
    check_rate(rates[0].t, fall * factor_e);
    check_rate(rates[1].t, 0.5 * fall * factor / g);  // by -g
    check_rate(rates[2].t, 0.5 * fall * factor / h);
    check_rate(rates[0].vn, -v * power_e);
    check_rate(rates[0].vn_after, v * (power_e * e + power));
    check_rate(rates[2].vn_after, 0.5 * v * power * e / h);
    check_rate(rates[0].impulse_n, v * (power_e * (1.0 + e) + power));
    check_rate(rates[1].impulse_n, -0.5 * v * power * (1.0 + e) / g);
  }
}

TEST_CASE("a ball's last rebounds are captured, and what comes after rests at rest") {
  const Sensitivities s = rates_of(ball("restitution = 0.5\ncapture_velocity = 0.3"), {"run.initial.u.1"});
  REQUIRE(s.events.size() > 3);
  CHECK(s.events.back().to == State::closed);
  const EventRates& last = s.event_rates.back()[0];
  check_rate(last.t, 0.5 * s.events.back().t);  // all times go as sqrt(h)
  CHECK(last.vn_after == doctest::Approx(0.0));
  CHECK(std::abs(s.value_rates[0].back()[0]) < 1e-12);
  CHECK(s.parameters[0].reason.empty());
}

TEST_CASE("a block slips under a load that grows, when friction lets it") {
  // T = 2 t reaches 0.4 N = 4 at t = 2; the weight is 10
  const std::string text = matrix_scene(
      "t_end = 3.0\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
      "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
      "law = \"rigid\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nfriction = { static = 0.4, kinetic = "
      "0.3 }",
      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -10.0\n[[loads]]\ndirection = { d0 = 1.0 "
      "}\namplitude = 2.0\n"
      "history = { type = \"polynomial\", coefficients = [0.0, 1.0], start = 0.5, end = 100.0 }\n");
  const Sensitivities s = rates_of(text, {"contacts.c.friction.static", "contacts.c.friction.kinetic",
                                          "loads.2.amplitude", "loads.1.amplitude", "loads.2.history.start"});
  REQUIRE(s.events.size() == 1);
  CHECK(s.events[0].t == doctest::Approx(2.5));
  const std::vector<EventRates>& rates = s.event_rates[0];
  check_rate(rates[0].t, 10.0 / 2.0);
  check_rate(rates[1].t, 0.0);
  check_rate(rates[2].t, -2.0 / 2.0);
  check_rate(rates[3].t, -0.4 / 2.0);
  check_rate(rates[4].t, 1.0);
  // u = int int 2 s - 3 over s = t - 0.5 from 2 to 2.5: slip at the end
  const double a = 2.0, b = 2.5;  // of s
  const double slid = (b * b * b - a * a * a) / 3.0 - a * a * (b - a) - 1.5 * (b - a) * (b - a);
  CHECK(figure(s, "rest slip").value == doctest::Approx(slid));
  check_rate(figure(s, "rest slip").rates[1], -5.0 * (b - a) * (b - a));
  // by the static coefficient: the beginning moves by 5, du/da = -2 a (b - a) + 10 fk (b - a)
  check_rate(figure(s, "rest slip").rates[0], 5.0 * (-2.0 * a * (b - a) + 3.0 * (b - a)));
  // by the start: what is left of the time
  check_rate(figure(s, "rest slip").rates[4], -(b * b - a * a - 3.0 * (b - a)));
}

TEST_CASE("turns of a rubbed oscillator: times by stiffness, what is left by friction") {
  const Sensitivities s =
      rates_of_model("coulomb-pad", {"contacts.pad.friction", "springs.1.stiffness", "masses.1.mass",
                                     "contacts.pad.normal_force", "run.initial.block.ux"});
  REQUIRE(s.events.size() == 4);
  const double k = 1e4, f = 0.1, N = 10.0;
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    const double t = s.events[i].t;
    check_rate(s.event_rates[i][0].t, 0.0);
    check_rate(s.event_rates[i][1].t, -0.5 * t / k);
    check_rate(s.event_rates[i][2].t, 0.5 * t);
    check_rate(s.event_rates[i][3].t, 0.0);
    check_rate(s.event_rates[i][4].t * 0.85e-3, 0.0);
  }
  const Response& rest = figure(s, "rest tangential");
  CHECK(rest.value == doctest::Approx(0.05e-3));
  check_rate(rest.rates[0], -8.0 * N / k);
  check_rate(rest.rates[1], 8.0 * f * N / (k * k));
  check_rate(rest.rates[2], 0.0);
  check_rate(rest.rates[3], -8.0 * f / k);
  check_rate(rest.rates[4], 1.0);
}

TEST_CASE("rows at output times between events: a free oscillator") {
  const Sensitivities s = rates_of(oscillator("normal_force = 0.0\nfriction = 0.1"), {"run.initial.u.1"});
  REQUIRE(s.times.size() == 5);
  for (std::size_t i = 0; i < s.times.size(); ++i) {
    check_rate(s.value_rates[0][i][0], std::cos(2.0 * s.times[i]));
    check_rate(s.values[i][0], 1.03 * std::cos(2.0 * s.times[i]));
  }
}

TEST_CASE("where derivatives from both sides differ there is none, and the reason is said") {
  // at the crest of its swing the mass comes as near as the gap is wide
  const auto swing = [](const std::string& gap) {
    return matrix_scene("t_end = 4.0\ninitial = { u = [1.0], v = [0.0] }",
                        "mass = [[1.0]]\nstiffness = [[1.0]]",
                        "law = \"compliant\"\nnormal_stiffness = 2.0\nnormal = { d0 = 1.0 }\ngap = " + gap);
  };
  const Sensitivities clear = rates_of(swing("0.9"), {"contacts.c.gap"});
  REQUIRE(clear.events.size() == 2);
  // cos t = -0.9
  check_rate(clear.event_rates[0][0].t, 1.0 / std::sin(std::acos(-0.9)));
  CHECK(clear.parameters[0].reason.empty());
  const Sensitivities graze = rates_of(swing("0.99999999999999"), {"contacts.c.gap"});
  if (!graze.events.empty()) {
    CHECK(graze.parameters[0].reason.find("grazes") != std::string::npos);
    CHECK(std::isnan(graze.event_rates[0][0].t));
  }
  // it rests on the ground without weight: lifted by one sign of the gap, pressed by the other
  const Sensitivities kink = rates_of(
      matrix_scene("t_end = 1.0\ninitial = { u = [0.0], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[4.0]]",
                   "law = \"rigid\"\nnormal = { d0 = 1.0 }\ngap = 0.0"),
      {"run.initial.v.1"});
  CHECK(kink.parameters[0].until == 0.0);
  CHECK(kink.parameters[0].reason.find("both sides") != std::string::npos);
}

TEST_CASE(
    "two masses that hit at one instant: each time has its own derivative, unless they act on each other") {
  const std::string twice = "law = \"rigid\"\nrestitution = 0.5\n";
  const auto pair = [&](const std::string& mass) {
    return matrix_scene(
        "t_end = 0.8\ninitial = { u = [1.0, 1.0], v = [0.0, 0.0] }",
        "mass = " + mass + "\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
        twice + "normal = { d0 = 1.0 }\n[[contacts]]\nname = \"b\"\n" + twice + "normal = { d1 = 1.0 }",
        "[[loads]]\ndirection = { d0 = 1.0, d1 = 1.0 }\namplitude = -10.0\n");
  };
  const Sensitivities same =
      rates_of(pair("[[1.0, 0.0], [0.0, 1.0]]"), {"loads.1.amplitude", "run.initial.u.1"});
  REQUIRE(same.events.size() == 2);
  CAPTURE(same.parameters[1].reason);
  check_rate(same.event_rates[0][0].t, 0.5 * same.events[0].t / 10.0);
  check_rate(same.event_rates[1][0].t, 0.5 * same.events[1].t / 10.0);
  CHECK(same.parameters[0].reason.empty());
  CHECK(same.parameters[1].reason.find("depends on their order") != std::string::npos);
  const Sensitivities coupled =
      rates_of(pair("[[1.0, 0.2], [0.2, 1.0]]"), {"loads.1.amplitude", "run.initial.u.1"});
  REQUIRE(coupled.events.size() == 2);
  CAPTURE(coupled.parameters[1].reason);
  check_rate(coupled.event_rates[1][0].t, 0.5 * coupled.events[1].t / 10.0);
  CHECK(coupled.parameters[1].reason.find("depends on their order") != std::string::npos);
  CHECK(std::isnan(coupled.event_rates[0][1].t));
}

TEST_CASE("keys that the scene leaves out: gravity and initial values are zero") {
  const SceneReader read = [](const std::vector<Override>& changes) {
    return parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 2.0, engine = "exact", output_dt = 0.5, initial = { b = { vy = -1.0 } } }
nodes = { b = [0.0, 1.0] }
masses = [{ node = "b", mass = 2.0 }]
contacts = [{ name = "floor", node = "b", law = "rigid", normal = [0.0, 1.0], gap = 1.0, restitution = 0.5 }]
)",
                       "test.toml", changes);
  };
  const Sensitivities s =
      sensitivities(read, {"gravity.1", "gravity.2", "run.initial.b.vx", "run.initial.b.uy"});
  REQUIRE(s.events.size() == 1);
  for (const Parameter& p : s.parameters) CHECK(p.value == 0.0);
  // h + g t^2/2 - v t = 0, t = 1
  check_rate(s.event_rates[0][0].t, 0.0);
  check_rate(s.event_rates[0][1].t, 0.5);
  check_rate(s.event_rates[0][2].t, 0.0);
  check_rate(s.event_rates[0][3].t, 1.0);
  check_rate(figure(s, "rest tangential").rates[0], 2.0);  // t^2/2
  check_rate(figure(s, "rest tangential").rates[2], 2.0);  // t
  CHECK_THROWS_WITH_AS(sensitivities(read, {"run.initial.c.vx"}), doctest::Contains("unknown node"),
                       UsageError);
  CHECK_THROWS_WITH_AS(sensitivities(read, {"contacts.floor.normal_stiffness"}),
                       doctest::Contains("If this key has no default"), UsageError);
}

TEST_CASE("the least changes at which neighbours meet, and keys that are refused") {
  const std::string text = oscillator("normal_force = 1.0\nfriction = 0.4");
  const Sensitivities s = rates_of(text, {"run.initial.u.1", "contacts.c.friction"});
  for (const SequenceChange& swap : smallest_sequence_changes(s)) {
    const double apart = s.events[swap.second].t - s.events[swap.first].t;
    const double first = s.event_rates[swap.first][swap.parameter].t,
                 second = s.event_rates[swap.second][swap.parameter].t;
    CHECK(apart + swap.change * (second - first) == doctest::Approx(0.0));
  }
  CHECK(s.parameters[0].is_valid(-1e9));
  CHECK_FALSE(s.parameters[1].is_valid(-1e-9));  // of friction
  CHECK(s.parameters[1].is_valid(0.0));
  // Two events 0.1 apart close by 2 for each unit of a key that is 0.03: they would meet at -0.02.
  Sensitivities beyond;
  beyond.parameters.resize(1);
  beyond.parameters[0].value = 0.03;
  beyond.events.resize(2);
  beyond.events[0].t = 1.0;
  beyond.events[1].t = 1.1;
  beyond.event_rates.assign(2, std::vector<EventRates>(1));
  beyond.event_rates[0][0].t = -2.0;
  beyond.event_rates[1][0].t = 0.0;
  REQUIRE(smallest_sequence_changes(beyond).size() == 1);
  CHECK(smallest_sequence_changes(beyond)[0].change == doctest::Approx(-0.05));
  beyond.parameters[0].is_valid = s.parameters[1].is_valid;
  CHECK(smallest_sequence_changes(beyond).empty());
  CHECK_THROWS_WITH_AS(rates_of(text, {"run.t_end"}),
                       "--parameter run.t_end: the motion does not depend on this key", UsageError);
  CHECK_THROWS_AS(rates_of(text, {"contacts.c.name"}), UsageError);
  CHECK_THROWS_AS(rates_of(text, {"contacts.d.friction"}), UsageError);
  CHECK_THROWS_AS(rates_of(oscillator("normal_force = 1.0\nfriction = { static = 0.4, kinetic = 0.3 }"),
                           {"contacts.c.friction"}),
                  UsageError);
  CHECK_THROWS_AS(rates_of(oscillator("normal_force = 1.0\nfriction = { static = 0.4, kinetic = 0.3, "
                                      "stribeck_velocity = 0.1 }"),
                           {"contacts.c.friction"}),
                  UsageError);
}

TEST_CASE("a reader is of the file as it was when the reader was made, however long it is used") {
  const made_up::Folder folder;
  const std::filesystem::path file = folder / "scene.toml";
  const std::string text = oscillator("normal_force = 1.0\nfriction = 0.3");
  made_up::spill(file, text);
  const SceneReader read = reader_of(file.string());
  made_up::spill(file, oscillator("normal_force = 2.0\nfriction = 0.3"));
  CHECK(read({}).resolved == parse_scene(text, file.string()).resolved);
  CHECK(read({{"contacts.c.friction", "0.4"}}).contacts[0].friction.static_ == 0.4);
  CHECK(reader_of(file.string())({}).resolved != read({}).resolved);
  CHECK_THROWS_AS((void)reader_of((folder / "none.toml").string()), FileError);
}
