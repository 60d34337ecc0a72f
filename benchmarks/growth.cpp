// How cost grows with the number of unknowns and of contacts: reading, building the model, `check`, a step of
// every engine, events, memory. One process a row, so that its peak of memory is its own.
//
//   build/release/signorini_growth [greatest number of unknowns]
#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>

#include "clock.hpp"
#include "scenes.hpp"
#include "signorini/simulate.hpp"
#include "study/check/check.hpp"

namespace {

using namespace signorini;
using benchmarks::cpu;

/// In a process of its own; prints its peak of memory.
void apart(const std::function<void()>& work) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    work();
    std::fflush(stdout);
    _exit(0);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  fmt::print(" {:>8.1f}\n", static_cast<double>(usage.ru_maxrss) / 1024.0);
}

/// us of CPU a step between two lengths of run, the start subtracted.
double step_cost(const Model& model, RunSpec spec, Engine engine, double t_short, double t_long) {
  spec.engine = engine;
  spec.dt = 1e-5;
  double seconds[2] = {0.0, 0.0};
  long steps[2] = {0, 0};
  for (int i = 0; i < 2; ++i) {
    spec.t_end = i == 0 ? t_short : t_long;
    spec.output_times = {spec.t_end};
    benchmarks::EventTimes silent;
    const double start = cpu();
    const Report report = simulate(model, spec, silent);
    seconds[i] = cpu() - start;
    steps[i] = report.counters.steps;
    if (report.outcome.kind != Outcome::Kind::done) return 0.0;
  }
  return 1e6 * (seconds[1] - seconds[0]) / static_cast<double>(steps[1] - steps[0]);
}

void pipe(int unknowns, int contacts) {
  const double start = cpu();
  const Scene scene = parse_scene(benchmarks::bedded_pipe(unknowns, contacts, 1e-3), "pipe");
  const double read = cpu();
  const Model model = build_model(scene);
  const double built = cpu();
  const check::CheckReport report = check::check(scene, model);
  const double checked = cpu();
  fmt::print("{:>7} {:>4} {:>8.3f} {:>8.3f} {:>8.3f}", model.size(), model.contacts.size(), read - start,
             built - read, checked - built);
  for (const auto& [engine, t_short, t_long] :
       {std::tuple{Engine::ida, 2e-4, 6e-4}, std::tuple{Engine::newmark, 1e-3, 3e-3},
        std::tuple{Engine::friction_iteration, 1e-3, 3e-3}, std::tuple{Engine::exact, 1e-3, 2e-3}})
    fmt::print(" {:>10.1f}", step_cost(model, scene.run, engine, t_short, t_long));
  (void)report;
}

void belt(int unknowns, int contacts) {
  const double t_end = 8.0;
  const Scene scene = parse_scene(benchmarks::chain(unknowns, contacts, t_end), "chain");
  const Model model = build_model(scene);
  fmt::print("{:>7} {:>4}", model.size(), model.contacts.size());
  for (const Engine engine : {Engine::ida, Engine::newmark, Engine::exact}) {
    RunSpec spec = scene.run;
    spec.engine = engine;
    spec.dt = 1e-2;
    benchmarks::EventTimes events;
    const double start = cpu();
    const Report report = simulate(model, spec, events);
    const double seconds = cpu() - start;
    fmt::print(" {:>7} {:>7} {:>9.1f}", report.counters.steps, events.events.size(),
               static_cast<double>(events.events.size()) / seconds);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int greatest = argc > 1 ? std::atoi(argv[1]) : 100000;
  fmt::print("bedded pipe: s of CPU to read, build, check; us a step; peak of memory, MB\n");
  fmt::print("{:>7} {:>4} {:>8} {:>8} {:>8} {:>10} {:>10} {:>10} {:>10} {:>8}\n", "n", "c", "read", "build",
             "check", "ida", "newmark", "iteration", "exact", "MB");
  for (const int n : {100, 1000, 10000, 100000})
    if (n <= greatest) apart([&] { pipe(n, 2); });
  for (const int c : {20, 200})
    if (10000 <= greatest) apart([&] { pipe(10000, c); });
  fmt::print("chain on a belt, 8 s: steps, events, events a second of CPU; ida, newmark, exact; MB\n");
  for (const int n : {100, 1000, 10000})
    if (n <= greatest) apart([&] { belt(n, 20); });
  for (const int c : {2, 200})
    if (1000 <= greatest) apart([&] { belt(1000, c); });
}
