#include "decide/cycle_fallback.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <utility>

#include "decide/massless_jump.hpp"

namespace signorini::decide {

/// Tries all combinations of states of a block, if no other method finds a consistent one.
Refusal CycleFallback::enumerate(std::size_t block, SolverState& course) {
  Enumeration enumeration(systems_, jets_);
  std::vector<Enumeration::Choice> choices;
  for (const Participant& participant : course.found.participants)
    if (blocks_.of[participant.contact] == block) choices.push_back(enumeration.choice(participant));
  for (const std::size_t c : blocks_.all[block]) {
    const Contact& contact = model_.contacts[c];
    if (contact.takes_impulses() || !course.decision.visited[c]) continue;
    const bool takes_part = std::any_of(choices.begin(), choices.end(),
                                        [&](const Enumeration::Choice& other) { return other.contact == c; });
    if (!takes_part)
      choices.push_back(enumeration.choice(c, course.instant.mode[c], course.decision.before[c]));
  }
  Refusal refusal{
      Refusal::Kind::endless,
      "no combination of states is consistent; guards that fail: " + names_of(model_, course.failed),
      contacts_of(course.failed)};
  const auto best = enumeration.least_failing(course.instant, course.after, blocks_.all[block], choices,
                                              course.found.known, course.mode);
  if (!best) return refusal;
  refusal.condition = best->condition;
  refusal.residual = best->forgiveness;
  if (!best->rival.empty()) {
    refusal.kind = Refusal::Kind::ambiguous;
    refusal.reason = fmt::format("{}; guards that fail in the last that was tried: {}",
                                 several_motions(model_, choices, *best), names_of(model_, course.failed));
  }
  if (!best->acceptable()) return refusal;
  course.mode = best->mode;
  for (const std::size_t c : blocks_.all[block]) course.found.known[c] = course.found.known[c].of_motion();
  course.undecided.push_back(block);
  course.decision.undecided = true;
  course.decision.forgiven = std::max(course.decision.forgiven, best->forgiveness);
  return {};
}

/// Lets massless parts leave the failing contact if no combination of states is consistent. False: they cannot, or
/// already have.
bool CycleFallback::release(std::size_t block, SolverState& course) {
  std::vector<std::size_t> circling;
  for (const Failure& f : course.failed)
    if (blocks_.of[f.contact] == block) circling.push_back(f.contact);
  if (circling.size() != 1) return false;
  const std::size_t c = circling.front();
  std::vector<std::size_t>& before = course.decision.released;
  if (std::find(before.begin(), before.end(), c) != before.end()) return false;
  auto u = released(systems_, jets_, course.after, course.instant, course.mode, c);
  if (!u) return false;
  before.push_back(c);
  course.instant.u = std::move(*u);
  const Contact& contact = model_.contacts[c];
  course.mode[c] = {contact::let_go(contact, contact.gap_at(course.instant.u)), 0.0};
  course.found.known[c] = {};
  course.seen.clear();
  return true;
}

/// Continues a decision whose modes repeat, in three steps. First, zeros are blurred: one sample of rounding, and the
/// clock, may have separated them too sharply. Second, sliders are decided together with the other contacts. Third,
/// rounding cannot decide, and all combinations are weighed.
Refusal CycleFallback::leave(SolverState& course) {
  if (course.make_blurred()) {
    course.seen.clear();
    return {};
  }
  if (!course.found.sliders) {
    course.found.sliders = true;
    return {};
  }
  std::vector<std::size_t> circling;
  for (const Failure& f : course.failed)
    if (circling.empty() ||
        std::find(circling.begin(), circling.end(), blocks_.of[f.contact]) == circling.end())
      circling.push_back(blocks_.of[f.contact]);
  for (const std::size_t block : circling)
    if (Refusal why = enumerate(block, course))
      if (!release(block, course)) return why;
  return {};
}

void leave_pushed_for_later(const Model& model, const std::vector<bool>& visited,
                            const std::vector<std::size_t>& block_of, std::vector<Failure>& failed) {
  const auto does_not_stick = [&](const Failure& f) {
    const Contact& contact = model.contacts[f.contact];
    return visited[f.contact] && contact::is_friction_limit(f.guard) && f.sign.order == 0 &&
           contact.sticks_rigidly() && !contact.takes_impulses();
  };
  std::vector<std::size_t> blocks;
  for (const Failure& f : failed)
    if (does_not_stick(f)) blocks.push_back(block_of[f.contact]);
  std::erase_if(failed, [&](const Failure& f) {
    return !visited[f.contact] && f.sign.order == 0 &&
           std::find(blocks.begin(), blocks.end(), block_of[f.contact]) != blocks.end();
  });
}

}  // namespace signorini::decide
