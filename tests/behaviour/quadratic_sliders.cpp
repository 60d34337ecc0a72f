// A slider on which |T|^2 <= F^2 is one quadratic guard: the events of the built-in slider with its two linear guards.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "signorini/modified_law.hpp"
#include "signorini/simulate.hpp"
#include "signorini/user_contact_law.hpp"

using namespace signorini;

namespace {

class DiscLaw final : public ModifiedLaw {
 public:
  explicit DiscLaw(Law base) : ModifiedLaw(base, false) {}
  [[nodiscard]] std::string name() const override { return "disc"; }
  [[nodiscard]] Guards guards(const Contact& contact, const ContactState& now) const override {
    Guards result = base().guards(contact, now);
    if (now.state != State::stick) return result;
    const std::vector<FormProduct> product = {{result[1].form, result[2].form}};
    result[1] = {Guard::friction_limit, {}, std::make_shared<const std::vector<FormProduct>>(product)};
    result[2] = {};
    return result;
  }
};

/// The slider with tangential stiffness, as data. products: the friction limit as one guard; which way the contact slips is
/// decided by the sign of T.
std::shared_ptr<UserContactLaw> data_slider(double stiffness, double fs, double fk, bool products) {
  using enum State;
  const UserLawForm given{{.N = 1.0, .applied_normal_force = 1.0}},
      held{{.T = 1.0, .ut = -stiffness}, stiffness};
  const Form minus{.T = 1.0, .applied_normal_force = fs}, plus{.T = -1.0, .applied_normal_force = fs};
  auto law = std::make_shared<UserContactLaw>();
  law->normal_force_given = true;
  if (products)
    law->states.push_back({"rests", stick, given, held, {{{}, 3, {}, {{plus, minus}}}}});
  else
    law->states.push_back({"rests", stick, given, held, {{{plus}, 1}, {{minus}, 2}}});
  for (const double s : {1.0, -1.0})
    law->states.push_back({"slides",
                           s > 0.0 ? slip_plus : slip_minus,
                           given,
                           {{.N = s * fk, .T = 1.0}},
                           {{{{.vt = s, .applied_normal_force_rate = -fk / stiffness}},
                             0,
                             Form{.T = -1.0 / stiffness, .ut = 1.0}}}});
  if (products)
    law->states.push_back({"leaves", stick, given, held, {{{{.T = 1.0}}, 2}, {{{.T = -1.0}}, 1}}});
  return law;
}

struct SliderCase {
  std::string friction = "0.4";
  std::string normal_force = "10.0";
  std::string surface = "0.0";
  std::string spring;  // line of tangential_stiffness; empty: none
  double angle = 0.37;
};

/// A block on springs of unequal stiffness, so that motions along and across the turned tangent are coupled.
Scene slider_scene(const SliderCase& of, const std::string& engine) {
  const double c = std::cos(of.angle), s = std::sin(of.angle);
  return parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 3.0, engine = "{}", rtol = 1e-10, output_dt = 0.1, initial = {{}} }}
nodes = {{ block = [0.0, 0.0] }}
masses = [{{ node = "block", mass = 1.3 }}]
springs = [
  {{ node = "block", direction = [1.0, 0.0], stiffness = 70.0 }},
  {{ node = "block", direction = [0.0, 1.0], stiffness = 130.0, damping = 0.8 }}]
[[contacts]]
name = "p"
node = "block"
law = "slider"
tangent = [{}, {}]
normal_force = {}
surface_velocity = {}
friction = {}
{}
[[loads]]
node = "block"
direction = [{}, {}]
amplitude = 9.0
history = {{ type = "harmonic", omega = 11.0 }}
[[loads]]
node = "block"
direction = [0.0, 1.0]
amplitude = 3.0
history = {{ type = "harmonic", omega = 5.0 }}
)",
                                 engine, c, s, of.normal_force, of.surface, of.friction, of.spring, c, s),
                     "slider.toml");
}

Result result_of(const Scene& scene) { return simulate(build_model(scene), scene.run); }

std::string objection(const Scene& scene) {
  try {
    static_cast<void>(result_of(scene));
  } catch (const SceneError& e) {
    return e.what();
  }
  return {};
}

/// Number of events of this type that slip in this direction.
long slips(const Result& result, int sign) {
  long count = 0;
  for (const Event& e : result.events) count += e.type != EventType::time && slip_sign(e.to) == sign ? 1 : 0;
  return count;
}

