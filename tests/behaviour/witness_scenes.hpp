// witness_scenes.hpp: scenes in which errors are planted, and the engines that compute them.
#pragma once

#include <doctest/doctest.h>

#include "run/fault_injector.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::witnessed {

/// Two blocks on ground inclined by 0.3 rad, a spring between them; one lands on a rigid floor again and again, the other
/// slides, sticks and lifts off on a compliant foot. Nothing is along an axis.
inline constexpr const char* scene_text = R"(schema = 1
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

/// A chain of three blocks on belts that move, turned by 0.7 rad: the first one is held rigidly where it sticks, the others
/// by springs.
inline constexpr const char* sliders_text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 12.0
output_dt = 0.01
rtol = 1e-9
dt = 5e-4
frames = [3.7]
initial = { A = { vx = 0.1147263281, vy = 0.0966326531 }, B = { vx = 0.0764842187, vy = 0.0644217687 } }
[nodes]
A = [0.0, 0.0]
B = [0.764842187, 0.644217687]
C = [1.529684374, 1.288435374]
[[masses]]
node = "A"
mass = 1.0
[[masses]]
node = "B"
mass = 1.7
[[masses]]
node = "C"
mass = 0.9
[[springs]]
node = "A"
direction = [0.764842187, 0.644217687]
stiffness = 9.0
[[springs]]
node = "B"
against = "A"
direction = [0.764842187, 0.644217687]
stiffness = 7.0
[[springs]]
node = "C"
against = "B"
direction = [0.764842187, 0.644217687]
stiffness = 5.0
[[springs]]
node = "A"
direction = [-0.644217687, 0.764842187]
stiffness = 400.0
[[springs]]
node = "B"
direction = [-0.644217687, 0.764842187]
stiffness = 500.0
[[springs]]
node = "C"
direction = [-0.644217687, 0.764842187]
stiffness = 600.0
[[contacts]]
name = "rigidly"
node = "A"
law = "slider"
tangent = [0.764842187, 0.644217687]
normal_force = 1.0
friction = { static = 0.6, kinetic = 0.4 }
surface_velocity = 0.15
[[contacts]]
name = "sprung"
node = "B"
law = "slider"
tangent = [0.764842187, 0.644217687]
normal_force = 1.3
tangential_stiffness = 300.0
friction = { static = 0.5, kinetic = 0.3 }
surface_velocity = 0.1
[[contacts]]
name = "driven"
node = "C"
law = "slider"
tangent = [0.764842187, 0.644217687]
normal_force = 1.1
surface_velocity = { type = "harmonic", amplitude = 0.4, omega = 2.3 }
tangential_stiffness = 400.0
friction = { static = 0.5, kinetic = 0.3 }
)";

/// A block on two rigid feet with static above kinetic friction, on ground inclined by 0.3 rad, pushed until it slides and back.
inline constexpr const char* held_text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [2.899053227347741, -9.371850958322195]
[run]
t_end = 4.0
output_dt = 0.05
rtol = 1e-9
dt = 1e-3
initial = "static"
[nodes]
L = [-0.477668244562803, -0.14776010333066977]
R = [0.38213459565024244, 0.11820808266453582]
[[rigid]]
name = "block"
centre = [-0.08865606199840186, 0.28660094673768177]
nodes = ["L", "R"]
mass = 2.0
inertia = 0.2
[[contacts]]
name = "foot"
nodes = ["L", "R"]
law = "rigid"
normal = [-0.29552020666133955, 0.955336489125606]
friction = { static = 0.5, kinetic = 0.3 }
[[loads]]
node = "block"
direction = [0.955336489125606, 0.29552020666133955]
amplitude = 12.0
history = { type = "table", times = [0.0, 1.0, 3.0, 4.0], values = [0.0, 0.9, -0.9, 0.0] }
)";

/// A bar on two feet, one with a dashpot, on ground inclined by -0.4 rad, shaken along it and lifted now and then.
inline constexpr const char* feet_text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [-3.8202, -9.0359]
[run]
t_end = 1.2
output_dt = 0.003
rtol = 1e-9
dt = 2e-4
frames = [0.51]
[nodes]
A = [0.0, 0.0]
B = [0.921060994, -0.389418342]
[[masses]]
node = "A"
mass = 2.0
[[masses]]
node = "B"
mass = 1.5
[[springs]]
node = "B"
against = "A"
direction = [0.921060994, -0.389418342]
stiffness = 900.0
[[loads]]
node = "A"
direction = [1.0, 0.2]
amplitude = 19.0
history = { type = "harmonic", frequency = 2.7 }
[[loads]]
node = "B"
direction = [0.5, 0.9]
amplitude = 24.0
history = { type = "harmonic", frequency = 4.3 }
[[contacts]]
name = "left"
node = "A"
law = "compliant"
normal = [0.389418342, 0.921060994]
normal_stiffness = 2e4
normal_damping = 9.0
tangential_stiffness = 1.5e4
friction = { static = 0.5, kinetic = 0.35 }
[[contacts]]
name = "right"
node = "B"
law = "compliant"
normal = [0.389418342, 0.921060994]
normal_stiffness = 3e4
tangential_stiffness = 2e4
friction = { static = 0.6, kinetic = 0.4 }
)";

struct Way {
  Engine engine;
  Flow flow;
};
inline constexpr Way ways[] = {{Engine::exact, Flow::taylor},
                               {Engine::exact, Flow::modal},
                               {Engine::ida, Flow::automatic},
                               {Engine::newmark, Flow::automatic}};

inline Result run_of(const char* text, const Way& way, run::FaultInjector& faults) {
  Scene scene = parse_scene(text, "planted.toml");
  scene.run.engine = way.engine;
  scene.run.flow = way.flow;
  scene.run.certify = Certify::no;
  Result result;
  result.report = run::simulate(build_model(scene), scene.run, result, faults);
  return result;
}

inline Report run_with(const Way& way, run::FaultInjector& faults) {
  return run_of(scene_text, way, faults).report;
}

inline void tell(const LawCheckSummary& witness) {
  for (const Violation& v : witness.violations)
    MESSAGE(v.t << " " << v.event << " " << v.contact << " " << v.law << " " << v.value << " " << v.limit);
}

}  // namespace signorini::tests::witnessed
