#include "run/engines.hpp"

#include <doctest/doctest.h>

#include "signorini/engine.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/run/engines");

TEST_CASE("engines: every name has a row, is found by its name, and `auto` is none of them") {
  for (const EngineInfo& engine : all_engines) {
    CHECK(run::engine_row(engine.engine).engine == engine.engine);
    CHECK(find_engine(engine.name) == engine.engine);
    CHECK(to_string(engine.engine) == engine.name);
  }
  CHECK(to_string(Engine::automatic) == "auto");
  CHECK_FALSE(find_engine("auto"));
  CHECK_FALSE(find_engine("Exact"));
}

TEST_CASE("engines: keys are whole words") {
  const EngineInfo& newmark = engine_info(Engine::newmark);
  CHECK(has_key(newmark, "refine"));
  CHECK(has_key(newmark, "step"));
  CHECK_FALSE(has_key(newmark, "ste"));
  CHECK_FALSE(has_key(newmark, "refine step"));
  CHECK_FALSE(has_key(engine_info(Engine::exact), ""));
}

TEST_SUITE_END();
