// engine.hpp: names of the engines, and the key that controls the accuracy of each.
//
//   for (const EngineInfo& e : all_engines) use(e.name);      run.engine is one of them, or "auto"
//
// A row here and one in run/engines.cpp (its restrictions, its factory, its cost) add an engine everywhere: to scene
// files, to `check`, `compare` and `study`, and to the documentation.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace signorini {

/// automatic: exact or ida, whichever is cheaper for the scene (run/choose_engine.hpp).
enum class Engine { automatic, exact, ida, newmark, friction_iteration };

/// Limit of an engine's accuracy: rounding, a tolerance (run.rtol), or the length of its steps (run.dt).
enum class Accuracy { rounding, tolerance, step };

struct EngineInfo {
  Engine engine = Engine::automatic;
  std::string_view name;   ///< as in scene files
  std::string_view title;  ///< name of the method in full
  Accuracy accuracy = Accuracy::rounding;
  std::string_view specific_keys;  ///< keys of [run], separated by blanks, that only this engine uses
};

/// The order is that of lists and reports.
inline constexpr std::array all_engines = {
    EngineInfo{Engine::exact, "exact", "Taylor series", Accuracy::rounding, ""},
    EngineInfo{Engine::ida, "ida", "BDF of SUNDIALS IDA", Accuracy::tolerance, "max_order"},
    EngineInfo{Engine::newmark, "newmark", "average acceleration", Accuracy::step, "refine step"},
    EngineInfo{Engine::friction_iteration, "friction-iteration", "average acceleration", Accuracy::step,
               "relaxation max_iterations"},
};

/// "auto" for automatic.
[[nodiscard]] std::string_view to_string(Engine engine);
/// Row of an engine; it must not be automatic.
[[nodiscard]] const EngineInfo& engine_info(Engine engine);
/// Engine with this name; nullopt for "auto" and for names of no engine.
[[nodiscard]] std::optional<Engine> find_engine(std::string_view name);
/// True if the key of [run] is used by this engine only.
[[nodiscard]] bool has_key(const EngineInfo& engine, std::string_view key);
/// "run.rtol", "run.dt", or "" if the engine has no accuracy setting.
[[nodiscard]] std::string_view accuracy_key(Accuracy accuracy);

}  // namespace signorini
