#include "differential/witnessed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "differential/track.hpp"
#include "signorini/model.hpp"

namespace signorini::differential {
namespace {

constexpr double steps_a_period = 20.0, fewest_steps = 500.0, most_steps = 20000.0;
constexpr double seconds_of_a_run = 20.0, coarser = 8.0;

struct Way {
  const char* name;
  Engine engine;
  Flow flow = Flow::automatic;
  double rtol = 1e-9, steps = 1.0;  // steps: how many times as long
};

constexpr Way ways[] = {
    {"exact", Engine::exact, Flow::taylor},
    {"modes", Engine::exact, Flow::modal},
    {"ida", Engine::ida},
    {"ida 1e-6", Engine::ida, Flow::automatic, 1e-6},
    {"newmark", Engine::newmark},
    {"newmark 8 dt", Engine::newmark, Flow::automatic, 1e-9, coarser},
    {"friction-iteration", Engine::friction_iteration},
    {"friction-iteration 8 dt", Engine::friction_iteration, Flow::automatic, 1e-9, coarser}};

double excess(const Violation& v) { return v.limit > 0.0 ? v.value / v.limit : v.value; }

void add(const Way& way, const Model& model, const Violation& v, std::vector<Alarm>& alarms) {
  const std::string contact = v.contact < 0 ? "" : model.contacts[static_cast<std::size_t>(v.contact)].name;
  const auto same = std::find_if(alarms.begin(), alarms.end(), [&](const Alarm& a) {
    return a.way == way.name && a.law == v.law && a.contact == contact;
  });
  if (same == alarms.end()) {
    alarms.push_back({way.name, v.law, contact, 1, v});
    return;
  }
  ++same->count;
  if (excess(v) > excess(same->worst)) same->worst = v;
}

}  // namespace

Witnessed before_the_witness(const Scene& scene, long steps) {
  Witnessed result;
  const Model model = build_model(scene);
  const double periods = scene.run.t_end * model.omega_max / (2.0 * std::numbers::pi);
  for (const Way& way : ways) {
    RunSpec spec = scene.run;
    spec.engine = way.engine;
    spec.flow = way.flow;
    spec.certify = Certify::no;
    if (way.engine == Engine::ida) {
      spec.rtol = way.rtol;
      spec.atol = {};
    }
    spec.dt = way.steps * scene.run.t_end /
              std::ceil(std::clamp(steps_a_period * periods, fewest_steps, most_steps));
    const Track track = run(model, spec, {steps, seconds_of_a_run});
    if (track.end == Track::End::refused) continue;
    ++result.runs;
    result.checked += track.report.law_checks.checked;
    for (const Violation& v : track.report.law_checks.violations) add(way, model, v, result.alarms);
  }
  return result;
}

}  // namespace signorini::differential
