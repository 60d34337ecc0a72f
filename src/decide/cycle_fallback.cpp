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

/// Takes the best of all combinations of states of a block, if it is acceptable; otherwise returns the
/// refusal.
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
  Refusal refusal{
      Refusal::Kind::endless,
      "no combination of states is consistent; guards that fail: " + names_of(model_, solver_state.failed),
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
        fmt::format("{}; guards that fail in the last that was tried: {}",
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

/// Lets massless parts leave the only failing contact of the block (massless_jump.hpp). False: several
/// contacts fail, or the parts cannot leave, or have already left.
bool CycleFallback::release(std::size_t block, SolverState& solver_state) {
  std::vector<std::size_t> circling;
  for (const FailedGuard& f : solver_state.failed)
    if (blocks_.of[f.contact] == block) circling.push_back(f.contact);
  if (circling.size() != 1) return false;
  const std::size_t c = circling.front();
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

/// Continues a decision whose states repeat, by the first of three steps that has not been taken yet. First,
/// noise and resolution are increased: one sample of rounding may have separated zeros too sharply. Second,
/// sliders are decided together with the other contacts. Third, all combinations of the states of each
/// failing block are compared.
Refusal CycleFallback::next_step(SolverState& solver_state) {
  if (solver_state.increase_noise()) {
    solver_state.tried_states.clear();
    return {};
  }
  if (!solver_state.impact_result.sliders) {
    solver_state.impact_result.sliders = true;
    return {};
  }
  std::vector<std::size_t> circling;
  for (const FailedGuard& f : solver_state.failed)
    if (circling.empty() ||
        std::find(circling.begin(), circling.end(), blocks_.of[f.contact]) == circling.end())
      circling.push_back(blocks_.of[f.contact]);
  for (const std::size_t block : circling)
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
