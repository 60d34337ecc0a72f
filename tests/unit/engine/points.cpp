// What engines tell of the inside of their steps: equations of motion, laws of the state, v = u', and the same from every flow.
#include <doctest/doctest.h>

#include <cmath>

#include "motion/point.hpp"
#include "unit/engine/six_masses.hpp"
#include "unit/engine/stretch.hpp"

namespace signorini::tests::points {
namespace {

/// Forces of the contacts by their laws: a slides upwards, b sticks, c is open or closed.
Vector law_forces(const Stretch& s, double t, const motion::Point& p) {
  Vector forces = Vector::Zero(6);
  for (std::size_t c = 0; c < 3; ++c) {
    const Contact& contact = s.model.contacts[c];
    const ContactMotion m = motion::motion_of(contact, c, s.forcing, t, p);
    const auto n = static_cast<Eigen::Index>(2 * c);
    const ContactState& state = s.decision.states[c];
    if (state.is_open()) continue;
    forces[n] = contact.normal_stiffness * m.gap + contact.normal_damping * m.vn;
    if (state.state == State::slip_plus) forces[n + 1] = -contact.friction.kinetic * forces[n];
    if (state.state == State::stick) forces[n + 1] = *contact.tangential_stiffness * (m.ut - state.anchor);
  }
  return forces;
}

/// off: in equilibrium and laws, of forces of some 20 N.
void check_points(Stretch& s, bool smooth, double off) {
  const engine::Step last = s.go([&](const engine::Step& step) {
    const double h = step.end - step.begin;
    for (const double x : {0.0, 0.07, 0.5, 0.93, 1.0}) {
      const double t = x == 1.0 ? step.end : step.begin + x * h;
      CAPTURE(t);
      const motion::Point p = s.at(t);
      REQUIRE(p.a.size() == 6);
      CHECK((p.forces - law_forces(s, t, p)).cwiseAbs().maxCoeff() < off);
      CHECK(motion::equilibrium_residual(s.model, s.structure, s.forcing, t, p) < off);
      motion::Point inside = p;
      inside.u.setConstant(std::numeric_limits<double>::infinity());
      inside.a.resize(0);
      s.engine->dense_output().interpolate(t, inside);
      if (!smooth) continue;
      CHECK((inside.u - p.u).norm() < 1e-12);
      CHECK((inside.v - p.v).norm() < 1e-11);
      CHECK((inside.a - p.a).norm() < 1e-9);
      CHECK((inside.forces - p.forces).norm() < 1e-9);
      motion::Point watched;
      s.engine->dense_output().evaluate_watched(t, std::nullopt, watched);
      for (const int dof : {0, 1, 2, 3, 4}) {
        CHECK(std::abs(watched.u[dof] - p.u[dof]) < 1e-12);
        CHECK(std::abs(watched.v[dof] - p.v[dof]) < 1e-11);
      }
      if (x == 0.0 || x == 1.0) continue;
      const double d = 0.01 * std::min(h, 0.02);
      motion::Point before, after;
      s.engine->dense_output().evaluate(t - d, before);
      s.engine->dense_output().evaluate(t + d, after);
      CHECK((after.u - before.u - 2.0 * d * p.v).norm() < 1e3 * d * d * d + 1e-15);
      CHECK((after.v - before.v - 2.0 * d * p.a).norm() < 1e5 * d * d * d + 1e-14);
    }
    CHECK(s.engine->dense_output().residual() < off);
  });
  REQUIRE(last.kind != engine::Step::Kind::failed);
  CHECK(last.end > 0.05);
}

}  // namespace

TEST_SUITE_BEGIN("unit/engine/points");

TEST_CASE(
    "equilibrium, laws and derivatives inside steps of every engine, and where modes give way to the "
    "series") {
  for (const auto& [text, more] :
       {std::pair{six_masses(proportional, "", ""), std::string("5.0")},
        std::pair{six_masses(proportional, "", ""), std::string("0.001")},  // c presses: too much for modes
        std::pair{six_masses(single_dampers, "normal_damping = 1.5",
                             "history = { type = \"harmonic\", omega = 7.0, phase = 0.4 }"),
                  std::string("5.0")}})
    for (const auto& [engine, flow, off] :
         {std::tuple{"exact", "taylor", 1e-11}, std::tuple{"exact", "modal", 1e-10},
          std::tuple{"ida", "auto", 1e-4}, std::tuple{"newmark", "auto", 1e-10}}) {
      CAPTURE(engine);
      CAPTURE(flow);
      CAPTURE(more);
      Stretch s(text,
                {{"run.engine", engine},
                 {"run.flow", flow},
                 {"run.rtol", "1e-8"},
                 {"run.dt", "3e-3"},
                 {"contacts.c.gap", more}},
                std::vector{0, 1, 2, 3, 4});
      REQUIRE(s.decision.consistent);
      CHECK(s.decision.states[2].is_open() == (more == "5.0"));
      check_points(s, std::string(engine) == "exact", off);
    }
}

TEST_CASE("both flows of exact and newmark of the second order tell the same motion") {
  const std::string text = six_masses(single_dampers, "normal_damping = 1.5", "");
  const auto end = [&](const char* engine, const char* flow, const char* dt) {
    Stretch s(text, {{"run.engine", engine}, {"run.flow", flow}, {"run.dt", dt}, {"run.t_end", "0.3"}});
    const engine::Step last = s.go();
    REQUIRE(last.end == 0.3);
    return s.at(0.3);
  };
  const motion::Point series = end("exact", "taylor", "1e-3"), modes = end("exact", "modal", "1e-3");
  CHECK((modes.u - series.u).norm() < 1e-13);
  CHECK((modes.v - series.v).norm() < 1e-12);
  CHECK((modes.a - series.a).norm() < 1e-10);
  CHECK((modes.forces - series.forces).norm() < 1e-10);
  const double coarse = (end("newmark", "auto", "3e-3").u - series.u).norm(),
               fine = (end("newmark", "auto", "1.5e-3").u - series.u).norm();
  CHECK(coarse / fine == doctest::Approx(4.0).epsilon(0.02));
  CHECK(fine < 1e-4);
}

TEST_SUITE_END();

}  // namespace signorini::tests::points
