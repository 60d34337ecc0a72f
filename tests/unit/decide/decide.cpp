#include "decide/contact_state_solver.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "contact/contact_states.hpp"
#include "decide/driven_states.hpp"

using namespace signorini;

namespace {

SparseMatrix matrix(const std::vector<std::vector<double>>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  SparseMatrix m(n, n);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j)
      if (rows[i][j] != 0.0)
        m.insert(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
  return m;
}

/// n masses on sliders, force f_i on each.
Model blocks(const std::vector<std::vector<double>>& mass, const std::vector<double>& force, double friction,
             std::optional<double> kt = {}) {
  Model model;
  const std::size_t n = mass.size();
  model.mass = matrix(mass);
  model.damping = matrix(std::vector<std::vector<double>>(n, std::vector<double>(n, 0.0)));
  model.stiffness = model.damping;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string name = "d" + std::to_string(i);
    model.dofs.push_back({name + ".u", name + ".v", false, mass[i][i] == 0.0});
    Contact c;
    c.name = "c" + std::to_string(i);
    c.law = Law::slider;
    c.tangent.terms = {{static_cast<int>(i), 1.0}};
    c.normal_force = History::constant(1.0);
    c.friction.static_ = c.friction.kinetic = friction;
    c.tangential_stiffness = kt;
    model.contacts.push_back(c);
    model.layout = contact::layout_of(model.contacts);
    Load load;
    load.direction.terms = {{static_cast<int>(i), 1.0}};
    load.history = History::constant(force[i]);
    model.loads.push_back(load);
  }
  model.u0 = model.v0 = Vector::Zero(static_cast<Eigen::Index>(n));
  return model;
}

/// Frictionless rigid floors under masses that move each other.
Model on_floors(const std::vector<std::vector<double>>& mass, const std::vector<double>& force) {
  Model model = blocks(mass, force, 0.0);
  for (std::size_t i = 0; i < mass.size(); ++i) {
    Contact c;
    c.name = "c" + std::to_string(i);
    c.law = Law::rigid;
    c.normal.terms = {{static_cast<int>(i), 1.0}};
    c.restitution = 0.5;
    model.contacts[i] = c;
  }
  return model;
}

decide::Decision fallen(const Model& model, decide::Instant instant) {
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const motion::Forcing forcing(model, instant.t, motion::Side::after);
  instant.states.assign(model.contacts.size(), {State::open, 0.0});
  instant.triggered = {{0, Guard::closing}};
  return decide::ContactStateSolver(systems, 100, 1e-9).decide(std::move(instant), forcing, forcing);
}

decide::Decision start(const Model& model) {
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  decide::Instant instant;
  instant.u = model.u0;
  instant.v = model.v0;
  instant.states = decide::initial_states(model, forcing, 0.0, model.u0, model.v0);
  return decide::ContactStateSolver(systems, 100, 1e-9).decide(instant, forcing, forcing);
}

}  // namespace

TEST_SUITE_BEGIN("unit/decide/decide");

TEST_CASE("a block sticks below the limit and slips towards the load above it") {
  CHECK(start(blocks({{2.0}}, {0.3}, 0.4)).states[0].state == State::stick);
  CHECK(start(blocks({{2.0}}, {0.5}, 0.4)).states[0].state == State::slip_plus);
  CHECK(start(blocks({{2.0}}, {-0.5}, 0.4)).states[0].state == State::slip_minus);
  const decide::Decision d = start(blocks({{2.0}}, {0.5}, 0.4));
  CHECK(d.jet.a()[0] == doctest::Approx(0.05));  // (0.5 - 0.4) / 2
}

TEST_CASE("exactly at the limit with a constant load the block stays") {
  CHECK(start(blocks({{2.0}}, {0.4}, 0.4)).states[0].state == State::stick);
}

