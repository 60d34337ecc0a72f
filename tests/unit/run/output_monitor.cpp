// Extremes of outputs along motions whose closed form is known.
#include "run/output_monitor.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "behaviour/one_mass.hpp"

namespace signorini::tests::responses {
namespace {

struct Rows : Recorder {
  void event(const Event&) override {}
  void sample(const Sample&) override {}
  void response(double t, const std::vector<double>& values) override { rows.push_back({t, values.front()}); }
  std::vector<std::pair<double, double>> rows;
};

/// u = e^-t/10 sin 3 t and N = 1e8 cos 5 t on both contacts, off by some roundings of it.
struct Known : engine::DenseOutput {
  void evaluate(double t, motion::Point& p) override {
    ++asked;
    p.u = Vector::Constant(1, std::exp(-0.1 * t) * std::sin(3.0 * t));
    p.v = Vector::Constant(1, std::exp(-0.1 * t) * (3.0 * std::cos(3.0 * t) - 0.1 * std::sin(3.0 * t)));
    p.a = Vector::Zero(1);
    const double N = 1e8 * std::cos(5.0 * t), noise = 1e-8 * std::sin(1e7 * t * t);
    p.forces = Vector::Zero(4);
    p.forces[0] = N;
    p.forces[2] = -N + noise;
  }
  void integrate(double, double, motion::WorkIntegrals&) override {}
  double residual() override { return 0.0; }
  engine::StepFacts facts() const override { return {}; }
  long asked = 0;
};

/// u = sin 3 t + fast sin 1e4 t, as an engine that knows both.
struct Rippled : Known, engine::FastModes {
  explicit Rippled(double of_fast) : fast(of_fast) {}
  void evaluate(double t, motion::Point& p) override {
    Known::evaluate(t, p);
    p.u = Vector::Constant(1, std::sin(3.0 * t) + fast * std::sin(1e4 * t));
  }
  engine::StepFacts facts() const override {
    engine::StepFacts facts;
    facts.fast_modes = this;
    return facts;
  }
  std::optional<engine::FastModeBound> fast_mode_bound(double omega) const override {
    const double u = (omega < 1e4 ? fast : 0.0) + (omega < 3.0 ? 1.0 : 0.0);
    return engine::FastModeBound{u, 1e4 * u, 1e8 * u, Vector::Zero(4)};
  }
  engine::FastModeBound term_sizes() const override {
    return engine::FastModeBound{1.0, 3.0, 9.0, Vector::Zero(4)};
  }
  double form_norm(const Combination& form) const override { return form.magnitude(Vector::Ones(1)); }
  double fast;
};

Model model_with(const Output& output) {
  Model model = build_model(parse_scene(
      matrix_scene(
          "t_end = 20.0", "mass = [[1.0]]\nstiffness = [[25.0]]",
          "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.1\n"
          "tangential_stiffness = 1.0\n[[contacts]]\nname = \"d\"\nlaw = \"slider\"\ntangent = { d0 = 1.0 }\n"
          "normal_force = 1.0\nfriction = 0.1\ntangential_stiffness = 1.0"),
      "test.toml"));
  model.outputs = {output};
  return model;
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/output_monitor");

TEST_CASE("extremes of a decaying sine between two rows: times and values of the closed form") {
  Output output;
  output.constant = 0.5;
  output.u.terms = {{0, -2.0}};
  const Model model = model_with(output);
  Rows rows;
  Known motion;
  run::OutputMonitor watch(model, 20.0, rows, true);
  motion::Point point;
  motion.evaluate(0.0, point);
  watch.row(0.0, motion::Side::after, point, {});
  watch.search_step(motion, 0.0, 20.0);
  motion.evaluate(20.0, point);
  watch.row(20.0, motion::Side::after, point, {});
  // u' = 0 at tan 3t = 30; the first is the highest, the second the lowest
  const double first = std::atan(30.0) / 3.0, second = first + M_PI / 3.0;
  const auto value = [](double t) { return 0.5 - 2.0 * std::exp(-0.1 * t) * std::sin(3.0 * t); };
  const OutputExtremes& e = watch.extremes()[0];
  CHECK(e.minimum == doctest::Approx(value(first)).epsilon(1e-13));
  CHECK(e.t_minimum == doctest::Approx(first).epsilon(1e-6));
  CHECK(e.maximum == doctest::Approx(value(second)).epsilon(1e-13));
  CHECK(e.t_maximum == doctest::Approx(second).epsilon(1e-6));
  CHECK(e.last == doctest::Approx(value(20.0)).epsilon(1e-14));
  REQUIRE(rows.rows.size() == 2);
  CHECK(rows.rows[0].second == 0.5);
}

TEST_CASE("a pulse asks for a finer search while it acts, not after") {
  Output output;
  output.constant = 0.5;
  output.u.terms = {{0, -2.0}};
  const auto asked = [&](const char* load) {
    Model model = model_with(output);
    model.loads.emplace_back();
    Piece swing;
    swing.origin = 1.0;
    swing.amplitude = 1.0;
    swing.omega = M_PI / 1e-7;
    if (*load != 0) model.loads.back().history = History({1.0, 1.0 + 1e-7}, {Piece{}, swing, Piece{}});
    Rows rows;
    Known motion;
    run::OutputMonitor watch(model, 20.0, rows, true);
    motion::Point point;
    motion.evaluate(0.0, point);
    watch.row(0.0, motion::Side::after, point, {});
    const double ends[] = {0.0, 1.0, 1.0 + 1e-7, 20.0};
    for (int i = 0; i < 3; ++i) watch.search_step(motion, ends[i], ends[i + 1]);
    CHECK_FALSE(watch.coarse_warning());
    const double first = std::atan(30.0) / 3.0;
    CHECK(watch.extremes()[0].t_minimum == doctest::Approx(first).epsilon(1e-6));
    return motion.asked;
  };
  CHECK(asked("pulse") <= asked("") + 17 * 64);  // 32 parts of a radian, and their halves
}

TEST_CASE(
    "a sum that is the rounding of its terms is settled as such, not halved down to the fastest motion") {
  Output output;
  output.forces = {{0, 1.0, 0.0}, {1, 1.0, 0.0}};
  const Model model = model_with(output);
  Rows rows;
  Known motion;
  run::OutputMonitor watch(model, 20.0, rows, true);
  motion::Point point;
  motion.evaluate(0.0, point);
  watch.row(0.0, motion::Side::after, point, {});
  motion.asked = 0;
  watch.search_step(motion, 0.0, 20.0);
  // 100 rad of the fastest motion in four parts, of 17 points and a few turns each
  CHECK(motion.asked < 4 * 40);
  CHECK(watch.extremes()[0].maximum <= 2e-8);
}

TEST_CASE("what an engine knows to be rounding of an output is not looked for, what shows is") {
  Output output;
  output.u.terms = {{0, -2.0}};
  Model model = model_with(output);
  model.omega_max = 1e4;
  for (const double fast : {1e-14, 1e-10}) {
    CAPTURE(fast);
    Rows rows;
    Rippled motion(fast);
    run::OutputMonitor watch(model, 2.0, rows, true);
    motion::Point point;
    motion.evaluate(0.0, point);
    watch.row(0.0, motion::Side::after, point, {});
    motion.asked = 0;
    watch.search_step(motion, 0.0, 2.0);
    // 2e4 rad are 625 parts of five points at least
    CHECK((motion.asked < 100) == (fast < 1e-12));
    CHECK((motion.asked > 3125) == (fast > 1e-12));
    // Near its turn the slow part falls by 4e-7 within a period of the fast one.
    CHECK(std::abs(watch.extremes()[0].minimum + 2.0) <= 2.0 * fast + 1e-15);
    CHECK(!watch.coarse_warning());
  }
}

TEST_CASE("a motion of more turns than anybody waits for is looked at in coarser parts, and that is said") {
  Output output;
  output.u.terms = {{0, 1.0}};
  Model model = model_with(output);
  model.omega_max = 1e4;
  Rows rows;
  Rippled motion(0.5);
  run::OutputMonitor watch(model, 1e7, rows,
                           true);  // 1e11 rad of the run; a step of 2 of them is passed here
  motion::Point point;
  motion.evaluate(0.0, point);
  watch.row(0.0, motion::Side::after, point, {});
  motion.asked = 0;
  watch.search_step(motion, 0.0, 2.0);
  CHECK(motion.asked < 2000);
  REQUIRE(watch.coarse_warning());
  CHECK(watch.coarse_warning()->find("1e+11 radians") != std::string::npos);
}

TEST_CASE("polynomials of a step need no parts, whatever frequencies the structure has") {
  struct Parabola : Known {
    void evaluate(double t, motion::Point& p) override {
      Known::evaluate(t, p);
      p.u = Vector::Constant(1, t * (1.5 - t));
    }
    engine::StepFacts facts() const override {
      engine::StepFacts facts;
      facts.phase_angle = 6.28;
      return facts;
    }
  };
  Output output;
  output.u.terms = {{0, 4.0}};
  Model model = model_with(output);
  model.omega_max = 1e150;
  Rows rows;
  Parabola motion;
  run::OutputMonitor watch(model, 2.0, rows, true);
  motion::Point point;
  motion.evaluate(0.0, point);
  watch.row(0.0, motion::Side::after, point, {});
  watch.search_step(motion, 0.0, 2.0);
  CHECK(motion.asked < 50);
  CHECK(watch.extremes()[0].maximum == doctest::Approx(4.0 * 0.5625).epsilon(1e-15));
  CHECK(watch.extremes()[0].t_maximum == doctest::Approx(0.75).epsilon(1e-7));
}

TEST_SUITE_END();

}  // namespace signorini::tests::responses
