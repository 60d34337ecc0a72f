#include "run/run_witness.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "model/said.hpp"
#include "witness/laws.hpp"

namespace signorini {
namespace {

/// Event with the guard's rate in the units of the computation, which are not those of its row.
RecordedEvent recorded(const Event& event, const Decision& decision) {
  RecordedEvent result = recorded_event(event);
  const Crossing* crossing = event.t_uncertainty ? decision.crossing(result.contact) : nullptr;
  if (crossing != nullptr) result.guard_rate = crossing->derivatives[0];
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

RunWitness::RunWitness(const Model& model, const WitnessedEngine& engine, Recorder& recorder)
    : model_(model),
      recorder_(recorder),
      engine_(engine),
      witness_(model, engine.limits),
      motion_(model, engine),
      holds_(std::any_of(model.contacts.begin(), model.contacts.end(),
                         [](const Contact& c) { return !c.normal_spring(); })) {}

namespace {

/// Copy of the data that the record points to.
InstantRow row_of(const InstantRecord& record) {
  const auto side = [](const WitnessedSide& s) {
    return InstantSide{*s.u, *s.v, s.a != nullptr ? *s.a : Vector(), *s.mode, *s.forces};
  };
  InstantRow row;
  row.t = record.t;
  row.resolution = record.resolution;
  row.forgiven = record.forgiven;
  row.dependence = record.dependence;
  row.start = record.start;
  row.breakpoint = record.breakpoint;
  row.load_jumps = record.load_jumps;
  row.located = record.located;
  row.before = side(record.before);
  row.after = side(record.after);
  for (const RecordedImpulse& p : record.impulses)
    row.blows.push_back({static_cast<int>(p.contact), p.turn, p.normal, p.tangent});
  row.captures = record.captures;
  for (const std::size_t k : record.released) row.released.push_back(static_cast<int>(k));
  return row;
}

}  // namespace

void RunWitness::instant(const Instant& now) {
  const Decision& d = *now.decision;
  if (now.start) start_peaks(now);
  motion_.reach(witness_, now.before->u, now.before->v);
  InstantRecord record;
  record.t = now.t;
  record.resolution = now.resolution;
  record.before = std::move(before_);  // their memory is reused
  record.after = std::move(after_);
  motion_.fill(*now.forcing_before, now.t, now.dependence, record.before);
  record.before.u = &now.before->u;
  record.before.v = &now.before->v;
  record.before.forces = &now.before->forces;
  record.before.mode = now.mode_before;
  motion_.fill(*now.forcing_after, now.t, now.dependence, record.after);
  const Vector forces = d.jet.forces.col(0), a = d.jet.a();
  record.after.u = &d.u;
  record.after.v = &d.v;
  record.after.a = &a;
  record.after.a_reach = motion_.of_accelerations(witness_, a, now.dependence);
  record.after.forces = &forces;
  record.after.mode = &d.mode;
  for (const Blow& blow : d.blows)
    record.impulses.push_back({blow.contact, blow.turn, blow.normal, blow.tangent});
  record.captures = d.captures;
  record.released = d.released;
  for (const Event& event : *now.events)
    if (event.contact >= 0) record.events.push_back(recorded(event, d));
  record.start = now.start;
  std::vector<ContactState> left;
  Vector forces_left;
  if (now.start && !model_.continues.empty()) {
    record.continues = record.breakpoint = true;
    left = left_states(model_, *now.mode_before);
    forces_left = left_forces(model_);
    record.before.mode = &left;
    record.before.forces = &forces_left;
  }
  record.breakpoint = record.breakpoint || now.breakpoint;
  record.load_jumps = now.load_jumps;
  record.located = engine_.located && !now.adopted;
  record.forgiven = d.forgiven;
  record.dependence = now.dependence;
  if (holds_) held_forces_ = std::max(held_forces_, witness_.held_forces(record.after));
  for (std::size_t k = 0; k < passed_.size(); ++k)
    passed_[k].surface = std::max(passed_[k].surface, std::abs(record.before.driven[k].s));
  for (const std::size_t turns : {0U, 1U})
    reached_[turns] = std::max(reached_[turns], record.before.u_reach[turns]);
  if (recorder_.wants_instants()) recorder_.instant(row_of(record));
  keep(witness_.instant(record));
  motion_.leave(*now.forcing_after, now.t);
  before_ = std::move(record.before);
  after_ = std::move(record.after);
}

void RunWitness::between(double t, const Forcing& forcing, const Mode& mode, const Point& point,
                         double dependence) {
  if (!engine_.follows) return;
  motion_.fill(forcing, t, dependence, point_);
  WitnessedSide& side = point_;
  side.u = &point.u;
  side.v = &point.v;
  side.a = point.a.size() > 0 ? &point.a : nullptr;
  side.forces = &point.forces;
  side.mode = &mode;
  keep(witness_.between(t, side));
}

namespace {

/// Deformation of the springs of a compliance split along n and t, in addition to the motion of its surfaces.
std::pair<double, double> borrowed(const Contact& c, const ForceLayout& layout, std::size_t k,
                                   const Vector& forces) {
  if (!c.compliance_split()) return {0.0, 0.0};
  return {forces.data()[layout.normal(k)] / c.normal_stiffness,
          c.tangential_stiffness ? forces.data()[layout.tangent(k)] / *c.tangential_stiffness : 0.0};
}

}  // namespace

void RunWitness::start_peaks(const Instant& now) {
  passed_.resize(model_.contacts.size());
  for (std::size_t k = 0; k < passed_.size(); ++k) {
    const Contact& c = model_.contacts[k];
    const auto [n, t] = borrowed(c, model_.layout, k, now.decision->jet.forces.col(0));
    passed_[k].g0 = c.normal.dot(now.decision->u) - n;
    passed_[k].ut0 = c.body_tangent().dot(now.decision->u) - now.forcing_after->surface(k, now.t, 0) - t;
  }
}

void RunWitness::passes(double t, const Forcing& forcing, const Point& point) {
  for (std::size_t k = 0; k < passed_.size(); ++k) passes(k, t, forcing, point);
}

void RunWitness::passes(std::size_t k, double t, const Forcing& forcing, const Point& point) {
  if (engine_.limits.step > 0.0) return;  // peaks are taken at the ends of steps
  const Contact& c = model_.contacts[k];
  PassedPeak& p = passed_[k];
  p.most.N = std::max(p.most.N, std::abs(point.N(model_.layout, k)));
  p.most.T = std::max(p.most.T, std::abs(point.T(model_.layout, k)));
  const auto [along_n, along_t] = borrowed(c, model_.layout, k, point.forces);
  p.most.normal = std::max(p.most.normal, std::abs(c.normal.dot(point.u) - along_n - p.g0));
  const double ut = c.body_tangent().dot(point.u) - forcing.surface(k, t, 0) - along_t;
  p.most.tangential = std::max(p.most.tangential, std::abs(ut - p.ut0));
}

/// Size of the terms of a contact's g and ut, with the largest displacement of each kind.
double RunWitness::place_of(std::size_t k) const {
  const Contact& c = model_.contacts[k];
  const auto size = [&](const Combination& form) {
    double of_form = 0.0, of_u = reached_[0] * reached_[0];
    for (const auto& [dof, factor] : form.terms) {
      const double reach = reached_[model_.dofs[static_cast<std::size_t>(dof)].rotation];
      of_form += factor * factor;
      of_u += reach * reach;
    }
    return std::sqrt(of_form * of_u);
  };
  return size(c.normal) + size(c.tangent) + std::abs(c.gap) + passed_[k].surface;
}

void RunWitness::peaks(double t, const std::vector<Peak>& told) {
  for (std::size_t k = 0; k < passed_.size() && k < told.size(); ++k) {
    const Contact& c = model_.contacts[k];
    const PassedPeak& p = passed_[k];
    // Both values are the same sum, at different points. A fixed point moves by the rounding of the scene's
    // displacements.
    const WitnessLimits& tol = engine_.limits;
    const double place = place_of(k);
    const double length = rounding::of_elimination * (place + model_.scales.displacement) +
                          of_tolerance * (tol.rtol * place + tol.displacement);
    const double force = (c.normal_stiffness + c.tangential_stiffness.value_or(0.0)) * length +
                         (rounding::of_elimination + of_tolerance * tol.rtol) * (p.most.N + p.most.T) +
                         (c.normal_spring() ? 0.0 : rounding::of_elimination * held_forces_) +
                         of_tolerance * tol.force;
    const auto check = [&](double farthest, double said, double limit, const Unit& unit) {
      if (farthest - said > limit)
        keep({{t, "end", static_cast<int>(k), "peak", farthest - said, limit, unit, false}});
    };
    check(p.most.N, told[k].N, force, unit::force);
    check(p.most.T, told[k].T, force, unit::force);
    check(p.most.normal, told[k].normal, length, unit::length);
    check(p.most.tangential, told[k].tangential, length, unit::length);
  }
}

void RunWitness::keep(std::vector<Violation> found) {
  ++testimony_.checked;
  testimony_.violated += static_cast<long>(found.size());
  for (Violation& v : found) {
    if (v.grave && grave_.empty()) {
      Violation shown = v;
      shown.t = said_time(model_, v.t);
      shown.value = said(model_, v.value, v.unit);
      shown.limit = said(model_, v.limit, v.unit);
      grave_ = sentence_of(shown, model_);
    }
    if (testimony_.violations.size() < most_violations) testimony_.violations.push_back(std::move(v));
  }
}

}  // namespace signorini
