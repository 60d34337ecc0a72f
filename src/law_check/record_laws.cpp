#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "law_check/laws.hpp"

namespace signorini::law_check {

bool InstantLawChecker::is_released(std::size_t k) const {
  return std::find(record_.released.begin(), record_.released.end(), k) != record_.released.end();
}

/// Checks contacts that massless parts leave instantaneously, because no motion exists in stick or in slip. Before, such a
/// contact was closed and at its friction limit or at N = 0; after, it has a gap if it is open.
void InstantLawChecker::releases() {
  for (const std::size_t k : record_.released) {
    const Contact& c = model_.contacts[k];
    if (!c.forces_follow_motion()) continue;
    const int contact = static_cast<int>(k);
    const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
    const ContactKinematics after = kinematics(c, k, record_.after),
                            before = kinematics(c, k, record_.before);
    const double rest =
        rounding::elimination * after.displacement_size +
        tolerance_factor * (context_.limits.rtol * after.displacement_size + context_.limits.displacement);
    if (now.state == State::open && after.g < -rest)
      add(contact, "release", -after.g, rest, seen::length, true);
    // If a jump of the forcing released the contact, no guard was zero before.
    if (record_.start || record_.breakpoint || is_open(old.state)) continue;
    const RecordedEvent* event = event_of(k);
    double least = std::numeric_limits<double>::infinity(), limit = 0.0;
    for (const GuardValue& guard : guards_of(c, old, before, context_.limits)) {
      double zero = zero_of(guard, c);
      if (event != nullptr && event->t_uncertainty >= 0.0)
        zero += uncertainty_factor * event->t_uncertainty *
                std::max(std::abs(event->guard_rate), std::abs(guard.rate));
      if (guard.value - zero >= least - limit) continue;
      least = guard.value;
      limit = zero;
    }
    if (least > limit && std::isfinite(least)) add(contact, "release", least, limit, seen::force, true);
  }
}

/// Scale of the rounding error of gap and slip of a contact whose state is continued from another run. If the structure
/// passes its rest position, its displacements are small but have the rounding error of the whole motion before; gaps
/// within this error are closed, which shifts and rotates the body. So each term has at least the scene's scale.
double InstantLawChecker::continued_position_scale(const Contact& c) const {
  double sum = 0.0;
  for (const Combination* form : {&c.normal, &c.tangent, &c.body_tangent()})
    for (const auto& [dof, factor] : form->terms) {
      const bool turns = model_.dofs[static_cast<std::size_t>(dof)].rotation;
      const double own = turns ? model_.scales.rotation : model_.scales.displacement;
      sum += std::abs(factor) * std::max(own, record_.before.max_u[turns]);
    }
  return sum;
}

/// Checks that a run that continues another run starts with its contacts where they were at the end of the other run.
void InstantLawChecker::continuation() {
  if (!record_.start || !record_.continues) return;
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& c = model_.contacts[k];
    const SavedState::FinalContact& left = model_.saved_contacts[k];
    const ContactKinematics m = kinematics(c, k, record_.before);
    const double limit = rounding::elimination * (m.displacement_size + continued_position_scale(c));
    const auto check = [&](double was, double is) {
      if (const double off = std::abs(was - is); off > limit)
        add(static_cast<int>(k), "continuation", off, limit, seen::length, true);
    };
    if (left.gap) check(*left.gap, m.g);
    if (c.surface_motion.is_constant()) check(c.sliding_point() ? left.slip : left.ut, m.ut);
  }
}

/// Checks that the forces on massless parts, and the rates of these forces, are balanced just after the instant.
void InstantLawChecker::balance() {
  for (const MasslessImbalance& found : massless_balance(context_, record_.after, 3)) {
    const bool turns = model_.dofs[static_cast<std::size_t>(found.dof)].rotation;
    add(-1, found.law, found.value, found.limit, Unit{1, turns ? 1 : 0, -found.order}, false);
  }
}

void InstantLawChecker::event_rows() {
  for (const RecordedEvent& event : record_.events) event_row(event);
}

