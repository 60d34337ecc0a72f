// law_check/massless_laws.cpp: parts without mass in balance, and with their rates. Numbers by hand.
#include <doctest/doctest.h>

#include <cmath>

#include "base/rounding.hpp"
#include "contact/contact_states.hpp"
#include "law_check/law_checker.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/law_check/massless");

namespace {

constexpr double spring = 50.0, normal_stiffness = 150.0, friction = 0.5;

/// A mass of 3, a spring of 50, and at its end a point without mass on a spring of 150 that pushes and rubs:
/// P - 50 (w - u) - N = 0 along n,  - 20 x - T = 0 along t.
struct Chain {
  Model model;
  Vector u = Vector::Zero(3), v = u, a = u, forces = Vector::Zero(2);
  std::vector<ContactState> mode = {{State::slip_plus, 0.0}};
  double load = 7.0, rate = 11.0, bend = 13.0;

  Chain() {
    model.dofs.resize(3);
    model.dofs[1].massless = model.dofs[2].massless = true;
    model.mass.resize(3, 3);
    model.mass.insert(0, 0) = 3.0;
    model.damping.resize(3, 3);
    model.stiffness.resize(3, 3);
    for (const auto& [i, j, k] :
         {std::tuple(0, 0, spring), std::tuple(1, 1, spring), std::tuple(0, 1, -spring),
          std::tuple(1, 0, -spring), std::tuple(2, 2, 20.0)})
      model.stiffness.insert(i, j) = k;
    Contact c;
    c.name = "foot";
    c.normal.terms = {{1, 1.0}};
    c.tangent.terms = {{2, 1.0}};
    c.normal_stiffness = normal_stiffness;
    c.tangential_stiffness = 90.0;
    c.friction.static_ = c.friction.kinetic = friction;
    model.contacts.push_back(c);
    model.layout = contact::layout_of(model.contacts);
    follow(u, -0.9, load);
    follow(v, 0.4, rate);
    follow(a, -1.3, bend);
    forces = Eigen::Vector2d(normal_stiffness * u[1], -friction * normal_stiffness * u[1]);
  }
  /// P = 50 (w - u) + 150 w, and x by friction.
  static void follow(Vector& x, double of_mass, double P) {
    x[0] = of_mass;
    x[1] = (P + spring * of_mass) / (spring + normal_stiffness);
    x[2] = friction * normal_stiffness * x[1] / 20.0;
  }
  [[nodiscard]] std::vector<Violation> between() const {
    law_check::CheckedSide side = sides();
    return law_check::LawChecker(model, {}).check_point(1.0, side);
  }
  [[nodiscard]] law_check::CheckedSide sides() const {
    law_check::CheckedSide side{&u, &v, &a, &mode, &forces, model.layout, {law_check::Driven{}}};
    for (const double P : {load, rate, bend}) side.loads.emplace_back(Eigen::Vector3d(0.0, P, 0.0));
    return side;
  }
  [[nodiscard]] std::vector<Violation> instant() const {
    law_check::InstantRecord record;
    record.t = 1.0;
    record.resolution = 1e-15;
    record.before = record.after = sides();
    return law_check::LawChecker(model, {}).check_instant(record);
  }
};

bool tells_of(const std::vector<Violation>& found, const char* law) {
  for (const Violation& v : found)
    if (v.law == law) return true;
  return false;
}

}  // namespace

TEST_CASE("parts without mass in balance, with their velocities and accelerations") {
  const Chain chain;
  CHECK(chain.u[1] < 0.0);
  CHECK(chain.between().empty());
  CHECK_FALSE(tells_of(chain.instant(), "massless equilibrium"));
  CHECK_FALSE(tells_of(chain.instant(), "massless velocity"));
  CHECK_FALSE(tells_of(chain.instant(), "massless acceleration"));
}

TEST_CASE("each of them a little off") {
  for (const int dof : {1, 2}) {
    CAPTURE(dof);
    Chain chain;
    chain.u[dof] += 1e-9;
    CHECK(tells_of(chain.between(), "massless equilibrium"));
    chain = Chain();
    chain.v[dof] += 1e-7;
    CHECK(tells_of(chain.between(), "massless velocity"));
    chain = Chain();
    chain.a[dof] += 1e-7;
    CHECK(tells_of(chain.instant(), "massless acceleration"));
    CHECK_FALSE(tells_of(chain.instant(), "massless velocity"));
  }
}

TEST_CASE("a motion that has decayed until its velocities have no digits breaks no law") {
  Chain chain;
  chain.rate = chain.bend = 0.0;
  chain.v.setZero();
  chain.a.setZero();
  for (const double rest : {4e-315, 5e-324}) {
    chain.v[1] = rest;
    CHECK_FALSE(tells_of(chain.between(), "massless velocity"));
  }
  chain.v[1] = 1e-280;
  CHECK(tells_of(chain.between(), "massless velocity"));
}

TEST_CASE("a load that is left out, or its rate") {
  Chain chain;
  chain.load = 0.0;
  CHECK(tells_of(chain.between(), "massless equilibrium"));
  chain = Chain();
  chain.rate = 0.0;
  CHECK(tells_of(chain.between(), "massless velocity"));
}

