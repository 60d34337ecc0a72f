// Kernels, by Google Benchmark: each alone, warm, at several sizes. Argument: degrees of freedom of the
// bedded pipe (scenes.hpp); 51 is models/pipeline.toml.
//
//   build/release/signorini_kernels --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "decide/contact_state_solver.hpp"
#include "decide/driven_states.hpp"
#include "engine/events/first_root.hpp"
#include "engine/events/step_history.hpp"
#include "engine/newmark/newmark_step.hpp"
#include "floor.hpp"
#include "linear/system_matrices.hpp"
#include "linear/system_matrix.hpp"
#include "scenes.hpp"
#include "signorini/simulate.hpp"

namespace {

using namespace signorini;
using benchmark::DoNotOptimize;
using benchmark::State;

/// Models are dear to build and shared.
const Model& model_of(long n) {
  static std::map<long, Model> models;
  const auto known = models.find(n);
  if (known != models.end()) return known->second;
  return models[n] =
             build_model(n == 51 ? read_scene(SIGNORINI_MODELS "/pipeline.toml")
                                 : parse_scene(benchmarks::bedded_pipe(static_cast<int>(n), 2, 1.0), "pipe"));
}

/// All that stands behind an engine, in the states at t = 0.
struct Bench {
  explicit Bench(long n)
      : model(model_of(n)),
        structure(model),
        systems(model, structure),
        forcing(model, 0.0, motion::Side::after),
        states(decide::initial_states(model, forcing, 0.0, model.u0, model.v0)) {}
  const Model& model;
  linear::SystemMatrices structure;
  motion::StateSystems systems;
  motion::Forcing forcing;
  contact::ContactStates states;
};

std::vector<linear::Weights> bdf_weights(const Model& model, double cj) {
  return {static_cast<std::size_t>(model.size()), linear::Weights{cj, 1.0, 1.0 / cj}};
}

void ida_floor(State& state) {
  const Model& model = model_of(state.range(0));
  const auto contacts = static_cast<int>(model.contacts.size());
  benchmarks::Floor floor(2 * model.size() + 2 * contacts, 3 * contacts, 1e-6, state.range(1) != 0);
  floor.steps(100);
  for (auto _ : state) floor.steps(1);
  state.counters["order"] = floor.order();
}

void momentum(State& state) {
  const Bench b(state.range(0));
  linear::StructuralForces product(b.model, b.structure);
  std::vector<double> r(static_cast<std::size_t>(b.model.size()));
  for (auto _ : state) {
    for (std::size_t i = 0; i < r.size(); ++i)
      product.put(i, 1.0, 0.1, b.model.u0[static_cast<Eigen::Index>(i)]);
    product.apply(r.data());
    DoNotOptimize(r.data());
  }
}

void damping_power(State& state) {
  const Bench b(state.range(0));
  const Vector v = Vector::Ones(b.model.size());
  for (auto _ : state) DoNotOptimize(b.structure.damping_power(v.data()));
}

void factor(State& state) {
  const Bench b(state.range(0));
  linear::SystemMatrix matrix(b.model, b.structure);
  const auto rows = linear::rows_of(b.model, b.states);
  const auto weights = bdf_weights(b.model, 1e6);
  for (auto _ : state) DoNotOptimize(matrix.set(rows, weights, true));
}

void refactor(State& state) {
  const Bench b(state.range(0));
  linear::SystemMatrix matrix(b.model, b.structure);
  const auto rows = linear::rows_of(b.model, b.states);
  const auto weights = bdf_weights(b.model, 1e6);
  matrix.set(rows, weights, true);
  for (auto _ : state) DoNotOptimize(matrix.set(rows, weights, false));
}

void solve(State& state) {
  const Bench b(state.range(0));
  linear::SystemMatrix matrix(b.model, b.structure);
  matrix.set(linear::rows_of(b.model, b.states), bdf_weights(b.model, 1e6), true);
  std::vector<double> x(static_cast<std::size_t>(matrix.size()), 1.0), y = x;
  for (auto _ : state) {
    y = x;
    matrix.solve(y.data());
    DoNotOptimize(y.data());
  }
}

/// Taylor coefficients of one step of engine `exact`, 30 levels.
void taylor(State& state) {
  Bench b(state.range(0));
  const motion::StateSystemPtr system = b.systems.system_of(b.states);
  if (!system) return state.SkipWithError("singular");
  motion::Taylor series(b.systems);
  motion::Series out;
  for (auto _ : state) {
    series.expand(system, b.forcing, 0.0, b.model.u0, b.model.v0, 30, 3.0 / b.model.omega_max, out);
    DoNotOptimize(out.u.data());
  }
}

void newmark_step(State& state) {
  Bench b(state.range(0));
  newmark::NewmarkStep step(b.model, b.structure);
  const motion::StateSystemPtr system = b.systems.system_of(b.states);
  if (!system) return state.SkipWithError("singular");
  step.set({}, system->rows());
  motion::Point from{b.model.u0, b.model.v0,
                     Vector::Zero(2 * static_cast<Eigen::Index>(b.model.contacts.size())),
                     Vector::Zero(b.model.size())};
  motion::Point to;
  if (!step.take(b.forcing, from, 1e-5, 1e-5, true, to)) return state.SkipWithError("singular");
  for (auto _ : state) DoNotOptimize(step.take(b.forcing, from, 1e-5, 1e-5, true, to));
}

/// The states at an instant, with all that a restart needs but the integrator's own.
void decide(State& state) {
  Bench b(state.range(0));
  decide::ContactStateSolver decider(b.systems, 1000, 0.0);
  for (auto _ : state) {
    decide::Instant instant;
    instant.u = b.model.u0;
    instant.v = b.model.v0;
    instant.resolution = 1e-15;
    instant.start = true;
    instant.states = b.states;
    DoNotOptimize(decider.decide(std::move(instant), b.forcing, b.forcing));
  }
}

/// One guard's check at the end of a step: quick proof (0), Bernstein coefficients (1).
void guard_polynomial(State& state) {
  events::StepHistory history(1);
  *history.restart(0.0) = 1.0;
  for (int i = 1; i <= 8; ++i) {
    *history.push(0.1 * i, 0.1) = 1.0 + 0.01 * std::sin(i);
    history.prepare(5);
  }
  for (auto _ : state) {
    if (state.range(0) == 0)
      DoNotOptimize(history.clearly_positive(0));
    else
      DoNotOptimize(history.polynomial(0).positive());
  }
}

void sizes(benchmark::internal::Benchmark* b) {
  for (const int n : {51, 1000, 10000, 100000}) b->Arg(n);
}

BENCHMARK(ida_floor)->ArgsProduct({{51, 1000, 10000, 100000}, {0, 1}});
BENCHMARK(momentum)->Apply(sizes);
BENCHMARK(damping_power)->Apply(sizes);
BENCHMARK(solve)->Apply(sizes);
BENCHMARK(refactor)->Apply(sizes);
BENCHMARK(factor)->Apply(sizes);
BENCHMARK(taylor)->Apply(sizes);
BENCHMARK(newmark_step)->Apply(sizes);
BENCHMARK(decide)->Apply(sizes);
BENCHMARK(guard_polynomial)->Arg(0)->Arg(1);

}  // namespace

BENCHMARK_MAIN();
