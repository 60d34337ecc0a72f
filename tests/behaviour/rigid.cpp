// Rigid contacts through both engines: impacts, starts, several contacts at once, Painleve, what is touched.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/engines.hpp"
#include "behaviour/one_mass.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

const std::string units =
    "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n";

/// A point mass of 1 kg in the plane over a rigid floor; `rest`: loads.
std::string block(const std::string& run, const std::string& contact, const std::string& rest = "") {
  return matrix_scene(run, "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
                      "law = \"rigid\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\n" + contact,
                      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -10.0\n" + rest);
}

const std::string push = "[[loads]]\ndirection = { d0 = 1.0 }\n";

/// A rigid bar of mass 2 and radius of gyration 1, feet at -1 and +1: d0 up, d1 turns, d2 along.
std::string bar(const std::string& run, const std::string& feet, const std::string& rest = "") {
  std::string text =
      units + "[run]\n" + run +
      "\n[matrices]\nmass = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]\nstiffness = [[0.0, "
      "0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]\n"
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -20.0\n";
  for (const int side : {-1, 1})
    text += fmt::format(
        "[[contacts]]\nname = \"{}\"\nlaw = \"rigid\"\nnormal = {{ d0 = 1.0, d1 = {}.0 }}\ntangent = {{ d2 = "
        "1.0 "
        "}}\n{}\n",
        side < 0 ? "left" : "right", side, feet);
  return text + rest;
}

void check_sound(const Result& result, double length = 0.0) {
  INFO(result.report.outcome.reason);
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
  const Audit& a = result.report.audit;
  CHECK(a.penetration.value <= 1e-12 * std::max(length, a.length_scale));
  CHECK(a.tension.value <= 1e-9 * a.force_scale);
  CHECK(a.friction.value <= 1e-9 * a.force_scale);
  CHECK(a.energy.value <= 1e-7 * a.energy_scale);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/rigid");

TEST_CASE("a block slides over a rigid floor and stops where friction says") {
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_text(
        block("t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [1.0, 0.0] }", "friction = 0.3"), engine);
    check_sound(r);
    REQUIRE(r.events.size() == 1);
    CHECK(r.events[0].type == EventType::stick);
    CHECK(std::abs(r.events[0].t - 1.0 / 3.0) < 1e-10);
    CHECK(std::abs(r.rows.back().u[0] - 1.0 / 6.0) < 1e-10);
    CHECK(r.rows.back().u[1] == 0.0);  // no drift at all along one degree of freedom
    CHECK(r.rows.back().v[0] == 0.0);
    CHECK(r.report.audit.friction_work[0] == doctest::Approx(0.5).epsilon(1e-9));
  }
}

TEST_CASE("rebounds: hits, impulses, energy and landings of a ball that falls one metre") {
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_text(
        block("t_end = 2.0\ninitial = { u = [0.0, 1.0], v = [0.0, 0.0] }", "restitution = 0.5"), engine);
    check_sound(r);
    const double v = std::sqrt(20.0);  // falls 0.447 s; then flights of 0.894 s times 1/2, 1/4, ...
    const double fall = v / 10.0;
    double t = fall, speed = v;
    REQUIRE(r.events.size() > 20);
    for (std::size_t i = 0; i < 20; ++i) {
      const Event& e = r.events[i];
      CHECK(e.type == EventType::impact);
      CHECK(e.from == State::open);
      CHECK(e.to == State::open);
      CHECK(std::abs(e.t - t) < 1e-8);
      CHECK(*e.impulse_n == doctest::Approx(1.5 * speed).epsilon(1e-6));
      CHECK(e.vn_after == doctest::Approx(-0.5 * e.vn));
      speed /= 2.0;
      t += 2.0 * speed / 10.0;
    }
    CHECK(r.events.back().to == State::closed);
    CHECK(std::abs(r.events.back().t - 3.0 * fall) < 1e-8);  // the accumulation point
    CHECK(r.rows.back().v[1] == 0.0);
    CHECK(r.rows.back().contacts[0].N == doctest::Approx(-10.0));
    CHECK(r.report.audit.final.impact == doctest::Approx(10.0).epsilon(1e-8));  // all of m g h
    const std::vector<Landing>& landings = r.report.landings[0];
    CHECK(landings.size() == r.events.size());
    CHECK(landings[0].start == landings[0].end);
    CHECK(landings[0].impulse == doctest::Approx(1.5 * v).epsilon(1e-8));
    CHECK(landings[0].peak_force == 0.0);  // a hit has an impulse, not a force
    CHECK(landings.back().end == doctest::Approx(2.0));
    CHECK(landings.back().peak_force == doctest::Approx(10.0));
    double all = 0.0;
    for (const Landing& landing : landings) all += landing.impulse;
    CHECK(all == doctest::Approx(20.0).epsilon(1e-8));  // = weight * time: it ends at rest
  }
}

