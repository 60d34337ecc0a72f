#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "witness/laws.hpp"

namespace signorini {

void Finder::add(int contact, const char* law, double value, double limit, const Unit& unit, bool grave) {
  Violation v;
  v.t = record_.t;
  v.contact = contact;
  v.law = law;
  v.value = value;
  v.limit = limit;
  v.unit = unit;
  v.grave = grave;
  const RecordedEvent* event = contact >= 0 ? event_of(static_cast<std::size_t>(contact)) : nullptr;
  if (event == nullptr && contact < 0 && !record_.events.empty()) event = &record_.events.front();
  v.event = record_.start ? "start" : event != nullptr ? event->type : record_.load_jumps ? "load" : "";
  found_.push_back(std::move(v));
}

const RecordedEvent* Finder::event_of(std::size_t k) const {
  const auto found = std::find_if(record_.events.begin(), record_.events.end(),
                                  [&](const RecordedEvent& e) { return e.contact == k; });
  return found == record_.events.end() ? nullptr : &*found;
}

/// M (v+ - v-) is a sum along n and t, to the backward error of the solves that made v+.
void Finder::momentum() {
  const Vector &before = *record_.before.v, &after = *record_.after.v;
  Vector impulse = Vector::Zero(model_.size()), size = impulse;
  bool any = false;
  const auto push = [&](const Combination& form, double value) {
    if (value == 0.0) return;
    any = true;
    form.add_to(impulse, value);
    for (const auto& [dof, factor] : form.terms) size[dof] += std::abs(factor * value);
  };
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& c = model_.contacts[k];
    const auto at = static_cast<Eigen::Index>(2 * k);
    if (!record_.impulses.empty()) push(c.normal, record_.impulses[k].normal);
    if (!record_.impulses.empty()) push(c.tangent, record_.impulses[k].tangent);
    if (record_.captures.size() > 0) push(c.normal, record_.captures[at]);
    if (record_.captures.size() > 0) push(c.tangent, record_.captures[at + 1]);
  }
  Vector jump = Vector::Zero(model_.size()), speed = jump;
  double translation = record_.before.v_reach[0], rotation = record_.before.v_reach[1];
  for (int i = 0; i < model_.size(); ++i) {
    if (!bench_.has_mass(i)) continue;
    jump[i] = after[i] - before[i];
    any = any || jump[i] != 0.0;
    double& greatest = model_.dofs[static_cast<std::size_t>(i)].rotation ? rotation : translation;
    greatest = std::max({greatest, std::abs(before[i]), std::abs(after[i])});
  }
  if (!any) return;
  for (int i = 0; i < model_.size(); ++i)
    if (bench_.has_mass(i))
      speed[i] = model_.dofs[static_cast<std::size_t>(i)].rotation ? rotation : translation;
  Vector rest = -impulse;
  for (int j = 0; j < model_.mass.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(model_.mass, j); it; ++it) {
      rest[it.row()] += it.value() * jump[j];
      size[it.row()] += std::abs(it.value() * speed[j]);
    }
  // What rests has velocities as great as forces make within the resolution of the clock.
  const double clock = of_uncertainty * record_.resolution * bench_.balance(record_.after);
  const auto limit_of = [&](int i) { return rounding::of_elimination * size[i] + clock; };
  int worst = -1;
  double by = 1.0;
  for (int i = 0; i < model_.size(); ++i) {
    const double limit = limit_of(i);
    if (!bench_.has_mass(i) || !(std::abs(rest[i]) > by * limit)) continue;
    worst = i;
    by = limit > 0.0 ? std::abs(rest[i]) / limit : std::numeric_limits<double>::max();
  }
  if (worst < 0) return;
  const bool turns = model_.dofs[static_cast<std::size_t>(worst)].rotation;
  add(-1, "momentum", std::abs(rest[worst]), limit_of(worst), turns ? seen::moment_impulse : seen::impulse,
      true);
}

/// What no law of impact gives is no more than a contact that rests may have had.
void Finder::captures() {
  if (record_.captures.size() == 0) return;
  Vector impulse = Vector::Zero(model_.size());
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(2 * k);
    model_.contacts[k].normal.add_to(impulse, record_.captures[at]);
    model_.contacts[k].tangent.add_to(impulse, record_.captures[at + 1]);
  }
  const Vector change = bench_.per_mass(impulse);
  if (change.size() == 0) return;
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& c = model_.contacts[k];
    const auto at = static_cast<Eigen::Index>(2 * k);
    if (record_.captures[at] == 0.0 && record_.captures[at + 1] == 0.0) continue;
    const double speed = std::max(std::abs(c.normal.dot(change)), std::abs(c.tangent.dot(change)));
    double limit = with_slow_slips * bench_.slowest(record_, k);
    // Between steps that hold its gap g' swings by what a step makes of the acceleration that is held.
    if (!is_open((*record_.before.mode)[k].state)) limit += bench_.limits.step * bench_.pull(record_, k);
    if (speed > limit) add(static_cast<int>(k), "capture", speed, limit, seen::velocity, true);
  }
}

