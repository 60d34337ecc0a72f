// orbit_scenes.hpp: scenes of which several tests seek orbits or branches, and what is read of an orbit.
#pragma once

#include <doctest/doctest.h>

#include <complex>
#include <string>

#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests {

inline Orbit orbit_of(const std::string& text, const OrbitOptions& options = {}) {
  return find_orbit(reader_of_text(text), options);
}

inline Result run_on(const std::string& text, const Orbit& orbit) {
  return simulate(orbit_scene(reader_of_text(text), orbit));
}

inline double product_of_multipliers(const Orbit& orbit) {
  std::complex<double> det = 1.0;
  for (const auto& mu : orbit.multipliers) det *= mu;
  CHECK(std::abs(det.imag()) <= 1e-12 * (1.0 + std::abs(det)));
  return det.real();
}

inline double saved_value(const Orbit& orbit, const std::string& name) {
  for (const auto& [key, value] : orbit.start.motions)
    if (key == name) return value;
  REQUIRE_MESSAGE(false, name);
  return 0.0;
}

/// NLvib's third example: a chain of two masses, the second before a one-sided spring.
inline std::string chain(const std::string& omega) {
  return matrix_scene(
      "t_end = 9.0\ninitial = { u = [0.9471418552234623, 0.6753036568662564], "
      "v = [0.37884121883540234, 0.10774812890179698] }",
      "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[1.0, -1.0], [-1.0, 2.0]]\n"
      "damping = [[0.03, -0.03], [-0.03, 0.06]]",
      "law = \"compliant\"\nnormal = { d0 = -1.0 }\ngap = 1.0\nnormal_stiffness = 100.0",
      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = 0.1\nhistory = { type = \"harmonic\", omega = " +
          omega + ", phase = 1.5707963267948966 }\n");
}

inline std::string jenkins(const std::string& load = "3.0") {
  return matrix_scene("t_end = 9.0", "mass = [[1.0]]\nstiffness = [[1.0]]\ndamping = [[0.02]]",
                      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 1.0\n"
                      "tangential_stiffness = 20.0\n",
                      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = " + load +
                          "\nhistory = { type = \"harmonic\", omega = 1.5, phase = 1.5707963267948966 }\n"
                          "[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = { d0 = 1.0 }\n");
}

}  // namespace signorini::tests