TEST_CASE("a ball without a capture velocity passes its accumulation point all the same") {
  for (const std::string& engine : engines)
    for (const char* e : {"0.5", "0.9"}) {
      CAPTURE(engine);
      CAPTURE(e);
      const Result r = run_text(block("t_end = 12.0\ninitial = { u = [0.0, 1.0], v = [0.0, 0.0] }",
                                      fmt::format("restitution = {}\ncapture_velocity = 0.0", e)),
                                engine);
      check_sound(r);
      CHECK(r.events.back().to == State::closed);
      CHECK(r.rows.back().u[1] == 0.0);
    }
}

TEST_CASE("starts: touching and approaching, at the friction limit, with a load that jumps") {
  const std::string at_rest = "t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }";
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    SUBCASE("approaching: a hit at t = 0") {
      const Result r = run_text(block("t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [1.0, -2.0] }",
                                      "friction = 0.3\nrestitution = 0.5"),
                                engine);
      check_sound(r);
      REQUIRE(!r.events.empty());
      CHECK(r.events[0].t == 0.0);
      CHECK(r.events[0].type == EventType::impact);
      CHECK(*r.events[0].impulse_n == doctest::Approx(3.0));
      CHECK(*r.events[0].impulse_t == doctest::Approx(-0.9));
      CHECK(r.events[0].vt_after == doctest::Approx(0.1));
    }
    SUBCASE("exactly at the limit it sticks, above it slips at once") {
      const Result at = run_text(block(at_rest, "friction = 0.3", push + "amplitude = 3.0\n"), engine);
      check_sound(at);
      CHECK(at.events.empty());
      CHECK(at.rows[0].contacts[0].state == State::stick);
      CHECK(at.rows.back().u[0] == 0.0);
      const Result above = run_text(block(at_rest, "friction = 0.3", push + "amplitude = 4.0\n"), engine);
      check_sound(above);
      CHECK(above.rows[0].contacts[0].state == State::slip_plus);
      CHECK(above.rows.back().u[0] == doctest::Approx(0.5).epsilon(1e-9));
    }
    SUBCASE("at the limit under a load that grows it slips, under one that falls it sticks") {
      for (const double rate : {1.0, -1.0}) {
        const Result r = run_text(block(at_rest, "friction = 0.3",
                                        push + fmt::format("amplitude = 1.0\nhistory = {{ type = "
                                                           "\"polynomial\", coefficients = [3.0, {}] }}\n",
                                                           rate)),
                                  engine);
        check_sound(r);
        CHECK(r.rows[0].contacts[0].state == (rate > 0.0 ? State::slip_plus : State::stick));
        CHECK(r.rows.back().u[0] == doctest::Approx(rate > 0.0 ? 1.0 / 6.0 : 0.0).epsilon(1e-8));
      }
    }
    SUBCASE("no load at all: it stays where it is") {
      const Result r = run_text(block(at_rest, "friction = 0.3",
                                      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = "
                                      "10.0\n"),
                                engine);
      check_sound(r);
      CHECK(r.rows.back().u[1] == 0.0);
      CHECK(r.rows.back().contacts[0].N == 0.0);
    }
    SUBCASE("the load jumps at t = 0, and again: the states are decided anew") {
      const Result r = run_text(
          block(at_rest, "friction = { static = 0.4, kinetic = 0.3 }",
                push + "amplitude = 5.0\nhistory = { type = \"rectangle\", start = 0.0, end = 0.5 }\n"),
          engine);
      check_sound(r);
      CHECK(r.rows[0].contacts[0].state == State::slip_plus);
      // 2 m/s2 for 0.5 s, then -3 m/s2
      REQUIRE(r.events.size() >= 2);
      CHECK(r.events.back().type == EventType::stick);
      CHECK(std::abs(r.events.back().t - (0.5 + 1.0 / 3.0)) < 1e-9);
    }
  }
}