TEST_CASE("rows with a damper know accelerations, and no more") {
  Chain chain;
  chain.model.damping.insert(1, 1) = 4.0;
  // P - 4 v - 50 (w - u) - 150 w = 0
  chain.v[1] = 0.3;
  chain.u[1] = (chain.load - 4.0 * 0.3 + spring * chain.u[0]) / (spring + normal_stiffness);
  chain.u[2] = friction * normal_stiffness * chain.u[1] / 20.0;
  chain.forces = Eigen::Vector2d(normal_stiffness * chain.u[1], -friction * normal_stiffness * chain.u[1]);
  chain.a[1] = (chain.rate - spring * (chain.v[1] - chain.v[0]) - normal_stiffness * chain.v[1]) / 4.0;
  chain.v[2] = friction * normal_stiffness * chain.v[1] / 20.0;
  CHECK(chain.between().empty());
  chain.a[1] += 1e-6;
  CHECK(tells_of(chain.between(), "massless velocity"));
}

TEST_CASE("a contact that parts without mass leave at once was at a limit") {
  Chain chain;
  const auto law_broken = [&](bool at_limit) {
    const State after = State::open;
    law_check::InstantRecord record;
    record.t = 1.0;
    record.resolution = 1e-15;
    const std::vector<ContactState> stick = {{State::stick, chain.u[2] - (at_limit ? -1.0 : -0.3) * friction *
                                                                             chain.forces[0] / 90.0}},
                                    then = {{after, 0.0}};
    const Vector T = Eigen::Vector2d(chain.forces[0], (at_limit ? -1.0 : -0.3) * friction * chain.forces[0]),
                 free = Vector::Zero(2);
    Vector gone = chain.u;
    gone[1] = 0.1;
    gone[2] = 0.0;
    record.before = {&chain.u, &chain.v, nullptr, &stick, &T, chain.model.layout, {law_check::Driven{}}};
    record.after = {&gone, &chain.v, &chain.a, &then, &free, chain.model.layout, {law_check::Driven{}}};
    record.released = {0};
    record.events.push_back({0, "separation", State::stick, after});
    return tells_of(law_check::LawChecker(chain.model, {}).check_instant(record), "release");
  };
  CHECK_FALSE(law_broken(true));
  CHECK(law_broken(false));
}

TEST_CASE("what rests on a damper has velocities of rounding over its damping: they tell no direction") {
  // dof 2: 5 v = -20 x - T; terms of 2 |T| at least, so that 1e3 eps 2 |T|/5 is in v; of kt x and kn g, too, ten times as much.
  const auto broken = [](double back) {
    Chain chain;
    chain.model.damping.insert(2, 2) = 5.0;
    chain.rate = 0.0;
    chain.follow(chain.u, -0.9, chain.load);
    chain.v.setZero();
    chain.v[2] = -back;
    return tells_of(chain.instant(), "slip direction");
  };
  const double T = std::abs(Chain().forces[1]), noise = 1e3 * 2.220446e-16 * 2.0 * T / 5.0;
  CHECK_FALSE(broken(0.0));
  CHECK_FALSE(broken(0.9 * noise));
  CHECK(broken(30.0 * noise));
}

TEST_CASE(
    "a damper along one odd direction of a node: its velocity is known by forces along it, by rates across "
    "it") {
  // A damper of 5 along d = (0.6, 0.8) of the node; c = (-0.8, 0.6) across it. With N = 150 g and T = -0.5 N in K:
  //   d^T C = 5 d = (3, 4),   c^T K = c^T ((200, 0), (-75, 20)) = (-205, 12)
  //   (0.5/90 150, 1) = x_1 (3, 4) + x_2 (-205, 12):   x_1 = 215/856,  x_2 = -1/2568
  const auto broken = [](double back) {
    Chain chain;
    for (const auto& [i, j, factor] :
         {std::tuple(1, 1, 0.36), std::tuple(1, 2, 0.48), std::tuple(2, 1, 0.48), std::tuple(2, 2, 0.64)})
      chain.model.damping.insert(i, j) = 5.0 * factor;
    chain.rate = 0.0;
    chain.follow(chain.u, -0.9, chain.load);
    chain.v.setZero();
    chain.v[2] = -back;
    return tells_of(chain.instant(), "slip direction");
  };
  // The terms of the second row are 2 |T| at least, 20 x and T; all of both rows some twenty times as much.
  const double T = std::abs(Chain().forces[1]);
  const double noise = 1e3 * 2.220446e-16 * 215.0 / 856.0 * 0.8 * 2.0 * T;
  CHECK_FALSE(broken(0.0));
  CHECK_FALSE(broken(0.9 * noise));
  CHECK(broken(100.0 * noise));
}

namespace {

/// The chain's foot lets go of its static friction, 0.6; beside it a slider sticks.
struct LetGo {
  Chain chain;
  Vector u_after, forces_before = Vector::Zero(4), forces_after = forces_before;
  std::vector<ContactState> before, after;
  double slid = 0.0;    ///< by so much more does x jump
  double anchor = 0.0;  ///< of the slider, after

