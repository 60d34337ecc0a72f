#include "run/run_law_checker.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "law_check/laws.hpp"
#include "model/internal_units.hpp"
#include "run/engines.hpp"

namespace signorini::run {
namespace {

// Modes of a contact state are used only if they reproduce a motion to 1e-12 of its size (src/engine/exact/modal).
// of_round_trip: this error relative to the rounding error of other sums.
constexpr double round_trip = 1e-12, of_round_trip = round_trip / rounding::elimination;

}  // namespace

// An engine that sums over modes does not resolve low flights: the return of a flight that is lower than the rounding of
// the sum is not detected.
CheckedEngine checked_engine(const RunSpec& run, const engine::Tolerance& tolerance, const std::string& flow,
                             bool low_flights) {
  CheckedEngine engine;
  const Accuracy accuracy = engine_info(run.engine).accuracy;
  engine.sums_over_modes = flow == "modal";
  const EngineCapabilities& can = engine_row(run.engine).capabilities;
  engine.laws_at_step_ends = can.laws_at_step_ends;
  engine.located = can.locates_events(run);
  law_check::LawLimits& limits = engine.limits;
  limits.capture_velocity = tolerance.capture_velocity();
  limits.resolves_low_flights = low_flights && !engine.sums_over_modes;
  if (accuracy == Accuracy::step) limits.step = run.dt.value_or(0.0);
  if (accuracy != Accuracy::tolerance) return engine;
  limits.rtol = tolerance.rtol;
  limits.displacement = tolerance.displacement;
  limits.rotation = tolerance.rotation;
  limits.velocity = tolerance.velocity;
  limits.angular_velocity = tolerance.angular_velocity;
  limits.force = tolerance.force;
  return engine;
}

law_check::RecordedEvent recorded_event(const Event& event) {
  law_check::RecordedEvent result;
  result.contact = static_cast<std::size_t>(event.contact);
  result.type = to_string(event.type);
  result.from = event.from;
  result.to = event.to;
  result.gap = event.gap;
  result.N = event.N;
  result.T = event.T;
  result.N_after = event.N_after;
  result.T_after = event.T_after;
  result.vn = event.vn;
  result.vn_after = event.vn_after;
  result.vt = event.vt;
  result.vt_after = event.vt_after;
  result.impulse_n = event.impulse_n.value_or(0.0);
  result.impulse_t = event.impulse_t.value_or(0.0);
  if (event.t_uncertainty) result.t_uncertainty = *event.t_uncertainty;
  return result;
}

std::vector<ContactState> final_states(const Model& model, const std::vector<ContactState>& guessed) {
  std::vector<ContactState> states = guessed;
  for (std::size_t k = 0; k < model.saved_contacts.size(); ++k) {
    const SavedState::FinalContact& left = model.saved_contacts[k];
    if (!model.contacts[k].obeys_coulomb()) continue;
    for (const State state : {State::open, State::closed, State::stick, State::slip_plus, State::slip_minus})
      if (left.state == to_string(state)) states[k] = {state, state == State::stick ? left.slip : 0.0};
    if (states[k].state == State::open && left.gap && *left.gap < 0.0) states[k].state = State::inside;
  }
  return states;
}

Vector final_forces(const Model& model) {
  Vector forces = Vector::Zero(model.force_count());
  for (std::size_t k = 0; k < model.saved_contacts.size(); ++k) {
    forces[static_cast<Eigen::Index>(model.layout.normal(k))] = model.saved_contacts[k].N;
    forces[static_cast<Eigen::Index>(model.layout.tangent(k))] = model.saved_contacts[k].T;
  }
  return forces;
}

CheckedMotion::CheckedMotion(const Model& model, const CheckedEngine& engine)
    : model_(model),
      sums_over_modes_(engine.sums_over_modes),
      massless_(
          std::any_of(model.dofs.begin(), model.dofs.end(), [](const Dof& dof) { return dof.massless; })),
      step_(engine.limits.step),
      jerk_(model.contacts.size(), 0.0) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (!model.contacts[k].surface_motion.is_constant() || !model.contacts[k].normal_force.is_constant())
      driven_.push_back(k);
}

