// law_check/law_checker.hpp: every law, at records that keep it and at one that does not. Numbers by hand.
#include "law_check/law_checker.hpp"
#include "contact/contact_states.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <utility>

using namespace signorini;

TEST_SUITE_BEGIN("unit/law_check/law_checker");

namespace {

constexpr double mass = 2.0, angle = 0.7;  // of the ground

/// A block of 2 kg on ground that is inclined by 0.7 rad; mass couples nothing.
Model block(const Contact& contact) {
  Model model;
  model.dofs.resize(2);
  model.mass.resize(2, 2);
  model.mass.insert(0, 0) = mass;
  model.mass.insert(1, 1) = mass;
  model.damping.resize(2, 2);
  model.stiffness.resize(2, 2);
  model.contacts.push_back(contact);
  model.layout = contact::layout_of(model.contacts);
  return model;
}

Contact ground(Law law) {
  Contact c;
  c.name = "ground";
  c.law = law;
  c.normal.terms = {{0, -std::sin(angle)}, {1, std::cos(angle)}};
  c.tangent.terms = {{0, std::cos(angle)}, {1, std::sin(angle)}};
  c.friction.static_ = 0.4;
  c.friction.kinetic = 0.3;
  if (law == Law::rigid) c.restitution = 0.5;
  if (law == Law::compliant) {
    c.normal_stiffness = 1e4;
    c.tangential_stiffness = 8e3;
  }
  return c;
}

Vector along(double n, double t) {
  return Eigen::Vector2d(-std::sin(angle) * n + std::cos(angle) * t,
                         std::cos(angle) * n + std::sin(angle) * t);
}

/// Rows of the events as both sides have them.
void write_rows(const Model& model, law_check::InstantRecord& record) {
  for (law_check::RecordedEvent& event : record.events) {
    const Contact& c = model.contacts[event.contact];
    const auto at = static_cast<Eigen::Index>(2 * event.contact);
    const double surface = record.after.driven[event.contact].ds;
    event.gap = c.optional_gap(c.gap_at(*record.after.u));
    event.N = (*record.before.forces)[at];
    event.T = (*record.before.forces)[at + 1];
    event.N_after = (*record.after.forces)[at];
    event.T_after = (*record.after.forces)[at + 1];
    event.vn = c.normal.dot(*record.before.v);
    event.vn_after = c.normal.dot(*record.after.v);
    event.vt = c.tangent.dot(*record.before.v) - surface;
    event.vt_after = c.tangent.dot(*record.after.v) - surface;
    for (const law_check::RecordedImpulse& p : record.impulses) {
      event.impulse_n += p.contact == event.contact ? p.normal : 0.0;
      event.impulse_t += p.contact == event.contact ? p.tangent : 0.0;
    }
  }
}

/// Both sides of an instant, in terms of n and t.
struct Recorded {
  Vector u_before, u_after, v_before, v_after, a, forces_before, forces_after;
  std::vector<ContactState> before, after;
  law_check::InstantRecord record;
  bool untrue = false;  ///< rows of events say nothing of both sides
  double drift = 0.0;   ///< of what sticks to a surface that moves

  explicit Recorded(double g = 0.0, double ut = 0.0)
      : u_before(along(g, ut)),
        u_after(u_before),
        v_before(along(0, 0)),
        v_after(v_before),
        a(along(0, 0)),
        forces_before(Vector::Zero(2)),
        forces_after(Vector::Zero(2)) {}

