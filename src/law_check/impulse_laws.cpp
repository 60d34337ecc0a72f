#include <algorithm>
#include <cmath>
#include <limits>

#include "base/rounding.hpp"
#include "law_check/laws.hpp"

namespace signorini::law_check {

/// Adds a violation if the value exceeds the limit. The limit is at least the smallest normal double, because smaller
/// numbers have few digits. unexplained: no rounding error explains the violation, and the run must end.
void InstantLawChecker::add(int contact, const char* law, double value, double limit, const Unit& unit,
                            bool unexplained) {
  limit = std::max(limit, std::numeric_limits<double>::min());
  if (value <= limit) return;
  Violation v;
  v.t = record_.t;
  v.contact = contact;
  v.law = law;
  v.value = value;
  v.limit = limit;
  v.unit = unit;
  v.unexplained = unexplained;
  const RecordedEvent* event = contact >= 0 ? event_of(static_cast<std::size_t>(contact)) : nullptr;
  if (event == nullptr && contact < 0 && !record_.events.empty()) event = &record_.events.front();
  v.event = record_.start ? "start" : event != nullptr ? event->type : record_.load_jumps ? "load" : "";
  found_.push_back(std::move(v));
}

const RecordedEvent* InstantLawChecker::event_of(std::size_t k) const {
  const auto found = std::find_if(record_.events.begin(), record_.events.end(),
                                  [&](const RecordedEvent& e) { return e.contact == k; });
  return found == record_.events.end() ? nullptr : &*found;
}

/// True if there are impulses or captures, or if the velocity of a degree of freedom with mass jumps.
bool InstantLawChecker::is_struck() const {
  if (!record_.impulses.empty()) return true;
  if (record_.captures.size() > 0 && !record_.captures.isZero(0.0)) return true;
  const Vector &before = *record_.before.v, &after = *record_.after.v;
  for (int i = 0; i < model_.size(); ++i)
    if (before[i] != after[i] && context_.has_mass(i)) return true;
  return false;
}

/// Checks that M (v+ - v-) equals the sum of all impulses, up to the rounding error of the solve for v+.
void InstantLawChecker::momentum() {
  if (!is_struck()) return;
  const Vector &before = *record_.before.v, &after = *record_.after.v;
  Vector impulse = Vector::Zero(model_.size()), size = impulse;
  const auto push = [&](const Combination& form, double value) {
    if (value == 0.0) return;
    form.add_to(impulse, value);
    for (const auto& [dof, factor] : form.terms) size[dof] += std::abs(factor * value);
  };
  for (const RecordedImpulse& p : record_.impulses) {
    push(model_.contacts[p.contact].normal, p.normal);
    push(model_.contacts[p.contact].tangent, p.tangent);
  }
  for (std::size_t k = 0; record_.captures.size() > 0 && k < model_.contacts.size(); ++k) {
    push(model_.contacts[k].normal, record_.captures.data()[model_.layout.normal(k)]);
    push(model_.contacts[k].tangent, record_.captures.data()[model_.layout.tangent(k)]);
  }
  Vector jump = Vector::Zero(model_.size()), speed = jump;
  // Velocities are not more accurate than the smallest normal double, because smaller numbers have few digits.
  constexpr double unknown = std::numeric_limits<double>::min() / rounding::elimination;
  double translation = std::max(unknown, record_.before.max_v[0]),
         rotation = std::max(unknown, record_.before.max_v[1]);
  for (int i = 0; i < model_.size(); ++i) {
    if (!context_.has_mass(i)) continue;
    jump[i] = after[i] - before[i];
    double& greatest = model_.dofs[static_cast<std::size_t>(i)].rotation ? rotation : translation;
    greatest = std::max({greatest, std::abs(before[i]), std::abs(after[i])});
  }
  for (int i = 0; i < model_.size(); ++i)
    if (context_.has_mass(i))
      speed[i] = model_.dofs[static_cast<std::size_t>(i)].rotation ? rotation : translation;
  Vector rest = -impulse;
  for (int j = 0; j < model_.mass.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(model_.mass, j); it; ++it) {
      rest[it.row()] += it.value() * jump[j];
      size[it.row()] += std::abs(it.value() * speed[j]);
    }
  double clock = 0.0;
  const auto limit_of = [&](int i) { return rounding::elimination * size[i] + clock; };
  const auto worst_of = [&] {
    int worst = -1;
    double by = 1.0;
    for (int i = 0; i < model_.size(); ++i) {
      const double limit = limit_of(i);
      if (!context_.has_mass(i) || !(std::abs(rest[i]) > by * limit)) continue;
      worst = i;
      by = limit > 0.0 ? std::abs(rest[i]) / limit : std::numeric_limits<double>::max();
    }
    return worst;
  };
  if (worst_of() < 0) return;
  // Tolerance: the impulse of all forces during the uncertainty of the instant's time.
  clock = uncertainty_factor * record_.resolution * context_.balance_terms(record_.after);
  const int worst = worst_of();
  if (worst < 0) return;
  const bool turns = model_.dofs[static_cast<std::size_t>(worst)].rotation;
  add(-1, "momentum", std::abs(rest[worst]), limit_of(worst), turns ? seen::moment_impulse : seen::impulse,
      true);
}

/// Checks that capture impulses are not larger than the speed of a contact at rest explains. While other contacts are
/// captured, a sticking contact is held, and a sliding contact moves with them. So the speed of a contact is the smaller
/// of two values: the effect of its own capture, and the effect of all captures.
void InstantLawChecker::captures() {
  if (record_.captures.size() == 0 || record_.captures.isZero(0.0)) return;
  Vector impulse = Vector::Zero(model_.size());
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const auto n = static_cast<Eigen::Index>(model_.layout.normal(k)),
               t = static_cast<Eigen::Index>(model_.layout.tangent(k));
    model_.contacts[k].normal.add_to(impulse, record_.captures[n]);
    model_.contacts[k].tangent.add_to(impulse, record_.captures[t]);
  }
  const Vector change = context_.solve_mass(impulse);
  if (change.size() == 0) return;
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& c = model_.contacts[k];
    const auto n = static_cast<Eigen::Index>(model_.layout.normal(k)),
               t = static_cast<Eigen::Index>(model_.layout.tangent(k));
    if (record_.captures[n] == 0.0 && record_.captures[t] == 0.0) continue;
    const ContactResponse* own = context_.contact_response(k);
    // Replaces the effect of the contact's own capture if this effect is not known.
    const double most = std::numeric_limits<double>::infinity();
    const double by_n = own != nullptr ? std::abs(own->nn * record_.captures[n]) : most;
    const double by_t = own != nullptr ? std::abs(own->tt * record_.captures[t]) : most;
    const double speed = std::max(std::min(by_n, std::abs(c.normal.dot(change))),
                                  std::min(by_t, std::abs(c.tangent.dot(change))));
    double limit = slow_slip_factor * context_.rest_speed(record_, k);
    // With fixed steps, g' of a closed contact oscillates by (step * constrained acceleration). A contact that stops
    // within a step is detected at the end of the step, when it may move again. The velocity of a contact that sticks
    // rigidly to a moving surface has the error of the integration rule (Driven::drift).
    if (context_.limits.step > 0.0 && !is_open((*record_.before.mode)[k].state))
      limit += context_.limits.step * context_.max_contact_acceleration(record_, k) +
               record_.before.driven[k].drift;
    // If the engine does not locate events, a contact that stops within a step may overshoot by its former speed, so no
    // capture is unexplained. For engines with steps the limit contains only the leading error terms in h; the higher terms
    // are allowed twice as much.
    const bool unexplained =
        record_.located && speed > (context_.limits.step > 0.0 ? uncertainty_factor : 1.0) * limit;
    if (speed > limit) add(static_cast<int>(k), "capture", speed, limit, seen::velocity, unexplained);
  }
}

