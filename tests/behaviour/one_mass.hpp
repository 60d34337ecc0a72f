// one_mass.hpp: small [matrices] scenes as text, for tests with closed-form answers.
#pragma once

#include <string>

#include "signorini/simulate.hpp"

namespace signorini::tests {

/// A scene of the given [run] lines, [matrices] lines, one contact named "c", and whatever follows.
inline std::string matrix_scene(const std::string& run, const std::string& matrices,
                                const std::string& contact, const std::string& rest = "") {
  return "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\n" + run +
         "\n[matrices]\n" + matrices + "\n[[contacts]]\nname = \"c\"\n" + contact + "\n" + rest;
}

/// `dt`: for engines whose steps have a given length.
inline Result run_text(const std::string& text, const std::string& engine, const char* rtol = "1e-10",
                       const char* dt = "1e-3") {
  const Scene scene =
      parse_scene(text, "test.toml", {{"run.engine", engine}, {"run.rtol", rtol}, {"run.dt", dt}});
  return simulate(build_model(scene), scene.run);
}

}  // namespace signorini::tests