TEST_CASE("a bar that falls flat hits with both feet at one instant") {
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    for (const double e : {0.0, 0.5}) {
      const Result r = run_text(bar("t_end = 3.0\ninitial = { u = [1.0, 0.0, 0.0], v = [0.0, 0.0, 0.0] }",
                                    fmt::format("restitution = {}", e)),
                                engine);
      check_sound(r);
      REQUIRE(r.events.size() >= 2);
      CHECK(r.events[0].t == r.events[1].t);
      CHECK(r.events[0].contact != r.events[1].contact);
      for (std::size_t i = 0; i < 2; ++i) {
        CHECK(r.events[i].type == EventType::impact);
        CHECK(*r.events[i].impulse_n == doctest::Approx((1.0 + e) * std::sqrt(20.0)));
      }
      CHECK(std::abs(r.rows.back().u[1]) < 1e-12);  // it does not turn
      CHECK(r.rows.back().contacts[0].N == doctest::Approx(-10.0));
      CHECK(r.rows.back().contacts[1].N == doctest::Approx(-10.0));
    }
  }
}

TEST_CASE("a bar that lands on one foot first: the second foot lands while the first one is loaded") {
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_text(
        bar("t_end = 2.0\ninitial = { u = [1.1, 0.1, 0.0], v = [0.0, 0.0, 0.0] }", "restitution = 0.0"),
        engine);
    check_sound(r);
    REQUIRE(r.events.size() >= 2);
    // the left foot falls 1 m: t = sqrt(0.2), v = sqrt(20); both axes have unit inverse mass 1/2: W = 1
    CHECK(std::abs(r.events[0].t - std::sqrt(0.2)) < 1e-9);
    CHECK(*r.events[0].impulse_n == doctest::Approx(std::sqrt(20.0)));
    CHECK(r.rows.back().contacts[0].state == State::closed);
    CHECK(r.rows.back().contacts[1].state == State::closed);
  }
}

TEST_CASE("two feet that both stick rigidly on one motion share its force in halves, and the run says so") {
  for (const std::string& engine : locating_engines) {
    CAPTURE(engine);
    const Result r = run_text(bar("t_end = 1.0\ninitial = { u = [0.0, 0.0, 0.0], v = [0.0, 0.0, 0.0] }",
                                  "friction = 0.3", "[[loads]]\ndirection = { d2 = 1.0 }\namplitude = 3.0\n"),
                              engine);
    CHECK(r.report.outcome.reason == "");
    CHECK(r.report.law_checks.violations.empty());
    CHECK(r.events.empty());
    for (const ContactSample& c : r.rows.back().contacts) {
      CHECK(c.state == State::stick);
      CHECK(c.T == doctest::Approx(1.5).epsilon(1e-12));
    }
    REQUIRE(!r.report.warnings.empty());
    CHECK(r.report.warnings[0].find("contacts 'left' and 'right' prevent the same motion") !=
          std::string::npos);
  }
}

