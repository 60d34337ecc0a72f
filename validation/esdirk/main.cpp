// Would ESDIRK restart better than BDF? Both go over the stretches between the events of a reference run,
// each from its exact state, with the same condensed solver and the same error norm. Prints Markdown.
//
//   build/release/signorini_esdirk [seconds that a row may take, 20] [scene, all]
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>

#include "integrator.hpp"

namespace {

using namespace signorini;
using namespace signorini::esdirk;

struct Subject {
  std::string name, file;
  std::vector<Override> changes;
  double restart = 0.0;
};

struct Row {
  double rtol = 0.0, seconds = 1e300;
  Tally tally;
  ModeFlow::Count count;
  double state = 0.0;     ///< root mean square over the stretches of the error at their ends
  double inside = 0.0;    ///< the same, interpolated in a step that passes the end
  double greatest = 0.0;  ///< of these errors
  double event = 0.0;     ///< error of the event's time that nine in ten stay below
};

/// What nine in ten stay below: an event at which its guard grazes says nothing about an integrator.
double ninth_decile(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(9 * values.size() / 10);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Row measure(Integrator& integrator, ModeFlow& flow, const std::vector<Stretch>& stretches, double rtol) {
  Row row;
  row.rtol = rtol;
  flow.set_tolerance(rtol);
  flow.count = {};
  std::vector<double> y, states, events;
  Tally unused;
  double passed = 0.0;
  for (const Stretch& s : stretches) {
    const double start = processor_time();
    integrator.run(s, false, y, row.tally);
    passed += processor_time() - start;
    states.push_back(flow.distance(y.data(), s.u1, s.v1));
    const ModeFlow::Count kept = flow.count;
    if (s.ending)
      events.push_back(
          std::abs(flow.value(s.ending->form, s.ending->contact, s.end, y.data()) / s.ending->rate));
    integrator.run(s, true, y, unused);
    const double inside = flow.distance(y.data(), s.u1, s.v1);
    row.inside += inside * inside / static_cast<double>(stretches.size());
    flow.count = kept;
  }
  row.seconds = passed;
  row.inside = std::sqrt(row.inside);
  row.count = flow.count;
  for (const double e : states) row.state += e * e;
  row.state = std::sqrt(row.state / static_cast<double>(states.size()));
  row.greatest = *std::max_element(states.begin(), states.end());
  row.event = ninth_decile(events);
  return row;
}

/// Cost at a given error: logarithmic between the rows above and below; 0: out of their range.
double cost_at(const std::vector<Row>& rows, double error, const std::function<double(const Row&)>& of,
               const std::function<double(const Row&)>& cost) {
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const double above = of(rows[i]), below = of(rows[i + 1]);
    if (above < error || below > error || below <= 0.0 || above <= below) continue;
    const double x = std::log(above / error) / std::log(above / below);
    return cost(rows[i]) * std::pow(cost(rows[i + 1]) / cost(rows[i]), x);
  }
  return 0.0;
}

/// Lines of a table: time and solves at equal error; all[0]: IDA.
void print_frontier(const std::string& of, const std::vector<std::vector<Row>>& all, double stretches,
                    const std::function<double(const Row&)>& error) {
  const auto seconds = [](const Row& r) { return r.seconds; };
  const auto solves = [](const Row& r) { return static_cast<double>(r.count.solves + r.count.derivatives); };
  fmt::print("\n| {} | ida, us | esdirk 3 | esdirk 4 | esdirk 5 | ida / best esdirk | the same of solves |\n",
             of);
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (int decade = -1; decade >= -13; --decade) {
    const double e = std::pow(10.0, decade), ida = cost_at(all[0], e, error, seconds);
    double time = 1e300, work = 1e300;
    std::string line;
    for (std::size_t m = 1; m < all.size(); ++m) {
      const double t = cost_at(all[m], e, error, seconds);
      line += t > 0.0 ? fmt::format(" {:.3g} |", 1e6 * t / stretches) : " - |";
      if (t > 0.0) time = std::min(time, t);
      if (t > 0.0) work = std::min(work, cost_at(all[m], e, error, solves));
    }
    if (ida > 0.0 && time < 1e300)
      fmt::print("| 1e{} | {:.3g} |{} {:.2f} | {:.2f} |\n", decade, 1e6 * ida / stretches, line, ida / time,
                 cost_at(all[0], e, error, solves) / work);
  }
}

void compare(const Subject& subject, double limit) {
  const Scene scene = read_scene(subject.file, subject.changes);
  const Model model = build_model(scene);
  const linear::SystemMatrices structure(model);
  ModeFlow flow(model, structure);
  const Cut reference = cut(scene, model, subject.restart);
  const auto stretches = static_cast<double>(reference.stretches.size());
  double length = 0.0;
  for (const Stretch& s : reference.stretches) length += (s.end - s.begin) / stretches;
  fmt::print("\n## {}\n\n{} degrees of freedom, {} events, {} stretches of {:.3g} s on average, ",
             subject.name, model.size(), reference.events, reference.stretches.size(), length);
  fmt::print("{:.3g} rad of the highest frequency each; the reference run ({}): {:.3g} us a stretch\n\n",
             length * model.omega_max, scene.run.engine == Engine::exact ? "exact" : "ida, rtol 1e-13",
             1e6 * reference.seconds / stretches);
  fmt::print(
      "| method | rtol | steps | failures | solves | f | factorisations | us | state | inside a step | "
      "greatest | event, s | steps to half of the longest | to the highest order "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const bool linear = scene.run.engine == Engine::exact;
  std::vector<std::unique_ptr<Integrator>> integrators;
  integrators.push_back(make_bdf(flow));
  for (const int order : {3, 4, 5}) integrators.push_back(make_esdirk(flow, order, linear));
  std::vector<std::vector<Row>> all(integrators.size());
  std::vector<bool> dear(integrators.size(), false);
  for (int decade = -2; decade >= -10; --decade) {
    const double rtol = std::pow(10.0, decade);
    std::vector<Row> best(integrators.size());
    double spent = 0.0;
    for (int repeat = 0; repeat < 5 && (repeat == 0 || spent < limit / 4.0); ++repeat)
      for (std::size_t m = 0; m < integrators.size(); ++m) {
        if (dear[m]) continue;
        Row row = measure(*integrators[m], flow, reference.stretches, rtol);
        spent += row.seconds;
        row.seconds = std::min(row.seconds, best[m].seconds);
        best[m] = row;
      }
    for (std::size_t m = 0; m < integrators.size(); ++m) {
      if (dear[m]) continue;
      const Row& r = best[m];
      all[m].push_back(r);
      dear[m] = 5.0 * r.seconds > 3.0 * limit;
      const auto each = [&](long n) { return static_cast<double>(n) / stretches; };
      fmt::print(
          "| {} | 1e{} | {:.1f} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | {:.3g} | {:.1e} | {:.1e} | {:.1e} | "
          "{:.1e} | {:.1f} | {} |\n",
          m == 0 ? "ida" : fmt::format("esdirk {}", m + 2), decade, each(r.tally.steps),
          each(r.tally.failures), each(r.count.solves), each(r.count.derivatives),
          each(r.count.factorisations), 1e6 * r.seconds / stretches, r.state, r.inside, r.greatest, r.event,
          each(r.tally.to_length), m == 0 ? fmt::format("{:.1f}", each(r.tally.to_order)) : "");
      std::fflush(stdout);
    }
  }
  print_frontier("error of the state", all, stretches, [](const Row& r) { return r.state; });
  print_frontier("error inside a step", all, stretches, [](const Row& r) { return r.inside; });
  print_frontier("error of the event's time, s", all, stretches, [](const Row& r) { return r.event; });
  std::fflush(stdout);
}

std::vector<Subject> subjects() {
  const std::string cases = SIGNORINI_CASES "/", models = SIGNORINI_MODELS "/";
  const Override exact{"run.engine", "exact"};
  const std::string pipeline = models + "pipeline.toml";
  return {
      {"oscillator", cases + "01b_coulomb_decay_compliant.toml", {exact}},
      {"two-masses", cases + "05g_two_mass_compliant.toml", {exact}},
      {"chain", cases + "10a_bk_chain_20.toml", {exact}},
      {"stribeck",
       cases + "02b_belt_fs_gt_fk.toml",
       {{"run.rtol", "1e-13"},
        {"contacts.f.friction", "{ static = 0.6, kinetic = 0.3, stribeck_velocity = 0.2 }"}}},
      {"chain-stribeck",
       cases + "10a_bk_chain_20.toml",
       {{"run.rtol", "1e-13"},
        {"run.t_end", "30.0"},
        {"run.output_times", "[30.0]"},
        {"contacts.*.friction", "{ static = 1.0, kinetic = 0.7, stribeck_velocity = 0.1 }"}}},
      {"pipeline", pipeline, {exact, {"run.t_end", "0.2"}}},
      {"pipeline-restarts-1e-3", pipeline, {exact, {"run.t_end", "0.05"}}, 1e-3},
      {"pipeline-restarts-1e-4", pipeline, {exact, {"run.t_end", "0.02"}}, 1e-4},
      {"pipeline-restarts-1e-5", pipeline, {exact, {"run.t_end", "0.004"}}, 1e-5},
  };
}

}  // namespace

int main(int argc, char** argv) {
  const double limit = argc > 1 ? std::atof(argv[1]) : 20.0;
  for (const Subject& subject : subjects())
    if (argc <= 2 || subject.name == argv[2]) compare(subject, limit);
}
