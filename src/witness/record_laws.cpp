#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "witness/laws.hpp"

namespace signorini {

bool Finder::is_released(std::size_t k) const {
  return std::find(record_.released.begin(), record_.released.end(), k) != record_.released.end();
}

/// Parts without mass that leave a contact at once do so because it could go on neither stuck nor sliding: it was closed,
/// at the limit of its friction or about to pull, and has a gap where it stays open.
void Finder::releases() {
  for (const std::size_t k : record_.released) {
    const Contact& c = model_.contacts[k];
    if (c.own || c.friction.varies() || c.shear) continue;
    const int contact = static_cast<int>(k);
    const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
    const Sight after = see(c, k, record_.after), before = see(c, k, record_.before);
    const double rest = rounding::of_elimination * after.place +
                        of_tolerance * (bench_.limits.rtol * after.place + bench_.limits.displacement);
    if (now.state == State::open && after.g < -rest)
      add(contact, "release", -after.g, rest, seen::length, true);
    if (record_.start || record_.breakpoint || is_open(old.state)) continue;  // the jump drove it there
    const RecordedEvent* event = event_of(k);
    double least = std::numeric_limits<double>::infinity(), limit = 0.0;
    for (const SeenGuard& guard : guards_of(c, old, before, bench_.limits)) {
      double zero = zero_of(guard, c);
      if (event != nullptr && event->t_uncertainty >= 0.0)
        zero += of_uncertainty * event->t_uncertainty *
                std::max(std::abs(event->guard_rate), std::abs(guard.rate));
      if (guard.value - zero >= least - limit) continue;
      least = guard.value;
      limit = zero;
    }
    if (least > limit && std::isfinite(least)) add(contact, "release", least, limit, seen::force, true);
  }
}

/// The terms of the gap and slip of a contact that was left. At an event a structure may pass its place at rest: its
/// displacements are the difference of a motion and itself there, known to the rounding of what it went through, and gaps
/// that this hides are closed, which turns and shifts the body. So none counts as less than the scene's own.
double Finder::left_terms(const Contact& c) const {
  double sum = 0.0;
  for (const Combination* form : {&c.normal, &c.tangent, &c.body_tangent()})
    for (const auto& [dof, factor] : form->terms) {
      const bool turns = model_.dofs[static_cast<std::size_t>(dof)].rotation;
      const double own = turns ? model_.scales.rotation : model_.scales.displacement;
      sum += std::abs(factor) * std::max(own, record_.before.u_reach[turns]);
    }
  return sum;
}

/// A run that goes on from another has its contacts where that one left them.
void Finder::continuation() {
  if (!record_.start || !record_.continues) return;
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& c = model_.contacts[k];
    const SavedState::Left& left = model_.continues[k];
    const Sight m = see(c, k, record_.before);
    const double limit = rounding::of_elimination * (m.place + left_terms(c));
    const auto check = [&](double was, double is) {
      if (const double off = std::abs(was - is); off > limit)
        add(static_cast<int>(k), "continuation", off, limit, seen::length, true);
    };
    if (left.gap) check(*left.gap, m.g);
    if (c.surface_motion.is_constant()) check(c.shear ? left.slip : left.ut, m.ut);
  }
}

/// Forces on parts without mass balance just after, and so do their rates.
void Finder::balance() {
  for (const Unbalanced& found : massless_balance(bench_, record_.after, 3)) {
    const bool turns = model_.dofs[static_cast<std::size_t>(found.dof)].rotation;
    add(-1, found.law, found.value, found.limit, Unit{1, turns ? 1 : 0, -found.order}, false);
  }
}

void Finder::rows() {
  for (const RecordedEvent& event : record_.events) row_of(event);
}

/// Rates of the surfaces that touch: rows leave out those of borrowed springs.
Sight Finder::touching(std::size_t k, const WitnessedSide& side) const {
  const Contact& c = model_.contacts[k];
  const State state = (*side.mode)[k].state;
  Sight m = see(c, k, side);
  if (!c.borrows || is_open(state)) return m;
  if (c.tangential_stiffness) {
    const int s = sign_of_slip(state);
    const double ratio = c.normal_stiffness / *c.tangential_stiffness;
    m.dut = s == 0 ? 0.0 : m.dut + s * c.friction.kinetic * ratio * m.dg;
  }
  m.dg = 0.0;
  return m;
}

/// What a row of the events says of both sides is what they are. Values before are those of the decision, which takes
/// out what tolerances have left.
void Finder::row_of(const RecordedEvent& event) {
  const std::size_t k = event.contact;
  const Contact& c = model_.contacts[k];
  const Sight b = touching(k, record_.before), a = touching(k, record_.after);
  const WitnessLimits& tol = bench_.limits;
  const int contact = static_cast<int>(k);
  // What forces that hold accelerations are known to is a sum over the structure: rarely asked for.
  const auto check = [&](double row, double side, double limit, const Unit& unit, bool holds = false) {
    const double off = std::abs(row - side);
    if (off <= limit) return;
    if (holds) limit += force_noise();
    if (off > limit) add(contact, "row", off, limit, unit, off > gross * (std::abs(row) + std::abs(side)));
  };
  const double size = size_of_normal(c, a) + c.tangential_stiffness.value_or(0.0) * a.place;
  const double force = rounding::of_elimination * (size + std::abs(a.N) + std::abs(a.T));
  check(event.N_after, a.N, force, seen::force, true);
  check(event.T_after, a.T, force, seen::force, true);
  const double speed = rounding::of_elimination * (a.speed + b.speed);
  check(event.vn_after, a.dg, speed, seen::velocity);
  if (!c.shear) check(event.vt_after, a.dut, speed, seen::velocity);
  const double loose =
      speed + of_tolerance * (tol.rtol * b.speed + tol.velocity) + bench_.moved_by(record_.captures, k);
  if (!moves_at_once(k)) {  // those of parts without mass are decided anew
    check(event.vn, b.dg, loose, seen::velocity);
    if (!c.shear) check(event.vt, b.dut, loose, seen::velocity);
  }
  double n = 0.0, t = 0.0, of_impulses = 0.0;
  for (const RecordedImpulse& p : record_.impulses) {
    if (p.contact != k) continue;
    n += p.normal;
    t += p.tangent;
    of_impulses += std::abs(p.normal) + std::abs(p.tangent);
  }
  if (event.type != "impact") return;
  check(event.impulse_n, n, rounding::of_elimination * of_impulses, seen::impulse);
  check(event.impulse_t, t, rounding::of_elimination * of_impulses, seen::impulse);
}

}  // namespace signorini