void CheckedMotion::finish_instant(const motion::Forcing& forcing, double t) {
  if (!(step_ > 0.0)) return;
  for (const std::size_t k : driven_) jerk_[k] = std::abs(forcing.surface(k, t, 3));
}

law_check::CheckedSide CheckedMotion::side(const motion::Forcing& forcing, double t,
                                           double dependence) const {
  law_check::CheckedSide side;
  fill(forcing, t, dependence, side);
  return side;
}

law_check::Driven CheckedMotion::driven_at(std::size_t k, const motion::Forcing& forcing, double t) const {
  law_check::Driven d;
  d.s = forcing.surface(k, t, 0);
  d.ds = forcing.surface(k, t, 1);
  d.dds = forcing.surface(k, t, 2);
  d.q = forcing.applied_normal_force(k, t, 0);
  d.dq = forcing.applied_normal_force(k, t, 1);
  d.ddq = forcing.applied_normal_force(k, t, 2);
  if (step_ > 0.0)
    d.drift = step_ * step_ / 12.0 *
              (jerk_[k] + std::abs(forcing.surface(k, t, 3)) + step_ * std::abs(forcing.surface(k, t, 4)));
  return d;
}

void CheckedMotion::fill(const motion::Forcing& forcing, double t, double dependence,
                         law_check::CheckedSide& side) const {
  side.layout = model_.layout;
  for (std::size_t turns : {0U, 1U}) {
    // Between two instants the motion may reach the scene's displacements, even if it is at rest at both instants.
    const double own = turns ? model_.scales.rotation : model_.scales.displacement;
    side.max_u[turns] = std::max({own, u_reach_[turns], dependence * of_round_trip * u_modal_[turns]});
    // The velocity of a body at rest has the rounding of the prescribed motion, for example A cos(w t - pi/2) at t = 0.
    const double given = rounding::few_operations / rounding::elimination *
                         (turns ? model_.scales.angular_velocity : model_.scales.velocity);
    side.max_v[turns] = std::max({given, v_reach_[turns], dependence * of_round_trip * v_modal_[turns]});
  }
  if (sums_over_modes_) side.modal_mismatch = dependence * round_trip * std::sqrt(energy_ + kinetic_);
  side.energy_speeds = speeds_.empty() ? nullptr : speeds_.data();
  if (side.driven.size() == model_.contacts.size()) {
    for (const std::size_t k : driven_) side.driven[k] = driven_at(k, forcing, t);
  } else {
    side.driven.clear();
    for (std::size_t k = 0; k < model_.contacts.size(); ++k) side.driven.push_back(driven_at(k, forcing, t));
  }
  if (!massless_) return;
  side.loads.resize(3);
  for (int order = 0; order < 3; ++order) {
    Vector& load = side.loads[static_cast<std::size_t>(order)];
    load.setZero(model_.size());
    forcing.add_load(t, order, load.data());
  }
}

void CheckedMotion::update_maxima(const law_check::LawChecker& witness, const Vector& u, const Vector& v) {
  for (int i = 0; i < model_.size(); ++i) {
    const bool turns = model_.dofs[static_cast<std::size_t>(i)].rotation;
    u_reach_[turns] = std::max(u_reach_[turns], std::abs(u[i]));
    v_reach_[turns] = std::max(v_reach_[turns], std::abs(v[i]));
  }
  energy_ = std::max(energy_, witness.twice_energy(u));
  for (std::size_t k = lightness_.size(); k < model_.contacts.size(); ++k)
    lightness_.push_back(witness.speed_per_energy_root(k));
  const double root = std::sqrt(energy_);
  speeds_.resize(lightness_.size());
  for (std::size_t k = 0; k < speeds_.size(); ++k) speeds_[k] = lightness_[k] * root;
  if (!sums_over_modes_) return;
  kinetic_ = std::max(kinetic_, v.dot(model_.mass * v));
  const std::array<double, 2> of_u = witness.modal_size(u), of_v = witness.modal_size(v);
  const std::array<double, 2> by_energy = witness.modal_size(std::sqrt(energy_));
  const double period = model_.omega1 > 0.0 ? 1.0 / model_.omega1 : 0.0;
  for (std::size_t turns : {0U, 1U}) {
    // In a sum over modes, displacements have amplitudes up to v / omega, omega being at least omega1.
    u_modal_[turns] =
        std::max({u_modal_[turns], of_u[turns], period * by_energy[turns], period * of_v[turns]});
    v_modal_[turns] = std::max({v_modal_[turns], of_v[turns], by_energy[turns]});
  }
}

