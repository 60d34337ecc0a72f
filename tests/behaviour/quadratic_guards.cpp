// The limit of friction as one guard, F^2 - T^2 > 0, in place of F - T > 0 and F + T > 0: the same events.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "signorini/simulate.hpp"
#include "signorini/user_contact_law.hpp"

using namespace signorini;

namespace {

constexpr double kn = 1e4, kt = 5e3, f = 0.4;

/// The compliant law with friction. Which way a contact slips that has left the disc is decided by the sign of T alone:
/// of the two guards of "leaves" one holds.
std::shared_ptr<UserContactLaw> disc_law() {
  using enum State;
  const UserLawForm spring{{.N = 1.0, .gap = -kn}}, held{{.T = 1.0, .ut = -kt}, kt};
  const UserLawGuard lets_go{{{.N = -1.0}}, 0};
  const Form plus{.N = -f, .T = 1.0}, minus{.N = -f, .T = -1.0};
  auto law = std::make_shared<UserContactLaw>();
  law->states.push_back({"off", open, {{.N = 1.0}}, {{.T = 1.0}}, {{{{.gap = 1.0}}, 1, Form{.ut = 1.0}}}});
  law->states.push_back({"rests", stick, spring, held, {lets_go, {{}, 4, {}, {{plus, minus}}}}});
  for (const double s : {1.0, -1.0})
    law->states.push_back({"slides",
                           s > 0.0 ? slip_plus : slip_minus,
                           spring,
                           {{.N = s * f, .T = 1.0}},
                           {lets_go, {{{.vn = f * kn / kt, .vt = s}}, 1, Form{.T = -1.0 / kt, .ut = 1.0}}}});
  law->states.push_back({"leaves", stick, spring, held, {lets_go, {{{.T = 1.0}}, 3}, {{{.T = -1.0}}, 2}}});
  return law;
}

/// A block on a compliant ground that is turned by an angle, pushed along it and pressed on it by loads of time.
Scene block(double angle, double lift, const std::string& engine) {
  const double c = std::cos(angle), s = std::sin(angle);
  return parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
gravity = [{0}, {1}]
run = {{ t_end = 2.0, engine = "{6}", rtol = 1e-10, output_dt = 0.1, initial = {{}} }}
nodes = {{ block = [0.0, 0.0] }}
masses = [{{ node = "block", mass = 1.0 }}]
springs = [{{ node = "block", direction = [{2}, {3}], stiffness = 60.0 }}]
[[contacts]]
name = "p"
node = "block"
law = "compliant"
normal = [{4}, {2}]
gap = 0.002
normal_stiffness = 1e4
tangential_stiffness = 5e3
friction = 0.4
[[loads]]
node = "block"
direction = [{2}, {3}]
amplitude = 7.0
history = {{ type = "harmonic", omega = 11.0 }}
[[loads]]
node = "block"
direction = [{4}, {2}]
amplitude = {5}
history = {{ type = "harmonic", omega = 17.0 }}
)",
                                 9.81 * s, -9.81 * c, c, s, -s, lift, engine),
                     "block.toml");
}

Result run_scene(const Scene& scene) { return simulate(build_model(scene), scene.run); }

}  // namespace

TEST_SUITE_BEGIN("behaviour/quadratic_guards");

TEST_CASE("one quadratic guard has the events of two linear ones") {
  std::size_t slips = 0;
  for (const std::string engine : {"exact", "ida"})
    for (const double angle : {0.0, 0.37})
      for (const double lift : {0.0, 6.0, 14.0}) {  // N stands after it has landed, varies, comes to zero
        CAPTURE(engine);
        CAPTURE(angle);
        CAPTURE(lift);
        const Scene linear = block(angle, lift, engine);
        Scene disc = linear;
        disc.contacts[0].friction = {};
        disc.contacts[0].user_law = disc_law();
        const Result a = run_scene(linear), b = run_scene(disc);
        CHECK(b.report.outcome.kind == Outcome::Kind::done);
        CHECK(b.report.method.engine == linear.run.engine);
        REQUIRE(a.events.size() == b.events.size());
        for (std::size_t i = 0; i < a.events.size(); ++i) {
          CHECK(a.events[i].type == b.events[i].type);
          CHECK(a.events[i].to == kind_of(b.events[i].to));
          CHECK(std::abs(a.events[i].t - b.events[i].t) <= (engine == "exact" ? 1e-11 : 1e-6));
          if (a.events[i].type == EventType::slip) ++slips;
        }
        CHECK((a.rows.back().u - b.rows.back().u).norm() <= (engine == "exact" ? 1e-11 : 1e-6));
      }
  CHECK(slips > 50);
}

TEST_SUITE_END();