  std::vector<Violation> by(const Model& model, const law_check::LawLimits& limits = {}) {
    record.t = 1.0;
    record.resolution = 1e-15;
    record.before = {
        &u_before, &v_before, nullptr, &before, &forces_before, model.layout, {law_check::Driven{}}};
    record.before.driven[0].drift = drift;
    record.after = {&u_after, &v_after, &a, &after, &forces_after, model.layout, {law_check::Driven{}}};
    if (before[0].state != after[0].state && record.events.empty())
      record.events.push_back({0, "event", before[0].state, after[0].state});
    if (!untrue) write_rows(model, record);
    return law_check::LawChecker(model, limits).check_instant(record);
  }
};

bool names(const std::vector<Violation>& found, const char* law) {
  for (const Violation& v : found)
    if (v.law == law) return true;
  return false;
}

/// 3 m/s down, 1 m/s along: Pn = m (1 + e) 3 = 9, it slides: Pt = -fk Pn, vt+ = 1 - 0.3 9 / 2... of kinetic friction.
Recorded rebound() {
  Recorded r;
  r.v_before = along(-3.0, 4.0);
  r.v_after = along(1.5, 4.0 - 0.3 * 9.0 / mass);
  r.before = r.after = {{State::open, 0.0}};
  r.record.impulses = {{0, 1, 9.0, -2.7}};
  return r;
}

}  // namespace

TEST_CASE("witness: velocities below the least normal number have no digits, and break no law of momentum") {
  Recorded r(0.1);
  r.before = r.after = {ContactState{State::open, 0.0}};
  r.v_before = along(0.0, 1e-308);
  r.v_after = along(0.0, 1e-308 + 4e-319);
  CHECK(r.by(block(ground(Law::rigid))).empty());
  r.v_before = along(0.0, 1e-290);
  r.v_after = along(0.0, 1.0000001e-290);
  CHECK(names(r.by(block(ground(Law::rigid))), "momentum"));
}

TEST_CASE("a rebound by Newton's and Coulomb's laws keeps all of them") {
  CHECK(rebound().by(block(ground(Law::rigid))).empty());
}

TEST_CASE("an impulse that is not recorded breaks the balance of momentum, gravely") {
  Recorded r = rebound();
  r.record.impulses.clear();
  const auto found = r.by(block(ground(Law::rigid)));
  REQUIRE(names(found, "momentum"));
  CHECK(found[0].unexplained);
}

TEST_CASE("a rebound with another coefficient breaks restitution") {
  Recorded r = rebound();  // e = 0.4: Pn = 2 1.4 3
  r.record.impulses = {{0, 1, 8.4, -2.52}};
  r.v_after = along(1.2, 4.0 - 0.3 * 8.4 / mass);
  const auto found = r.by(block(ground(Law::rigid)));
  CHECK(names(found, "restitution"));
  CHECK_FALSE(names(found, "momentum"));
}

TEST_CASE("hits of one instant come one after the other: each by its own velocities") {
  // On a surface that moves at -10 m/s the body lands first, e = 0, and is thrown by friction against a wall that it was
  // about to leave: along (t, n) from (0.9, -1) by 1 (-1, 1), f = 1, to (-0.1, 0), and by 0.12 (0.8, 0.6), e = 1/2.
  Contact floor = ground(Law::rigid), wall = ground(Law::rigid);
  floor.restitution = 0.0;
  floor.friction.static_ = floor.friction.kinetic = 1.0;
  const Vector normal = along(0.6, 0.8), tangent = along(-0.8, 0.6);
  wall.normal.terms = {{0, normal[0]}, {1, normal[1]}};
  wall.tangent.terms = {{0, tangent[0]}, {1, tangent[1]}};
  wall.friction.static_ = wall.friction.kinetic = 0.0;
  Model model = block(wall);
  model.contacts.push_back(floor);
  model.layout = contact::layout_of(model.contacts);
  const Vector u = along(0.0, 0.0), before = along(-1.0, 0.9), none = Vector::Zero(4);
  const std::vector<ContactState> open = {{State::open, 0.0}, {State::open, 0.0}};
  const auto found = [&](double at_wall, int turn_of_wall) {
    const Vector after = along(0.6 * at_wall, -0.1 + 0.8 * at_wall), a = u;
    law_check::InstantRecord record;
    record.t = 1.0;
    record.resolution = 1e-15;
    law_check::Driven surface;
    surface.ds = -10.0;
    record.before = {&u, &before, nullptr, &open, &none, model.layout, {law_check::Driven{}, surface}};
    record.after = {&u, &after, &a, &open, &none, model.layout, {law_check::Driven{}, surface}};
    record.impulses = {{1, 1, mass, -mass}, {0, turn_of_wall, at_wall * mass, 0.0}};
    record.events.push_back({0, "impact", State::open, State::open});
    record.events.push_back({1, "impact", State::open, State::open});
    write_rows(model, record);
    return law_check::LawChecker(model, {}).check_instant(record);
  };
  CHECK(found(0.12, 2).empty());
  CHECK(names(found(0.13, 2), "restitution"));  // another e
  CHECK(names(found(0.12, 1), "restitution"));  // at once it would not be hit
}

