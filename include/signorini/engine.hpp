// engine.hpp: names of the engines, and the scene key that controls the accuracy of each engine.
//
//   for (const EngineInfo& e : all_engines) use(e.name);      run.engine is one of these names, or "auto"
//
// To add an engine, add a row here and a row in run/engines.cpp (restrictions, factory, cost). Scene files, the commands
// `check`, `compare` and `study`, and the documentation then know the engine.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace signorini {

/// automatic: the program chooses exact or ida, whichever is cheaper for the scene (run/choose_engine.hpp).
enum class Engine { automatic, exact, ida, newmark, friction_iteration };

/// Quantity that limits the accuracy of an engine: rounding, a tolerance (run.rtol), or the time step (run.dt).
enum class Accuracy { rounding, tolerance, step };

struct EngineInfo {
  Engine engine = Engine::automatic;
  std::string_view name;   ///< name in scene files
  std::string_view title;  ///< full name of the method
  Accuracy accuracy = Accuracy::rounding;
  std::string_view specific_keys;  ///< keys of [run], separated by blanks, that only this engine uses
};

/// All engines, in the order of lists and reports.
inline constexpr std::array all_engines = {
    EngineInfo{Engine::exact, "exact", "Taylor series", Accuracy::rounding, ""},
    EngineInfo{Engine::ida, "ida", "BDF of SUNDIALS IDA", Accuracy::tolerance, "max_order"},
    EngineInfo{Engine::newmark, "newmark", "average acceleration", Accuracy::step, "refine step"},
    EngineInfo{Engine::friction_iteration, "friction-iteration", "average acceleration", Accuracy::step,
               "relaxation max_iterations"},
};

/// Name of the engine; "auto" for Engine::automatic.
[[nodiscard]] std::string_view to_string(Engine engine);
/// Row of an engine in all_engines; `engine` must not be automatic.
[[nodiscard]] const EngineInfo& engine_info(Engine engine);
/// Engine with this name; nullopt for "auto" and for unknown names.
[[nodiscard]] std::optional<Engine> find_engine(std::string_view name);
/// True if only this engine uses the key of [run].
[[nodiscard]] bool has_key(const EngineInfo& engine, std::string_view key);
/// Name of the scene key that sets the accuracy: "run.rtol", "run.dt", or "" for Accuracy::rounding.
[[nodiscard]] std::string_view accuracy_key(Accuracy accuracy);

}  // namespace signorini