TEST_CASE("exactly at the limit with a growing load the next derivative decides") {
  Model model = blocks({{2.0}}, {0.0}, 0.4);
  model.loads[0].history = History(Piece{0.0, {0.4, 1.0}, 0.0, 0.0, 0.0});
  CHECK(start(model).states[0].state == State::slip_plus);
  model.loads[0].history = History(Piece{0.0, {0.4, -1.0}, 0.0, 0.0, 0.0});
  CHECK(start(model).states[0].state == State::stick);
  model.loads[0].history = History(Piece{0.0, {0.4, 0.0, 0.0, 1.0}, 0.0, 0.0, 0.0});
  CHECK(start(model).states[0].state == State::slip_plus);
}

TEST_CASE("inertially coupled blocks are decided together") {
  // M = [[2,1],[1,2]]: pulling the first with 3 drags the second backwards, and its friction reacts.
  const decide::Decision d = start(blocks({{2.0, 1.0}, {1.0, 2.0}}, {3.0, 0.0}, 0.4));
  REQUIRE(d.consistent);
  CHECK(d.states[0].state == State::slip_plus);
  CHECK(d.states[1].state == State::slip_minus);
  CHECK(d.after[1].T == doctest::Approx(-0.4));
  // a1 = 2 (T_1 = 0.4) ... stuck second block would need T = -1.3: it must slip, so the guess is right
  CHECK(d.jet.a()[1] < 0.0);
}

TEST_CASE("two sliders without stiffness on one degree of freedom share its force by the least norm") {
  Model model = blocks({{2.0}}, {0.1}, 0.4);
  model.contacts.push_back(model.contacts[0]);
  model.layout = contact::layout_of(model.contacts);
  const decide::Decision d = start(model);
  REQUIRE(d.consistent);
  CHECK(d.after[0].T == doctest::Approx(0.05).epsilon(1e-14));
  CHECK(d.after[1].T == doctest::Approx(0.05).epsilon(1e-14));
  // 0.1 at most at the second, then the first bears the rest, and above 0.5 both slip.
  model.contacts[1].normal_force = History::constant(0.25);
  model.loads[0].history = History::constant(0.3);
  const decide::Decision rest = start(model);
  REQUIRE(rest.consistent);
  CHECK(rest.states[0].state == State::stick);
  CHECK(rest.after[0].T == doctest::Approx(0.2).epsilon(1e-14));
  CHECK(rest.after[1].T == doctest::Approx(0.1).epsilon(1e-14));
  model.loads[0].history = History::constant(-0.6);
  const decide::Decision slips = start(model);
  REQUIRE(slips.consistent);
  CHECK(slips.states[0].state == State::slip_minus);
  CHECK(slips.states[1].state == State::slip_minus);
  CHECK(slips.jet.a()[0] == doctest::Approx(-0.05).epsilon(1e-13));
}

TEST_CASE("level 0 of the jet satisfies the equation of motion, level 1 its derivative") {
  Model model = blocks({{2.0, 1.0}, {1.0, 2.0}}, {0.0, 0.0}, 0.4, 50.0);
  model.stiffness = matrix({{3.0, -1.0}, {-1.0, 4.0}});
  model.damping = matrix({{0.2, 0.0}, {0.0, 0.1}});
  model.u0 << 0.001, -0.002;
  model.v0 << 0.3, 0.1;
  const decide::Decision d = start(model);
  REQUIRE(d.consistent);
  for (Eigen::Index k = 0; k < 3; ++k) {
    Vector r = model.mass * d.jet.u.col(k + 2) + model.damping * d.jet.u.col(k + 1) +
               model.stiffness * d.jet.u.col(k);
    for (std::size_t c = 0; c < 2; ++c)
      model.contacts[c].tangent.add_to(r, d.jet.forces(static_cast<Eigen::Index>(2 * c) + 1, k));
    CHECK(r.norm() < 1e-12 * (1.0 + d.jet.forces.col(k).norm()));
  }
}

