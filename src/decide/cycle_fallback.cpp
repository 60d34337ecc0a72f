#include "decide/cycle_fallback.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <limits>
#include <utility>

#include "decide/massless_jump.hpp"

namespace signorini::decide {

std::size_t ContactBlocks::max_rigid(const Model& model) const {
  std::size_t most = 0;
  for (const Block& block : all) {
    std::size_t rigid = 0;
    for (const std::size_t c : block) {
      if (model.contacts[c].takes_impulses()) return std::numeric_limits<std::size_t>::max();
      rigid += model.contacts[c].sticks_rigidly() ? 1 : 0;
    }
    most = std::max(most, rigid);
  }
  return most;
}

/// Adopts the combination of states of a block with the smallest violation; returns a refusal if it is not acceptable.
Refusal CycleFallback::enumerate(std::size_t block, SolverState& solver_state) {
  StateEnumeration enumeration(systems_, jets_);
  std::vector<StateEnumeration::Choice> choices;
  for (const Participant& participant : solver_state.impact_result.participants)
    if (blocks_.of[participant.contact] == block) choices.push_back(enumeration.choice(participant));
  for (const std::size_t c : blocks_.all[block]) {
    const Contact& contact = model_.contacts[c];
    if (contact.takes_impulses() || !solver_state.decision.visited[c]) continue;
    const bool takes_part =
        std::any_of(choices.begin(), choices.end(),
                    [&](const StateEnumeration::Choice& other) { return other.contact == c; });
    if (!takes_part)
      choices.push_back(
          enumeration.choice(c, solver_state.instant.states[c], solver_state.decision.before[c]));
  }
  Refusal refusal{Refusal::Kind::endless,
                  "no combination of contact states satisfies all guards; guards that fail: " +
                      names_of(model_, solver_state.failed),
                  contacts_of(solver_state.failed)};
  const auto best =
      enumeration.best_combination(solver_state.instant, solver_state.after, blocks_.all[block], choices,
                                   solver_state.impact_result.known, solver_state.states);
  if (!best) return refusal;
  refusal.condition = best->condition;
  refusal.residual = best->relative_violation;
  if (!best->alternative.empty()) {
    refusal.kind = Refusal::Kind::ambiguous;
    refusal.reason =
        fmt::format("{}; guards that fail in the states tried last: {}",
                    several_motions(model_, choices, *best), names_of(model_, solver_state.failed));
  }
  if (!best->acceptable()) return refusal;
  solver_state.states = best->contact_states;
  for (const std::size_t c : blocks_.all[block])
    solver_state.impact_result.known[c] = solver_state.impact_result.known[c].of_motion();
  solver_state.undecided.push_back(block);
  solver_state.decision.undecided = true;
  solver_state.decision.tolerated_violation =
      std::max(solver_state.decision.tolerated_violation, best->relative_violation);
  return {};
}

/// If exactly one contact of the block fails, lets massless parts leave this contact (massless_jump.hpp). False: several
/// contacts fail, or the parts cannot leave the contact, or have already left it.
bool CycleFallback::release(std::size_t block, SolverState& solver_state) {
  std::vector<std::size_t> repeating;
  for (const FailedGuard& f : solver_state.failed)
    if (blocks_.of[f.contact] == block) repeating.push_back(f.contact);
  if (repeating.size() != 1) return false;
  const std::size_t c = repeating.front();
  std::vector<std::size_t>& before = solver_state.decision.released;
  if (std::find(before.begin(), before.end(), c) != before.end()) return false;
  auto u = released(systems_, jets_, solver_state.after, solver_state.instant, solver_state.states, c);
  if (!u) return false;
  before.push_back(c);
  solver_state.instant.u = std::move(*u);
  const Contact& contact = model_.contacts[c];
  solver_state.states[c] = {contact::separated_state(contact, contact.gap_at(solver_state.instant.u)), 0.0};
  solver_state.impact_result.known[c] = {};
  solver_state.tried_states.clear();
  return true;
}

/// Takes the first step that was not taken before. First, noise and resolution are increased, because rounding errors may have
/// separated zeros that are equal. Second, sliders are decided together with the rigid contacts. Third, in each block with a
/// failing guard all combinations of states are compared; if none is acceptable, massless parts may leave a contact.
Refusal CycleFallback::next_step(SolverState& solver_state) {
  if (solver_state.increase_noise()) {
    solver_state.tried_states.clear();
    return {};
  }
  if (!solver_state.impact_result.sliders) {
    solver_state.impact_result.sliders = true;
    return {};
  }
  std::vector<std::size_t> repeating;
  for (const FailedGuard& f : solver_state.failed)
    if (repeating.empty() ||
        std::find(repeating.begin(), repeating.end(), blocks_.of[f.contact]) == repeating.end())
      repeating.push_back(blocks_.of[f.contact]);
  for (const std::size_t block : repeating)
    if (Refusal why = enumerate(block, solver_state))
      if (!release(block, solver_state)) return why;
  return {};
}

bool is_pushed(const FailedGuard& f, const Instant& instant, const ContactMotion& before,
               const ContactMotion& noise) {
  return f.sign.order == 0 && !instant.has_triggered(f.contact, f.guard) &&
         f.form.value(before) > retry_noise_factor * f.form.rounding(&before, &noise, 0);
}

void defer_pushed_failures(const Model& model, const std::vector<bool>& visited,
                           const std::vector<std::size_t>& block_of, std::vector<FailedGuard>& failed) {
  const auto does_not_stick = [&](const FailedGuard& f) {
    const Contact& contact = model.contacts[f.contact];
    return visited[f.contact] && contact::is_friction_limit(f.guard) && f.sign.order == 0 &&
           contact.sticks_rigidly() && !contact.takes_impulses();
  };
  std::vector<std::size_t> blocks;
  for (const FailedGuard& f : failed)
    if (does_not_stick(f)) blocks.push_back(block_of[f.contact]);
  std::erase_if(failed, [&](const FailedGuard& f) {
    return !visited[f.contact] && f.sign.order == 0 &&
           std::find(blocks.begin(), blocks.end(), block_of[f.contact]) != blocks.end();
  });
}

}  // namespace signorini::decide