void check_same(const Result& linear, const Result& disc, double relative) {
  CHECK(disc.report.outcome.kind == Outcome::Kind::done);
  REQUIRE(linear.events.size() == disc.events.size());
  for (std::size_t i = 0; i < linear.events.size(); ++i) {
    const Event &a = linear.events[i], &b = disc.events[i];
    CHECK(a.type == b.type);
    CHECK(a.from == kind_of(b.from));
    CHECK(a.to == kind_of(b.to));
    CHECK(std::abs(a.t - b.t) <= relative * a.t);
    CHECK(std::abs(a.T - b.T) <= 10.0 * relative * 10.0);
  }
  CHECK((linear.rows.back().u - disc.rows.back().u).norm() <= relative * 10.0);
}

std::vector<SliderCase> cases() {
  const std::string spring_key = "tangential_stiffness = 900.0";
  const std::string drop = "{ static = 0.5, kinetic = 0.3 }";
  const std::string varying = "{ type = \"harmonic\", offset = 10.0, amplitude = 4.0, omega = 7.0 }";
  const std::string ramp = "{ type = \"polynomial\", coefficients = [14.0, -3.0] }";
  const std::string belt = "{ type = \"harmonic\", offset = 0.05, amplitude = 0.2, omega = 3.0 }";
  std::vector<SliderCase> all;
  for (const std::string& spring : {std::string(), spring_key})
    for (const std::string& friction : {std::string("0.4"), drop})
      for (const std::string& force : {std::string("10.0"), varying, ramp})
        for (const std::string& surface : {std::string("0.0"), belt})
          all.push_back({friction, force, surface, spring});
  all.push_back({"0.4", varying, belt, spring_key, 0.0});
  all.push_back({drop, varying, belt, "", 2.2});
  return all;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/quadratic_sliders");

TEST_CASE("one quadratic guard of a slider has the events of two linear ones") {
  long plus = 0, minus = 0;
  for (const std::string engine : {"exact", "ida"})
    for (const SliderCase& of : cases()) {
      CAPTURE(engine);
      CAPTURE(of.friction);
      CAPTURE(of.normal_force);
      CAPTURE(of.surface);
      CAPTURE(of.spring);
      const Scene linear = slider_scene(of, engine);
      Scene disc = linear;
      disc.contacts[0].user_law = std::make_shared<DiscLaw>(Law::slider);
      const Result a = result_of(linear), b = result_of(disc);
      CHECK(b.report.method.engine == linear.run.engine);
      CHECK(a.events.size() > 4);
      check_same(a, b, engine == "exact" ? 1e-11 : 1e-7);
      plus += slips(b, 1);
      minus += slips(b, -1);
    }
  CHECK(plus > 100);
  CHECK(minus > 100);
}

TEST_CASE("a slider as data has the events of the built-in slider") {
  std::size_t events = 0;
  for (const std::string engine : {"exact", "ida"})
    for (const bool products : {false, true})
      for (const SliderCase& of : cases()) {
        if (of.spring.empty()) continue;
        CAPTURE(engine);
        CAPTURE(products);
        CAPTURE(of.friction);
        CAPTURE(of.normal_force);
        CAPTURE(of.surface);
        const Scene built = slider_scene(of, engine);
        Scene own = built;
        const Friction& friction = built.contacts[0].friction;
        own.contacts[0].user_law = data_slider(*built.contacts[0].tangential_stiffness, friction.static_,
                                               friction.kinetic, products);
        own.contacts[0].friction = {};
        const Result a = result_of(built), b = result_of(own);
        check_same(a, b, engine == "exact" ? 1e-11 : 1e-7);
        CHECK(b.report.audit.energy.value < 1e-6 * b.report.audit.energy_scale);
        events += b.events.size();
      }
  CHECK(events > 500);
}

TEST_CASE("engines that know linear guards only refuse a law with products by its name") {
  Scene scene = slider_scene({}, "exact");
  scene.run.engine = Engine::newmark;
  scene.run.dt = 1e-3;
  CHECK(objection(scene).empty());
  scene.contacts[0].user_law = std::make_shared<DiscLaw>(Law::slider);
  CHECK(objection(scene).find("does not support law \"disc\" of contact 'p'; use \"ida\"") !=
        std::string::npos);
  scene.run.engine = Engine::friction_iteration;
  CHECK(objection(scene).find("does not support law \"disc\" of contact 'p'") != std::string::npos);
  scene.run.engine = Engine::exact;
  scene.run.flow = Flow::modal;
  CHECK(objection(scene).find("user-defined laws; use \"taylor\"") != std::string::npos);
}

TEST_CASE("a user law determines N in the way of the law that the scene names") {
  Scene scene = slider_scene({}, "exact");
  scene.contacts[0].user_law = std::make_shared<DiscLaw>(Law::compliant);
  CHECK(objection(scene).find(
            "whose N is that of a spring, together with law = \"slider\", whose N is given") !=
        std::string::npos);
}

TEST_SUITE_END();