/// Motion of the surfaces in contact, as in event rows: with a compliance split, the deformation of the split springs is
/// subtracted.
ContactKinematics InstantLawChecker::touching(std::size_t k, const CheckedSide& side) const {
  const Contact& c = model_.contacts[k];
  const State state = (*side.mode)[k].state;
  ContactKinematics m = kinematics(c, k, side);
  if (!c.compliance_split() || is_open(state)) return m;
  if (c.tangential_stiffness) {
    const int s = slip_direction(state);
    const double ratio = c.normal_stiffness / *c.tangential_stiffness;
    m.dut = s == 0 ? 0.0 : m.dut + s * c.friction.kinetic * ratio * m.dg;
  }
  m.dg = 0.0;
  return m;
}

void InstantLawChecker::row_check(const RecordedEvent& event, double off, double limit, const Unit& unit) {
  if (off > limit) add(static_cast<int>(event.contact), "row", off, limit, unit, false);
}

/// Allowed value of a guard, in the guard's unit, if the event row gives its quantity as exactly zero.
double InstantLawChecker::settled(const RecordedEvent& event) const {
  return uncertainty_factor * std::max(event.t_uncertainty, record_.resolution) * std::abs(event.guard_rate);
}

/// Allowed difference of N and T of contact springs just before the instant. Engine and decision compute them separately
/// from the same u and v; the decision first removes velocities within tolerances. In modes, both sums over modes differ
/// by the energy lost^2 / 2 (modal_mismatch), so N differs by at most kn dg with kn dg^2 <= lost^2.
double InstantLawChecker::spring_noise_before(std::size_t k, const ContactKinematics& before) const {
  const Contact& c = model_.contacts[k];
  const LawLimits& tol = context_.limits;
  const double kn = c.normal_stiffness, cn = c.normal_damping, kt = c.tangential_stiffness.value_or(0.0);
  const ContactState& state = (*record_.before.mode)[k];
  const double of_captures = cn * context_.capture_speed(record_.captures, k);
  return rounding::elimination * (2.0 * (normal_force_size(c, before) +
                                         kt * (before.displacement_size + std::abs(state.anchor))) +
                                  std::abs(before.N) + std::abs(before.T)) +
         tolerance_factor * ((kn + kt) * (tol.rtol * before.displacement_size + tol.displacement) +
                             cn * (tol.rtol * before.velocity_size + tol.velocity) +
                             tol.rtol * (std::abs(before.N) + std::abs(before.T)) + tol.force) +
         (std::sqrt(kn) + std::sqrt(kt)) * record_.before.modal_mismatch + of_captures;
}

/// Allowed difference of constraint forces just before the instant, which engine and decision compute separately
/// (check_context.cpp). T of a sliding contact is f N, hence the factor f.
double InstantLawChecker::held_noise_before(std::size_t k) const {
  const ConstraintForceWeights held = context_.constraint_force_weights(record_, k);
  const Friction& friction = model_.contacts[k].friction;
  return std::max(
      context_.constraint_force_noise(record_, held.N) * std::max({1.0, friction.static_, friction.kinetic}),
      context_.constraint_force_noise(record_, held.T));
}

/// Error of the fixed step h in which a guard was located, by the trapezoidal rule: h^2/12 |da| in a displacement, h/12
/// |d(da)| in a velocity. It is added to settled(), which is no bound if the guard rate is nearly zero. Accelerations in
/// the step are assumed not to exceed A = max_contact_acceleration(), so |da| <= 2 A, |d(da)| <= 4 A;
/// uncertainty_factor allows for higher terms in h. of_u, of_v: factors of displacement and velocity in the guard.
double InstantLawChecker::step_error(std::size_t k, double of_u, double of_v) const {
  const double h = context_.limits.step;
  if (!(h > 0.0)) return 0.0;
  return uncertainty_factor * h / 12.0 * (2.0 * h * of_u + 4.0 * of_v) *
         context_.max_contact_acceleration(record_, k);
}

