#include "engine/newmark/friction_iteration.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "contact/friction.hpp"
#include "contact/law.hpp"
#include "engine/newmark/newmark_step.hpp"
#include "model/internal_units.hpp"
#include "motion/point.hpp"

namespace signorini::newmark {
namespace {

constexpr double unchanged = 1e-12;  // limit of a converged bound's change, relative to the greatest force
constexpr int slips = 100;  // key of a slipping contact: T is a load, so both directions have the same matrix
constexpr int stops = 101;  // key of a contact without tangential stiffness that stops within the step

}  // namespace

FrictionIteration::FrictionIteration(const Model& model, const linear::SystemMatrices& structure,
                                     motion::StateSystems& systems, const RunSpec& run)
    : model_(model),
      structure_(structure),
      dt_(run.dt.value()),
      relaxation_(run.relaxation),
      max_iterations_(run.max_iterations),
      step_(model, structure),
      works_(model, structure),
      systems_(systems),
      consistent_(systems),
      iterates_(model.contacts.size()),
      key_(model.contacts.size()) {}

void FrictionIteration::start(const engine::Segment& segment) {
  segment_ = segment;
  const decide::Decision& decision = *segment.decision;
  t0_ = t1_ = decision.jet.t;
  end_ = {decision.u, decision.v, decision.jet.forces.col(0), decision.jet.a()};
  states_ = decision.states;
  key_in_force_.clear();
  step_.set({}, signorini::linear::rows_of(model_, states_));
  segment_dt_ = segment_step_length(model_, t0_, segment.end, dt_);
  ++counters.restarts;
}

/// Greatest contact force at the point, and the resulting error of a converged bound.
FrictionIteration::ForceScale FrictionIteration::known_forces(const motion::Point& point) const {
  ForceScale known;
  double noise = 0.0;
  for (std::size_t k = 0; k < iterates_.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    known.greatest =
        std::max({known.greatest, std::abs(point.N(model_.layout, k)), std::abs(point.T(model_.layout, k))});
    const double terms = std::abs(contact.gap) + contact.normal.magnitude(point.u);
    noise = std::max(noise, rounding::many_operations * contact.normal_stiffness * terms);
  }
  known.error = unchanged * known.greatest + noise;
  return known;
}

/// Initialises the iterates of all contacts at the beginning of a step: states, bounds, and the anchors for contacts that stick
/// at the end of the step.
void FrictionIteration::begin_iterates() {
  bound_error_ = known_forces(begin_).error;
  for (std::size_t k = 0; k < iterates_.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const ContactMotion m = motion::motion_of(contact, k, *segment_.forcing, t0_, begin_);
    ContactIterate& side = iterates_[k];
    side.state = contact::representative_state(states_[k].state);
    side.normal_force = std::max(0.0, -m.N);
    side.anchor = side.state == State::stick ? states_[k].anchor : contact::slip_of(contact, m);
  }
}

/// Sets the rows for the contact states of this iterate. Equal values of key_ mean equal matrices, so that factorisations are
/// reused.
void FrictionIteration::apply_rows() {
  std::vector<Rows>& rows = step_.own_rows();
  for (std::size_t k = 0; k < iterates_.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const ContactIterate& side = iterates_[k];
    rows[k] = signorini::contact::rows(contact, {side.state, side.anchor});
    key_[k] = static_cast<int>(side.state);
    Form& tangent = rows[k].tangent;
    if (const int s = slip_sign(side.state); s != 0) {
      tangent = contact::sliding_row(s, 0.0);  // T is a load, given by the bound of the last iterate
      tangent.constant = -s * contact::kinetic_friction(contact) * side.normal_force;
      key_[k] = slips;
    } else if (side.state == State::stick && !contact.tangential_stiffness &&
               states_[k].state != State::stick) {
      tangent = {};
      tangent.vt = 1.0;
      key_[k] = stops;
    }
  }
  if (key_ == key_in_force_) return;
  key_in_force_ = key_;
  step_.set(key_, std::move(rows));
}

/// New state of contact k, from the motion of the last iterate and the present bound of |T|.
State FrictionIteration::state_of(std::size_t k) const {
  const Contact& contact = model_.contacts[k];
  const ContactIterate& side = iterates_[k];
  const ContactMotion m = motion::motion_of(contact, k, *segment_.forcing, t1_, end_);
  // A contact is closed if spring and dashpot together press. With a positive gap it is open, whatever the dashpot force.
  if (contact.normal_force_given()
          ? is_open(side.state)
          : m.gap > 0.0 || contact.normal_stiffness * m.gap + contact.normal_damping * m.vn >= 0.0)
    return State::open;
  if (!contact.has_friction() || is_open(side.state)) return contact::state_at_rest(contact);
  const auto& kt = contact.tangential_stiffness;
  if (const int s = slip_sign(side.state); s != 0) {
    if (!kt) return s * m.vt < 0.0 ? State::stick : side.state;
    const double terms = std::abs(m.ut) + std::abs(m.T / *kt) + std::abs(side.anchor);
    return s * (contact::slip_of(contact, m) - side.anchor) < -rounding::many_operations * terms
               ? State::stick
               : side.state;
  }
  // The limit of |T| is kinetic friction if the contact slipped in the last step, otherwise static friction.
  const double friction = slip_sign(states_[k].state) != 0 ? contact::kinetic_friction(contact)
                                                           : contact::static_friction(contact);
  const double terms = kt ? *kt * (std::abs(m.ut) + std::abs(side.anchor)) : 0.0;
  // A contact whose T stays constant at the limit must not start to slip because of rounding, so the limit gets a margin. A
  // contact whose T grows to the limit gets no margin and slips.
  const double loose = bound_error_ + rounding::many_operations * terms;
  const bool rests = std::abs(m.T - begin_.T(model_.layout, k)) <= loose;
  if (std::abs(m.T) <= friction * side.normal_force + (rests ? loose : 0.0)) return State::stick;
  return contact::slip_state(m.T);
}

/// Sets the contact states that follow from the last iterate. True if a state has changed.
bool FrictionIteration::update_states() {
  bool changed = false;
  for (std::size_t k = 0; k < iterates_.size(); ++k) {
    const State state = state_of(k);
    changed = changed || state != iterates_[k].state;
    key_[k] = static_cast<int>(state);
  }
  for (std::size_t k = 0; k < iterates_.size(); ++k) iterates_[k].state = static_cast<State>(key_[k]);
  return changed;
}

/// Iterates the step of length h to t1_. Returns an empty string, or the reason why the step fails.
std::string FrictionIteration::iterate(double h, bool kept) {
  begin_iterates();
  double change = 0.0, force = 0.0;
  std::size_t worst = 0;
  bool switching = false;
  for (int i = 0; i < max_iterations_; ++i) {
    apply_rows();
    if (!step_.take(*segment_.forcing, begin_, t1_, h, kept, end_))
      return "the matrix of a step is singular; another dt may help";
    if (!end_.u.allFinite()) return "the motion overflows and is no longer finite";
    switching = update_states();
    if (switching) continue;  // change the bounds only after the states have become consistent
    change = 0.0;
    const ForceScale known = known_forces(end_);
    force = known.greatest;
    bound_error_ = known.error;
    for (std::size_t k = 0; k < iterates_.size(); ++k) {
      const Contact& contact = model_.contacts[k];
      ContactIterate& side = iterates_[k];
      const double by = std::max(0.0, -end_.N(model_.layout, k)) - side.normal_force;
      if (slip_sign(side.state) != 0 && contact::kinetic_friction(contact) * std::abs(by) > change) {
        change = contact::kinetic_friction(contact) * std::abs(by);
        worst = k;
      }
      // Relaxation is applied only to slipping contacts, because only their bounds are loads in the next iterate.
      side.normal_force += (slip_sign(side.state) != 0 ? relaxation_ : 1.0) * by;
    }
    // The iteration has converged only if the new bounds give the same states.
    switching = update_states();
    if (!switching && change <= bound_error_) return {};
  }
  std::vector<std::string> what;
  for (std::size_t k = 0; k < iterates_.size(); ++k)
    if (iterates_[k].state != contact::representative_state(states_[k].state) || k == worst)
      what.push_back(model_.contacts[k].name);
  return fmt::format(
      "the friction iteration does not converge: after {} iterations {} (contacts {}); a smaller dt, more "
      "max_iterations or a relaxation other than {} may help",
      max_iterations_,
      switching
          ? "contact states still change"
          : fmt::format("a friction limit still changes by {:.3g} {}, {:.2g} % of the greatest contact force",
                        model::in_scene_units(model_, change, unit::force), model_.units.force,
                        force > 0.0 ? 100.0 * change / force : 0.0),
      base::join_quoted(what), relaxation_);
}

engine::Step FrictionIteration::advance() {
  std::swap(begin_, end_);
  t0_ = t1_;
  engine::Step step;
  step.begin = step.end = t0_;
  step.resolution = motion::resolution_at(t0_, 0.0);
  changed_ = false;
  if (t0_ >= segment_.end) {  // the last step has already reached the end of the segment
    std::swap(begin_, end_);
    return step;
  }
  // Steps end at multiples of dt; after a discontinuity of the forcing, the first step is shorter and ends at the next
  // multiple. Steps within a short pulse have equal lengths from the beginning of the pulse.
  t1_ = segment_dt_ < dt_ ? t0_ + segment_dt_ : dt_ * (std::floor(t0_ / dt_ + length_tolerance) + 1.0);
  if (segment_.end - t1_ <= length_tolerance * segment_dt_) t1_ = segment_.end;
  double h = t1_ - t0_;
  const bool whole = std::abs(h - segment_dt_) <= length_tolerance * segment_dt_;
  if (whole) h = segment_dt_;
  ++counters.steps;
  std::string failure =
      t1_ > t0_ ? iterate(h, whole) : "the step is shorter than the resolution of time; a larger dt may help";
  step_.count(counters);
  if (!failure.empty()) {
    step.kind = engine::Step::Kind::failed;
    step.reason = fmt::format("at t = {:.9g}: {}", model::time_in_scene_units(model_, t1_), failure);
    return step;
  }
  step.end = t1_;
  step.resolution = motion::resolution_at(t1_, h);
  for (std::size_t k = 0; k < iterates_.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const ContactIterate& side = iterates_[k];
    changed_ = changed_ || side.state != contact::representative_state(states_[k].state);
    states_[k] = {side.state, side.state == State::stick ? side.anchor : 0.0};
    if (is_open(side.state)) states_[k].state = contact::separated_state(contact, contact.gap_at(end_.u));
  }
  solve_massless_velocities();
  if (changed_) {
    step.kind = engine::Step::Kind::event;
    step.engine_states = states_;
  }
  return step;
}

/// Computes the velocities of massless degrees of freedom at the end of the step from the time derivative of the equation of
/// motion. The step itself gives velocities that oscillate about these values from step to step.
void FrictionIteration::solve_massless_velocities() {
  if (!consistent_.massless()) return;
  const motion::StateSystemPtr system = systems_.system_of(states_);
  if (!system) return;
  motion::Point settled = end_;
  consistent_.make(system, *segment_.forcing, t1_, settled);
  for (Eigen::Index i = 0; i < end_.v.size(); ++i)
    if (model_.dofs[static_cast<std::size_t>(i)].massless) end_.v[i] = settled.v[i];
}

/// Adds the accelerations of massless degrees of freedom. The step has already computed the accelerations of degrees of freedom
/// with mass. Inside the step, the contact states are those at the beginning of the step.
void FrictionIteration::accelerate(double t, motion::Point& point) {
  if (!consistent_.massless()) return;
  const motion::StateSystemPtr system =
      t == t1_ && changed_ ? systems_.system_of(states_) : segment_.decision->system;
  if (!system) return;
  const Vector of_step = point.a;
  consistent_.accelerate(system, *segment_.forcing, t, point);
  for (Eigen::Index i = 0; i < of_step.size(); ++i)
    if (!model_.dofs[static_cast<std::size_t>(i)].massless) point.a[i] = of_step[i];
}

/// Interpolates linearly between the ends of the step, because |T| <= -f N is then satisfied inside the step too.
void FrictionIteration::evaluate(double t, motion::Point& point) {
  if (t == t1_ || !(t1_ > t0_)) {
    point = end_;
    return;
  }
  point = motion::interpolate(begin_, end_, (t - t0_) / (t1_ - t0_));
  if (changed_) point.forces = begin_.forces;
}

/// Adds the fraction (to - from) / h of the works of the whole step, computed with the contact states at the end of the step.
void FrictionIteration::integrate(double from, double to, motion::WorkIntegrals& works) {
  if (!(t1_ > t0_)) return;
  works_.add(*segment_.forcing, states_, begin_, t0_, end_, t1_, (to - from) / (t1_ - t0_), works);
}

}  // namespace signorini::newmark
