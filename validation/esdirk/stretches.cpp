#include "stretches.hpp"

#include <algorithm>
#include <ctime>
#include <stdexcept>

namespace signorini::esdirk {
namespace {

std::optional<Ending> ending_of(const Model& model, const Event& event,
                                const contact::ContactStates& states) {
  const auto contact = static_cast<std::size_t>(event.contact);
  if (!event.guard_rate || *event.guard_rate == 0.0) return std::nullopt;
  Guard guard = Guard::none;
  if (event.type == EventType::separation) guard = Guard::separation;
  if (event.type == EventType::contact) guard = Guard::closing;
  if (event.type == EventType::stick || event.type == EventType::reversal) guard = Guard::sliding;
  if (event.type == EventType::slip)
    guard = event.to == State::slip_plus ? Guard::slip_plus : Guard::slip_minus;
  for (const GuardForm& g : contact::guards(model.contacts[contact], states[contact]))
    if (g.kind == guard && guard != Guard::none) return Ending{contact, g.form, *event.guard_rate};
  return std::nullopt;
}

Result run(const Scene& scene, const Model& model) {
  Result result = simulate(model, scene.run);
  if (result.report.outcome.kind != Outcome::Kind::done)
    throw std::runtime_error(result.report.outcome.reason);
  return result;
}

}  // namespace

double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Cut cut(Scene scene, const Model& model, double restart) {
  scene.run.output_dt.reset();
  scene.run.frames.clear();
  scene.run.output_times = std::vector<double>{scene.run.t_end};
  Cut result;
  Result bare;
  result.seconds = 1e300;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const double start = processor_time();
    bare = run(scene, model);
    result.seconds = std::min(result.seconds, processor_time() - start);
  }

  std::vector<double> times{0.0, scene.run.t_end};
  for (const Event& event : bare.events) {
    result.events += event.type != EventType::time ? 1 : 0;
    times.push_back(event.t);
  }
  if (restart > 0.0)
    for (double k = 1.0; k * restart < scene.run.t_end; k += 1.0) times.push_back(k * restart);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  scene.run.output_times = times;
  const Result full = run(scene, model);

  for (std::size_t i = 0; i + 1 < full.rows.size(); ++i) {
    const Result::Row &from = full.rows[i], &to = full.rows[i + 1];
    Stretch s{from.t, to.t, from.u, from.v, to.u, to.v, {}, {}};
    for (const ContactSample& c : from.contacts) s.states.push_back({c.state, c.slip});
    int events = 0;
    for (const Event& event : full.events)
      if (event.t == to.t && (++events, event.contact >= 0 && event.type != EventType::time))
        s.ending = ending_of(model, event, s.states);
    if (events > 1) s.ending.reset();
    result.stretches.push_back(std::move(s));
  }
  return result;
}

}  // namespace signorini::esdirk