TEST_CASE("a contact that is hit twice at one instant: each hit by its own velocities") {
  // Along (n, t) from (-1, -0.7): the floor makes 0.5 of -1, e = 1/2; then it closes a wall with normal (-0.6, 0.8) at
  // 0.86, which throws it by 1.29 (-0.6, 0.8), down again: at -0.274, to 0.137.
  Contact floor = ground(Law::rigid), wall = floor;
  for (Contact* c : {&floor, &wall}) c->friction.static_ = c->friction.kinetic = 0.0;
  const Vector normal = along(-0.6, 0.8), tangent = along(0.8, 0.6);
  wall.normal.terms = {{0, normal[0]}, {1, normal[1]}};
  wall.tangent.terms = {{0, tangent[0]}, {1, tangent[1]}};
  Model model = block(floor);
  model.contacts.push_back(wall);
  model.layout = contact::layout_of(model.contacts);
  const Vector u = along(0.0, 0.0), before = along(-1.0, -0.7), none = Vector::Zero(4);
  const std::vector<ContactState> open = {{State::open, 0.0}, {State::open, 0.0}};
  const auto found = [&](double last) {
    const Vector after = along(-0.274 + last, 0.332);
    law_check::InstantRecord record;
    record.t = 1.0;
    record.resolution = 1e-15;
    record.before = {
        &u, &before, nullptr, &open, &none, model.layout, {law_check::Driven{}, law_check::Driven{}}};
    record.after = {&u, &after, &u, &open, &none, model.layout, {law_check::Driven{}, law_check::Driven{}}};
    record.impulses = {{0, 1, 1.5 * mass, 0.0}, {1, 2, 1.29 * mass, 0.0}, {0, 3, last * mass, 0.0}};
    return law_check::LawChecker(model, {}).check_instant(record);
  };
  CHECK(found(0.411).empty());
  CHECK(names(found(0.45), "restitution"));
  CHECK_FALSE(names(found(0.45), "momentum"));
}

TEST_CASE("an impulse of friction outside its cone, or against the law of sliding") {
  for (const double tangent : {-9.0 * 0.41, -9.0 * 0.35, 9.0 * 0.3}) {
    CAPTURE(tangent);
    Recorded r = rebound();
    r.record.impulses = {{0, 1, 9.0, tangent}};
    r.v_after = along(1.5, 4.0 + tangent / mass);
    const auto found = r.by(block(ground(Law::rigid)));
    CHECK(names(found, "friction impulse"));
    CHECK_FALSE(names(found, "momentum"));
  }
}

TEST_CASE("a hit is no capture: rest is for what is slower than capture_velocity") {
  for (const double fell : {1e-9, 25.29}) {
    CAPTURE(fell);
    Recorded r;
    r.v_before = along(-fell, 0.0);
    r.before = {{State::open, 0.0}};
    r.after = {{State::stick, 0.0}};
    r.forces_after = Eigen::Vector2d(-10.0, 1.0);
    r.record.captures = Eigen::Vector2d(mass * fell, 0.0);
    law_check::LawLimits limits;
    limits.capture_velocity = 1e-8;
    const auto found = r.by(block(ground(Law::rigid)), limits);
    CHECK(names(found, "capture") == (fell > 1.0));
    CHECK_FALSE(names(found, "momentum"));
  }
}

