#include "signorini/engine.hpp"

#include <algorithm>

namespace signorini {

std::string_view to_string(Engine engine) {
  return engine == Engine::automatic ? "auto" : name_of(engine).name;
}

const EngineName& name_of(Engine engine) {
  return *std::find_if(all_engines.begin(), all_engines.end(),
                       [&](const EngineName& e) { return e.engine == engine; });
}

std::optional<Engine> engine_called(std::string_view name) {
  for (const EngineName& e : all_engines)
    if (e.name == name) return e.engine;
  return std::nullopt;
}

bool has_key(const EngineName& engine, std::string_view key) {
  std::string_view rest = engine.own_keys;
  while (!rest.empty()) {
    const std::size_t blank = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, blank) == key) return true;
    rest.remove_prefix(std::min(blank + 1, rest.size()));
  }
  return false;
}

std::string_view accuracy_key(Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::tolerance:
      return "run.rtol";
    case Accuracy::step:
      return "run.dt";
    case Accuracy::rounding:
      break;
  }
  return "";
}

}  // namespace signorini
