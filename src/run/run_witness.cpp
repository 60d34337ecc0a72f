#include "run/run_witness.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/quantities.hpp"

namespace signorini {
namespace {

constexpr std::size_t most_violations = 100;  // that are kept; all are counted

WitnessLimits limits_of(const RunSpec& run, const Tolerance& tolerance, bool knows_low_flights) {
  WitnessLimits limits;
  limits.capture_velocity = tolerance.capture_velocity();
  limits.knows_low_flights = knows_low_flights;
  if (name_of(run.engine).accuracy == Accuracy::step) limits.step = run.dt.value_or(0.0);
  if (name_of(run.engine).accuracy != Accuracy::tolerance) return limits;
  limits.rtol = tolerance.rtol;
  limits.displacement = tolerance.displacement;
  limits.rotation = tolerance.rotation;
  limits.velocity = tolerance.velocity;
  limits.angular_velocity = tolerance.angular_velocity;
  limits.force = tolerance.force;
  return limits;
}

RecordedEvent recorded(const Event& event, const Decision& decision) {
  RecordedEvent result;
  result.contact = static_cast<std::size_t>(event.contact);
  result.type = to_string(event.type);
  result.from = event.from;
  result.to = event.to;
  if (!event.t_uncertainty) return result;
  result.t_uncertainty = *event.t_uncertainty;
  result.guard_rate = decision.crossings[result.contact].derivatives[0];
  return result;
}

}  // namespace

std::string sentence_of(const Violation& v, const Model& model) {
  const std::string who =
      v.contact >= 0 ? fmt::format("contact '{}'", model.contacts[static_cast<std::size_t>(v.contact)].name)
                     : std::string("the structure");
  return fmt::format("the witness finds that {} breaks the law of {} at t = {:.9g}: {:.4g}, limit {:.2g}",
                     who, v.law, v.t, v.value, v.limit);
}

std::string sentence_of(const Testimony& testimony, const Model& model) {
  std::string sentence = sentence_of(testimony.violations.front(), model);
  if (testimony.violated > 1) sentence += fmt::format(" (the first of {})", testimony.violated);
  return sentence;
}

// A sum over modes starts a flight at g = 0 and does not see it return where it is lower than the sum's rounding.
RunWitness::RunWitness(const Model& model, const RunSpec& run, const Tolerance& tolerance,
                       bool sums_over_modes, bool knows_low_flights)
    : model_(model),
      witness_(model, limits_of(run, tolerance, knows_low_flights && !sums_over_modes)),
      located_(run.engine != Engine::friction_iteration &&
               !(run.engine == Engine::newmark && run.refine == Refine::linear)),
      follows_(run.engine != Engine::friction_iteration),
      ends_(name_of(run.engine).accuracy != Accuracy::step),
      sums_over_modes_(sums_over_modes) {}

WitnessedSide RunWitness::side_of(const Forcing& forcing, double t) const {
  WitnessedSide side;
  side.u_reach = u_reach_;
  side.v_reach = v_reach_;
  side.driven.resize(model_.contacts.size());
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    side.driven[k] = {forcing.surface(k, t, 0), forcing.surface(k, t, 1), forcing.surface(k, t, 2),
                      forcing.pressing(k, t, 0), forcing.pressing(k, t, 1)};
  return side;
}

/// At instants alone: what is greater between two is little greater.
void RunWitness::reach(const Vector& u, const Vector& v) {
  for (int i = 0; i < model_.size(); ++i) {
    const bool turns = model_.dofs[static_cast<std::size_t>(i)].rotation;
    u_reach_[turns] = std::max(u_reach_[turns], std::abs(u[i]));
    v_reach_[turns] = std::max(v_reach_[turns], std::abs(v[i]));
  }
  if (!sums_over_modes_) return;
  const std::array<double, 2> of_u = witness_.modal_size(u), of_v = witness_.modal_size(v);
  for (std::size_t turns : {0U, 1U}) {
    u_reach_[turns] = std::max(u_reach_[turns], of_u[turns]);
    v_reach_[turns] = std::max(v_reach_[turns], of_v[turns]);
  }
}

void RunWitness::instant(const Instant& now) {
  const Decision& d = *now.decision;
  reach(now.before->u, now.before->v);
  InstantRecord record;
  record.t = now.t;
  record.resolution = now.resolution;
  record.before = side_of(*now.forcing_before, now.t);
  record.before.u = &now.before->u;
  record.before.v = &now.before->v;
  record.before.forces = &now.before->forces;
  record.before.mode = now.mode_before;
  record.after = side_of(*now.forcing_after, now.t);
  const Vector forces = d.jet.forces.col(0), a = d.jet.a();
  record.after.u = &d.u;
  record.after.v = &d.v;
  record.after.a = &a;
  record.after.forces = &forces;
  record.after.mode = &d.mode;
  for (const Impulse& p : d.impulses)
    record.impulses.push_back({p.normal, p.tangent, p.strikes, p.rebound < 1.0, p.turn});
  record.captures = d.captures;
  for (const Event& event : *now.events)
    if (event.contact >= 0) record.events.push_back(recorded(event, d));
  record.start = now.start;
  record.breakpoint = now.breakpoint;
  record.load_jumps = now.load_jumps;
  record.located = located_ && !now.adopted;
  record.forgiven = d.forgiven;
  keep(witness_.instant(record));
}

void RunWitness::between(double t, const Forcing& forcing, const Mode& mode, const Point& point) {
  if (!follows_) return;
  WitnessedSide side = side_of(forcing, t);
  side.u = &point.u;
  side.v = &point.v;
  side.a = point.a.size() > 0 ? &point.a : nullptr;
  side.forces = &point.forces;
  side.mode = &mode;
  keep(witness_.between(t, side));
}

void RunWitness::keep(std::vector<Violation> found) {
  ++testimony_.checked;
  testimony_.violated += static_cast<long>(found.size());
  for (Violation& v : found) {
    if (v.grave && ends_ && grave_.empty()) {
      Violation shown = v;
      shown.t *= model_.unit.time;
      shown.value *= factor_of(v.unit, model_.unit);
      shown.limit *= factor_of(v.unit, model_.unit);
      grave_ = sentence_of(shown, model_);
    }
    if (testimony_.violations.size() < most_violations) testimony_.violations.push_back(std::move(v));
  }
}

}  // namespace signorini