TEST_CASE(
    "steps leave what sticks to a moving surface beside it by their rule's error: more is noticed, thrice is "
    "grave") {
  for (const double part : {0.9, 2.0, 4.0}) {
    CAPTURE(part);
    Recorded r;
    r.drift = 1e-6;
    r.v_before = along(0.0, part * r.drift);
    r.before = r.after = {{State::stick, 0.0}};
    r.record.captures = Eigen::Vector2d(0.0, -mass * part * r.drift);
    law_check::LawLimits limits;
    limits.capture_velocity = 1e-12;
    limits.step = 0.01;
    const auto found = r.by(block(ground(Law::slider)), limits);
    CHECK_FALSE(names(found, "momentum"));
    CHECK(names(found, "capture") == (part > 1.0));
    for (const Violation& v : found)
      if (v.law == std::string("capture")) CHECK(v.unexplained == (part > 3.0));
  }
}

TEST_CASE("a contact that touches and still falls") {
  Recorded r;
  r.v_before = r.v_after = along(-0.1, 0.0);
  r.before = r.after = {{State::open, 0.0}};
  CHECK(names(r.by(block(ground(Law::rigid))), "penetration rate"));
}

namespace {

/// Pressed 1 mm into its spring: N = -10, sliding at its limit along +t.
Recorded sliding(double speed) {
  Recorded r(-1e-3, 0.02);
  r.v_before = r.v_after = along(0.0, speed);
  r.forces_before = r.forces_after = Eigen::Vector2d(-10.0, 3.0);
  r.before = r.after = {{State::slip_plus, 0.0}};
  return r;
}

/// It sticks from there on, T as it was.
void stick(Recorded& r, double T = 3.0) {
  r.after = {{State::stick, 0.02 - T / 8e3}};
  r.forces_after[1] = T;
}

}  // namespace

TEST_CASE("what slides and goes on sliding has no reason to stick") {
  Recorded r = sliding(0.5);
  CHECK(r.by(block(ground(Law::compliant))).empty());
  stick(r);
  const auto found = r.by(block(ground(Law::compliant)));
  REQUIRE(names(found, "necessity"));
  CHECK(found[0].value == doctest::Approx(0.5));
}

TEST_CASE("what has come to rest may stick, with T as it was, and not with another") {
  Recorded r = sliding(0.0);
  stick(r);
  CHECK(r.by(block(ground(Law::compliant))).empty());
  stick(r, 0.0);  // the anchor where it is
  CHECK(names(r.by(block(ground(Law::compliant))), "continuity of friction"));
}

TEST_CASE("T at its static limit lets go in its own direction, down to kinetic friction") {
  Recorded r(-1e-3, 0.02);
  r.forces_before = Eigen::Vector2d(-10.0, 4.0);
  r.forces_after = Eigen::Vector2d(-10.0, 3.0);
  r.before = {{State::stick, 0.02 - 4.0 / 8e3}};
  r.after = {{State::slip_plus, 0.0}};
  CHECK(r.by(block(ground(Law::compliant))).empty());
  Contact like = ground(Law::compliant);  // fs = fk: T goes on where it was
  like.friction.static_ = like.friction.kinetic = 0.4;
  r.after = {{State::slip_minus, 0.0}};
  r.forces_after[1] = -4.0;
  CHECK(names(r.by(block(like)), "continuity of friction"));
}

TEST_CASE(
    "a hit lets |N| of a slip drop and turns the body: what stops sticks at the T that it had, or that fell "
    "with N") {
  Contact damped = ground(Law::compliant);
  damped.normal_damping = 10.0;
  for (const double T : {3.0, 2.7, 0.3 * 8.0}) {
    CAPTURE(T);
    Recorded r(-1e-3, 0.02);
    r.v_before = along(0.0, 1.0);
    r.v_after = along(0.2, -1.0);
    r.forces_before = Eigen::Vector2d(-10.0, 3.0);
    r.forces_after = Eigen::Vector2d(-8.0, T);
    r.before = {{State::slip_plus, 0.0}};
    r.after = {{State::stick, 0.02 - T / 8e3}};
    CHECK(names(r.by(block(damped)), "continuity of friction") == (T == 2.7));
  }
}