  std::vector<Violation> found(double part_of_limit) {
    Contact beside;
    beside.name = "beside";
    beside.law = Law::slider;
    beside.tangent.terms = {{2, 1.0}};
    beside.tangential_stiffness = 30.0;
    beside.friction.static_ = beside.friction.kinetic = 5.0;
    if (chain.model.contacts.size() == 1) chain.model.contacts.push_back(beside);
    chain.model.layout = contact::layout_of(chain.model.contacts);
    chain.model.contacts[0].friction.static_ = 0.6;
    const double N = chain.forces[0];
    const auto x_of = [&](double T) { return -T / (20.0 + 30.0); };  // -20 x - T - 30 x = 0
    const double held = -part_of_limit * 0.6 * N, slides = -0.5 * N;
    chain.u[2] = x_of(held);
    u_after = chain.u;
    u_after[2] = x_of(slides) + slid;
    forces_before << N, held, -8.0, 30.0 * chain.u[2];
    forces_after << N, slides, -8.0, 30.0 * (u_after[2] - anchor);
    before = {{State::stick, chain.u[2] - held / 90.0}, {State::stick, 0.0}};
    after = {{State::slip_plus, u_after[2] - slides / 90.0}, {State::stick, anchor}};
    law_check::InstantRecord record;
    record.t = 1.0;
    record.resolution = 1e-15;
    record.before = chain.sides();
    record.after = chain.sides();
    record.before.driven = record.after.driven = {law_check::Driven{}, law_check::Driven{}};
    for (law_check::Driven* d : {&record.before.driven[1], &record.after.driven[1]}) d->q = 8.0;
    record.before.forces = &forces_before;
    record.before.mode = &before;
    record.after.u = &u_after;
    record.after.forces = &forces_after;
    record.after.mode = &after;
    record.events.push_back({0, "slip", State::stick, State::slip_plus, 1.0, 1e-15, N, held, N, slides});
    return law_check::LawChecker(chain.model, {}).check_instant(record);
  }
};

}  // namespace

TEST_CASE("parts without mass jump where friction drops to its kinetic value, and nowhere else") {
  const auto jumps = [](const std::vector<Violation>& found) {
    return tells_of(found, "continuity") || tells_of(found, "continuity of friction");
  };
  CHECK_FALSE(jumps(LetGo().found(1.0)));
  CHECK(tells_of(LetGo().found(0.9), "continuity"));  // it was not at its limit
  LetGo back;
  back.slid = -1.0;  // against the force that held it
  CHECK(tells_of(back.found(1.0), "continuity of friction"));
  LetGo drops;
  drops.anchor = 1e-6;  // of what sticks beside
  CHECK(tells_of(drops.found(1.0), "continuity of friction"));
}

TEST_CASE("stiff springs of contacts make forces of the rounding of u, and these move what has no mass") {
  Chain chain;
  constexpr double stiff = 1e13, behind = 20.0;
  chain.model.contacts[0].tangential_stiffness = stiff;
  chain.mode[0] = {State::stick, chain.u[2]};
  const double unsure = rounding::elimination * stiff * std::abs(chain.u[2]) / behind;
  const auto told_at = [&](double off) {
    Vector moved = chain.u;
    moved[2] += off;
    law_check::InstantRecord record;
    record.t = 1.0;
    record.resolution = 1e-15;
    record.before = record.after = chain.sides();
    record.after.u = &moved;
    return tells_of(law_check::LawChecker(chain.model, {}).check_instant(record), "continuity");
  };
  CHECK_FALSE(told_at(0.5 * unsure));
  CHECK(told_at(50.0 * unsure));
  chain.model.dofs[2].massless = false;  // with mass it moves by velocities alone
  chain.model.mass.insert(2, 2) = 1.0;
  CHECK(told_at(0.5 * unsure));
}

TEST_CASE("what slid and stopped at once has a row of slip from stick to stick; without it u does not jump") {
  Chain chain;
  chain.model.contacts[0].friction.static_ = 0.6;
  std::vector<ContactState> stuck = {{State::stick, 0.0}}, stopped = {{State::stick, 0.25}};
  const Vector limit = Eigen::Vector2d(chain.forces[0], -0.6 * chain.forces[0]);
  Vector moved = chain.u;
  moved[2] += 0.1;
  law_check::InstantRecord record;
  record.t = 1.0;
  record.resolution = 1e-15;
  record.before = record.after = chain.sides();
  record.before.mode = &stuck;
  record.before.forces = &limit;
  record.after.mode = &stopped;
  record.after.u = &moved;
  const auto told = [&] {
    return tells_of(law_check::LawChecker(chain.model, {}).check_instant(record), "continuity");
  };
  CHECK(told());
  law_check::RecordedEvent slip{0, "slip", State::stick, State::stick, -1.0, 1e-15};
  record.events = {slip};
  CHECK_FALSE(told());
  record.events[0].type = "stick";
  CHECK(told());
  record.events = {slip};
  const Vector below = Eigen::Vector2d(chain.forces[0], -0.55 * chain.forces[0]);
  record.before.forces = &below;  // not at its limit
  CHECK(told());
}

TEST_SUITE_END();
