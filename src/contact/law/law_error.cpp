#include "contact/law/law_error.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "contact/law.hpp"

namespace signorini {
namespace {

bool has_friction_limit(const Form& f) { return f.limit != 0.0 || f.limit_rate != 0.0; }
bool has_accelerations(const Form& f) { return f.an != 0.0 || f.at != 0.0; }
/// The slip rate of a compliant contact with a dashpot contains g''.
bool has_unsupported_accelerations(const GuardForm& guard, const Contact& contact) {
  GuardForm rest = guard;
  if (contact.obeys_coulomb() && contact.normal_damping > 0.0) rest.form.an = 0.0;
  return rest.any_form(has_accelerations);
}
bool has_tangent(const Form& f) {
  return f.T != 0.0 || f.ut != 0.0 || f.vt != 0.0 || f.at != 0.0 || has_friction_limit(f);
}
bool is_force_squared(const Unit& unit) { return unit.force == 2 && unit.length == 0 && unit.time == 0; }
bool has_applied_force(const Form& f) {
  return f.applied_normal_force != 0.0 || f.applied_normal_force_rate != 0.0;
}

const char* normal_force_of(const LawCapabilities& law) {
  if (law.normal_force_given) return "is given";
  if (law.takes_impulses) return "is that of a constraint";
  return law.normal_spring ? "is that of a spring" : "is neither given nor that of a spring or constraint";
}

bool determine_normal_force_equally(const LawCapabilities& a, const LawCapabilities& b) {
  return a.normal_force_given == b.normal_force_given && a.takes_impulses == b.takes_impulses &&
         a.normal_spring == b.normal_spring;
}

/// Error of the guards in one state. own_states: the law has its own states, so its guards are user_1 to user_3.
std::string guard_error(const Contact& contact, State state, bool own_states) {
  const LawCapabilities& can = contact.law->capabilities;
  const ContactLaw::Guards guards = contact::guards(contact, {state, 0.0});
  std::vector<Guard> kinds;
  for (std::size_t i = 0; i < guards.size(); ++i) {
    const GuardForm& guard = guards[i];
    if (guard.kind == Guard::none) continue;
    if (i >= can.guards)
      return fmt::format("found guard {}, expected at most {}, as in the capabilities", i + 1, can.guards);
    if ((guard.kind >= Guard::user_1) != own_states)
      return own_states ? "expected guards of the kinds user_1 to user_3, because the law has its own states"
                        : "expected guards of the built-in kinds, because the law has the built-in states";
    if (std::find(kinds.begin(), kinds.end(), guard.kind) != kinds.end())
      return fmt::format("found two guards of the kind '{}'", contact::to_string(guard.kind));
    kinds.push_back(guard.kind);
    if (!guard.is_linear() && can.linear_guards)
      return "found a guard with products, but linear_guards in the capabilities";
    if (contact::is_friction_limit(guard.kind) && !guard.is_linear() &&
        !is_force_squared(contact::unit_of(guard)))
      return "expected products of two forces, F^2 - T^2, in the guard of the friction limit";
    if (has_unsupported_accelerations(guard, contact)) return "found a guard that depends on accelerations";
    if (can.tangents == 0 && guard.any_form(has_tangent))
      return "found a guard that depends on T or ut, but no tangents in the capabilities";
    if (!can.normal_force_given && guard.any_form(has_applied_force))
      return "found a guard that depends on normal_force(t), but N is not given";
    if (own_states && guard.any_form(has_friction_limit))
      return "found a guard that depends on the friction of the contact, but the law has its own states";
  }
  return {};
}

std::string error_without_tangents(const Contact& contact, State state) {
  const auto [normal, tangent] = contact::rows(contact, {state, 0.0});
  if (tangent != Form{.T = tangent.T} || has_tangent(normal))
    return "expected the tangent row T = 0 and a normal row without T and ut, because there are no tangents";
  return {};
}

std::string row_error(const Contact& contact, State state) {
  const auto [normal, tangent] = contact::rows(contact, {state, 0.0});
  if (normal.N == 0.0 || tangent.T == 0.0) return "expected N in its normal row and T in its tangent row";
  for (const Form& row : {normal, tangent})
    if (has_accelerations(row) || has_friction_limit(row))
      return "expected rows that depend only on N, T, g, ut and their rates";
  const bool given = contact.normal_force_given();
  if (given && normal != Form{.N = 1.0, .applied_normal_force = 1.0})
    return "expected the normal row N + q = 0, because N is given";
  if (!given && (has_applied_force(normal) || has_applied_force(tangent)))
    return "found a row that depends on normal_force(t), but N is not given";
  return {};
}

std::string error_with_own_states(const Contact& contact, const std::vector<State>& states) {
  if (contact.takes_impulses())
    return "found impulses together with states of its own; impacts know the built-in states only";
  if (states.size() > max_user_law_states)
    return fmt::format("found {} states, expected 1 to {}", states.size(), max_user_law_states);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const State kind = kind_of(states[i]);
    if (states[i] != user_law_state(i, kind) || kind == State::inside)
      return fmt::format("state {}: expected user_law_state({}, kind), kind open, closed, stick or slip", i,
                         i);
    std::string error = row_error(contact, states[i]);
    if (error.empty() && contact.law->capabilities.tangents == 0)
      error = error_without_tangents(contact, states[i]);
    if (error.empty()) error = guard_error(contact, states[i], true);
    if (!error.empty()) return fmt::format("state {} ({}): {}", i, to_string(states[i]), error);
  }
  return {};
}

std::string error_with_built_in_states(const Contact& contact, Law named) {
  const ContactLawPtr built_in = named;
  const bool slips = contact.law->capabilities.tangents > 0;
  for (const State state : {State::open, State::inside, State::closed, State::stick, State::slip_plus,
                            State::slip_minus, State::static_limit_plus, State::static_limit_minus}) {
    if (!slips && state != State::open && state != State::inside && state != State::closed) continue;
    const Rows rows = contact::rows(contact, {state, 0.0}), known = built_in->rows(contact, {state, 0.0});
    if (rows.normal != known.normal || rows.tangent != known.tangent)
      return fmt::format(
          "state {}: found other rows than those of law = \"{}\", but no states of its own "
          "(signorini_coulomb "
          "in the capabilities)",
          to_string(state), built_in->name());
    if (state == State::inside && !contact.normal_spring()) continue;  // this state needs a dashpot
    if (const std::string error = guard_error(contact, state, false); !error.empty())
      return fmt::format("state {}: {}", to_string(state), error);
  }
  return {};
}

}  // namespace

