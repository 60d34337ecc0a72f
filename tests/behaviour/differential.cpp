// Random scenes through all engines (validation/differential), a handful; and those on which they once
// disagreed.
#include <doctest/doctest.h>

#include <filesystem>

#include "differential/generator.hpp"
#include "differential/judge.hpp"

using namespace signorini;
using namespace signorini::differential;

namespace {

/// No clock: a slow machine is no other verdict.
Judgement judged(const Scene& scene) {
  JudgeSettings settings;
  settings.seconds = settings.scene_seconds = 1e6;
  return judge(scene, settings);
}

}  // namespace

TEST_SUITE("behaviour/differential") {
  TEST_CASE("random scenes: engines agree as far as they promise") {
    int agree = 0, events = 0;
    for (std::uint64_t seed = 51; seed <= 80; ++seed) {
      const Judgement j = judged(parse_scene(draw_scene(seed), "drawn.toml"));
      CAPTURE(seed);
      CAPTURE(j.what);
      CHECK(j.verdict != Verdict::disagree);
      agree += j.verdict == Verdict::agree ? 1 : 0;
      events += static_cast<int>(j.events);
    }
    CHECK(agree >= 25);
    CHECK(events > 300);
  }

  TEST_CASE("scenes on which engines once disagreed") {
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(SIGNORINI_TEST_DATA "/scenes/differential")) {
      const Judgement j = judged(read_scene(entry.path().string()));
      CAPTURE(entry.path().filename().string());
      CAPTURE(j.what);
      CHECK(j.verdict != Verdict::disagree);
      CHECK(j.verdict != Verdict::refused);
      ++count;
    }
    CHECK(count >= 2);
  }
}