TEST_CASE(
    "rows: what captured velocities do by dampers is greater in forces of contacts that are nearly the "
    "same") {
  Contact flat = ground(Law::rigid), inclined = flat;
  const double c = std::sqrt(0.99);
  flat.normal.terms = {{1, 1.0}};
  flat.tangent.terms = {{0, 1.0}};
  inclined.normal.terms = {{0, 0.1}, {1, c}};
  inclined.tangent.terms = {{0, c}, {1, -0.1}};
  for (Contact* contact : {&flat, &inclined}) contact->friction.static_ = contact->friction.kinetic = 0.0;
  Model model = block(flat);
  model.contacts.push_back(inclined);
  model.layout = contact::layout_of(model.contacts);
  for (const int dof : {0, 1}) model.damping.insert(dof, dof) = 3.0;
  const Vector u = Vector::Zero(2);
  const std::vector<ContactState> closed = {{State::closed, 0.0}, {State::closed, 0.0}};
  const std::vector<ContactState> left = {{State::open, 0.0}, {State::closed, 0.0}};
  Vector forces = Vector::Zero(4), after = forces;
  forces[0] = -10.0;
  for (const double part : {1.0, 4.0}) {
    CAPTURE(part);
    law_check::InstantRecord record;
    record.t = 1.0;
    record.resolution = 1e-15;
    record.before = {
        &u, &u, nullptr, &closed, &forces, model.layout, {law_check::Driven{}, law_check::Driven{}}};
    record.after = {&u, &u, &u, &left, &after, model.layout, {law_check::Driven{}, law_check::Driven{}}};
    record.captures.setZero(4);
    record.captures[0] =
        -2e-5 * c;  // together 1e-6 m/s across: 3e-6 N by the dampers, 3e-5 N in each contact
    record.captures[2] = 2e-5;
    record.events.push_back({0, "event", State::closed, State::open});
    write_rows(model, record);
    record.events[0].N += part * 3e-5 * c;
    law_check::LawLimits limits;
    limits.step = 0.01;
    CHECK(names(law_check::LawChecker(model, limits).check_instant(record), "row") == (part > 3.0));
  }
}

TEST_CASE("rows: a gap that is written as zero was so to the error of a step, though its rate says nothing") {
  for (const double gap : {1e-4, 1e-3}) {
    CAPTURE(gap);
    Recorded r(gap);
    r.a = along(10.0, 0.0);  // 3 h^2/12 2 a = 5e-4
    r.before = r.after = {{State::open, 0.0}};
    law_check::RecordedEvent event{0, "contact", State::open, State::open};
    event.t_uncertainty = 0.1;
    event.gap = 0.0;
    r.record.events = {event};
    r.untrue = true;
    law_check::LawLimits limits;
    limits.step = 0.01;
    CHECK(names(r.by(block(ground(Law::rigid)), limits), "row") == (gap > 5e-4));
    CHECK(names(r.by(block(ground(Law::rigid))), "row"));
  }
}

TEST_CASE("T below its limit does not let go") {
  Recorded r(-1e-3, 0.02);
  r.forces_before = Eigen::Vector2d(-10.0, 3.9);
  r.forces_after = Eigen::Vector2d(-10.0, 3.0);
  r.before = {{State::stick, 0.02 - 3.9 / 8e3}};
  r.after = {{State::slip_plus, 0.0}};
  CHECK(names(r.by(block(ground(Law::compliant))), "necessity"));
}

