// outputs.hpp: scenes with outputs, computed, and a beam and a frame to ask.
//
//   const Computed c = compute(beam(clamped_at_A, cut("M", "M", 0.5)));   c.last("M"), c.extremes("M").maximum
//
// Units: kN, t, m, s.
#pragma once

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <string>
#include <vector>

#include "signorini/simulate.hpp"

namespace signorini::tests::outputs {

struct Computed {
  Model model;
  Result result;

  [[nodiscard]] std::size_t index(const std::string& name) const {
    for (std::size_t i = 0; i < model.outputs.size(); ++i)
      if (model.outputs[i].name == name) return i;
    FAIL("no output " << name);
    return 0;
  }
  /// The last row's value.
  [[nodiscard]] double last(const std::string& name) const {
    return result.responses.back().values[index(name)];
  }
  [[nodiscard]] const OutputExtremes& extremes(const std::string& name) const {
    return result.report.response[index(name)];
  }
};

inline Computed compute(const std::string& text, const std::string& engine = "exact",
                        const std::vector<Override>& more = {}) {
  std::vector<Override> changes{
      {"run.engine", engine}, {"run.rtol", "1e-10"}, {"run.dt", "1e-4"}, {"run.certify", "false"}};
  changes.insert(changes.end(), more.begin(), more.end());
  const Scene scene = parse_scene(text, "test.toml", changes);
  Computed computed{build_model(scene), {}};
  computed.result = simulate(computed.model, scene.run);
  return computed;
}

inline std::string output(const std::string& name, const std::string& kind, const std::string& rest) {
  return fmt::format("[[output]]\nname = \"{}\"\nkind = \"{}\"\n{}\n", name, kind, rest);
}

inline std::string cut(const std::string& name, const std::string& quantity, double station,
                       const std::string& at = "[\"A\", \"B\"]") {
  return output(name, "member_force",
                fmt::format("at = {}\nquantity = \"{}\"\nstation = {:.17g}", at, quantity, station));
}

inline const std::string head = R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
gravity = [0.0, -10.0]
[run]
t_end = 0.1
initial = "static"
output_dt = 0.02
[sections.s]
EA = 2e5
EI = 3e4
mass_per_length = 0.4
)";

/// A beam of length 6 from A to B in 3 elements, as `supports` hold it; its weight is 4 a length.
inline std::string beam(const std::string& supports, const std::string& rest,
                        const std::string& member = "") {
  return head +
         "[nodes]\nA = [0.0, 0.0]\nB = [6.0, 0.0]\n[[members]]\nnodes = [\"A\", \"B\"]\nsection = \"s\"\n" +
         "elements = 3\n" + member + "\n" + supports + rest;
}
inline const std::string clamped_at_A = "[[supports]]\nnode = \"A\"\nfix = [\"ux\", \"uy\", \"rz\"]\n";
inline const std::string simple =
    "[[supports]]\nnode = \"A\"\nfix = [\"ux\", \"uy\"]\n[[supports]]\nnode = \"B\"\nfix = [\"uy\"]\n";

/// A frame that a support moves, on the ground that shakes, with springs, a mass, a contact and a damper.
inline std::string frame(const std::string& rest) {
  return R"(schema = 1
units = { force = "kN", mass = "t", length = "m", time = "s" }
gravity = [1.0, -10.0]
[run]
t_end = 0.4
output_dt = 0.01
initial = { B = { vx = 0.3, vy = -0.2 } }
[damping]
alpha = 0.4
beta = 1e-4
[sections.s]
EA = 2e4
EI = 3e3
mass_per_length = 0.4
[nodes]
A = [0.0, 0.0]
B = [1.0, 3.0]
C = [4.0, 3.0]
D = [4.0, 0.0]
[[members]]
nodes = ["A", "B", "C"]
section = "s"
elements = [3, 2]
thermal_expansion = 1e-5
temperature = { type = "table", times = [0.0, 0.2, 1.0], values = [0.0, 40.0, 40.0], interpolation = "steffen" }
[[members]]
nodes = ["C", "D"]
section = "s"
elements = 2
mass = "lumped"
[[masses]]
node = "B"
mass = 1.5
inertia = 0.2
[[masses]]
node = "D"
mass = 0.7
[[springs]]
node = "C"
direction = [3.0, -4.0]
stiffness = 200.0
damping = 3.0
[[springs]]
node = "B"
against = "D"
direction = [1.0, 1.0]
stiffness = 100.0
damping = 1.0
[[supports]]
node = "A"
fix = ["ux", "uy"]
[[supports]]
node = "D"
fix = ["uy"]
[[supports]]
node = "D"
fix = ["ux"]
motion = { type = "table", times = [0.0, 0.1, 0.3, 1.0], values = [0.0, 0.01, -0.005, 0.0], interpolation = "steffen" }
[[contacts]]
name = "floor"
node = "B"
law = "compliant"
normal = [0.6, 0.8]
gap = 0.001
normal_stiffness = 1e4
tangential_stiffness = 5e3
friction = 0.4
[[loads]]
node = "D"
direction = [1.0, 0.0]
amplitude = 5.0
history = { type = "half_sine", start = 0.0, duration = 0.1 }
[[loads]]
nodes = ["A", "B"]
direction = [1.0, 0.0]
axes = "member"
distributed = 2.0
[[base_motion]]
direction = [1.0, 0.0]
acceleration = { type = "harmonic", amplitude = 3.0, offset = 0.0, omega = 20.0, start = 0.0 }
)" + rest;
}

inline const std::string reactions = output("Ax", "reaction", "at = \"A\"\ndirection = [1.0, 0.0]") +
                                     output("Ay", "reaction", "at = \"A\"\ndirection = [0.0, 1.0]") +
                                     output("Dx", "reaction", "at = \"D\"\ndirection = [1.0, 0.0]") +
                                     output("Dy", "reaction", "at = \"D\"\ndirection = [0.0, 1.0]");

}  // namespace signorini::tests::outputs
