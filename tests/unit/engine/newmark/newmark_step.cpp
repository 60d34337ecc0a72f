#include "engine/newmark/newmark_step.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "motion/consistent_motion.hpp"
#include "motion/point.hpp"
#include "signorini/simulate.hpp"
#include "unit/linear/rubbing_row.hpp"

using namespace signorini;

namespace {

/// Two masses, one of them on a compliant contact that slips.
Model make_model() {
  return build_model(parse_scene(
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "1.0\n"
      "initial = { u = [0.1, -0.02], v = [0.3, 0.1] }\n[matrices]\nmass = [[2.0, 0.1], [0.1, 1.0]]\n"
      "damping = [[0.2, 0.0], [0.0, 0.1]]\nstiffness = [[30.0, -5.0], [-5.0, 20.0]]\n"
      "[[contacts]]\nname = \"c\"\nlaw = \"compliant\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\n"
      "normal_stiffness = 1e3\ntangential_stiffness = 1e3\nfriction = 0.4\n"
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 3.0\nhistory = { type = \"harmonic\", omega = 2.0 "
      "}\n",
      "test.toml"));
}

}  // namespace

TEST_SUITE("unit/engine/newmark/newmark_step") {
  TEST_CASE("the formulas of average acceleration, equilibrium and the limit hold at the end of a step") {
    const Model m = make_model();
    const linear::SystemMatrices structure(m);
    motion::StateSystems systems(m, structure);
    const contact::ContactStates contact_states{{State::slip_plus, 0.0}};
    const motion::StateSystemPtr system = systems.system_of(contact_states);
    REQUIRE(system);
    const motion::Forcing forcing(m, 0.0, motion::Side::after);
    motion::Point from{m.u0, m.v0, Vector::Zero(2)}, to;
    motion::ConsistentMotion(systems).make(system, forcing, 0.0, from);
    newmark::NewmarkStep step(m, structure);
    step.set({1}, system->rows());
    // From a thousandth of a period of the contact's spring to far above it, and to the clock's resolution.
    for (double h : {1e-16, 1e-9, 1e-4, 1e-2, 10.0}) {
      CAPTURE(h);
      REQUIRE(step.take(forcing, from, h, h, false, to));
      for (Eigen::Index i = 0; i < 2; ++i) {
        const double u = from.u[i] + h * from.v[i] + 0.25 * h * h * (from.a[i] + to.a[i]);
        const double v = from.v[i] + 0.5 * h * (from.a[i] + to.a[i]);
        CHECK(to.u[i] == doctest::Approx(u).epsilon(1e-13));
        CHECK(to.v[i] == doctest::Approx(v).epsilon(1e-13));
      }
      CHECK(to.forces[1] == -0.4 * to.forces[0]);  // to the last bit
      CHECK(motion::equilibrium_residual(m, structure, forcing, h, to) <
            1e-12 * (1.0 + 1e3 * to.u.cwiseAbs().maxCoeff()));
    }
  }

  TEST_CASE("a part without mass moves by the same formula: its velocity follows from where it stood") {
    const Model m = build_model(parse_scene(
        "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
        "1.0\n"
        "initial = { u = [0.1, 0.0], v = [0.3, 0.0] }\n[matrices]\nmass = [[2.0, 0.0], [0.0, 0.0]]\n"
        "stiffness = [[30.0, -5.0], [-5.0, 20.0]]\n[[loads]]\ndirection = { d0 = 1.0, d1 = 2.0 }\n"
        "amplitude = 3.0\nhistory = { type = \"harmonic\", omega = 2.0 }\n",
        "test.toml"));
    const linear::SystemMatrices structure(m);
    motion::StateSystems systems(m, structure);
    const motion::StateSystemPtr system = systems.system_of({});
    REQUIRE(system);
    const motion::Forcing forcing(m, 0.0, motion::Side::after);
    motion::Point from{m.u0, m.v0, Vector::Zero(0)}, to;
    from.u[1] = 5.0 * from.u[0] / 20.0;  // K u = P of the second row, P(0) = 0
    motion::ConsistentMotion(systems).make(system, forcing, 0.0, from);
    newmark::NewmarkStep step(m, structure);
    step.set({}, system->rows());
    for (double h : {1e-6, 1e-2, 0.5}) {
      CAPTURE(h);
      REQUIRE(step.take(forcing, from, h, h, false, to));
      CHECK(20.0 * to.u[1] == doctest::Approx(5.0 * to.u[0] + 6.0 * std::sin(2.0 * h)).epsilon(1e-13));
      // u1 = u0 + h (v0 + v1) / 2
      CHECK(std::abs(from.u[1] + 0.5 * h * (from.v[1] + to.v[1]) - to.u[1]) < 1e-14);
      CHECK(to.v[1] != 0.0);
      CHECK(to.a[1] == 0.0);
    }
  }

  TEST_CASE("a factorisation is kept for a length that comes again in the same states") {
    const Model m = make_model();
    const linear::SystemMatrices structure(m);
    motion::StateSystems systems(m, structure);
    newmark::NewmarkStep step(m, structure);
    const contact::ContactStates stick{{State::stick, 0.0}}, slip{{State::slip_plus, 0.0}};
    const motion::Forcing forcing(m, 0.0, motion::Side::after);
    motion::Point from{m.u0, m.v0, Vector::Zero(2), Vector::Zero(2)}, to;
    for (int i = 0; i < 5; ++i)
      for (const contact::ContactStates& contact_states : {stick, slip}) {
        const motion::StateSystemPtr system = systems.system_of(contact_states);
        REQUIRE(system);
        step.set({static_cast<int>(contact_states[0].state)}, system->rows());
        REQUIRE(step.take(forcing, from, 0.01, 0.01, true, to));
        REQUIRE(step.take(forcing, from, 0.02, 0.01, true, to));
      }
    Counters counters;
    step.count(counters);
    CHECK(counters.factorisations == 2);
    CHECK(counters.solves == 20);
  }

  /// Steps of all lengths in many states: each fulfils its equations, whatever factorisation was used for it.
  TEST_CASE("steps by updates and refinement fulfil equilibrium and rows, with few factorisations") {
    struct Kind {
      int masses;
      std::size_t widest;
    };
    // Every step factorised; avoided; as a band, once for each odd length.
    for (const auto& [masses, widest] :
         {Kind{9, 0}, Kind{77, 0}, Kind{77, linear::CondensedMatrix::max_width}}) {
      const Model m = rubbing_row(masses);
      const linear::SystemMatrices structure(m);
      const motion::Forcing forcing(m, 0.0, motion::Side::after);
      newmark::NewmarkStep step(m, structure, widest);
      const Eigen::Index n = m.size(), forces = 2 * static_cast<Eigen::Index>(m.contacts.size());
      motion::Point from{m.u0, m.v0, Vector::Zero(forces), Vector::LinSpaced(n, -1.0, 1.0)}, to;
      contact::ContactStates contact_states = rubbing_mode(m, 11);
      const double dt = 0.01;
      int states = 0;
      for (int i = 0; i < 24; ++i) {
        State& changed = contact_states[static_cast<std::size_t>(5 * i) % contact_states.size()].state;
        changed = changed == State::stick  ? State::slip_minus
                  : changed == State::open ? State::stick
                                           : State::open;
        newmark::NewmarkStep::Key key;
        for (const State s : contact::states_of(contact_states)) key.push_back(static_cast<int>(s));
        step.set(key, linear::rows_of(m, contact_states));
        ++states;
        const auto check = [&](double h, bool kept) {
          CAPTURE(h);
          CAPTURE(i);
          REQUIRE(step.take(forcing, from, h, h, kept, to));
          const double force = 1.0 + 1e3 * to.u.cwiseAbs().maxCoeff();
          CHECK(motion::equilibrium_residual(m, structure, forcing, h, to) < 1e-12 * force);
          const Vector u = from.u + h * from.v + 0.25 * h * h * (from.a + to.a);
          CHECK((to.u - u).cwiseAbs().maxCoeff() < 1e-14);
          for (std::size_t k = 0; k < m.contacts.size(); ++k) {
            const ContactMotion motion = motion::motion_of(m.contacts[k], k, forcing, h, to);
            CHECK(std::abs(step.rows()[k].normal.value(motion)) < 1e-12 * force);
            CHECK(std::abs(step.rows()[k].tangent.value(motion)) < 1e-12 * force);
          }
        };
        check(dt, true);
        for (const double part : {0.3, 0.31, 0.3101, 0.9}) check(part * dt, false);
        check(dt, true);
      }
      Counters counters;
      step.count(counters);
      const long factored = counters.factorisations + counters.refactorisations;
      CAPTURE(factored);
      if (masses < 50)
        CHECK(factored == states * 5);
      else if (widest > 0)
        CHECK(factored == states * 4 + 1);  // the first of the length that comes again
      else
        CHECK(factored < states * 3);
    }
  }
}
