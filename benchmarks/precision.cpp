// CPU time against errors of event times, on models/pipeline.toml unreduced: `ida` by its tolerance,
// `newmark` by its step, both against `exact`.
//
//   build/release/signorini_precision [t_end] [repeats]
//
// Errors are those of the first event of each kind of change that differs by contact and states, in order, as
// long as the sequences agree: the greatest |t - t_exact| over the events compared, and how many those are.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "clock.hpp"
#include "signorini/simulate.hpp"

namespace {

using namespace signorini;
using benchmarks::cpu;

struct Run {
  std::vector<Event> events;
  double seconds = 1e99;
  long steps = 0;
};

Run run(const Model& model, const RunSpec& spec, int repeats) {
  Run best;
  for (int i = 0; i < repeats; ++i) {
    benchmarks::EventTimes recorder;
    const double start = cpu();
    const Report report = simulate(model, spec, recorder);
    best.seconds = std::min(best.seconds, cpu() - start);
    best.events = std::move(recorder.events);
    best.steps = report.counters.steps;
  }
  return best;
}

void row(const std::string& name, const Run& run, const Run& exact) {
  std::size_t same = 0;
  double error = 0.0;
  for (; same < std::min(run.events.size(), exact.events.size()); ++same) {
    const Event &a = run.events[same], &b = exact.events[same];
    if (a.contact != b.contact || a.from != b.from || a.to != b.to) break;
    error = std::max(error, std::abs(a.t - b.t));
  }
  fmt::print("{:<16} {:>9} {:>9.3f} {:>6} {:>6} {:>10.2e}\n", name, run.steps, run.seconds, run.events.size(),
             same, error);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const double t_end = argc > 1 ? std::atof(argv[1]) : 0.2;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 3;
  RunSpec spec;
  const Scene scene = read_scene(SIGNORINI_MODELS "/pipeline.toml");
  const Model model = build_model(scene);
  spec = scene.run;
  spec.t_end = t_end;
  spec.output_times = {t_end};
  spec.engine = Engine::exact;
  const Run exact = run(model, spec, repeats);
  fmt::print(
      "to {} s: steps, s of CPU (least of {}), events, events in exact's order, greatest error of their "
      "times\n",
      t_end, repeats);
  row("exact", exact, exact);
  spec.engine = Engine::ida;
  for (const double rtol : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
    spec.rtol = rtol;
    row(fmt::format("ida {:.0e}", rtol), run(model, spec, repeats), exact);
  }
  spec.engine = Engine::newmark;
  for (const double dt : {1e-5, 2.5e-6, 1e-6, 2.5e-7, 1e-7, 5e-8}) {
    spec.dt = dt;
    row(fmt::format("newmark {:.1e}", dt), run(model, spec, dt < 2e-7 ? 1 : repeats), exact);
  }
}