void InstantLawChecker::restitution() {
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& c = model_.contacts[k];
    if (!c.takes_impulses()) continue;
    const ContactKinematics m = kinematics(c, k, record_.after);
    const bool closed = !record_.after.mode->at(k).is_open();
    const double rounding_of_speed = context_.rest_speed(record_, k);
    if ((closed || m.g <= 0.0) && m.dg < -rounding_of_speed)
      add(static_cast<int>(k), "penetration rate", -m.dg, rounding_of_speed, seen::velocity, true);
  }
  // Scale of impulses: the largest impulse, or the impulse that would cause the velocities before the impact.
  double greatest = 0.0;
  for (const RecordedImpulse& p : record_.impulses) {
    greatest = std::max({greatest, std::abs(p.normal), std::abs(p.tangent)});
    const ContactResponse* own = context_.contact_response(p.contact);
    if (own == nullptr) continue;
    const double speed = kinematics(model_.contacts[p.contact], p.contact, record_.before).velocity_size;
    if (own->nn > 0.0) greatest = std::max(greatest, speed / own->nn);
    if (own->tt > 0.0) greatest = std::max(greatest, speed / own->tt);
  }
  for (const RecordedImpulse& p : record_.impulses) {
    const Contact& c = model_.contacts[p.contact];
    const ImpactVelocities strike = impact_velocities(p, kinematics(c, p.contact, record_.before),
                                                      kinematics(c, p.contact, record_.after));
    restitution_of(p, strike, greatest);
    friction_impulse(p, strike, greatest);
  }
}