std::string law_error(const Contact& contact, Law named) {
  const ContactLaw& law = *contact.law;
  const LawCapabilities &can = law.capabilities, expected = capabilities_of(named);
  if (!determine_normal_force_equally(can, expected))
    return fmt::format("found a user-defined law whose N {}, together with law = \"{}\", whose N {}",
                       normal_force_of(can), contact::to_string(named), normal_force_of(expected));
  if (std::string error = law.validation_error(); !error.empty()) return error;
  if (can.tangents > 1) return fmt::format("found {} tangents, expected 0 or 1", can.tangents);
  if (can.tangents == 0 && can.takes_impulses)
    return "found no tangents, but impulses, which have a component along the tangent";
  if (can.tangents == 0 && contact.has_friction())
    return "found friction, but no tangents in the capabilities of the law";
  if (can.guards > ContactLaw::max_guards)
    return fmt::format("found {} guards, expected at most {}", can.guards, ContactLaw::max_guards);
  const std::vector<State> states = law.user_law_states();
  if (states.empty() != can.signorini_coulomb)
    return can.signorini_coulomb
               ? "found states of its own, but signorini_coulomb in the capabilities"
               : "found no states of its own, which a law without signorini_coulomb in the capabilities has";
  return can.signorini_coulomb ? error_with_built_in_states(contact, named)
                               : error_with_own_states(contact, states);
}

}  // namespace signorini