std::array<double, 2> CheckedMotion::acceleration_terms(const law_check::LawChecker& witness, const Vector& a,
                                                        double dependence) const {
  if (!sums_over_modes_) return {0.0, 0.0};
  const std::array<double, 2> size = witness.modal_size(a);
  return {dependence * of_round_trip * size[0], dependence * of_round_trip * size[1]};
}

namespace {

/// Event with guard_rate in the units of the computation; Event::guard_rate is in the scene's units.
law_check::RecordedEvent recorded(const Event& event, const decide::Decision& decision) {
  law_check::RecordedEvent result = recorded_event(event);
  const decide::Crossing* crossing = event.t_uncertainty ? decision.crossing(result.contact) : nullptr;
  if (crossing != nullptr) result.guard_rate = crossing->derivatives[0];
  return result;
}

}  // namespace

std::string sentence_of(const Violation& v, const Model& model) {
  const std::string who =
      v.contact >= 0 ? fmt::format("contact '{}'", model.contacts[static_cast<std::size_t>(v.contact)].name)
                     : std::string("the structure");
  return fmt::format("{} violates a law ({}) at t = {:.9g}: error {:.4g}, allowed {:.2g}", who, v.law, v.t,
                     v.value, v.limit);
}

std::string sentence_of(const LawCheckSummary& law_checks, const Model& model) {
  std::string sentence = sentence_of(law_checks.violations.front(), model);
  if (law_checks.violated > 1) sentence += fmt::format(" (the first of {} violations)", law_checks.violated);
  return sentence;
}

RunLawChecker::RunLawChecker(const Model& model, const CheckedEngine& engine, Recorder& recorder)
    : model_(model),
      recorder_(recorder),
      engine_(engine),
      law_checker_(model, engine.limits),
      motion_(model, engine),
      has_constraints_(std::any_of(model.contacts.begin(), model.contacts.end(),
                                   [](const Contact& c) { return !c.normal_spring(); })) {}

namespace {

/// Copy of a record for the Recorder; the record only points to its data.
InstantRow row_of(const law_check::InstantRecord& record) {
  const auto side = [](const law_check::CheckedSide& s) {
    return InstantSide{*s.u, *s.v, s.a != nullptr ? *s.a : Vector(), *s.mode, *s.forces};
  };
  InstantRow row;
  row.t = record.t;
  row.resolution = record.resolution;
  row.tolerated_violation = record.forgiven;
  row.eigenvector_condition = record.eigenvector_condition;
  row.start = record.start;
  row.breakpoint = record.breakpoint;
  row.load_jumps = record.load_jumps;
  row.located = record.located;
  row.before = side(record.before);
  row.after = side(record.after);
  for (const law_check::RecordedImpulse& p : record.impulses)
    row.impacts.push_back({static_cast<int>(p.contact), p.impact_number, p.normal, p.tangent});
  row.capture_impulses = record.captures;
  for (const std::size_t k : record.released) row.released.push_back(static_cast<int>(k));
  return row;
}

}  // namespace