void Finder::restitution() {
  double greatest = 0.0;  // impulse, those included that rounding leaves of velocities that cancel
  for (std::size_t k = 0; k < record_.impulses.size(); ++k) {
    const RecordedImpulse& p = record_.impulses[k];
    const OwnResponse* own = p.strikes > 0 ? bench_.own_response(k) : nullptr;
    greatest = std::max({greatest, std::abs(p.normal), std::abs(p.tangent)});
    if (own == nullptr) continue;
    const double speed = see(model_.contacts[k], k, record_.before).speed;
    if (own->nn > 0.0) greatest = std::max(greatest, speed / own->nn);
    if (own->tt > 0.0) greatest = std::max(greatest, speed / own->tt);
  }
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& c = model_.contacts[k];
    if (!c.takes_impulses()) continue;
    const Sight m = see(c, k, record_.after);
    const bool closed = !record_.after.mode->at(k).is_open();
    const double rounding_of_speed = bench_.slowest(record_, k);
    if ((closed || m.g <= 0.0) && m.dg < -rounding_of_speed)
      add(static_cast<int>(k), "penetration rate", -m.dg, rounding_of_speed, seen::velocity, true);
    if (record_.impulses.empty()) continue;
    restitution_of(k, greatest);
    friction_impulse(k, greatest);
  }
}

/// Of several hits at one instant each starts where the last one ended: v- and the impulses of earlier turns make its
/// beginning, v+ less those of later turns its end.
std::optional<Finder::Strike> Finder::strike_of(std::size_t k, const Sight& before,
                                                const Sight& after) const {
  const RecordedImpulse& p = record_.impulses[k];
  if (p.strikes != 1 || std::any_of(record_.impulses.begin(), record_.impulses.end(),
                                    [](const RecordedImpulse& other) { return other.strikes > 1; }))
    return std::nullopt;
  Strike strike{before.dg, after.dg, after.dut};
  const auto is_other = [&](const RecordedImpulse& other) {
    return other.strikes > 0 && other.turn != p.turn;
  };
  if (std::none_of(record_.impulses.begin(), record_.impulses.end(), is_other)) return strike;
  const OwnResponse* own = bench_.own_response(k);
  if (own == nullptr) return std::nullopt;
  for (std::size_t l = 0; l < record_.impulses.size(); ++l) {
    const RecordedImpulse& other = record_.impulses[l];
    if (!is_other(other)) continue;
    const Contact& c = model_.contacts[l];
    const double dg = c.normal.dot(own->by_n) * other.normal + c.tangent.dot(own->by_n) * other.tangent;
    const double dut = c.normal.dot(own->by_t) * other.normal + c.tangent.dot(own->by_t) * other.tangent;
    if (other.turn < p.turn) {
      strike.dg_before += dg;
    } else {
      strike.dg_after -= dg;
      strike.dut_after -= dut;
    }
  }
  for (std::size_t l = 0; record_.captures.size() > 0 && l < record_.impulses.size(); ++l) {
    const Contact& c = model_.contacts[l];
    const auto at = static_cast<Eigen::Index>(2 * l);
    for (const Vector* by : {&own->by_n, &own->by_t})
      strike.unsure += std::abs(c.normal.dot(*by) * record_.captures[at]) +
                       std::abs(c.tangent.dot(*by) * record_.captures[at + 1]);
  }
  return strike;
}

/// 0 <= Pn _|_ g'+ + e min(g'-, 0) >= 0. Of several hits of one contact at one instant the sum is recorded: then Pn >= 0
/// alone.
void Finder::restitution_of(std::size_t k, double greatest) {
  const RecordedImpulse& p = record_.impulses[k];
  if (p.strikes == 0) return;
  const int contact = static_cast<int>(k);
  const double zero = rounding::of_elimination * greatest;
  if (p.normal < -zero) add(contact, "restitution", -p.normal, zero, seen::impulse, true);
  const Contact& c = model_.contacts[k];
  const auto strike = strike_of(k, see(c, k, record_.before), see(c, k, record_.after));
  if (!strike) return;
  const OwnResponse* own = bench_.own_response(k);
  const double slow = bench_.slowest(record_, k);
  const double limit =
      slow + strike->unsure + (own != nullptr ? rounding::of_elimination * own->nn * greatest : 0.0);
  const double asked = -c.restitution * std::min(strike->dg_before, 0.0);
  double off = asked - strike->dg_after;                                // slower than restitution asks for
  if (p.normal > zero) off = std::abs(off);                             // or faster than it gives
  if (asked <= limit) off = std::min(off, std::abs(strike->dg_after));  // e = 0: rest
  if (off > limit) add(contact, "restitution", off, limit, seen::velocity, true);
}

void Finder::friction_impulse(std::size_t k, double greatest) {
  const Contact& c = model_.contacts[k];
  const RecordedImpulse& p = record_.impulses[k];
  const double zero = rounding::of_elimination * greatest * (1.0 + c.friction.static_);
  const double over = std::abs(p.tangent) - c.friction.static_ * p.normal;
  if (over > zero) add(static_cast<int>(k), "friction impulse", over, zero, seen::impulse, true);
  if (!c.has_friction() || c.friction.varies() || !(p.normal > zero)) return;
  const auto strike = strike_of(k, see(c, k, record_.before), see(c, k, record_.after));
  if (!strike) return;
  const double slow = with_slow_slips * bench_.slowest(record_, k) + strike->unsure;
  if (std::abs(strike->dut_after) <= slow) return;
  const double off =
      std::abs(p.tangent + (strike->dut_after > 0.0 ? 1.0 : -1.0) * c.friction.kinetic * p.normal);
  if (off > zero) add(static_cast<int>(k), "friction impulse", off, zero, seen::impulse, true);
}

}  // namespace signorini