TEST_CASE("Painleve's rod: the run stops where no motion, or more than one, goes on") {
  // A rod of length 2, mass 1, inertia 1/3, tip coordinates along and across at 45 degrees: M^-1 of the tip
  // has a strong coupling, here made so that sliding along + with f = 2 digs in.
  const auto rod = [](double load) {
    return matrix_scene(
        "t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [1.0, 0.0] }",
        "mass = [[0.34847735667203295, 0.2532986927066816], [0.2532986927066816, 0.9015226433279672]]\n"
        "stiffness = [[0.0, 0.0], [0.0, 0.0]]",
        "law = \"rigid\"\nnormal = { d1 = -1.0 }\ntangent = { d0 = 1.0 }\nfriction = 4.0",
        fmt::format(
            "[[loads]]\ndirection = {{ d0 = 0.2532986927066816, d1 = 0.9015226433279672 }}\namplitude "
            "= {}\n",
            load));
  };
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result none = run_text(rod(10.0), engine);
    CHECK(none.report.outcome.kind == Outcome::Kind::stopped);
    CHECK(none.report.outcome.t == 0.0);
    CHECK(none.report.outcome.reason.find("no motion continues") != std::string::npos);
    CHECK(none.report.outcome.reason.find("'c'") != std::string::npos);
    const Result several = run_text(rod(-10.0), engine);
    CHECK(several.report.outcome.kind == Outcome::Kind::stopped);
    CHECK(several.report.outcome.reason.find("several motions continue") != std::string::npos);
  }
}

TEST_CASE("node against node: two masses collide and swap their velocities") {
  const std::string text =
      units +
      "[run]\nt_end = 2.0\ninitial = { a = { vx = 1.0 } }\n[nodes]\na = [0.0, 0.0]\nb = [1.0, 0.0]\n"
      "[[masses]]\nnode = \"a\"\nmass = 1.0\n[[masses]]\nnode = \"b\"\nmass = 1.0\n"
      "[[supports]]\nnode = \"a\"\nfix = [\"uy\"]\n[[supports]]\nnode = \"b\"\nfix = [\"uy\"]\n"
      "[[contacts]]\nname = \"c\"\nnode = \"b\"\nagainst = \"a\"\nlaw = \"rigid\"\nnormal = [1.0, 0.0]\ngap "
      "= "
      "1.0\nrestitution = 1.0\n";
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_text(text, engine);
    check_sound(r);
    REQUIRE(r.events.size() == 1);
    CHECK(std::abs(r.events[0].t - 1.0) < 1e-10);
    CHECK(std::abs(r.rows.back().v[0]) < 1e-12);
    CHECK(r.rows.back().v[1] == doctest::Approx(1.0));
  }
}

TEST_CASE("node against segment: a mass lands on a plank, a quarter of the way from its left end") {
  // Left and right end carry 2 kg each; the point x = 1/4 between them has the inverse mass (9 + 1)/32.
  const std::string text =
      units +
      "[run]\nt_end = 1.0\ninitial = { m = { vy = -1.0 } }\n[nodes]\nm = [1.0, 0.5]\nl = [0.0, 0.0]\nr = "
      "[4.0, "
      "0.0]\n"
      "[[masses]]\nnode = \"m\"\nmass = 1.0\n[[masses]]\nnode = \"l\"\nmass = 2.0\n[[masses]]\nnode = "
      "\"r\"\nmass = 2.0\n"
      "[[contacts]]\nname = \"c\"\nnode = \"m\"\nagainst = [\"l\", \"r\"]\nlaw = \"rigid\"\nnormal = [0.0, "
      "1.0]\ngap = 0.5\nrestitution = 0.0\n";
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_text(text, engine);
    check_sound(r);
    REQUIRE(r.events.size() == 1);
    CHECK(std::abs(r.events[0].t - 0.5) < 1e-10);
    const double impulse = 1.0 / (1.0 + 10.0 / 32.0);
    CHECK(*r.events[0].impulse_n == doctest::Approx(impulse));
    const Vector& v = r.rows.back().v;  // m.vx, m.vy, l.vx, l.vy, r.vx, r.vy
    CHECK(v[1] == doctest::Approx(-1.0 + impulse));
    CHECK(v[3] == doctest::Approx(-0.75 * impulse / 2.0));
    CHECK(v[5] == doctest::Approx(-0.25 * impulse / 2.0));
  }
}