/// Velocities before and after one of several impacts of an instant: v- plus the effects of earlier impacts, and v+ minus
/// the effects of later impacts.
InstantLawChecker::ImpactVelocities InstantLawChecker::impact_velocities(
    const RecordedImpulse& p, const ContactKinematics& before, const ContactKinematics& after) const {
  ImpactVelocities strike{before.dg, after.dg, after.dut};
  const ContactResponse* own = context_.contact_response(p.contact);
  if (own == nullptr) {  // rigid contacts act on mass (docs/theory.md, "Rigid contacts")
    strike.uncertainty = std::numeric_limits<double>::infinity();
    return strike;
  }
  for (const RecordedImpulse& other : record_.impulses) {
    if (other.impact_number == p.impact_number) continue;
    const Contact& c = model_.contacts[other.contact];
    const double dg = c.normal.dot(own->by_n) * other.normal + c.tangent.dot(own->by_n) * other.tangent;
    const double dut = c.normal.dot(own->by_t) * other.normal + c.tangent.dot(own->by_t) * other.tangent;
    if (other.impact_number < p.impact_number) {
      strike.dg_before += dg;
    } else {
      strike.dg_after -= dg;
      strike.dut_after -= dut;
    }
  }
  strike.uncertainty = context_.capture_speed(record_.captures, p.contact);
  return strike;
}

/// Checks the law of restitution, 0 <= Pn _|_ g'+ + e min(g'-, 0) >= 0.
void InstantLawChecker::restitution_of(const RecordedImpulse& p, const ImpactVelocities& strike,
                                       double greatest) {
  const int contact = static_cast<int>(p.contact);
  const double zero = rounding::elimination * greatest;
  if (p.normal < -zero) add(contact, "restitution", -p.normal, zero, seen::impulse, true);
  const Contact& c = model_.contacts[p.contact];
  const ContactResponse* own = context_.contact_response(p.contact);
  const double limit = context_.rest_speed(record_, p.contact) + strike.uncertainty +
                       (own != nullptr ? rounding::elimination * own->nn * greatest : 0.0);
  const double asked = -c.restitution * std::min(strike.dg_before, 0.0);
  double off = asked - strike.dg_after;      // the rebound is too slow
  if (p.normal > zero) off = std::abs(off);  // with an impulse, also if it is too fast
  if (asked <= limit) off = std::min(off, std::abs(strike.dg_after));  // a slow rebound may end at rest
  if (off > limit) add(contact, "restitution", off, limit, seen::velocity, true);
}

void InstantLawChecker::friction_impulse(const RecordedImpulse& p, const ImpactVelocities& strike,
                                         double greatest) {
  const Contact& c = model_.contacts[p.contact];
  const int contact = static_cast<int>(p.contact);
  const double most = std::max(c.friction.static_, c.friction.kinetic);
  const double zero = rounding::elimination * greatest * (1.0 + most);
  const double over = std::abs(p.tangent) - most * p.normal;
  if (over > zero) add(contact, "friction impulse", over, zero, seen::impulse, true);
  if (!c.has_friction() || c.friction.is_rate_dependent() || !(p.normal > zero)) return;
  const double slow = slow_slip_factor * context_.rest_speed(record_, p.contact) + strike.uncertainty;
  if (std::abs(strike.dut_after) <= slow) return;
  const double off =
      std::abs(p.tangent + (strike.dut_after > 0.0 ? 1.0 : -1.0) * c.friction.kinetic * p.normal);
  if (off > zero) add(contact, "friction impulse", off, zero, seen::impulse, true);
}

}  // namespace signorini::law_check