void RunLawChecker::instant(const Instant& now) {
  const decide::Decision& d = *now.decision;
  if (now.start) start_peaks(now);
  motion_.update_maxima(law_checker_, now.before->u, now.before->v);
  law_check::InstantRecord record;
  record.t = now.t;
  record.resolution = now.resolution;
  record.before = std::move(before_);  // reuses the memory of the previous instant
  record.after = std::move(after_);
  motion_.fill(*now.forcing_before, now.t, now.eigenvector_condition, record.before);
  record.before.u = &now.before->u;
  record.before.v = &now.before->v;
  record.before.forces = &now.before->forces;
  record.before.mode = now.states_before;
  motion_.fill(*now.forcing_after, now.t, now.eigenvector_condition, record.after);
  const Vector forces = d.jet.forces.col(0), a = d.jet.a();
  record.after.u = &d.u;
  record.after.v = &d.v;
  record.after.a = &a;
  record.after.acceleration_terms = motion_.acceleration_terms(law_checker_, a, now.eigenvector_condition);
  record.after.forces = &forces;
  record.after.mode = &d.states;
  for (const decide::SingleImpact& impact : d.single_impacts)
    record.impulses.push_back({impact.contact, impact.impact_number, impact.normal, impact.tangent});
  record.captures = d.capture_impulses;
  record.released = d.released;
  for (const Event& event : *now.events)
    if (event.contact >= 0) record.events.push_back(recorded(event, d));
  record.start = now.start;
  std::vector<ContactState> left;
  Vector forces_left;
  if (now.start && !model_.saved_contacts.empty()) {
    record.continues = record.breakpoint = true;
    left = final_states(model_, *now.states_before);
    forces_left = final_forces(model_);
    record.before.mode = &left;
    record.before.forces = &forces_left;
  }
  record.breakpoint = record.breakpoint || now.breakpoint;
  record.load_jumps = now.load_jumps;
  record.located = engine_.located && !now.adopted;
  record.forgiven = d.tolerated_violation;
  record.eigenvector_condition = now.eigenvector_condition;
  if (has_constraints_)
    max_constraint_force_terms_ =
        std::max(max_constraint_force_terms_, law_checker_.constraint_force_terms(record.after));
  for (std::size_t k = 0; k < observed_peaks_.size(); ++k)
    observed_peaks_[k].surface = std::max(observed_peaks_[k].surface, std::abs(record.before.driven[k].s));
  for (const std::size_t turns : {0U, 1U})
    reached_[turns] = std::max(reached_[turns], record.before.max_u[turns]);
  if (recorder_.wants_instants()) recorder_.instant(row_of(record));
  store_violations(law_checker_.check_instant(record));
  motion_.finish_instant(*now.forcing_after, now.t);
  before_ = std::move(record.before);
  after_ = std::move(record.after);
}

void RunLawChecker::between(double t, const motion::Forcing& forcing,
                            const contact::ContactStates& contact_states, const motion::Point& point,
                            double dependence) {
  if (!engine_.laws_at_step_ends) return;
  motion_.fill(forcing, t, dependence, point_);
  law_check::CheckedSide& side = point_;
  side.u = &point.u;
  side.v = &point.v;
  side.a = point.a.size() > 0 ? &point.a : nullptr;
  side.forces = &point.forces;
  side.mode = &contact_states;
  store_violations(law_checker_.check_point(t, side));
}

namespace {

/// Deformations along n and t of the springs that a compliance split takes from the structure; 0 without a split.
std::pair<double, double> borrowed(const Contact& c, const ForceLayout& layout, std::size_t k,
                                   const Vector& forces) {
  if (!c.compliance_split()) return {0.0, 0.0};
  return {forces.data()[layout.normal(k)] / c.normal_stiffness,
          c.tangential_stiffness ? forces.data()[layout.tangent(k)] / *c.tangential_stiffness : 0.0};
}

}  // namespace

