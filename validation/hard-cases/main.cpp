// The hard cases of the tests, long, through both engines, and three that are too long for tests. Prints
// Markdown: the error of each, in the unit named, and the time that all of its runs took.
//
//   build/release/signorini_hard_cases
#include <fmt/core.h>

#include <chrono>
#include <cmath>

#include "behaviour/hard_cases.hpp"
#include "signorini/simulate.hpp"

namespace {

using namespace signorini;

constexpr double cycles = 100.0;  // times as many as in the tests

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string number(double error) {
  return std::isfinite(error) ? fmt::format("{:.1e}", error) : "another sequence";
}

void known_answers() {
  fmt::print("| case | error, in | ida | s | exact | s |\n|---|---|---|---|---|---|\n");
  for (const tests::HardCase& hard : tests::hard_cases()) {
    std::string row = fmt::format("| {} | {} |", hard.name, hard.what);
    for (const char* engine : {"ida", "exact"}) {
      const auto start = std::chrono::steady_clock::now();
      const double error = hard.error(engine, cycles);
      row += fmt::format(" {} | {:.2g} |", number(error), seconds_since(start));
    }
    fmt::print("{}\n", row);
    std::fflush(stdout);
  }
}

struct Finding {
  Result result;
  double seconds = 0.0;
};

Finding run(const std::string& file, std::vector<Override> changes, const std::string& engine) {
  changes.push_back({"run.engine", engine});
  Scene scene = read_scene(file, changes);
  const Model model = build_model(scene);
  const auto start = std::chrono::steady_clock::now();
  return {simulate(model, scene.run), seconds_since(start)};
}

void structures() {
  fmt::print(
      "\n| structure | engine | events | end | t of the last event, s | ux of A at the end, m | energy "
      "balance, "
      "relative | s |\n|---|---|---|---|---|---|---|---|\n");
  struct Subject {
    const char *name, *file;
    std::vector<Override> changes;
  };
  const Subject subjects[] = {
      {"rigid Z-shaped frame chatters to rest", SIGNORINI_MODELS "/rigid-frame.toml", {{"run.frames", "[]"}}},
      {"pipeline wedged: f = 1.3, kn = kt = 1e7",
       SIGNORINI_MODELS "/pipeline.toml",
       {{"contacts.*.friction", "1.3"},
        {"contacts.*.normal_stiffness", "1e7"},
        {"contacts.*.tangential_stiffness", "1e7"},
        {"run.frames", "[]"}}},
  };
  for (const Subject& subject : subjects)
    for (const char* engine : {"exact", "ida"}) {
      const Finding f = run(subject.file, subject.changes, engine);
      const Report& report = f.result.report;
      long events = 0;
      double last = 0.0;
      for (const Event& e : f.result.events)
        if (e.type != EventType::time) {
          ++events;
          last = e.t;
        }
      fmt::print("| {} | {} | {} | {} | {:.9f} | {:.9e} | {:.1e} | {:.2g} |\n", subject.name, engine, events,
                 report.outcome.kind == Outcome::Kind::done ? "done" : report.outcome.reason, last,
                 f.result.rows.back().u[0], report.audit.energy.value / report.audit.energy_scale, f.seconds);
      std::fflush(stdout);
    }
}

}  // namespace

int main() {
  known_answers();
  structures();
}