TEST_CASE("what a rigid stop holds, too, has no friction force of its own: no reason to slip is asked for") {
  // T = 3.5 below its limit of 4 becomes 3; the stop that is pushed against takes the rest, if it is closed.
  for (const bool held : {false, true}) {
    Contact foot = ground(Law::rigid), stop = ground(Law::rigid);
    stop.name = "stop";
    std::swap(stop.normal, stop.tangent);
    stop.friction = {};
    if (!held) stop.gap = 0.1;
    Model model = block(foot);
    model.contacts.push_back(stop);
    model.layout = contact::layout_of(model.contacts);
    Recorded r;
    const Eigen::VectorXd before = Eigen::Vector4d(-10.0, 3.5, held ? -1.0 : 0.0, 0.0),
                          after = Eigen::Vector4d(-10.0, 3.0, held ? -1.5 : 0.0, 0.0);
    const State of_stop = held ? State::closed : State::open;
    r.before = {{State::stick, 0.0}, {of_stop, 0.0}};
    r.after = {{State::slip_plus, 0.0}, {of_stop, 0.0}};
    r.record.t = 1.0;
    r.record.resolution = 1e-15;
    r.record.before = {&r.u_before,
                       &r.v_before,
                       nullptr,
                       &r.before,
                       &before,
                       model.layout,
                       {law_check::Driven{}, law_check::Driven{}}};
    r.record.after = {&r.u_after,
                      &r.v_after,
                      &r.a,
                      &r.after,
                      &after,
                      model.layout,
                      {law_check::Driven{}, law_check::Driven{}}};
    r.record.events.push_back({0, "slip", State::stick, State::slip_plus});
    CAPTURE(held);
    CHECK(names(law_check::LawChecker(model, {}).check_instant(r.record), "necessity") == !held);
  }
}

TEST_CASE("an event that is ten uncertainties late") {
  for (const double late : {0.5, 10.0}) {
    CAPTURE(late);
    constexpr double uncertainty = 1e-9, speed = 2.0;
    Recorded r(-late * uncertainty * speed, 0.0);
    r.v_before = r.v_after = along(-speed, 0.0);
    r.before = {{State::open, 0.0}};
    r.after = {{State::stick, 0.0}};
    r.forces_after = Eigen::Vector2d(1e4 * -late * uncertainty * speed, 0.0);
    r.record.events = {{0, "contact", State::open, State::stick, -speed, uncertainty}};
    CHECK(names(r.by(block(ground(Law::compliant))), "time of the event") == (late > 1.0));
  }
}

TEST_CASE(
    "an event whose own motion or force jumps was led to its state: its guard need not have been zero") {
  // It sticks rigidly in flight of its guard, 0.5 m/s from zero; what jumps at that instant is one quantity, or none.
  enum class Jump { none, g_rate, ut_rate, N, little };
  for (const Jump jump : {Jump::none, Jump::g_rate, Jump::ut_rate, Jump::N, Jump::little}) {
    CAPTURE(static_cast<int>(jump));
    Recorded r;
    r.v_before = along(0.0, 0.5);
    const double size = jump == Jump::little ? 1e-15 : 0.1;
    r.v_after = along(jump == Jump::g_rate ? size : 0.0,
                      jump == Jump::ut_rate || jump == Jump::little ? 0.5 + size : 0.5);
    r.forces_before = Eigen::Vector2d(-10.0, -3.0);
    r.forces_after = Eigen::Vector2d(jump == Jump::N ? -11.0 : -10.0, -2.0);
    r.before = {{State::slip_plus, 0.0}};
    r.after = {{State::stick, 0.0}};
    r.record.events = {{0, "stick", State::slip_plus, State::stick, -3.0, 1e-9}};
    const bool jumps = jump != Jump::none && jump != Jump::little;
    CHECK(names(r.by(block(ground(Law::rigid))), "time of the event") == !jumps);
  }
  // N of a spring goes with u: a jump of it tells nothing, but with a dashpot beside it does.
  for (const double damping : {0.0, 20.0}) {
    Contact foot = ground(Law::compliant);
    foot.normal_damping = damping;
    Recorded r(-1e-3, 0.0);
    r.v_before = r.v_after = along(0.0, 0.5);
    r.a = along(0.0, 0.0);
    r.forces_before = Eigen::Vector2d(-10.0, -3.0);
    r.forces_after = Eigen::Vector2d(-11.0, -3.0);
    r.before = {{State::slip_plus, 0.0}};
    r.after = {{State::stick, 3.0 / 8e3}};
    r.record.events = {{0, "stick", State::slip_plus, State::stick, -3.0, 1e-9}};
    CAPTURE(damping);
    CHECK(names(r.by(block(foot)), "time of the event") == (damping == 0.0));
  }
}

