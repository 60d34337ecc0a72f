// Loads, initial states, dashpots and compressions of a node scene as the model holds them.
#include <doctest/doctest.h>

#include <cmath>

#include "base/history/pieces.hpp"
#include "scene/history_from_spec.hpp"
#include "signorini/simulate.hpp"
#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

Scene good(const char* name) { return read_scene(std::string(SIGNORINI_TEST_DATA "/scenes/good/") + name); }

HistorySpec polynomial(std::vector<double> coefficients) {
  HistorySpec s;
  s.type = HistoryType::polynomial;
  s.coefficients = std::move(coefficients);
  return s;
}

double negative(const HistorySpec& spec, double t_end) {
  return history::find_negative_time(scene::make_history(spec, "h"), t_end);
}

}  // namespace

TEST_SUITE("unit/model/inputs") {
  TEST_CASE("initial states reach every component, rotations and velocities among them") {
    const Model model = build_model(good("rest.toml"));
    const auto b = [&](const char* name) { return dof(model, std::string("B.") + name); };
    CHECK(model.u0[b("ux")] == 0.01);
    CHECK(model.u0[b("uy")] == -0.02);
    CHECK(model.u0[b("rz")] == 0.001);
    CHECK(model.v0[b("ux")] == 0.1);
    CHECK(model.v0[b("uy")] == 0.2);
    CHECK(model.v0[b("rz")] == -0.3);
    CHECK(model.v0[dof(model, "C.uy")] == 0.5);
    CHECK(model.u0[dof(model, "A.ux")] == 0.0);
    CHECK(model.u0.cwiseAbs().sum() == doctest::Approx(0.031));
    CHECK(model.v0.cwiseAbs().sum() == doctest::Approx(1.1));
  }

  TEST_CASE("seams, touched segments and the motion of the base") {
    const Model model = build_model(good("touching.toml"));
    REQUIRE(model.contacts.size() == 3);
    const Contact &plank = model.contacts[0], &bedding = model.contacts[2];
    CHECK(bedding.normal_stiffness == doctest::Approx(2.0e5 * 0.3 / 0.05));
    CHECK(*bedding.tangential_stiffness == doctest::Approx(8.0e4 * 0.3 / 0.05));
    CHECK(plank.restitution == 0.5);
    CHECK(*plank.capture_velocity == 1e-6);
    CHECK(*plank.friction.stribeck_velocity == 0.1);
    // a at x = 0 between l at -1 and r at 3: weights 3/4 and 1/4
    Vector u = Vector::Zero(model.size());
    u[dof(model, "a.uy")] = 1.0;
    CHECK(plank.normal.dot(u) == 1.0);
    u.setZero();
    u[dof(model, "l.uy")] = 1.0;
    CHECK(plank.normal.dot(u) == doctest::Approx(-0.75));
    u.setZero();
    u[dof(model, "r.ux")] = 1.0;
    CHECK(plank.tangent.dot(u) == doctest::Approx(-0.25));
    const Load& base = model.loads.back();
    CHECK(base.name == "base motion");
    Vector p = Vector::Zero(model.size());
    base.direction.add_to(p, base.history.value(0.1));
    CHECK(p[dof(model, "l.ux")] == doctest::Approx(-2.0 * 0.6 * 2.0 * std::sin(0.5)));
    CHECK(p[dof(model, "b.uy")] == doctest::Approx(-1.0 * 0.8 * 2.0 * std::sin(0.5)));
  }

  TEST_CASE("dashpots and positions of contacts") {
    const Model model = build_model(good("rest.toml"));
    CHECK(model.contacts[0].normal_damping == 12.5);
    CHECK(model.contacts[1].normal_damping == 0.0);
    REQUIRE(model.drawn_contacts.size() == 2);
    const DrawnContact& right = model.drawn_contacts[1];
    CHECK(model.drawn_nodes[static_cast<std::size_t>(right.node)].name == "B");
    CHECK(right.x == 4.0);
    CHECK(right.ny == 1.0);
    CHECK(right.tx == 1.0);
    // A slider that only has a tangent: its normal is a quarter turn to the left.
    Scene s = pipeline();
    s.contacts.push_back(slider("side", Direction{"D", {0.0, 2.0}, {}, {}}, 1.0, 0.3));
    const DrawnContact side = build_model(s).drawn_contacts[2];
    CHECK(side.nx == -1.0);
    CHECK(side.ny == 0.0);
    CHECK(side.tx == 0.0);
    CHECK(side.ty == 1.0);
  }

  TEST_CASE("a table from a file: values, jump, zero outside, and Steffen through the same points") {
    const Scene scene = good("rest.toml");
    const History line = scene::make_history(scene.loads[0].history, "h");
    const History smooth = scene::make_history(scene.loads[1].history, "h");
    for (const History& f : {line, smooth}) {
      CHECK(f.value(0.0) == 0.0);
      CHECK(f.piece_before(0.25).value(0.25) == doctest::Approx(1.5));
      CHECK(f.value(0.25) == 0.5);
      CHECK(f.value(0.75) == doctest::Approx(0.1));
      CHECK(f.value(1.0) == 0.0);
      CHECK(f.value(-0.1) == 0.0);
    }
    CHECK(line.value(0.5) == doctest::Approx(0.3));
    CHECK(smooth.value(0.5) != doctest::Approx(0.3));
    CHECK(smooth.value(0.5) < 0.5);
    CHECK(smooth.value(0.5) > 0.1);
  }

  TEST_CASE("loads on one node add up") {
    const char* head =
        "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
        "[run]\nt_end = 1.0\noutput_dt = 0.25\n[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = "
        "2.0\n";
    const auto load = [](const char* direction, const char* amplitude, const char* more) {
      return std::string("[[loads]]\nnode = \"A\"\ndirection = ") + direction + "\namplitude = " + amplitude +
             "\n" + more;
    };
    const std::string text = head + load("[1.0, 0.0]", "3.0", "") + load("[1.0, 0.0]", "-1.0", "") +
                             load("[3.0, 4.0]", "5.0", "history = { type = \"step\", start = 0.5 }\n");
    const Scene scene = parse_scene(text, "test.toml");
    const Model model = build_model(scene);
    REQUIRE(model.loads.size() == 3);
    const Result result = simulate(model, scene.run);
    REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
    // a = 1 m/s^2, and from 0.5 s on (1.5, 2) more.
    CHECK(result.rows.back().u[0] == doctest::Approx(0.5 + 0.5 * 1.5 * 0.25).epsilon(1e-7));
    CHECK(result.rows.back().u[1] == doctest::Approx(0.5 * 2.0 * 0.25).epsilon(1e-7));
  }

  TEST_CASE("a compression that is negative between its nodes is found, one that touches zero is not") {
    // (t - 0.3)^2 and the same a hair lower.
    CHECK(negative(polynomial({0.09, -0.6, 1.0}), 1.0) < 0.0);
    CHECK(negative(polynomial({0.09 - 1e-12, -0.6, 1.0}), 1.0) == doctest::Approx(0.3).epsilon(1e-5));
    CHECK(negative(polynomial({0.09 - 1e-12, -0.6, 1.0}), 0.29) < 0.0);
    // (t - 0.3)^4 and a sextic with two dips, the second one below zero by 1e-9.
    CHECK(negative(polynomial({0.0081, -0.108, 0.54, -1.2, 1.0}), 1.0) < 0.0);
    CHECK(negative(polynomial({0.0081 - 1e-14, -0.108, 0.54, -1.2, 1.0}), 1.0) ==
          doctest::Approx(0.3).epsilon(2e-2));
    CHECK(negative(polynomial({1.0, -1.0}), 1.0) < 0.0);
    CHECK(negative(polynomial({1.0, -1.0}), 1.1) == doctest::Approx(1.1));
    HistorySpec wave;
    wave.type = HistoryType::harmonic;
    wave.omega = 1000.0;
    wave.offset = 1.0;
    for (const double phase : {0.0, 1.0, 4.0}) {
      wave.phase = phase;
      wave.amplitude = 1.0;
      CHECK(negative(wave, 1e3) < 0.0);
      wave.amplitude = 1.0 + 1e-9;
      const double t = negative(wave, 1e3);
      REQUIRE(t >= 0.0);
      CHECK(std::sin(1000.0 * t + phase) == doctest::Approx(-1.0));
      CHECK(t < 2.0 * 3.1416 / 1000.0);
    }
    HistorySpec table;
    table.type = HistoryType::table;
    table.times = {0.0, 1.0, 2.0, 3.0};
    table.values = {1.0, 0.0, 0.0, 2.0};
    for (const bool steffen : {false, true}) {
      table.steffen = steffen;
      CHECK(negative(table, 10.0) < 0.0);
    }
    table.values[2] = -1e-9;
    for (const bool steffen : {false, true}) {
      table.steffen = steffen;
      CHECK(negative(table, 10.0) > 1.0);
      CHECK(negative(table, 1.0) < 0.0);
    }
  }

  TEST_CASE("a compression that pulls is refused with the time, after the run it does not matter") {
    Scene s = empty_scene();
    s.nodes = {{"A", 0.0, 0.0, {}}};
    PointMass m;
    m.node = "A";
    m.mass = 1.0;
    s.masses = {m};
    s.contacts = {slider("pad", Direction{"A", {1.0, 0.0}, {}, {}}, 1.0, 0.3)};
    s.contacts[0].normal_force = polynomial({1.0, -4.0, 3.99});
    CHECK(contains(refusal(s), "contacts.pad.normal_force"));
    CHECK(contains(refusal(s), "at time 0.5"));
    s.run.t_end = 0.4;
    CHECK(refusal(s).empty());
  }
}
