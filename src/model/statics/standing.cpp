#include "model/statics/standing.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "contact/friction.hpp"

namespace signorini {
namespace {

// Forces that differ by less, relative to the largest one so far, count as equal: errors of some thousand solves and
// events. Chosen value.
constexpr double same_force = 1e-11;

}  // namespace

Standing undeformed(const Contact& contact) {
  Standing s;
  const State pressed = contact.has_friction() ? State::stick : State::closed;
  if (contact.normal_force_given()) {
    s.N = -contact.normal_force.value(0.0);
    s.state = s.N == 0.0 ? State::open : pressed;
  } else {
    s.gap = std::max(0.0, contact.gap);
    s.state = s.gap > 0.0 ? State::open : pressed;
  }
  return s;
}

double friction_of(const Contact& contact, const Standing& standing) {
  return slip_sign(standing.state) != 0 ? kinetic_friction(contact) : static_friction(contact);
}

double margin_of(const Contact& contact, const Standing& standing, int s) {
  return friction_of(contact, standing) * std::abs(standing.N) - s * standing.T;
}

double zero_force(double greatest) { return same_force * greatest; }

bool touching(const Contact& contact, const Standing& standing, double zero, double travelled) {
  if (contact.normal_force_given() || std::abs(standing.N) > zero) return false;
  if (!is_open(standing.state)) return true;
  const double rounded = rounding::of_many * (contact.gap + travelled);
  return standing.gap <=
         (contact.takes_impulses() ? same_force * travelled : zero / contact.normal_stiffness) + rounded;
}

}  // namespace signorini
