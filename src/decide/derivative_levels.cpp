#include "decide/derivative_levels.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/friction.hpp"
#include "decide/coulomb_problem.hpp"
#include "decide/delassus.hpp"
#include "model/internal_units.hpp"

namespace signorini::decide {
namespace {

using Kind = CoulombItem::Kind;

// Limit of the number of contacts for which all solutions are compared.
constexpr std::size_t max_compared_contacts = 5;

int sign_of(double x) { return x > 0.0 ? 1 : -1; }

/// Sets the entries for the normals of items at their friction limit to zero: the normal of such an item is already a
/// constraint, so its entries in W contain only rounding errors.
void clear_limit_normals(CoulombProblem& p) {
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    if (p.items[i].kind != Kind::limit) continue;
    const Eigen::Index n = p.normal(i);
    p.W.row(n).setZero();
    p.W.col(n).setZero();
    p.b[n] = 0.0;
  }
}

/// Decision about one contact. open: undecided; limit: undecided and at the friction limit.
enum class Verdict : unsigned char { open, limit, decided };

void start_slip(int sign, std::size_t order, ContactState& state, KnownGuards& guards) {
  state.state = contact::slip_state(sign);
  guards.sliding = {order + 1, true};
}

/// Decides a contact at its friction limit: it sticks because its force returns into the friction cone, or slips, or stays
/// undecided.
Verdict decide_at_limit(const CoulombSignificance& r, std::size_t order, std::size_t i, ContactState& state,
                        KnownGuards& guards) {
  const int sign = r.item(i).sign;
  const Eigen::Index t = r.tangent(i);
  if (sign * r.force(t) > r.force_tolerance(t)) {
    state.state = State::stick;
    (sign > 0 ? guards.slip_plus : guards.slip_minus) = {order, true};
    return Verdict::decided;
  }
  if (r.is_zero_response(t)) return Verdict::open;
  start_slip(sign, order, state, guards);
  return Verdict::decided;
}

/// Decides about stick or slip of a contact that has a compressive force and does not slip at lower orders.
Verdict decide_friction(const CoulombSignificance& r, std::size_t order, std::size_t i,
                        Participant& participant, ContactState& state, KnownGuards& guards) {
  const CoulombItem& item = r.item(i);
  const Eigen::Index t = r.tangent(i);
  state.state = State::stick;
  if (r.is_inside_cone(i)) return Verdict::decided;
  if (!r.is_zero_response(t)) {
    start_slip(sign_of(r.response(t)), order, state, guards);
    return Verdict::decided;
  }
  const bool two = item.static_friction != item.kinetic_friction;
  if ((two && !participant.stays_at_limit) || std::abs(r.force(t)) <= r.force_tolerance(t))
    return Verdict::decided;
  // The contact is at its friction limit. If static and kinetic coefficient are equal, the next derivative decides. Otherwise
  // the contact sticks until the guard of the static limit fails; it then stays at that limit if other contacts prevent slip.
  participant.sign = -sign_of(r.force(t));
  state.state = contact::slip_state(participant.sign);
  return Verdict::limit;
}

/// Decides one contact. If its normal force is not zero, its normal response is treated as zero; it may contain rounding.
Verdict decide_contact(const CoulombSignificance& r, std::size_t order, std::size_t i,
                       Participant& participant, ContactState& state, KnownGuards& guards) {
  const CoulombItem& item = r.item(i);
  const Eigen::Index n = r.normal(i), t = r.tangent(i);
  if (item.kind != Kind::pressed && !(r.force(n) > r.force_tolerance(n))) {
    if (!(r.force(n) > 0.0) && !r.is_zero_response(n)) {
      guards.closing = {order + 2, true};
      return Verdict::decided;
    }
    if (item.kind == Kind::frictional && !r.is_zero_response(t)) {
      participant.slipping = true;
      participant.sign = sign_of(r.response(t));
    }
    return Verdict::open;
  }
  if (item.kind != Kind::pressed) guards.separation = {order, true};
  if (item.kind == Kind::normal) {
    state.state = State::closed;
    return Verdict::decided;
  }
  if (item.kind == Kind::sliding) {
    state.state = contact::slip_state(item.sign);
    return Verdict::decided;
  }
  return decide_friction(r, order, i, participant, state, guards);
}

/// Participants that are closed in `states`, so that their rows are constraints.
std::vector<std::size_t> in_force(const std::vector<Participant>& participants,
                                  const contact::ContactStates& states) {
  std::vector<std::size_t> result;
  for (const Participant& participant : participants)
    if (!states[participant.contact].is_open()) result.push_back(participant.contact);
  return result;
}

}  // namespace