TEST_CASE("friction between two moving bodies: a block rides on a cart") {
  // mu g = 2 m/s2 against a push of 12 N on 1 + 2 kg: the block slips back.
  const std::string text =
      units +
      "gravity = [0.0, -10.0]\n[run]\nt_end = 1.0\n[nodes]\nblock = [0.0, 1.0]\ncart = [0.0, 0.0]\n"
      "[[masses]]\nnode = \"block\"\nmass = 1.0\n[[masses]]\nnode = \"cart\"\nmass = 2.0\n"
      "[[supports]]\nnode = \"cart\"\nfix = [\"uy\"]\n"
      "[[contacts]]\nname = \"c\"\nnode = \"block\"\nagainst = \"cart\"\nlaw = \"rigid\"\nnormal = [0.0, "
      "1.0]\nfriction = 0.2\n"
      "[[loads]]\nnode = \"cart\"\ndirection = [1.0, 0.0]\namplitude = 12.0\n";
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_text(text, engine);
    check_sound(r);
    CHECK(r.rows.back().contacts[0].state == State::slip_minus);
    CHECK(r.rows.back().u[0] == doctest::Approx(1.0));  // block: 2 m/s2
    CHECK(r.rows.back().u[2] == doctest::Approx(2.5));  // cart: (12 - 2)/2
  }
}

TEST_CASE("base motion: an oscillator's relative answer, and a block that slips when the ground shakes") {
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r =
        run_text(units +
                     "[run]\nt_end = 3.0\n[matrices]\nmass = [[2.0]]\nstiffness = [[8.0]]\n"
                     "[base_motion]\ndirection = { d0 = 1.0 }\nacceleration = { type = \"harmonic\", "
                     "amplitude = 3.0, omega = 1.0 }\n",
                 engine);
    // x'' + 4 x = -3 sin t:  x = -sin t + sin(2 t)/2
    CHECK(r.rows.back().u[0] == doctest::Approx(-std::sin(3.0) + 0.5 * std::sin(6.0)).epsilon(1e-8));
    const Result s = run_text(units +
                                  "gravity = [0.0, -10.0]\n[run]\nt_end = 1.0\n[nodes]\nb = [0.0, "
                                  "0.0]\n[[masses]]\nnode = \"b\"\nmass = "
                                  "4.0\n[base_motion]\ndirection = [2.0, 0.0]\nacceleration = 5.0\n"
                                  "[[contacts]]\nname = \"c\"\nnode = \"b\"\nlaw = \"rigid\"\nnormal = [0.0, "
                                  "1.0]\nfriction = 0.3\n",
                              engine);
    check_sound(s);
    CHECK(s.rows.back().u[0] == doctest::Approx(-1.0).epsilon(1e-9));  // -(5 - 3)/2
  }
}

TEST_CASE("a mass between two rigid walls is not redundant, and keeps its energy when they are elastic") {
  const std::string text =
      matrix_scene("t_end = 9.5\ninitial = { u = [0.0], v = [1.0] }", "mass = [[1.0]]\nstiffness = [[0.0]]",
                   "law = \"rigid\"\nnormal = { d0 = 1.0 }\ngap = 1.0\nrestitution = 1.0\n[[contacts]]\nname "
                   "= \"d\"\nlaw = "
                   "\"rigid\"\nnormal = { d0 = -1.0 }\ngap = 1.0\nrestitution = 1.0");
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_text(text, engine);
    check_sound(r);
    CHECK(r.events.size() == 5);  // at 1, 3, 5, 7, 9
    CHECK(std::abs(r.events.back().t - 9.0) < 1e-8);
    CHECK(std::abs(r.rows.back().v[0]) == doctest::Approx(1.0));
  }
}

