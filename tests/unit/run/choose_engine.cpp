#include "run/choose_engine.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "contact/contact_states.hpp"
#include "engine/ida/restart_order.hpp"
#include "model/slip_growth.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

/// A mass of 1 on a spring of 100 (omega 10) and a dashpot; slides on a floor.
Scene oscillator(double dashpot, const std::string& engine, const std::string& friction = "0.3") {
  return parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = 1.0
initial = {{ u = [1.0], v = [0.0] }}
{}
[matrices]
dofs = ["x"]
mass = [[1.0]]
damping = [[{}]]
stiffness = [[100.0]]
[[contacts]]
name = "floor"
law = "slider"
tangent = {{ x = 1.0 }}
normal_force = 1.0
friction = {}
)",
                                 engine, dashpot, friction),
                     "test.toml");
}

std::string computed_by(const Scene& scene) {
  const Result result = simulate(build_model(scene), scene.run);
  CHECK(result.report.outcome.kind == Outcome::Kind::done);
  const Method& method = result.report.method;
  return std::string(to_string(method.engine)) + " " + method.engine_reason().substr(0, 8);
}

}  // namespace

TEST_SUITE_BEGIN("unit/run/choose_engine");

TEST_CASE("engine auto: exact unless decay is faster than oscillation or a law is not linear") {
  CHECK(computed_by(oscillator(0.0, "")) == "ida as given");
  CHECK(computed_by(oscillator(1.9, "engine = \"auto\"")) == "exact auto: th");
  CHECK(computed_by(oscillator(2.1, "engine = \"auto\"")) == "ida auto: th");
  CHECK(computed_by(oscillator(0.0, "engine = \"auto\"",
                               "{ static = 0.3, kinetic = 0.2, stribeck_velocity = 0.1 }")) ==
        "ida auto: a ");
  CHECK(computed_by(oscillator(1e3, "engine = \"exact\"")) == "exact as given");
  CHECK(computed_by(oscillator(0.0, "engine = \"ida\"")) == "ida as given");
}

TEST_CASE("max_order auto: below rtol 1e-4 always 5; above, what is stable for the least damped mode") {
  Model model;
  model.omega1 = 10.0;
  model.omega_max = 1000.0;
  RunSpec run;
  const auto order = [&](double rtol, double alpha, double beta) {
    run.rtol = rtol;
    model.alpha = alpha;
    model.beta = beta;
    return ida::choose_order(model, run).max_order;
  };
  CHECK(order(1e-4, 0.0, 0.0) == 5);
  CHECK(order(1e-3, 0.0, 0.0) == 2);
  CHECK(order(1e-3, 0.0, 1.0) == 2);  // slow motions are hardly damped by beta K
  CHECK(order(1e-3, 0.0694, 0.0694) == 3);
  CHECK(order(1e-3, 0.0690, 0.0690) == 2);
  CHECK(order(1e-3, 0.2870, 0.2870) == 4);
  CHECK(order(1e-3, 2.0 * 0.6180 * 1000.0, 0.0) == 5);  // zeta of omega_max, the least
  CHECK(model::min_damping_ratio(model) == doctest::Approx(0.618));
  model.alpha = 10.0;
  model.beta = 1e-3;  // least between: sqrt(alpha beta)
  CHECK(model::min_damping_ratio(model) == doctest::Approx(0.1));
  Contact spring;
  spring.normal_stiffness = 1.0;
  model.contacts = {spring};  // which beta K does not damp
  model.layout = contact::layout_of(model.contacts);
  CHECK(model::min_damping_ratio(model) == doctest::Approx(0.005));
}