Refusal dependent_rows(std::vector<std::size_t> contacts) {
  return {Refusal::Kind::dependent,
          "the constraints of the contacts that stick are linearly dependent, so the contact forces are not "
          "unique",
          std::move(contacts), std::numeric_limits<double>::infinity()};
}

std::string massless_stick_error(const Model& model, const Contact& contact) {
  if (!contact.constrains_tangent_only()) return {};
  const auto moves_mass = [&](const auto& term) {
    return term.second != 0.0 && !model.dofs[static_cast<std::size_t>(term.first)].massless;
  };
  if (std::any_of(contact.tangent.terms.begin(), contact.tangent.terms.end(), moves_mass)) return {};
  return "contact '" + contact.name +
         "' sticks rigidly to a massless point; give the contact a tangential_stiffness, or the point a mass";
}

CoulombItem DerivativeLevels::item_of(const Entry& entry, const motion::Forcing& forcing, double t) const {
  const std::size_t c = entry.participant.contact;
  const Contact& contact = model_.contacts[c];
  CoulombItem item;
  item.sign = entry.participant.sign;
  item.kinetic_friction = entry.participant.sliding_friction;
  item.static_friction =
      entry.participant.kinetic ? item.kinetic_friction : contact::static_friction(contact);
  if (entry.status == Status::limit) {
    item.kind = Kind::limit;
  } else if (contact.normal_force_given()) {
    item.kind = Kind::pressed;
    item.applied_normal_force = forcing.applied_normal_force(c, t, 0);
  } else if (!contact.has_friction()) {
    item.kind = Kind::normal;
  } else {
    item.kind = entry.participant.slipping ? Kind::sliding : Kind::frictional;
  }
  return item;
}

Refusal DerivativeLevels::refusal(const Level& level, const EnumerationResult& all) const {
  const CoulombProblem& problem = level.problem;
  const bool several = all.solutions.size() > 1;
  Refusal result{
      several ? Refusal::Kind::ambiguous : Refusal::Kind::paradox,
      several ? "several motions continue from this instant (Painleve's paradox: friction is so strong that "
                "a contact may either press or open)"
              : "no motion continues from this instant (Painleve's paradox: friction is so strong that "
                "pressing a sliding contact pushes it into its surface)",
      level.contacts, condition_number(problem), all.min_violation};
  const double acceleration = model::in_scene_units(model_, 1.0, unit::acceleration);
  const double per_force = acceleration / model::in_scene_units(model_, 1.0, unit::force);
  for (std::size_t i = 0; i < level.contacts.size(); ++i) {
    const CoulombItem& item = problem.items[i];
    const Eigen::Index n = problem.normal(i), t = problem.tangent(i);
    result.reason += fmt::format(
        "; '{}': without contact forces g'' = {:.6g}, ut'' = {:.6g}; one unit of -N adds "
        "{:.6g} to g''",
        model_.contacts[level.contacts[i]].name, problem.b[n] * acceleration, problem.b[t] * acceleration,
        problem.W(n, n) * per_force);
    const double sliding = problem.W(n, n) - item.sign * item.kinetic_friction * problem.W(n, t);
    if (item.kind == Kind::sliding)
      result.reason += fmt::format(", and {:.6g} together with friction in {}", sliding * per_force,
                                   to_string(contact::slip_state(item.sign)));
    else if (item.kind == Kind::frictional)
      result.reason +=
          fmt::format(", one unit of -T adds {:.6g} to g'', the coefficient of friction is {:.6g}",
                      problem.W(n, t) * per_force, item.static_friction);
  }
  return result;
}

/// Sets the items of the problem, its right-hand side b and the noise of b, from the motion with the contacts decided so far.
void DerivativeLevels::fill(const Instant& instant, const motion::Forcing& forcing,
                            const std::vector<Entry>& entries, const std::vector<MotionJet>& jets,
                            Level& level) const {
  level.problem.layout = model_.layout.part(level.contacts);
  const Eigen::Index size = place_count(level.problem.layout);
  level.problem.b = Eigen::VectorXd::Zero(size);
  level.noise = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < level.entries.size(); ++i) {
    const MotionJet& jet = jets[level.contacts[i]];
    const ContactMotion &now = jet.motion[level.order], &zero = jet.noise[level.order];
    const bool last = level.order + 1 == MotionJet::orders;
    const double an = last ? 0.0 : jet.motion[level.order + 1].an,
                 at = last ? 0.0 : jet.motion[level.order + 1].at;
    const Eigen::Index n = level.problem.normal(i), t = level.problem.tangent(i);
    level.noise[n] = instant.noise_factor * zero.an + instant.resolution * std::abs(an);
    level.noise[t] = instant.noise_factor * zero.at + instant.resolution * std::abs(at);
    if (std::abs(now.an) > level.noise[n]) level.problem.b[n] = now.an;
    if (std::abs(now.at) > level.noise[t]) level.problem.b[t] = now.at;
    level.problem.items.push_back(item_of(entries[level.entries[i]], forcing, instant.t));
  }
}