void RunLawChecker::start_peaks(const Instant& now) {
  observed_peaks_.resize(model_.contacts.size());
  for (std::size_t k = 0; k < observed_peaks_.size(); ++k) {
    const Contact& c = model_.contacts[k];
    const auto [n, t] = borrowed(c, model_.layout, k, now.decision->jet.forces.col(0));
    observed_peaks_[k].g0 = c.normal.dot(now.decision->u) - n;
    observed_peaks_[k].ut0 =
        c.body_tangent().dot(now.decision->u) - now.forcing_after->surface(k, now.t, 0) - t;
  }
}

void RunLawChecker::observe(double t, const motion::Forcing& forcing, const motion::Point& point) {
  for (std::size_t k = 0; k < observed_peaks_.size(); ++k) observe(k, t, forcing, point);
}

void RunLawChecker::observe(std::size_t k, double t, const motion::Forcing& forcing,
                            const motion::Point& point) {
  if (engine_.limits.step > 0.0) return;  // engines with fixed steps record peaks only at the ends of steps
  const Contact& c = model_.contacts[k];
  ObservedPeak& p = observed_peaks_[k];
  p.most.N = std::max(p.most.N, std::abs(point.N(model_.layout, k)));
  p.most.T = std::max(p.most.T, std::abs(point.T(model_.layout, k)));
  const auto [along_n, along_t] = borrowed(c, model_.layout, k, point.forces);
  p.most.normal = std::max(p.most.normal, std::abs(c.normal.dot(point.u) - along_n - p.g0));
  const double ut = c.body_tangent().dot(point.u) - forcing.surface(k, t, 0) - along_t;
  p.most.tangential = std::max(p.most.tangential, std::abs(ut - p.ut0));
}

/// Bound for the terms of a contact's g and ut, from the largest displacements and rotations so far.
double RunLawChecker::place_of(std::size_t k) const {
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
  return size(c.normal) + size(c.tangent) + std::abs(c.gap) + observed_peaks_[k].surface;
}

void RunLawChecker::peaks(double t, const std::vector<Peak>& recorded) {
  for (std::size_t k = 0; k < observed_peaks_.size() && k < recorded.size(); ++k) {
    const Contact& c = model_.contacts[k];
    const ObservedPeak& p = observed_peaks_[k];
    // The observed and the recorded peak are the same sum at different points. Even a contact at rest moves by the
    // rounding of the scene's displacements.
    const law_check::LawLimits& tol = engine_.limits;
    const double place = place_of(k);
    const double length = rounding::elimination * (place + model_.scales.displacement) +
                          law_check::tolerance_factor * (tol.rtol * place + tol.displacement);
    const double force =
        (c.normal_stiffness + c.tangential_stiffness.value_or(0.0)) * length +
        (rounding::elimination + law_check::tolerance_factor * tol.rtol) * (p.most.N + p.most.T) +
        (c.normal_spring() ? 0.0 : rounding::elimination * max_constraint_force_terms_) +
        law_check::tolerance_factor * tol.force;
    const auto check = [&](double farthest, double recorded_value, double limit, const Unit& unit) {
      if (farthest - recorded_value > limit)
        store_violations(
            {{t, "end", static_cast<int>(k), "peak", farthest - recorded_value, limit, unit, false}});
    };
    check(p.most.N, recorded[k].N, force, unit::force);
    check(p.most.T, recorded[k].T, force, unit::force);
    check(p.most.normal, recorded[k].normal, length, unit::length);
    check(p.most.tangential, recorded[k].tangential, length, unit::length);
  }
}

void RunLawChecker::store_violations(std::vector<Violation> found) {
  ++law_checks_.checked;
  law_checks_.violated += static_cast<long>(found.size());
  for (Violation& v : found) {
    if (v.unexplained && unexplained_violation_.empty()) {
      Violation shown = v;
      shown.t = model::time_in_scene_units(model_, v.t);
      shown.value = model::in_scene_units(model_, v.value, v.unit);
      shown.limit = model::in_scene_units(model_, v.limit, v.unit);
      unexplained_violation_ = sentence_of(shown, model_);
    }
    if (law_checks_.violations.size() < max_stored_violations) law_checks_.violations.push_back(std::move(v));
  }
}

}  // namespace signorini::run
