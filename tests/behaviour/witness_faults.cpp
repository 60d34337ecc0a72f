// Errors that are planted in a run: each that changes the result is noticed by the run's witness, with every engine.
#include <doctest/doctest.h>

#include <cmath>
#include <optional>

#include "contact/motion.hpp"
#include "run/meddler.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("behaviour/witness_faults");

namespace {

/// Two blocks on ground inclined by 0.3 rad, a spring between them; one lands on a rigid floor again and again, the other
/// slides, sticks and lifts off on a compliant foot. Nothing is along an axis.
constexpr const char* scene_text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [0.7, -9.6]
[run]
t_end = 1.5
output_dt = 0.003
rtol = 1e-9
dt = 2e-4
initial = { A = { ux = -0.0295520, uy = 0.0955336, vx = 1.3 }, B = { vx = 0.8, vy = 0.2 } }
[nodes]
A = [0.0, 0.0]
B = [1.0, 0.30933625]
[[masses]]
node = "A"
mass = 1.3
[[masses]]
node = "B"
mass = 2.1
[[springs]]
node = "B"
against = "A"
direction = [0.955336489, 0.295520207]
stiffness = 170.0
[[loads]]
node = "B"
direction = [0.7, 1.0]
amplitude = 27.0
history = { type = "harmonic", frequency = 3.1 }
[[contacts]]
name = "floor"
node = "A"
law = "rigid"
normal = [-0.295520207, 0.955336489]
restitution = 0.6
friction = 0.2
[[contacts]]
name = "foot"
node = "B"
law = "compliant"
normal = [-0.295520207, 0.955336489]
normal_stiffness = 3e4
tangential_stiffness = 2e4
friction = { static = 0.5, kinetic = 0.35 }
)";

struct Way {
  Engine engine;
  Flow flow;
};
constexpr Way ways[] = {{Engine::exact, Flow::taylor},
                        {Engine::exact, Flow::modal},
                        {Engine::ida, Flow::automatic},
                        {Engine::newmark, Flow::automatic}};

Report run_with(const Way& way, Meddler& meddler) {
  Scene scene = parse_scene(scene_text, "planted.toml");
  scene.run.engine = way.engine;
  scene.run.flow = way.flow;
  scene.run.certify = Certify::no;
  Result result;
  return simulate(build_model(scene), scene.run, result, meddler);
}

/// Changes the first decision that it can.
class Once : public Meddler {
 public:
  bool done = false;
  bool change(const Mode& mode, const Vector& v, Decision& decided) override {
    if (done || decided.jet.t < 0.05) return false;
    return done = plant(mode, v, decided);
  }

 protected:
  virtual bool plant(const Mode& mode, const Vector& v, Decision& decided) = 0;
};

class Nothing final : public Meddler {};

/// The hit happens, and leaves no impulse in the record.
class ImpulseLeftOut final : public Once {
  bool plant(const Mode&, const Vector&, Decision& decided) override {
    if (decided.impulses.empty() || !decided.impulses[0].hit) return false;
    decided.impulses.clear();
    return true;
  }
};

/// The hit is swallowed: it is held at rest.
class HitSwallowed final : public Once {
  bool plant(const Mode&, const Vector& v, Decision& decided) override {
    if (decided.impulses.empty() || !decided.impulses[0].hit) return false;
    decided.impulses.clear();
    decided.v = v;
    decided.mode[0] = {State::slip_plus, 0.0};
    return true;
  }
};

class RestitutionIgnored final : public Meddler {
 public:
  void correct(Model& model) override { model.contacts[0].restitution = 0.8; }
};

class WrongSign final : public Once {
  bool plant(const Mode& before, const Vector&, Decision& decided) override {
    if (before[1].state != State::stick) return false;
    State& state = decided.mode[1].state;
    if (state != State::slip_plus && state != State::slip_minus) return false;
    state = state == State::slip_plus ? State::slip_minus : State::slip_plus;
    return true;
  }
};

/// What slides sticks at a hit of the other.
class NeighbourStuck final : public Once {
  bool plant(const Mode& before, const Vector&, Decision& decided) override {
    if (decided.impulses.empty() || !decided.impulses[0].hit) return false;
    if (before[1].state != State::slip_plus && before[1].state != State::slip_minus) return false;
    if (decided.mode[1].state != before[1].state) return false;
    decided.mode[1] = {State::stick, decided.before[1].ut - decided.before[1].T / 2e4};
    return true;
  }
};

class Late final : public Meddler {
 public:
  bool done = false;
  double late(const Step& step, const Decision& before) override {
    if (done || step.fired.empty() || step.end < 0.05 || step.fired[0].contact != 1) return 0.0;
    if (before.mode[1].state != State::stick) return 0.0;
    done = true;
    return by;
  }
  double by = 1e-6;
};

class AnchorReset final : public Once {
  bool plant(const Mode& before, const Vector&, Decision& decided) override {
    if (before[1].is_open() || decided.mode[1].state != State::stick || before[1].state == State::stick)
      return false;
    decided.mode[1].anchor = decided.before[1].ut;
    return true;
  }
};

class Skipped final : public Meddler {
 public:
  void watch(std::vector<GuardStart>& guards) override {
    for (std::size_t i = 3; i < guards.size(); ++i) guards[i].kind = Guard::none;
  }
};

}  // namespace

TEST_CASE("planted faults: none without a fault") {
  for (const Way& way : ways) {
    CAPTURE(to_string(way.engine));
    CAPTURE(static_cast<int>(way.flow));
    Nothing nothing;
    const Report report = run_with(way, nothing);
    CHECK(report.outcome.reason == "");
    CHECK(report.witness.checked > 50);
    CHECK(report.witness.violated == 0);
    for (const Violation& v : report.witness.violations)
      MESSAGE(v.t << " " << v.event << " " << v.contact << " " << v.law << " " << v.value << " " << v.limit);
  }
}

TEST_CASE_TEMPLATE("planted faults: noticed by every engine", Fault, ImpulseLeftOut, HitSwallowed,
                   RestitutionIgnored, WrongSign, NeighbourStuck, AnchorReset, Late, Skipped) {
  for (const Way& way : ways) {
    CAPTURE(to_string(way.engine));
    CAPTURE(static_cast<int>(way.flow));
    Fault fault;
    const Report report = run_with(way, fault);
    CHECK(report.witness.violated > 0);
    for (const Violation& v : report.witness.violations)
      MESSAGE(to_string(way.engine) << " " << v.t << " " << v.event << " " << v.contact << " " << v.law << " "
                                    << v.value << " " << v.limit);
  }
}

TEST_SUITE_END();
