#include "engine/exact/modal/modal_engine.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "engine/exact/modal/damped_flow.hpp"
#include "engine/exact/modal/proportional_flow.hpp"
#include "model/internal_units.hpp"
#include "motion/point.hpp"

namespace signorini::modal {
namespace {

constexpr std::size_t max_parts = 256;  // limit of the number of parts of a step: each stores all amplitudes
constexpr int max_touches = 5;          // limit of the number of warnings about touches
constexpr double max_conversion_error = 1e-12;  // limit of the error of a conversion to modes and back
constexpr int max_corrections = 4;  // limit of the corrections of an event time; one is usually enough

}  // namespace

ModalEngine::ModalEngine(const Model& model, const linear::SystemMatrices& structure,
                         motion::StateSystems& systems, double t_end, const ModalOptions& use)
    : model_(model),
      structure_(structure),
      kept_(use.share != nullptr && use.share->memory != nullptr ? use.share->memory->entry_for(model, t_end)
                                                                 : nullptr),
      own_basis_(kept_ ? nullptr : std::make_unique<UnconstrainedBasis>(model)),
      basis_(kept_ ? kept_->basis : *own_basis_),
      taylor_(model, structure, systems, t_end, {false, use.step_seed}),
      turning_points_(model.contacts.size()),
      peaks_(use.peaks) {
  resolves_low_flights = true;  // a gap that starts at zero is examined through its leading derivative
  if (!basis_.failure().empty()) return;
  if (proportional_refusal(model).empty()) {
    flow_ = std::make_unique<ProportionalFlow>(model, basis_, t_end);
  } else {
    if (kept_ && !kept_->damped)
      kept_->damped = std::make_unique<DampedSystem>(kept_->model, kept_->basis, kept_->t_end);
    flow_ = std::make_unique<DampedFlow>(model, basis_, t_end, kept_ ? kept_->damped.get() : nullptr);
  }
  contact_shape_rows_ = rows_of({});
  if (use.watched) watched_ = rows_of(*use.watched);
  if (use.share != nullptr) use.share->modes = flow_->modes();
}

void ModalEngine::warn_of_fallback(double t, const std::string& why) {
  if (fallbacks_++ > 0) return;
  warnings.push_back(fmt::format("the Taylor series replaces the modal flow from t = {:.6g} on: {}",
                                 model::time_in_scene_units(model_, t), why));
}

/// Continues a segment with the Taylor series. The series starts at the beginning of the segment. Its steps up to t_ are
/// skipped, because the modal flow has already computed this part of the motion.
engine::Step ModalEngine::fall_back_to_series() {
  warn_of_fallback(t_, "a guard stays too close to zero for the error bounds of the modal flow");
  modal_ = false;
  taylor_.start(segment_);
  engine::Step step = taylor_.advance();
  while (step.kind == engine::Step::Kind::accepted && step.end <= t_) step = taylor_.advance();
  step.begin = std::max(step.begin, t_);
  return step;
}

std::string ModalEngine::start_modes(const engine::Segment& segment) {
  if (!basis_.failure().empty()) return basis_.failure();
  const decide::Decision& decision = *segment.decision;
  // Most decisions do not change the motion. Then q_ and rate_ stay valid, and a conversion with rounding errors is avoided.
  if (!modal_ || q_.size() == 0 || decision.u != end_.u || decision.v != end_.v) {
    q_ = basis_.amplitudes(decision.u);
    rate_ = basis_.amplitudes(decision.v);
  }
  segment_ = segment;
  return flow_->start(segment_, q_, rate_, now_);
}

void ModalEngine::start(const engine::Segment& segment) {
  const std::string why = start_modes(segment);
  const decide::Decision& decision = *segment.decision;
  modal_ = why.empty();
  if (!modal_) {
    warn_of_fallback(decision.jet.t, why);
    taylor_.start(segment);
    return;
  }
  if (decision.jet.t != t_) rest_ = 0.0;
  t_ = decision.jet.t;
  turning_points_.start(decision);
  has_works_ = false;
  end_ = {decision.u, decision.v, decision.jet.forces.col(0), decision.jet.a()};
  ++restarts_;
}

/// Updates cancellation_: the rounding error due to terms that cancel, relative to the admissible error of a conversion to
/// modes and back. Responses of slow modes to loads are sums of terms far greater than the motion.
void ModalEngine::update_cancellation() {
  const motion::StructureEnergy energy = energy_of(q_, rate_);
  max_velocity_ = std::max(max_velocity_, std::sqrt(2.0 * (energy.kinetic + energy.elastic)));
  max_displacement_ =
      std::max({max_displacement_, q_.norm(), model_.omega1 > 0.0 ? max_velocity_ / model_.omega1 : 0.0});
  const SumTerms terms = flow_->terms(now_);
  const auto over = [](double sum, double motion) {
    return motion > 0.0 ? rounding::many_operations * sum / (max_conversion_error * motion) : 0.0;
  };
  cancellation_ = std::max({1.0, over(terms.amplitude, max_displacement_), over(terms.rate, max_velocity_),
                            over(terms.omega_amplitude, max_velocity_)});
}

void ModalEngine::warn_of_touches(const Passage& passage, double begin) {
  for (const std::size_t slot : passage.touches)
    if (++touches_ <= max_touches)
      warnings.push_back(
          fmt::format("contact '{}': its {} touches zero near t = {:.9g}; double precision cannot decide "
                      "whether it crosses zero, so no event is recorded",
                      model_.contacts[model_.layout.contact_of_guard(slot)].name,
                      contact::to_string(segment_.decision->guards[slot].kind),
                      model::time_in_scene_units(model_, begin)));
}

/// Time from t_ to the root of the guard, computed with the forces that the decision will use, and the uncertainty of this time
/// due to the rounding of the modes.
ModalEngine::ZeroCrossing ModalEngine::crossing_of(std::size_t slot, const motion::Point& point) const {
  const std::size_t c = model_.layout.contact_of_guard(slot);
  const ContactMotion now = motion::motion_of(model_.contacts[c], c, *segment_.forcing, t_, point);
  const double slope = flow_->slope(slot, now_, point, t_);
  if (!(slope < 0.0)) return {};
  return {-segment_.decision->form(slot).value(now) / slope,
          -rounding::many_operations * flow_->magnitude(slot, now_) / slope};
}

/// Moves the end of the last part to the root of the guard, with forces computed from u and v as in the decision. In modes the
/// guard is zero only up to the rounding of the modes, which exceeds the rounding bound of the decision. Returns the
/// uncertainty of the time. begin_rest: rest_ at the beginning of the part.
double ModalEngine::refine_crossing(std::size_t slot, double begin_rest) {
  Part& part = parts_.back();
  for (int i = 0;; ++i) {
    t_ = part.begin + (part.length + begin_rest);
    rest_ = exact::rest_of_sum(part.begin, part.length + begin_rest, t_);
    Motion reached = motion(now_, true);
    motion::Point point;
    fill_rows(contact_shape_rows_, now_, reached, point);
    const ZeroCrossing fall = crossing_of(slot, point);
    const bool sharp =
        std::abs(fall.offset) <= std::max(0.25 * motion::resolution_at(t_, 0.0), fall.uncertainty);
    if (i == max_corrections || sharp) {
      fill(now_, std::move(reached), end_);
      return fall.uncertainty;
    }
    part.length = std::max(0.0, part.length + fall.offset);
    flow_->advance(part.at, part.length, now_);
  }
}

engine::Step ModalEngine::advance() {
  if (!modal_) return taylor_.advance();
  engine::Step step;
  step.begin = t_;
  parts_.clear();
  turning_times_.clear();
  last_turning_times_.clear();
  ++steps_;
  for (;;) {
    const double begin_rest = rest_, remaining = segment_.end - t_ - begin_rest;
    const Passage passage = flow_->pass(now_, remaining);
    ++proofs_;
    double end = t_ + (passage.length + begin_rest);
    const bool last =
        !passage.triggered && (end >= segment_.end || segment_.end - end <= motion::resolution_at(end, 0.0));
    if (last) end = segment_.end;
    const bool stuck =
        !passage.triggered && !last && !(passage.length > 0.01 * motion::resolution_at(t_, 0.0));
    if (stuck && parts_.empty()) return fall_back_to_series();
    if (stuck) break;
    if (!std::isfinite(passage.length)) {
      step.kind = engine::Step::Kind::failed;
      step.end = t_;
      step.reason = "the motion overflows and is no longer finite";
      return step;
    }
    warn_of_touches(passage, t_);
    const double length = last ? remaining : passage.length;
    parts_.push_back({t_, length, now_});
    ModalPoint next;
    flow_->advance(now_, length, next);
    if (peaks_)
      flow_->find_turning_points(now_, t_, passage.length, parts_.size() == 1, turning_points_,
                                 last_turning_times_);
    now_ = std::move(next);
    rest_ = last ? 0.0 : exact::rest_of_sum(t_, length + begin_rest, end);
    t_ = end;
    if (passage.triggered) {
      step.resolution = refine_crossing(*passage.triggered, begin_rest);
      step.kind = engine::Step::Kind::event;
      step.triggered = {{model_.layout.contact_of_guard(*passage.triggered),
                         segment_.decision->guards[*passage.triggered].kind, passage.unseen}};
      break;
    }
    if (last) break;
    flow_->rearm(now_);
    if (parts_.size() >= max_parts) break;
  }
  for (const auto& [kind, time] : last_turning_times_)
    if (time < t_) turning_times_.push_back(time);  // the step ends at t_, the refined time of the event
  std::sort(turning_times_.begin(), turning_times_.end());
  step.end = t_;
  step.resolution = std::max(step.resolution, motion::resolution_at(t_, parts_.back().length));
  if (step.kind != engine::Step::Kind::event) fill(now_, motion(now_, true), end_);
  update_cancellation();
  return step;
}

ModalPoint ModalEngine::at(double t) const {
  if (t == t_) return now_;
  ModalPoint point;
  if (t > t_) {  // t is after the refined time of the event
    flow_->advance(now_, t - t_, point);
    return point;
  }
  auto part = std::upper_bound(parts_.begin(), parts_.end(), t,
                               [](double time, const Part& p) { return time < p.begin; });
  if (part != parts_.begin()) --part;
  flow_->advance(part->at, t - part->begin, point);
  return point;
}

/// Energy 1/2 (q'^2 + omega^2 q^2). All terms are positive, so none cancel.
motion::StructureEnergy ModalEngine::energy_of(const Vector& q, const Vector& rate) const {
  return {0.5 * rate.squaredNorm(), 0.5 * basis_.omega_squared().dot(q.cwiseAbs2())};
}

void ModalEngine::set_energy(motion::Point& point) const {
  if (!flow_) return;
  const bool same = modal_ && q_.size() > 0 && point.u == end_.u && point.v == end_.v;
  point.energy =
      same ? energy_of(q_, rate_) : energy_of(basis_.amplitudes(point.u), basis_.amplitudes(point.v));
}

ModalEngine::Motion ModalEngine::motion(const ModalPoint& z, bool accelerations) const {
  Motion m;
  flow_->motion(z, m.q, m.rate, accelerations ? &m.change : nullptr);
  return m;
}

/// Computes the forces and the energy of a point whose u and v are known.
void ModalEngine::fill_rest(const ModalPoint& z, const Motion& motion, motion::Point& point) const {
  point.forces.resize(model_.force_count());
  flow_->forces(z, point);
  point.energy = energy_of(motion.q, motion.rate);
}

/// Computes u, v, forces and energy of the point, and a if the motion contains accelerations. If the point is end_, also stores
/// q_ and rate_.
void ModalEngine::fill(const ModalPoint& z, Motion&& motion, motion::Point& point) {
  if (motion.change.size() > 0) {
    basis_.motions({&motion.q, &motion.rate, &motion.change}, {&point.u, &point.v, &point.a});
  } else {
    basis_.motions({&motion.q, &motion.rate}, {&point.u, &point.v});
    point.a.resize(0);
  }
  fill_rest(z, motion, point);
  if (&point == &end_) {
    q_ = std::move(motion.q);
    rate_ = std::move(motion.rate);
  }
}

/// Rows of Phi for the degrees of freedom of all contacts and for `dofs`.
ModalEngine::Rows ModalEngine::rows_of(std::vector<int> dofs) const {
  for (const Contact& contact : model_.contacts)
    for (const Combination* form : {&contact.normal, &contact.tangent, &contact.body_tangent()})
      for (const auto& [dof, factor] : form->terms) dofs.push_back(dof);
  std::sort(dofs.begin(), dofs.end());
  dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  RowMatrix shapes = basis_.shapes()(dofs, Eigen::all);
  return {std::move(dofs), std::move(shapes)};
}

/// Computes some entries of u, v and a, bitwise equal to those of fill(). All other entries are NaN.
void ModalEngine::fill_rows(const Rows& rows, const ModalPoint& z, const Motion& motion,
                            motion::Point& point) const {
  Vector u, v, a;
  const bool accelerations = motion.change.size() > 0;
  if (accelerations)
    thin_product(rows.shapes, {&motion.q, &motion.rate, &motion.change}, {&u, &v, &a});
  else
    thin_product(rows.shapes, {&motion.q, &motion.rate}, {&u, &v});
  const auto put = [&](const Vector& some, Vector& all) {
    all.setConstant(model_.size(), std::numeric_limits<double>::quiet_NaN());
    all(rows.dofs) = some;
  };
  put(u, point.u);
  put(v, point.v);
  if (accelerations)
    put(a, point.a);
  else
    point.a.resize(0);
  fill_rest(z, motion, point);
}

void ModalEngine::evaluate(double t, motion::Point& point) {
  if (!modal_) {
    point.energy.reset();
    return taylor_.evaluate(t, point);
  }
  if (t == t_) {
    point = end_;
    return;
  }
  const ModalPoint z = at(t);
  fill(z, motion(z, false), point);
}

void ModalEngine::evaluate_watched(double t, std::optional<std::size_t> /*contact*/, motion::Point& point) {
  if (!modal_ || t == t_ || watched_.dofs.empty()) return evaluate(t, point);
  const ModalPoint z = at(t);
  fill_rows(watched_, z, motion(z, false), point);
}

void ModalEngine::accelerate(double t, motion::Point& point) {
  if (point.a.size() == 0) interpolate(t, point);
}

void ModalEngine::interpolate(double t, motion::Point& point) {
  if (!modal_ || t == t_) return evaluate(t, point);
  const ModalPoint z = at(t);
  fill(z, motion(z, true), point);
}

void ModalEngine::integrate(double from, double to, motion::WorkIntegrals& works) {
  if (!modal_) return taylor_.integrate(from, to, works);
  if (!has_works_ || works_end_ != from) works_point_ = at(from);
  ModalPoint next = at(to);
  flow_->add_works(works_point_, next, to - from, works);
  works_point_ = std::move(next);
  works_end_ = to;
  has_works_ = true;
}

engine::StepFacts ModalEngine::facts() const {
  engine::StepFacts facts;
  if (modal_) {
    facts.turning_points = turning_times_;
    facts.eigenvector_condition = std::max(flow_->eigenvector_condition(), cancellation_);
    if (!parts_.empty()) facts.fast_modes = this;
    return facts;
  }
  facts = taylor_.facts();
  facts.contact_turning_points = nullptr;  // evaluate_watched() is not faster for one contact
  return facts;
}

std::optional<engine::FastModeBound> ModalEngine::fast_mode_bound(double omega) const {
  return flow_->fast_mode_bound(parts_.front().at, t_ - parts_.front().begin, omega);
}

/// Each amplitude is a sum over the whole structure, so its rounding error is relative to |q|, not to the amplitude. The errors
/// of velocities and accelerations are larger by the factors w and w^2, where w is the highest circular frequency. The forces
/// of springs and dashpots bound the contact forces.
engine::FastModeBound ModalEngine::term_sizes() const {
  const Motion m = motion(parts_.front().at, false);
  const auto norm = [](const Vector& of) { return of.norm(); };
  const double w = model_.omega_max, q = norm(m.q), rate = norm(m.rate);
  engine::FastModeBound r{q + rate / w, w * q + rate, w * (w * q + rate), Vector::Zero(model_.force_count())};
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const double N = contact.normal_stiffness * r.u + contact.normal_damping * r.v;
    const double T = contact.tangential_stiffness.value_or(0.0) * r.u;
    r.forces[static_cast<Eigen::Index>(model_.layout.normal(c))] = N * norm(basis_.normal(c));
    r.forces[static_cast<Eigen::Index>(model_.layout.tangent(c))] =
        T * norm(basis_.tangent(c)) + contact::static_friction(contact) * N * norm(basis_.normal(c));
  }
  return r;
}

double ModalEngine::residual() {
  if (!modal_) return taylor_.residual();
  return motion::equilibrium_residual(model_, structure_, *segment_.forcing, t_, end_);
}

engine::StepperReport ModalEngine::report() {
  engine::StepperReport report{taylor_.counters, warnings, {}, {}};
  report.counters.steps += steps_;
  report.counters.restarts += restarts_;
  report.counters.contact_states = flow_ ? flow_->states_made() : 0;
  report.counters.proof_steps = proofs_;
  report.counters.fallbacks = fallbacks_;
  report.warnings.insert(report.warnings.end(), taylor_.warnings.begin(), taylor_.warnings.end());
  return report;
}

}  // namespace signorini::modal