/// Sets up the problem of each given level, which has an order and a block, for all undecided contacts of the block. False:
/// constraint rows are linearly dependent.
bool DerivativeLevels::set_up_levels(const Instant& instant, const motion::Forcing& forcing,
                                     const std::vector<Entry>& entries, const contact::ContactStates& states,
                                     std::vector<Level>& levels) {
  for (Level& level : levels) level = {level.order, level.block, {}, {}, {}, {}, {}};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].status == Status::decided) continue;
    const auto of = std::find_if(levels.begin(), levels.end(), [&](const Level& level) {
      return level.block == entries[i].participant.block;
    });
    if (of == levels.end()) continue;
    of->entries.push_back(i);
    of->contacts.push_back(entries[i].participant.contact);
  }
  std::erase_if(levels, [](const Level& level) { return level.entries.empty(); });
  if (levels.empty()) return true;
  const motion::StateSystemPtr system = systems_.system_of(states);
  if (!system) return false;
  std::vector<MotionJet> jets;
  const motion::StateSystemPtr at_slip =
      jets_.make(system, forcing, instant.t, instant.u, instant.v, jets).system;
  for (Level& level : levels) {
    level.system = at_slip;
    fill(instant, forcing, entries, jets, level);
  }
  return true;
}

/// Solves the problem of a level. If its right-hand side is zero, `solution` stays empty and there is no refusal.
Refusal DerivativeLevels::solve_level(Level& level, std::optional<CoulombSolution>& solution) const {
  CoulombProblem& problem = level.problem;
  const bool pressed = std::any_of(problem.items.begin(), problem.items.end(),
                                   [](const CoulombItem& item) { return item.kind == Kind::pressed; });
  if (problem.b.isZero(0.0) && !pressed) return {};
  problem.W = delassus(model_, *level.system, level.contacts).W;
  clear_limit_normals(problem);
  solution = solve(problem);
  if (!solution) return refusal(level, all_solutions(problem));
  std::vector<bool> may_share;
  for (const std::size_t c : level.contacts) may_share.push_back(systems_.may_share(c));
  min_norm_forces(problem, may_share, *solution);
  if (level.entries.size() > max_compared_contacts || !may_be_nonunique(problem)) return {};
  // If a force lies between kinetic and static friction, the contact could stick or slip. The friction law makes it stick, so
  // this is not Painleve's paradox.
  CoulombProblem settled = problem;
  for (std::size_t i = 0; i < settled.items.size(); ++i) {
    CoulombItem& item = settled.items[i];
    item.static_friction = item.kinetic_friction = item.friction(solution->kinetic[i]);
  }
  const EnumerationResult all = all_solutions(settled);
  return all.solutions.size() > 1 ? refusal(level, all) : Refusal{};
}

/// Decides contacts by the forces and responses in the solution. True: at least one contact was decided.
bool DerivativeLevels::apply_solution(const Level& level, const CoulombSolution& solution,
                                      std::vector<Entry>& entries, contact::ContactStates& states,
                                      std::vector<KnownGuards>& known) const {
  const CoulombSignificance reading(level.problem, solution, level.noise);
  bool decides = false;
  for (std::size_t i = 0; i < level.entries.size(); ++i) {
    Entry& entry = entries[level.entries[i]];
    ContactState& state = states[entry.participant.contact];
    KnownGuards& guards = known[entry.participant.contact];
    const Verdict verdict = level.problem.items[i].kind == Kind::limit
                                ? decide_at_limit(reading, level.order, i, state, guards)
                                : decide_contact(reading, level.order, i, entry.participant, state, guards);
    if (verdict == Verdict::open) continue;
    entry.status = verdict == Verdict::limit ? Status::limit : Status::decided;
    decides = true;
  }
  return decides;
}

