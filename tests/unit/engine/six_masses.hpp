// six_masses.hpp: six coupled masses on three contacts, the first sliding, the second sticking, the third open.
#pragma once

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

namespace signorini::tests {

inline std::string diagonal(const std::vector<double>& d) {
  std::string rows;
  for (std::size_t i = 0; i < d.size(); ++i) {
    std::vector<double> row(d.size(), 0.0);
    row[i] = d[i];
    rows += fmt::format("{}[{}]", i == 0 ? "" : ", ", fmt::join(row, ", "));
  }
  return "[" + rows + "]";
}

/// Six masses, coupled; a slides, b sticks, c is open.
inline std::string six_masses(const std::vector<double>& damping, const std::string& contact_damping,
                              const std::string& history) {
  return fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
[run]
t_end = 0.9
initial = {{ u = [-0.03, 0.05, -0.05, 0.001, 0.01, -0.02], v = [0.02, 0.9, -0.04, 0.0, 0.3, -0.2] }}
[matrices]
damping = {0}
mass = {3}
stiffness = [[90.0, -12.0, -9.0, 0.0, -7.0, 0.0], [-12.0, 40.0, 0.0, -6.0, 0.0, -5.0], [-9.0, 0.0, 120.0, -20.0, 0.0, -11.0],
             [0.0, -6.0, -20.0, 70.0, -13.0, 0.0], [-7.0, 0.0, 0.0, -13.0, 55.0, -4.0], [0.0, -5.0, -11.0, 0.0, -4.0, 30.0]]
[[contacts]]
name = "a"
law = "compliant"
normal = {{ d0 = 0.8, d1 = -0.3 }}
tangent = {{ d1 = 0.9, d0 = 0.2 }}
normal_stiffness = 300.0
tangential_stiffness = 150.0
friction = 0.3
initial_shear = 6.0
{1}
surface_velocity = -3.0
[[contacts]]
name = "b"
law = "compliant"
normal = {{ d2 = 1.0 }}
tangent = {{ d3 = 0.7, d4 = 0.1 }}
normal_stiffness = 250.0
tangential_stiffness = 60.0
friction = 5.0
[[contacts]]
name = "c"
law = "compliant"
normal = {{ d4 = -1.0 }}
gap = 5.0
normal_stiffness = 250.0
[[loads]]
direction = {{ d0 = -1.0, d2 = -2.5, d5 = 0.6 }}
amplitude = 12.0
{2}
)",
                     diagonal(damping), contact_damping, history, diagonal({2.0, 1.5, 1.0, 1.2, 0.8, 1.1}));
}

/// 0.8 M: real modes; and dampers that need complex ones.
inline const std::vector<double> proportional{1.6, 1.2, 0.8, 0.96, 0.64, 0.88},
    single_dampers{0.9, 0.2, 0.5, 1.3, 0.1, 0.4};

}  // namespace signorini::tests
