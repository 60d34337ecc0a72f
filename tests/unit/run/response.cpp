// Extremes of outputs along motions whose closed form is known.
#include "run/response.hpp"

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
struct Known : Stepper {
  void start(const Segment&) override {}
  Step advance() override { return {}; }
  void evaluate(double t, Point& p) override {
    ++asked;
    p.u = Vector::Constant(1, std::exp(-0.1 * t) * std::sin(3.0 * t));
    p.v = Vector::Constant(1, std::exp(-0.1 * t) * (3.0 * std::cos(3.0 * t) - 0.1 * std::sin(3.0 * t)));
    p.a = Vector::Zero(1);
    const double N = 1e8 * std::cos(5.0 * t), noise = 1e-8 * std::sin(1e7 * t * t);
    p.forces = Vector::Zero(4);
    p.forces[0] = N;
    p.forces[2] = -N + noise;
  }
  void integrate(double, double, Works&) override {}
  double residual() override { return 0.0; }
  double guard_error(const Form&, const ContactMotion&, std::size_t) const override { return 0.0; }
  long asked = 0;
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

TEST_SUITE_BEGIN("unit/run/response");

TEST_CASE("extremes of a decaying sine between two rows: times and values of the closed form") {
  Output output;
  output.constant = 0.5;
  output.u.terms = {{0, -2.0}};
  const Model model = model_with(output);
  Rows rows;
  Known motion;
  ResponseWatch watch(model, 20.0, rows, true);
  Point point;
  motion.evaluate(0.0, point);
  watch.row(0.0, Side::after, point, {});
  watch.inside(motion, 0.0, 20.0);
  motion.evaluate(20.0, point);
  watch.row(20.0, Side::after, point, {});
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

TEST_CASE(
    "a sum that is the rounding of its terms is settled as such, not halved down to the fastest motion") {
  Output output;
  output.forces = {{0, 1.0, 0.0}, {1, 1.0, 0.0}};
  const Model model = model_with(output);
  Rows rows;
  Known motion;
  ResponseWatch watch(model, 20.0, rows, true);
  Point point;
  motion.evaluate(0.0, point);
  watch.row(0.0, Side::after, point, {});
  motion.asked = 0;
  watch.inside(motion, 0.0, 20.0);
  // 100 rad of the fastest motion in four parts, of 17 points and a few turns each
  CHECK(motion.asked < 4 * 40);
  CHECK(watch.extremes()[0].maximum <= 2e-8);
}

TEST_SUITE_END();

}  // namespace signorini::tests::responses