/// Checks N and T just before the event in its row. If states were found at the end of a step, the row may contain the
/// forces just after the event instead.
void InstantLawChecker::row_before(const RecordedEvent& event, const ContactKinematics& before,
                                   const ContactKinematics& after) {
  // At the start, and for massless parts, the forces before are guesses.
  if (record_.start || moves_instantaneously(event.contact)) return;
  const std::size_t k = event.contact;
  const Contact& c = model_.contacts[k];
  const auto apart = [&](double row, double ContactKinematics::*force) {
    const double by = std::abs(row - before.*force);
    return record_.located ? by : std::min(by, std::abs(row - after.*force));
  };
  const double off = std::max(apart(event.N, &ContactKinematics::N), apart(event.T, &ContactKinematics::T));
  double limit = spring_noise_before(k, before);
  if (off <= limit) return;
  limit += held_noise_before(k);
  const bool zero = event.type == "separation" && event.N == 0.0 && event.T == 0.0;
  if (zero)
    limit += (1.0 + std::max(c.friction.static_, c.friction.kinetic)) *
             (settled(event) + step_error(k, c.normal_stiffness, c.normal_damping));
  row_check(event, off, limit, seen::force);
}

/// Checks the gap of an event row, which is the gap just after the event; with a compliance split, the gap between the
/// surfaces.
void InstantLawChecker::row_gap(const RecordedEvent& event, const ContactKinematics& after) {
  const Contact& c = model_.contacts[event.contact];
  if (!event.gap) return;
  const bool touches = c.compliance_split() && !is_open((*record_.after.mode)[event.contact].state);
  const double g = touches ? 0.0 : after.g;
  double limit = rounding::elimination * after.displacement_size;
  if (*event.gap == 0.0) {
    const bool by_force = event.type == "separation" && c.normal_spring();
    const double dashpot = by_force ? c.normal_damping / c.normal_stiffness : 0.0;
    limit +=
        tolerance_factor * (context_.limits.rtol * after.displacement_size + context_.limits.displacement) +
        settled(event) / (by_force ? c.normal_stiffness : 1.0) + step_error(event.contact, 1.0, dashpot);
  }
  row_check(event, std::abs(*event.gap - g), limit, seen::length);
}

/// Checks that an event row agrees with both sides of the instant. The velocities before are those of the decision, which
/// has removed velocities within tolerances by captures.
void InstantLawChecker::event_row(const RecordedEvent& event) {
  const std::size_t k = event.contact;
  const Contact& c = model_.contacts[k];
  const ContactKinematics b = touching(k, record_.before), a = touching(k, record_.after);
  const int contact = static_cast<int>(k);
  // The uncertainty of constraint forces is a costly sum over the structure, so it is computed only if needed.
  const auto check = [&](double row, double side, double limit, const Unit& unit, bool holds = false) {
    const double off = std::abs(row - side);
    if (off <= limit) return;
    if (holds) limit += force_noise();
    if (off > limit)
      add(contact, "row", off, limit, unit, off > grave_fraction * (std::abs(row) + std::abs(side)));
  };
  const double size = normal_force_size(c, a) + c.tangential_stiffness.value_or(0.0) * a.displacement_size;
  const double force = rounding::elimination * (size + std::abs(a.N) + std::abs(a.T));
  check(event.N_after, a.N, force, seen::force, true);
  check(event.T_after, a.T, force, seen::force, true);
  const double speed = rounding::elimination * (a.velocity_size + b.velocity_size);
  check(event.vn_after, a.dg, speed, seen::velocity);
  if (!c.sliding_point()) check(event.vt_after, a.dut, speed, seen::velocity);
  const double loose = speed + context_.capture_speed(record_.captures, k);
  // The decision replaces velocities of massless parts, so these are not compared.
  if (!moves_instantaneously(k)) {
    check(event.vn, b.dg, loose, seen::velocity);
    if (!c.sliding_point()) check(event.vt, b.dut, loose, seen::velocity);
  }
  row_before(event, b, a);
  row_gap(event, a);
  double n = 0.0, t = 0.0, of_impulses = 0.0;
  for (const RecordedImpulse& p : record_.impulses) {
    if (p.contact != k) continue;
    n += p.normal;
    t += p.tangent;
    of_impulses += std::abs(p.normal) + std::abs(p.tangent);
  }
  if (event.type != "impact") return;
  check(event.impulse_n, n, rounding::elimination * of_impulses, seen::impulse);
  check(event.impulse_t, t, rounding::elimination * of_impulses, seen::impulse);
}

}  // namespace signorini::law_check