TEST_CASE("a Z-shaped frame is thrown up, lands and chatters to rest") {
  // Times from an independent program with matrix exponentials: the first two events of A and its first hit,
  // and where A rests.
  Result by_exact;
  for (const std::string engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Scene scene = read_scene(SIGNORINI_MODELS "/rigid-frame.toml", {{"run.engine", engine}});
    const Model model = build_model(scene);
    Result r = simulate(model, scene.run);
    check_sound(r);
    std::vector<double> first;  // of A: slip, lift-off, hit
    for (const Event& e : r.events)
      if (e.contact == 0 && first.size() < 3) first.push_back(e.t);
    REQUIRE(first.size() == 3);
    const double tolerance = engine == "exact" ? 1e-10 : 1e-7;
    CHECK(std::abs(first[0] - 0.00390145740137) < tolerance);
    CHECK(std::abs(first[1] - 0.011638888955) < tolerance);
    CHECK(std::abs(first[2] - 0.209377022949) < tolerance);
    CHECK(r.events.back().t < 0.604);
    for (const ContactSample& c : r.rows.back().contacts) CHECK(c.state == State::stick);
    CHECK(std::abs(r.rows.back().u[0] - 1.695854e-4) < (engine == "exact" ? 1e-9 : 1e-7));
    if (engine == "exact") {
      by_exact = std::move(r);
      continue;
    }
    REQUIRE(r.events.size() == by_exact.events.size());
    for (std::size_t i = 0; i < r.events.size(); ++i) {
      CHECK(r.events[i].contact == by_exact.events[i].contact);
      CHECK(r.events[i].to == by_exact.events[i].to);
      CHECK(std::abs(r.events[i].t - by_exact.events[i].t) < 1e-7);
    }
  }
}

TEST_CASE("a ramp under 30 degrees: no drift into it, exact sliding, over a long run") {
  const double angle = std::numbers::pi / 6.0, s = std::sin(angle), c = std::cos(angle);
  const std::string text = matrix_scene(
      "t_end = 100.0\noutput_dt = 10.0",
      "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
      fmt::format(
          "law = \"rigid\"\nnormal = {{ d0 = {}, d1 = {} }}\ntangent = {{ d0 = {}, d1 = {} }}\nfriction = "
          "0.2",
          s, c, c, -s),
      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -10.0\n");
  for (const std::string& engine : engines) {
    CAPTURE(engine);
    const Result r = run_text(text, engine);
    const double travelled = 0.5 * 10.0 * (s - 0.2 * c) * 1e4;
    check_sound(r, travelled);
    CHECK(r.rows.back().contacts[0].ut == doctest::Approx(travelled).epsilon(1e-9));
  }
}

TEST_CASE("Stribeck's friction: the way of a block that stops, against its closed form") {
  // m v' = -N (fk + d exp(-v/vs)):  t = m vs/(fk N) ln((e^(v0/vs) + d/fk)/(1 + d/fk))
  const double N = 10.0, fk = 0.2, d = 0.2, vs = 0.3, v0 = 1.0;
  const double stop = vs / (fk * N) * std::log((std::exp(v0 / vs) + d / fk) / (1.0 + d / fk));
  for (const char* law :
       {"law = \"slider\"\nnormal_force = 10.0", "law = \"rigid\"\nnormal = { d1 = 1.0 }"}) {
    CAPTURE(law);
    const std::string text = matrix_scene(
        "t_end = 1.0\ninitial = { u = [0.0, 0.0], v = [1.0, 0.0] }",
        "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 1.0]]",
        std::string(law) +
            "\ntangent = { d0 = 1.0 }\nfriction = { static = 0.4, kinetic = 0.2, stribeck_velocity = 0.3 }",
        "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -10.0\n");
    const Result r = run_text(text, "ida");
    CHECK(r.report.outcome.kind == Outcome::Kind::done);
    REQUIRE(r.events.size() == 1);
    CHECK(r.events[0].type == EventType::stick);
    CHECK(std::abs(r.events[0].t - stop) < 3e-9);
    CHECK(r.report.audit.friction.value <= 1e-11 * r.report.audit.force_scale);
    CHECK(r.report.audit.energy.value < 1e-8 * r.report.audit.energy_scale);
    const Scene scene = parse_scene(text, "test.toml", {{"run.engine", "exact"}});
    CHECK_THROWS_WITH_AS((void)simulate(build_model(scene), scene.run),
                         doctest::Contains("depends on its slip rate"), SceneError);
  }
}

TEST_SUITE_END();
