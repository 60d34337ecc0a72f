#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "behaviour/one_mass.hpp"
#include "behaviour/scene_parts.hpp"
#include "engine/newmark/newmark_step.hpp"
#include "unit/engine/stretch.hpp"

namespace signorini::tests::newmark_engines {
namespace {

const std::vector<Override> steps{{"run.engine", "newmark"}, {"run.dt", "0.3"}};

/// A block that friction stops: u'' = -1, u' = 1 - t, at rest from t = 1 on.
const std::string block =
    matrix_scene("t_end = 3.0\ninitial = { u = [0.0], v = [1.0] }", "mass = [[2.0]]\nstiffness = [[0.0]]",
                 "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 4.0\nfriction = 0.5");

/// A ball under gravity above a floor: u = 0.5 - 0.2 t - 5 t^2.
const std::string ball =
    matrix_scene("t_end = 3.0\ninitial = { u = [0.5], v = [-0.2] }", "mass = [[2.0]]\nstiffness = [[0.0]]",
                 "law = \"rigid\"\nnormal = { d0 = 1.0 }\nrestitution = 0.5",
                 "[[loads]]\ndirection = { d0 = -1.0 }\namplitude = 20.0\n");

}  // namespace

TEST_SUITE_BEGIN("unit/engine/newmark/newmark_engine");

TEST_CASE("a block that friction stops: the steps are exact, the slip rate falls at t = 1, works are f N u") {
  Stretch s(block, steps);
  motion::WorkIntegrals works(1);
  long taken = 0;
  const engine::Step last = s.go([&](const engine::Step& step) {
    ++taken;
    for (const double x : {0.2, 0.5, 1.0}) {
      const double t = step.begin + x * (step.end - step.begin);
      const motion::Point p = s.at(t);
      CHECK(p.u[0] == doctest::Approx(t - 0.5 * t * t).epsilon(1e-13));
      CHECK(p.v[0] == doctest::Approx(1.0 - t).epsilon(1e-12));
      CHECK(p.T(s.model.layout, 0) == doctest::Approx(2.0).epsilon(1e-14));
      motion::Point curve;
      s.engine->dense_output().interpolate(t, curve);
      CHECK(curve.u[0] == doctest::Approx(p.u[0]).epsilon(1e-13));
    }
    const double middle = step.begin + 0.4 * (step.end - step.begin);
    s.engine->dense_output().integrate(step.begin, middle, works);
    s.engine->dense_output().integrate(middle, step.end, works);
  });
  CHECK(taken == 4);
  REQUIRE(last.kind == engine::Step::Kind::event);
  REQUIRE(last.triggered.size() == 1);
  CHECK(last.triggered[0].guard == Guard::sliding);
  CHECK(last.end == doctest::Approx(1.0).epsilon(1e-14));
  CHECK(works.friction[0] == doctest::Approx(2.0 * 0.5).epsilon(1e-13));
  CHECK(works.applied_normal_force[0] == doctest::Approx(4.0).epsilon(1e-13));
  // Constant acceleration: what a step leaves out is nothing.
  Form rate;
  rate.vt = 1.0;
  CHECK(s.engine->guard_error({Guard::sliding, rate}, {}, 0) < 1e-14);
  REQUIRE(s.pass(last));
  CHECK(s.go().end == 3.0);
  CHECK(s.at(3.0).u[0] == doctest::Approx(0.5).epsilon(1e-13));
}

TEST_CASE("a fall between steps is found where the motion has it, the rebound half as fast") {
  for (const char* refine : {"root", "linear"}) {
    CAPTURE(refine);
    std::vector<Override> changes = steps;
    changes.push_back({"run.refine", refine});
    Stretch s(ball, changes);
    double t = (-0.2 + std::sqrt(0.04 + 10.0)) / 10.0, speed = 0.2 + 10.0 * t, begin = 0.0;
    for (int hit = 0; hit < 4; ++hit) {
      CAPTURE(hit);
      const engine::Step last = s.go();
      REQUIRE(last.kind == engine::Step::Kind::event);
      CHECK(last.triggered[0].guard == Guard::closing);
      CHECK(last.end == doctest::Approx(begin + t).epsilon(1e-13));
      CHECK(s.at(last.end).v[0] == doctest::Approx(-speed).epsilon(1e-12));
      REQUIRE(s.pass(last));
      CHECK(s.decision.v[0] == doctest::Approx(0.5 * speed).epsilon(1e-12));
      begin += t;
      speed *= 0.5;
      t = 0.2 * speed;
    }
  }
}

TEST_CASE("what a step leaves out of a guard: h^2/12 of the change of u'', and h/12 of the change of that") {
  // u'' = -w^2 u from rest at 1: in one step from the start a changes by w^2 (1 - u1)
  Stretch s(
      matrix_scene("t_end = 3.0\ninitial = { u = [1.0], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[4.0]]",
                   "law = \"compliant\"\nnormal = { d0 = 1.0 }\ngap = 10.0\nnormal_stiffness = 7.0"),
      {{"run.engine", "newmark"}, {"run.dt", "0.1"}});
  const double h = 0.1, half = 0.01;                            // (w h / 2)^2
  const double angle = std::acos((1.0 - half) / (1.0 + half));  // of a step
  Form gap, rate;
  gap.gap = rate.vn = 1.0;
  for (int i = 1; i < 5; ++i) {
    CAPTURE(i);
    (void)s.engine->advance();
    const auto a = [&](int j) { return -4.0 * std::cos(angle * j); };
    CHECK(s.engine->guard_error({Guard::closing, gap}, {}, 0) ==
          doctest::Approx(h * h / 12.0 * std::abs(a(i) - a(i - 1))).epsilon(1e-9));
    const double before = i > 1 ? a(i - 1) - a(i - 2) : 0.0;
    CHECK(s.engine->guard_error({Guard::sliding, rate}, {}, 0) ==
          doctest::Approx(h / 12.0 * std::abs(a(i) - a(i - 1) - before)).epsilon(1e-9));
  }
}

TEST_CASE(
    "doubling takes the first of dt, dt/2, ... whose error is within the tolerance of motions of any size") {
  // u'' = -w^2 u turns by 2 atan(w h/2) in a step: two of h beside one of 2h, from u = A cos p, v = -A w sin p
  const double w = 2.0, rtol = 1e-4;
  for (const double A : {0x1p-10, 1.0, 0x1p10})
    for (const double phase : {0.5, 1.1})
      for (const double dt : {0.5, 0.7}) {
        CAPTURE(A);
        CAPTURE(phase);
        CAPTURE(dt);
        Stretch s(matrix_scene(fmt::format("t_end = 30.0\ninitial = {{ u = [{:.17g}], v = [{:.17g}] }}",
                                           A * std::cos(phase), -A * w * std::sin(phase)),
                               "mass = [[1.0]]\nstiffness = [[4.0]]",
                               fmt::format("law = \"compliant\"\nnormal = {{ d0 = 1.0 }}\ngap = {}\n"
                                           "normal_stiffness = 7.0",
                                           10.0 * A)),
                  {{"run.engine", "newmark"},
                   {"run.step", "doubling"},
                   {"run.dt", fmt::format("{}", dt)},
                   {"run.rtol", fmt::format("{}", rtol)},
                   {"run.atol.displacement", fmt::format("{:.17g}", 1e-9 * A)},
                   {"run.atol.velocity", fmt::format("{:.17g}", 1e-9 * A)}});
        const auto turned = [&](double h) { return 2.0 * std::atan(0.5 * w * h); };
        const auto off = [&](double fine, double coarse) {
          return std::abs(fine - coarse) / (rtol * std::abs(fine) + 1e-9);
        };
        double h = 2.0 * dt, change = 0.0;
        do {
          h *= 0.5;
          const double fine = phase + 2.0 * turned(h), coarse = phase + turned(2.0 * h);
          change =
              std::max(off(std::cos(fine), std::cos(coarse)), off(w * std::sin(fine), w * std::sin(coarse)));
        } while (change > 1.0);
        REQUIRE(h < dt);
        CHECK(s.engine->advance().end == doctest::Approx(h).epsilon(1e-14));
        CHECK(s.engine->advance().end == doctest::Approx(2.0 * h).epsilon(1e-14));
      }
}

TEST_CASE(
    "falls on a long beam are those of whole steps by a general method, found with one whole step more") {
  constexpr int nodes = 250;
  for (const double turn : {0.0, 0.3}) {
    const auto vector = [&](double x, double y) {
      return fmt::format("[{:.17g}, {:.17g}]", std::cos(turn) * x - std::sin(turn) * y,
                         std::sin(turn) * x + std::cos(turn) * y);
    };
    std::string text = parts::head + "gravity = " + vector(0.0, -9.81) + "\n" +
                       parts::run_table(0.012, 0.004, "static") +
                       "[damping]\nratios = [0.02, 0.02]\nfrequencies = [1.0, 30.0]\n" +
                       parts::section(2.1e6, 2.1e4, 0.1) + "[nodes]\n";
    std::string names, more;
    for (int i = 0; i < nodes; ++i) {
      text += fmt::format("b{} = {}\n", i, vector(2.0 * i, 0.0));
      names += fmt::format("{}\"b{}\"", i > 0 ? ", " : "", i);
      more += fmt::format(
          "[[contacts]]\nname = \"c{0}\"\nnode = \"b{0}\"\nlaw = \"compliant\"\nnormal = {1}\n"
          "normal_stiffness = 1e4\ntangential_stiffness = 1e4\nfriction = 0.3\n",
          i, vector(0.0, 1.0));
      if (i % 9 == 3)
        more += fmt::format(
            "[[loads]]\nnode = \"b{}\"\ndirection = {}\namplitude = {}\nhistory = {{ type = \"harmonic\", "
            "omega = {} }}\n",
            i, vector(0.3 * std::sin(1.7 * i), 1.0), 20.0 + 5.0 * (i % 7), 300.0 + 7.0 * (i % 5));
    }
    text += "[[members]]\nnodes = [" + names + "]\nsection = \"s\"\nelements = 1\n" + more;
    Stretch s(text, {{"run.engine", "newmark"}, {"run.dt", "1e-4"}});
    REQUIRE(s.decision.consistent);
    int events = 0;
    for (; events < 60; ++events) {
      CAPTURE(turn);
      CAPTURE(events);
      const engine::Step last = s.go();
      if (last.kind != engine::Step::Kind::event) break;
      const auto& [contact, kind, unseen] = last.triggered.at(0);
      std::size_t slot = s.model.layout.guard(contact);
      while (s.decision.guards[slot].kind != kind) ++slot;
      newmark::NewmarkStep whole(s.model, s.structure, 0);
      whole.set({0}, s.decision.system->rows());
      const motion::Point from = s.at(last.begin);
      const auto value = [&](double h, double& rounding) {
        motion::Point to;
        REQUIRE(whole.take(s.forcing, from, last.begin + h, h, false, to));
        const ContactMotion m =
            motion::motion_of(s.model.contacts[contact], contact, s.forcing, last.begin + h, to);
        rounding = rounding::many_operations * s.decision.form(slot).magnitude(m);
        return s.decision.form(slot).value(m);
      };
      const double h = last.end - last.begin, apart = 1e-11;
      double rounding = 0.0, of_others = 0.0;
      const double now = value(h, rounding), after = value(h + apart, of_others);
      CHECK(after < 0.0);
      if (h > apart) CHECK(value(h - apart, of_others) > 0.0);
      CHECK(std::abs(now) <= rounding + std::abs(after - now) / apart * last.resolution);
      REQUIRE(s.pass(last));
    }
    CHECK(events > 20);
    const Counters& counters = s.engine->counters;
    CAPTURE(counters.steps);
    CHECK(counters.solves <=
          2 * counters.steps + events / 4);  // some falls are passed on the way to an earlier one
    CHECK(counters.guard_evaluations > events);
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::newmark_engines