TEST_CASE("forces of the new state: its rows, no tension, no friction outside the cone") {
  Recorded r = sliding(0.5);
  r.forces_after = Eigen::Vector2d(-10.0, 2.9);
  CHECK(names(r.by(block(ground(Law::compliant))), "friction force"));
  r.forces_after = Eigen::Vector2d(-9.9, 2.97);
  CHECK(names(r.by(block(ground(Law::compliant))), "normal force"));
  r = sliding(-0.5);
  CHECK(names(r.by(block(ground(Law::compliant))), "slip direction"));
}

TEST_CASE(
    "the greatest velocity along n and t that an energy makes: roots of both compliances of mass, added") {
  Model model = block(ground(Law::rigid));
  model.mass.coeffRef(1, 1) = 5.0;
  const double s = std::sin(angle), c = std::cos(angle);
  const double nn = s * s / mass + c * c / 5.0, tt = c * c / mass + s * s / 5.0;
  CHECK(law_check::LawChecker(model, {}).speed_per_energy_root(0) ==
        doctest::Approx(std::sqrt(nn) + std::sqrt(tt)).epsilon(1e-14));
}

TEST_CASE("displacements do not jump") {
  Recorded r = sliding(0.5);
  r.u_before = along(-1e-3, 0.02001);
  CHECK(names(r.by(block(ground(Law::compliant))), "continuity"));
}

TEST_CASE("a change of state without its row in the list of events") {
  Recorded r = sliding(0.0);
  stick(r);
  r.record.events = {{0, "stick", State::slip_minus, State::stick}};
  CHECK(names(r.by(block(ground(Law::compliant))), "record"));
}

TEST_CASE("a row that says other forces, velocities or impulses than both sides have") {
  CHECK_FALSE(names(rebound().by(block(ground(Law::rigid))), "row"));
  Recorded r = rebound();
  r.record.events.push_back({0, "impact", State::open, State::open});
  CHECK_FALSE(names(r.by(block(ground(Law::rigid))), "row"));
  r = rebound();
  r.record.events.push_back({0, "impact", State::open, State::open});
  r.untrue = true;
  CHECK(names(r.by(block(ground(Law::rigid))), "row"));
  r = sliding(0.0);
  stick(r);
  r.untrue = true;
  CHECK(names(r.by(block(ground(Law::compliant))), "row"));
}

TEST_CASE("between events: what is open has a gap, what presses does not pull") {
  const Model model = block(ground(Law::compliant));
  const law_check::LawChecker witness(model, {});
  Recorded r(-1e-3, 0.0);
  const std::vector<ContactState> open = {{State::open, 0.0}}, closed = {{State::stick, 0.0}};
  law_check::CheckedSide side{&r.u_before,  &r.v_before,          nullptr, &open, &r.forces_before,
                              model.layout, {law_check::Driven{}}};
  CHECK(names(witness.check_point(1.0, side), "penetration"));
  side.mode = &closed;
  r.forces_before = Eigen::Vector2d(0.5, 0.0);
  CHECK(names(witness.check_point(1.0, side), "tension"));
  r.forces_before = Eigen::Vector2d(-10.0, 4.1);
  CHECK(names(witness.check_point(1.0, side), "friction"));
  r.forces_before = Eigen::Vector2d(-10.0, 3.9);
  CHECK(witness.check_point(1.0, side).empty());
}

TEST_SUITE_END();
