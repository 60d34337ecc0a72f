// rates.hpp: derivatives of scenes that are given as text, or stand in models/.
#pragma once

#include <string>
#include <vector>

#include "signorini/sensitivity.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests {

/// With `exact`, unless the text names an engine.
inline SceneReader reader_of_text(const std::string& text) {
  return [text](const std::vector<Override>& changes) {
    std::vector<Override> all;
    if (text.find("engine = ") == std::string::npos) all.push_back({"run.engine", "exact"});
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, "test.toml", all);
  };
}

inline Sensitivities rates_of(const std::string& text, const std::vector<std::string>& paths) {
  return sensitivities(reader_of_text(text), paths);
}

inline Sensitivities rates_of_model(const std::string& name, const std::vector<std::string>& paths,
                                    std::vector<Override> changes = {}) {
  changes.insert(changes.begin(), {"run.engine", "exact"});
  return sensitivities(reader_of(std::string(SIGNORINI_MODELS) + "/" + name + ".toml", std::move(changes)),
                       paths);
}

inline Result run_exact(const SceneReader& read, const Override& change) {
  Scene scene = read({change});
  scene.run.engine = Engine::exact;
  scene.run.flow = Flow::taylor;
  return simulate(build_model(scene), scene.run);
}

}  // namespace signorini::tests