/// Groups of participants that forces within their cones hold at rest, by the accelerations alone. states: of all
/// other contacts.
std::vector<RestingFeet> DerivativeLevels::find_resting(const Instant& instant,
                                                        const motion::Forcing& forcing,
                                                        const std::vector<Participant>& participants,
                                                        contact::ContactStates states) {
  std::vector<RestingFeet> result;
  for (const Participant& participant : participants) states[participant.contact] = {State::open, 0.0};
  for (const std::vector<std::size_t>& group : systems_.sharing()) {
    std::vector<std::size_t> feet;
    bool rests = true;
    for (const Participant& participant : participants) {
      if (std::find(group.begin(), group.end(), participant.contact) == group.end()) continue;
      rests = rests && !participant.slipping && !participant.kinetic;
      feet.push_back(participant.contact);
    }
    if (!rests) continue;
    auto resting = find_resting_feet(systems_, forcing, instant.t, feet, states);
    if (!resting) continue;
    contact::ContactStates sticking = states;
    for (const std::size_t c : feet) sticking[c] = {contact::state_at_rest(model_.contacts[c]), 0.0};
    std::vector<MotionJet> jets;
    const motion::StateSystemPtr system = systems_.system_of(sticking);
    static_cast<void>(jets_.make(system, forcing, instant.t, instant.u, instant.v, jets));
    if (resting->may_rest(forcing, instant.t, jets)) result.push_back(std::move(*resting));
  }
  return result;
}

Refusal DerivativeLevels::decide(const Instant& instant, const motion::Forcing& forcing,
                                 const std::vector<Participant>& participants,
                                 const contact::ContactStates& old, contact::ContactStates& states,
                                 std::vector<KnownGuards>& known) {
  const contact::ContactStates given = states;
  const std::vector<KnownGuards> given_known = known;
  for (std::vector<RestingFeet> resting = find_resting(instant, forcing, participants, states);;) {
    std::vector<Participant> moving = participants;
    for (const RestingFeet& feet : resting)
      for (const std::size_t c : feet.contacts()) {
        states[c] = {contact::state_at_rest(model_.contacts[c]), 0.0};
        std::erase_if(moving, [&](const Participant& participant) { return participant.contact == c; });
      }
    if (Refusal why = decide_moving(instant, forcing, moving, old, states, known); why || resting.empty())
      return why;
    const motion::StateSystemPtr system = systems_.system_of(states);
    if (!system) return dependent_rows(in_force(participants, states));
    std::vector<MotionJet> jets;
    static_cast<void>(jets_.make(system, forcing, instant.t, instant.u, instant.v, jets));
    const auto moves = std::find_if(resting.begin(), resting.end(), [&](const RestingFeet& feet) {
      return !feet.decide(instant, forcing, jets, states, known);
    });
    if (moves == resting.end()) {
      systems_.mark_static_limits(states, forcing, instant.t);
      return {};
    }
    resting.erase(moves);  // ends: one group fewer
    states = given;
    known = given_known;
  }
}

Refusal DerivativeLevels::decide_moving(const Instant& instant, const motion::Forcing& forcing,
                                        const std::vector<Participant>& participants,
                                        const contact::ContactStates& old, contact::ContactStates& states,
                                        std::vector<KnownGuards>& known) {
  std::vector<Entry> entries;
  for (const Participant& participant : participants) {
    entries.push_back({participant});
    states[participant.contact] = {State::open, 0.0};
  }
  for (std::size_t order = 0; order < MotionJet::orders; ++order) {
    std::vector<Level> levels;
    for (const Participant& participant : participants)
      if (levels.empty() || levels.back().block != participant.block)
        levels.push_back({order, participant.block, {}, {}, {}, {}, {}});
    // The problem of a block at one order is solved again as long as it decides a contact: when contacts with large forces
    // have become constraints, smaller forces exceed the rounding error.
    while (!levels.empty()) {
      if (!set_up_levels(instant, forcing, entries, states, levels))
        return dependent_rows(in_force(participants, states));
      std::vector<Level> again;
      for (Level& level : levels) {
        std::optional<CoulombSolution> solution;
        if (Refusal why = solve_level(level, solution)) return why;
        if (solution && apply_solution(level, *solution, entries, states, known))
          again.push_back(std::move(level));
        systems_.mark_static_limits(states, forcing, instant.t);
      }
      levels = std::move(again);
    }
  }
  // No derivative decides the remaining contacts. Contacts that touch without force keep their states; contacts at their
  // friction limit stick.
  for (const Entry& entry : entries) {
    if (entry.status == Status::limit &&
        systems_.held_by_others(entry.participant.contact, states, forcing, instant.t)) {
      known[entry.participant.contact].sliding = Known::at_limit();  // stays at its limit without slip
    } else if (entry.status == Status::limit) {
      states[entry.participant.contact].state = State::stick;
      KnownGuards& guards = known[entry.participant.contact];
      (entry.participant.sign > 0 ? guards.slip_plus : guards.slip_minus) = Known::at_limit();
    }
    if (entry.status == Status::apex) states[entry.participant.contact] = old[entry.participant.contact];
  }
  return {};
}

}  // namespace signorini::decide
