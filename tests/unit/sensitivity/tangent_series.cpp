#include "sensitivity/tangent_series.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "behaviour/one_mass.hpp"
#include "signorini/sensitivity.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/sensitivity/tangent_series");

TEST_CASE("a polynomial about another place is the same polynomial") {
  Model model;
  model.dofs.resize(1);
  model.u0 = model.v0 = Vector::Zero(1);
  motion::Series s;
  s.t = 2.0;
  s.scale = 0.5;
  s.levels = 3;
  s.u.resize(1, 6);
  s.u << 1.0, -2.0, 0.5, 3.0, -0.25, 0.125;
  s.forces.resize(2, 6);  // levels 0 to 3, and room that nobody has written to
  s.forces << 1.0, 2.0, -1.0, 0.5, NAN, NAN, 3.0, 0.0, 0.0, -2.0, NAN, NAN;
  motion::Series moved;
  sensitivity::recentre(s, motion::Forcing::none(model), 0.4, 0.5, moved);
  CHECK(moved.t == doctest::Approx(2.2));
  CHECK(moved.scale == doctest::Approx(0.25));
  const auto value = [](const motion::Series& series, double x) {
    double sum = 0.0;
    for (Eigen::Index k = series.u.cols(); k-- > 0;) sum = sum * x + series.u(0, k);
    return sum;
  };
  for (const double x : {-1.0, 0.0, 0.3, 1.0})
    for (Eigen::Index f = 0; f < 2; ++f) {
      const auto force = [f](const motion::Series& series, double z) {
        return series.forces(f, 0) +
               z * (series.forces(f, 1) + z * (series.forces(f, 2) + z * series.forces(f, 3)));
      };
      CHECK(force(moved, x) == doctest::Approx(force(s, 0.4 + 0.5 * x)).epsilon(1e-14));
    }
  for (const double x : {-1.0, 0.0, 0.3, 1.0})
    CHECK(value(moved, x) == doctest::Approx(value(s, 0.4 + 0.5 * x)).epsilon(1e-14));
}

TEST_CASE("ten parameters beside each other are ten parameters one by one") {
  const SceneReader read = reader_of(std::string(SIGNORINI_MODELS) + "/pipeline.toml",
                                     {{"run.t_end", "0.01"}, {"run.output_dt", "0.005"}});
  const std::vector<std::string> paths{"contacts.*.friction",
                                       "loads.1.amplitude",
                                       "contacts.first.friction",
                                       "contacts.second.friction",
                                       "gravity.2",
                                       "sections.pipe.EI",
                                       "contacts.first.normal_stiffness",
                                       "nodes.D.1",
                                       "sections.pipe.mass_per_length",
                                       "contacts.second.tangential_stiffness"};
  const Sensitivities all = sensitivities(read, paths);
  for (const std::size_t p : {std::size_t{0}, std::size_t{5}, std::size_t{9}}) {
    CAPTURE(paths[p]);
    const Sensitivities one = sensitivities(read, {paths[p]});
    REQUIRE(one.events.size() == all.events.size());
    for (std::size_t i = 0; i < one.events.size(); ++i) {
      const double t = one.event_rates[i][0].t;
      CHECK(std::abs(all.event_rates[i][p].t - t) <= 1e-10 * std::abs(t));
    }
    for (std::size_t c = 0; c < one.columns.size(); ++c) {
      const double x = one.value_rates[0].back()[c];
      CHECK(std::abs(all.value_rates[p].back()[c] - x) <= 1e-9 * std::abs(x) + 1e-15);
    }
  }
}

TEST_CASE("the error of a tangent contains the friction that its series do not follow") {
  // A mass slows down from 300 Stribeck velocities: E = exp(-x/v) is zero to its series, and not near the end.
  const Model model = build_model(
      parse_scene(tests::matrix_scene("t_end = 20.0\nengine = \"ida\"\ninitial = { u = [0.0], v = [3.0] }",
                                      "mass = [[1.0]]\nstiffness = [[0.0]]",
                                      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\n"
                                      "friction = { static = 0.5, kinetic = 0.2, stribeck_velocity = 0.01 }"),
                  "test.toml"));
  const linear::SystemMatrices structure(model);
  motion::StateSystems systems(model, structure);
  const motion::Forcing forcing(model, 0.0, motion::Side::after);
  contact::ContactStates states(1);
  states[0].state = State::slip_plus;
  motion::Taylor taylor(systems);
  motion::Series series;
  constexpr double end = 14.99;
  taylor.expand(systems.system_of(states), forcing, 0.0, model.u0, model.v0, 30, end, series);
  sensitivity::ModelDerivative by_velocity;
  by_velocity.mass = by_velocity.damping = by_velocity.stiffness = SparseMatrix(1, 1);
  by_velocity.contacts.resize(1);
  by_velocity.u0 = Vector::Zero(1);
  by_velocity.v0 = Vector::Ones(1);
  sensitivity::TangentSeries tangent(model, structure, by_velocity, 1.0);
  const sensitivity::ForcingRates rates(model, by_velocity, 0.0, motion::Side::after);
  const sensitivity::Tangent start{by_velocity.u0, by_velocity.v0, {0.0}};
  REQUIRE(tangent.expand(*taylor.system(), series, rates, start, 0.5, 12));
  CHECK(tangent.error() < 1e-12);
  REQUIRE(tangent.expand(*taylor.system(), series, rates, start, 1.0, 12));
  CHECK(tangent.error() > 0.1);
  // Over a part that is as long as friction needs the error is rounding again.
  const double reach = taylor.friction_reach(30, 1.0);
  CHECK(reach > 0.7);
  CHECK(reach < 0.95);
  REQUIRE(tangent.expand(*taylor.system(), series, rates, start, reach, 12));
  CHECK(tangent.error() < 1e-12);
}
