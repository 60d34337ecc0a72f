// piping.hpp: a hot pipe with a bend, a support with friction, a spring hanger, a stop and a snubber, shaken at its end.
//
//            D |- stop       A-P-B: along the ground, P: support;  B-C: a quarter of a circle;  C-D: upwards
//              |
//   A --P-- B_/ C            C: spring hanger
#pragma once

#include <fmt/core.h>

#include <string>

#include "behaviour/outputs.hpp"

namespace signorini::tests::piping {

inline const std::string stages = R"([[run.stages]]
name = "weight"
loads = ["gravity", "preload"]
[[run.stages]]
name = "heat"
loads = ["temperature"]
)";

inline std::string line(const std::string& rest = "", const std::string& start = "\"frictional\"") {
  return "schema = 1\nunits = { force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }\ngravity = "
         "[0.0, -9.81]\n"
         "[run]\nt_end = 0.25\noutput_dt = 0.01\ncertify = false\ninitial = " +
         start + "\n" + (start == "\"frictional\"" ? stages : "") + R"([damping]
alpha = 0.5
beta = 2e-5
[sections.pipe]
pipe = { diameter = 0.2191, wall = 0.0082, E = 2e8, density = 7.85, content = 1.0, insulation = { thickness = 0.05, density = 0.2 } }
[nodes]
A = [0.0, 0.0]
P = [3.0, 0.0]
B = [6.0, 0.0]
C = [7.0, 1.0]
D = [7.0, 4.0]
[[members]]
nodes = ["A", "P", "B"]
section = "pipe"
elements = 2
thermal_expansion = 1.2e-5
temperature = 120.0
[[members]]
nodes = ["B", "C"]
section = "pipe"
bend = { radius = 1.0 }
elements = 4
thermal_expansion = 1.2e-5
temperature = 120.0
[[members]]
nodes = ["C", "D"]
section = "pipe"
elements = 2
[[supports]]
node = "A"
fix = ["ux", "uy", "rz"]
[[springs]]
node = "C"
direction = [0.0, -1.0]
hanger = { hot = 4.0, cold = 4.5, travel = 0.005 }
[[springs]]
node = "D"
direction = [0.6, 0.8]
damping = 2.0
[[contacts]]
name = "shoe"
node = "P"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 5e4
tangential_stiffness = 4e4
friction = 0.3
[[stops]]
name = "guide"
node = "D"
law = "compliant"
direction = [1.0, 0.0]
gap = 0.02
normal_stiffness = 2e4
[[loads]]
node = "D"
direction = [1.0, 0.0]
amplitude = 12.0
history = { type = "half_sine", start = 0.02, duration = 0.1 }
)" + rest;
}

}  // namespace signorini::tests::piping