TEST_CASE("a trace hears of every mode that is tried, and the last one holds") {
  const Model model = blocks({{2.0}}, {0.5}, 0.4);
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  decide::ContactStateSolver decider(systems, 100, 1e-9);
  std::vector<DecisionRound> rounds;
  decider.trace([&](const DecisionRound& round) { rounds.push_back(round); });
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  decide::Instant instant;
  instant.t = 0.25;
  instant.u = model.u0;
  instant.v = model.v0;
  instant.states = decide::initial_states(model, forcing, 0.0, model.u0, model.v0);
  REQUIRE(decider.decide(instant, forcing, forcing).consistent);
  REQUIRE(rounds.size() == 2);
  CHECK(rounds[0].t == 0.25);
  CHECK(rounds[0].number == 0);
  CHECK(rounds[0].states[0].state == State::stick);
  REQUIRE(rounds[0].failed.size() == 1);
  CHECK(rounds[0].failed[0].guard == "friction limit (+)");
  CHECK(rounds[0].failed[0].order == 0);
  CHECK(rounds[0].failed[0].excess > 1.0);
  CHECK(rounds[1].number == 1);
  CHECK(rounds[1].states[0].state == State::slip_plus);
  CHECK(rounds[1].failed.empty());
}

TEST_CASE("a refusal says what kind it is") {
  Model model = blocks({{2.0, 0.0}, {0.0, 0.0}}, {0.1, 0.1}, 0.4);  // two on a point without mass
  model.stiffness = matrix({{3.0, -1.0}, {-1.0, 4.0}});
  model.contacts.push_back(model.contacts[1]);
  model.layout = contact::layout_of(model.contacts);
  CHECK(start(model).refusal.kind == Refusal::Kind::dependent);
  CHECK(start(blocks({{2.0}}, {0.5}, 0.4)).refusal.kind == Refusal::Kind::none);
}

TEST_CASE("what a decision took for rest at the limit of friction is rounding to an engine") {
  // Two blocks, tied by their mass, pushed at their limits but for k roundings: where they are taken to rest,
  // no guard may seem to have fallen already.
  int resting = 0;
  for (int k = -400; k <= 400; ++k) {
    CAPTURE(k);
    const double push = 0.4 * (1.0 + k * 0x1p-52);
    const decide::Decision d = start(blocks({{2.0, 0.9}, {0.9, 1.0}}, {push, push}, 0.4));
    REQUIRE(d.consistent);
    for (std::size_t slot = 0; slot < d.guards.size(); ++slot) {
      const decide::GuardStart& guard = d.guards[slot];
      if (guard.kind != Guard::slip_plus || !guard.at_zero || guard.leading_order >= 0) continue;
      ++resting;
      CHECK(d.form(slot).value(d.after[d.layout.contact_of_guard(slot)]) >= -guard.noise);
    }
  }
  CHECK(resting > 100);
}

TEST_CASE("a limit that has rested: what the way has left of it is rounding to an engine") {
  const Model model = blocks({{2.0}}, {0.4 * (1.0 + 1e-9)}, 0.4);
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const motion::Forcing forcing(model, 1.0, motion::Side::after);
  const auto decided = [&](std::vector<decide::TriggeredGuard> rested) {
    decide::Instant instant;
    instant.t = 1.0;
    instant.resolution = 1e-14;
    instant.u = instant.v = Vector::Zero(1);
    instant.states = {{State::stick, 0.0}};
    instant.jump = true;
    instant.resting_limits = std::move(rested);
    return decide::ContactStateSolver(systems, 100, 1e-9).decide(std::move(instant), forcing, forcing);
  };
  CHECK(decided({}).states[0].state == State::slip_plus);
  const decide::Decision d = decided({{0, Guard::slip_plus}});
  REQUIRE(d.consistent);
  CHECK(d.states[0].state == State::stick);
  const auto limit = std::find_if(d.guards.begin(), d.guards.end(), [](const decide::GuardStart& guard) {
    return guard.kind == Guard::slip_plus;
  });
  REQUIRE(limit != d.guards.end());
  CHECK(limit->at_zero);
  CHECK(limit->leading_order < 0);
  const double below = d.form(static_cast<std::size_t>(limit - d.guards.begin())).value(d.after[0]);
  CHECK(below < -3e-10);
  CHECK(limit->noise >= -below);
}

