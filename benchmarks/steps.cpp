// What a step of engine `ida` costs beside IDA's own floor (floor.hpp): alternating runs in one process,
// CPU time, ratio of each pair. `packaged`: the floor with SUNDIALS' own vector.
//
//   build/release/signorini_steps [pairs] [greatest number of unknowns]
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "allocations.hpp"
#include "clock.hpp"
#include "floor.hpp"
#include "scenes.hpp"
#include "signorini/simulate.hpp"

namespace {

using namespace signorini;

struct Taken {
  double seconds;
  long steps, events, allocations;
  Counters counters;
};

Taken run(const Model& model, RunSpec spec, double t_end) {
  spec.t_end = t_end;
  spec.output_times = {t_end};
  benchmarks::EventTimes silent;
  const long before = benchmarks::allocations();
  const double start = benchmarks::cpu();
  const Report report = simulate(model, spec, silent);
  const double seconds = benchmarks::cpu() - start;
  if (report.outcome.kind != Outcome::Kind::done) fmt::print("stopped: {}\n", report.outcome.reason);
  return {seconds, report.counters.steps, static_cast<long>(silent.events.size()),
          benchmarks::allocations() - before, report.counters};
}

/// Steps between t_short and t_long: what comes before (start, reading of loads) is subtracted.
void row(const std::string& name, const Scene& scene, double t_short, double t_long, int pairs) {
  const Model model = build_model(scene);
  const auto unknowns = 2 * model.size() + 2 * static_cast<int>(model.contacts.size());
  benchmarks::Floor floor(unknowns, 3 * static_cast<int>(model.contacts.size()), scene.run.rtol);
  benchmarks::Floor packaged(unknowns, 3 * static_cast<int>(model.contacts.size()), scene.run.rtol, true);
  floor.steps(200);
  packaged.steps(200);
  std::vector<double> ours, theirs, theirs_packaged, ratios;
  Taken a{}, b{};
  for (int i = 0; i < pairs; ++i) {
    a = run(model, scene.run, t_short);
    b = run(model, scene.run, t_long);
    const long steps = b.steps - a.steps;
    const double start = benchmarks::cpu();
    floor.steps(steps);
    theirs.push_back(1e6 * (benchmarks::cpu() - start) / static_cast<double>(steps));
    const double middle = benchmarks::cpu();
    packaged.steps(steps);
    theirs_packaged.push_back(1e6 * (benchmarks::cpu() - middle) / static_cast<double>(steps));
    ours.push_back(1e6 * (b.seconds - a.seconds) / static_cast<double>(steps));
    ratios.push_back(ours.back() / theirs.back());
  }
  for (auto* v : {&ours, &theirs, &theirs_packaged, &ratios}) std::sort(v->begin(), v->end());
  const auto half = ratios.size() / 2;
  const auto a_step = [&](long longer, long shorter) {
    return static_cast<double>(longer - shorter) / static_cast<double>(b.steps - a.steps);
  };
  fmt::print("{:<18} {:>7} {:>4} {:>8} {:>6} {:>5.2f} {:>5.2f} {:>6.2f} {:>10.2f} {:>10.2f} {:>10.2f}", name,
             model.size(), model.contacts.size(), b.steps - a.steps, b.events - a.events,
             a_step(b.counters.solves, a.counters.solves),
             a_step(b.counters.refactorisations, a.counters.refactorisations),
             a_step(b.allocations, a.allocations), ours[half], theirs[half], theirs_packaged[half]);
  fmt::print("   {:.2f} {:.2f} {:.2f}\n", ratios.front(), ratios[half], ratios.back());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int pairs = argc > 1 ? std::atoi(argv[1]) : 7;
  const int greatest = argc > 2 ? std::atoi(argv[2]) : 100000;
  fmt::print("per step: solves, refactorisations, allocations; us of CPU (median); ratio min median max\n");
  fmt::print("{:<18} {:>7} {:>4} {:>8} {:>6} {:>5} {:>5} {:>6} {:>10} {:>10} {:>10}   {}\n", "scene", "n",
             "c", "steps", "events", "solve", "refac", "alloc", "ida", "floor", "packaged", "ratio");
  for (const char* rtol : {"1e-6", "1e-8"})
    row(std::string("pipeline ") + rtol, read_scene(SIGNORINI_MODELS "/pipeline.toml", {{"run.rtol", rtol}}),
        0.0003, 0.0019, pairs);
  row("pipeline, events", read_scene(SIGNORINI_MODELS "/pipeline.toml", {{"run.rtol", "1e-6"}}), 0.001, 0.3,
      pairs);
  for (const int n : {100, 1000, 10000, 100000})
    if (n <= greatest)
      row("bedded pipe", parse_scene(benchmarks::bedded_pipe(n, 2, 1e-3), "pipe"), 2e-4,
          n > 50000 ? 4e-4 : 1e-3, pairs);
  for (const int c : {20, 200})
    row("bedded pipe", parse_scene(benchmarks::bedded_pipe(10000, c, 1e-3), "pipe"), 2e-4, 1e-3, pairs);
}
