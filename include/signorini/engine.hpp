// engine.hpp: the engines by name, and what says how accurate each of them is.
//
//   for (const EngineName& e : all_engines) use(e.name);      run.engine is one of them, or "auto"
//
// A row here and one in run/engines.cpp (what it refuses, its factory, its cost) make an engine known
// everywhere: to scene files, to `check`, `compare` and `study`, and to the documentation.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace signorini {

/// automatic: exact or ida, whichever the scene is cheaper with (run/choose_engine.hpp).
enum class Engine { automatic, exact, ida, newmark, friction_iteration };

/// What limits the error of an engine: rounding, a tolerance (run.rtol), or the length of its steps (run.dt).
enum class Accuracy { rounding, tolerance, step };

struct EngineName {
  Engine engine = Engine::automatic;
  std::string_view name;   ///< as in scene files
  std::string_view title;  ///< of the method
  Accuracy accuracy = Accuracy::rounding;
  std::string_view own_keys;  ///< of [run], separated by blanks: they mean something to this engine only
};

/// In the order of lists and reports.
inline constexpr std::array all_engines = {
    EngineName{Engine::exact, "exact", "Taylor series", Accuracy::rounding, ""},
    EngineName{Engine::ida, "ida", "BDF of SUNDIALS IDA", Accuracy::tolerance, "max_order"},
    EngineName{Engine::newmark, "newmark", "average acceleration", Accuracy::step, "refine step"},
    EngineName{Engine::friction_iteration, "friction-iteration", "average acceleration", Accuracy::step,
               "relaxation max_iterations"},
};

/// "auto" for automatic.
[[nodiscard]] std::string_view to_string(Engine engine);
/// The row of an engine that is not automatic.
[[nodiscard]] const EngineName& name_of(Engine engine);
/// Of that name; "auto" and what is no engine have none.
[[nodiscard]] std::optional<Engine> engine_called(std::string_view name);
/// Whether a key of [run] is one of the engine's own.
[[nodiscard]] bool has_key(const EngineName& engine, std::string_view key);
/// "run.rtol", "run.dt", or "" where nothing is to be set.
[[nodiscard]] std::string_view accuracy_key(Accuracy accuracy);

}  // namespace signorini
