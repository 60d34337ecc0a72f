#include "decide/state_enumeration.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <limits>
#include <utility>

#include "contact/friction.hpp"
#include "contact/motion.hpp"
#include "decide/coulomb_problem.hpp"
#include "decide/delassus.hpp"
#include "motion/state_systems.hpp"

namespace signorini::decide {
namespace {

// Accelerations are equal if they differ by less than this fraction of the largest acceleration in all combinations. The
// value is the accuracy of forces in a block with the largest acceptable condition number, 1e8. A tolerance relative to the
// two compared accelerations would distinguish accelerations that are both zero up to rounding.
constexpr double same_acceleration = 1e-8;

/// Sets the states of combination number `code`. The digits of `code`, one per choice, are the indices of the chosen states.
void apply(const std::vector<StateEnumeration::Choice>& choices, std::size_t code,
           contact::ContactStates& contact_states) {
  for (const StateEnumeration::Choice& choice : choices) {
    contact_states[choice.contact] = choice.states[code % choice.states.size()];
    code /= choice.states.size();
  }
}

/// True if the combinations differ only in contacts whose force is between kinetic and static friction. Such a contact could
/// stick or slip; the friction law makes it stick.
bool differ_by_static_friction(const Model& model, const contact::ContactStates& one,
                               const contact::ContactStates& other) {
  for (std::size_t c = 0; c < one.size(); ++c) {
    if (one[c] == other[c]) continue;
    const Contact& contact = model.contacts[c];
    const bool lets_go = one[c].state == State::stick && slip_sign(other[c].state) != 0;
    const Friction& f = contact.friction;
    if (!lets_go || f.is_load_dependent() || !(f.static_ > f.kinetic)) return false;
  }
  return true;
}

/// States of the contacts with choices, as text, for example "'first' stick, 'second' slip+".
std::string named_states(const Model& model, const std::vector<StateEnumeration::Choice>& choices,
                         const contact::ContactStates& contact_states) {
  std::string text;
  for (const StateEnumeration::Choice& choice : choices)
    text += fmt::format("{}'{}' {}", text.empty() ? "" : ", ", model.contacts[choice.contact].name,
                        to_string(contact_states[choice.contact].state));
  return text;
}

}  // namespace

std::string several_motions(const Model& model, const std::vector<StateEnumeration::Choice>& choices,
                            const StateEnumeration::BestCombination& best) {
  return fmt::format("several motions continue from this instant: one with {}; another with {}",
                     named_states(model, choices, best.contact_states),
                     named_states(model, choices, best.alternative));
}

bool StateEnumeration::BestCombination::acceptable() const {
  return alternative.empty() && relative_violation <= std::max(1.0, condition);
}

StateEnumeration::Choice StateEnumeration::choice(const Participant& participant) const {
  const Contact& contact = model_.contacts[participant.contact];
  const ContactState open{State::open, 0.0}, closed{State::closed, 0.0}, stick{State::stick, 0.0},
      plus{State::slip_plus, 0.0}, minus{State::slip_minus, 0.0};
  if (contact.normal_force_given()) return {participant.contact, {stick, plus, minus}};
  if (!contact.has_friction()) return {participant.contact, {open, closed}};
  if (participant.slipping) return {participant.contact, {open, participant.sign > 0 ? plus : minus}};
  return {participant.contact, {open, stick, plus, minus}};
}

StateEnumeration::Choice StateEnumeration::choice(std::size_t c, const ContactState& state,
                                                  const ContactMotion& before) const {
  const Contact& contact = model_.contacts[c];
  return {c, contact.law->candidates(contact, state, before)};
}

/// Relative violation and accelerations of a combination of states; nullopt: its contact forces are not unique.
std::optional<StateEnumeration::Evaluation> StateEnumeration::evaluate(
    const Instant& instant, const motion::Forcing& forcing, const Block& block,
    const std::vector<KnownGuards>& known, const contact::ContactStates& contact_states) {
  const motion::StateSystemPtr system = systems_.system_of(contact_states);
  if (!system) return std::nullopt;
  Vector u = instant.u, v = instant.v;
  motion::project_constraints(model_, *system, forcing, instant.t, u, v);
  std::vector<MotionJet> motions;
  const motion::Jet jet = jets_.make(system, forcing, instant.t, u, v, motions);
  if (forces_are_noise(model_, motions) && !forces_are_unique(systems_, contact_states)) return std::nullopt;
  Evaluation result{0.0, jet.a()};
  for (const std::size_t c : block)
    for (const GuardForm& guard : contact::guards(model_.contacts[c], contact_states[c]))
      if (guard.kind != Guard::none)
        result.relative_violation = std::max(
            result.relative_violation,
            relative_violation(guard, motions[c], instant, known[c].of_motion().of(guard.kind).zeros));
  return result;
}

double StateEnumeration::condition(const std::vector<std::size_t>& contacts,
                                   contact::ContactStates contact_states) {
  const ForceLayout layout = model_.layout.part(contacts);
  std::vector<Eigen::Index> rows;  // rows of the forces of rigid contacts and of rigid sticking
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = model_.contacts[contacts[i]];
    if (contact.takes_impulses()) rows.push_back(normal_place(layout, i));
    if (contact.has_friction() && (contact.takes_impulses() || contact.sticks_rigidly()))
      rows.push_back(tangent_place(layout, i));
    contact_states[contacts[i]] = {State::open, 0.0};
  }
  if (rows.empty()) return 1.0;
  const motion::StateSystemPtr system = systems_.system_of(contact_states);
  if (!system) return std::numeric_limits<double>::quiet_NaN();
  CoulombProblem problem;
  problem.W = delassus(model_, *system, contacts).W(rows, rows);
  problem.b = Eigen::VectorXd::Zero(problem.W.rows());
  return condition_number(problem);
}

std::optional<StateEnumeration::BestCombination> StateEnumeration::best_combination(
    const Instant& instant, const motion::Forcing& forcing, const Block& block,
    const std::vector<Choice>& choices, const std::vector<KnownGuards>& known,
    const contact::ContactStates& contact_states) {
  if (choices.empty() || choices.size() > max_contacts) return std::nullopt;
  std::size_t combinations = 1;
  for (const Choice& choice : choices) combinations *= choice.states.size();
  std::optional<BestCombination> best;
  std::vector<std::pair<contact::ContactStates, Vector>> holding;  // consistent states and accelerations
  double greatest = 0.0;
  for (std::size_t code = 0; code < combinations; ++code) {
    contact::ContactStates tried = contact_states;
    apply(choices, code, tried);
    const auto weighed = evaluate(instant, forcing, block, known, tried);
    if (!weighed) continue;
    greatest = std::max(greatest, weighed->a.norm());
    if (weighed->relative_violation == 0.0) holding.emplace_back(tried, weighed->a);
    if (best && weighed->relative_violation >= best->relative_violation) continue;
    best = BestCombination{std::move(tried), weighed->relative_violation, 1.0, {}};
  }
  // If all consistent combinations have the same accelerations, the first one is the result.
  for (std::size_t i = 1; i < holding.size() && best->alternative.empty(); ++i)
    if (!((holding[i].second - holding[0].second).norm() <= same_acceleration * greatest) &&
        !differ_by_static_friction(model_, holding[0].first, holding[i].first))
      best->alternative = holding[i].first;
  if (!best) return best;
  std::vector<std::size_t> contacts;
  for (const Choice& choice : choices) contacts.push_back(choice.contact);
  best->condition = condition(contacts, contact_states);
  return best;
}

}  // namespace signorini::decide