TEST_CASE("what an engine saw fall does not rise, whatever rounding has left of its rate") {
  Model model = on_floors({{1.0}}, {0.0});
  model.loads[0].history = History(Piece{0.0, {0.0, -1.0}, 0.0, 0.0, 0.0});  // g'' = 0, g''' < 0
  decide::Instant instant;
  instant.u = Vector::Zero(1);
  instant.v = Vector::Constant(1, 1e-20);
  const decide::Decision d = fallen(model, instant);
  REQUIRE(d.consistent);
  CHECK(d.states[0].state == State::closed);
  CHECK(d.v[0] == 0.0);
}

TEST_CASE("contacts that land within what rounding has carried into their gaps hit together") {
  const Model model = on_floors({{2.0, 1.0}, {1.0, 2.0}}, {-1.0, -1.0});
  decide::Instant instant;
  instant.t = 1.0;
  instant.resolution = 1e-14;
  instant.u = Vector::Zero(2);
  instant.u[1] = 1e-13;  // a hundred times what its own digits and the clock's say
  instant.v = Vector::Constant(2, -1.0);
  const auto hits = [](const decide::Decision& d, std::size_t c) {
    return !d.impulses.empty() && d.impulses[c].hit;
  };
  instant.last_touch = {0.0, 1.0 - 1e-12};
  const decide::Decision apart = fallen(model, instant);  // it has not flown for long enough
  CHECK(hits(apart, 0));
  CHECK_FALSE(hits(apart, 1));
  instant.t = 100.0;
  instant.last_touch = {0.0, 0.0};
  const decide::Decision together = fallen(model, instant);
  CHECK(hits(together, 0));
  CHECK(hits(together, 1));
  CHECK(together.v[0] == together.v[1]);
  CHECK(together.crossing(1) != nullptr);
}

TEST_CASE(
    "how clearly a mass leaves its floor: its speed over the captured one and over rounding, in any scale") {
  const auto left = [](double factor, double speed, double captured) {
    Model model = on_floors({{2.0}}, {-3.0});
    model.contacts[0].normal.terms[0].second = factor;
    model.contacts[0].capture_velocity = captured * factor;
    const linear::SystemMatrices structure(model);
    motion::StateSystems systems(model, structure);
    const motion::Forcing forcing(model, 0.0, motion::Side::after);
    decide::Instant instant;
    instant.start = instant.resolves_low_flights = true;
    instant.u = Vector::Zero(1);
    instant.v = Vector::Constant(1, speed);
    instant.states = {{State::open, 0.0}};
    return decide::ContactStateSolver(systems, 100, 1e-9).decide(std::move(instant), forcing, forcing);
  };
  for (const double factor : {0x1p-30, 1.0, 0x1p20}) {
    CAPTURE(factor);
    const decide::Decision fast = left(factor, 0.3, 0.2), slow = left(factor, 0.1, 0.2),
                           free = left(factor, 0.3, 0.0);
    REQUIRE(fast.departures.size() == 1);
    CHECK(fast.states[0].is_open());
    CHECK(fast.departures[0] == doctest::Approx(1.5).epsilon(1e-12));
    CHECK_FALSE(slow.states[0].is_open());
    CHECK(slow.departures[0] == doctest::Approx(0.5).epsilon(1e-12));
    // Without a captured speed rounding alone decides: a speed is 1e15 of its own rounding, or so.
    CHECK(free.states[0].is_open());
    CHECK(free.departures[0] > 1e12);
    CHECK(free.departures[0] < 1e17);
    CHECK(free.departures[0] == doctest::Approx(left(1.0, 0.3, 0.0).departures[0]).epsilon(1e-9));
  }
}

TEST_CASE("a fast landing after a long time on a stiff structure is a hit") {
  Model model = on_floors({{1.0}}, {-1.0});
  model.omega_max = 1e9;
  decide::Instant instant;
  instant.t = 1e6;  // rounding may have carried anything: t da alone is 1e-8
  instant.resolution = 1e-8;
  instant.u = Vector::Zero(1);
  instant.v = Vector::Constant(1, -1.0);
  instant.last_touch = {0.0};
  const decide::Decision d = fallen(model, instant);
  REQUIRE(d.consistent);
  REQUIRE(!d.impulses.empty());
  CHECK(d.impulses[0].hit);
  CHECK(d.impulses[0].normal == doctest::Approx(1.5));  // (1 + e) m v
}

TEST_SUITE_END();
