// cycle_fallback.hpp: continues a decision whose states repeat.
//
//   blurred zeros -> sliders with the others -> all combinations of states of a block -> massless parts let go
//
// Guards that fail in turns are zeros that rounding has separated too sharply. If no combination of states is
// consistent either, the decision is refused.
#pragma once

#include <vector>

#include "decide/guard_signs.hpp"
#include "decide/solver_state.hpp"
#include "decide/state_enumeration.hpp"
#include "model/assembly/parts.hpp"
#include "signorini/model.hpp"

namespace signorini::decide {

/// Groups of contacts that are decided together, and the block of each contact.
struct ContactBlocks {
  explicit ContactBlocks(const Model& model)
      : all(assembly::coupled_contacts(model)), of(model.contacts.size()) {
    for (std::size_t b = 0; b < all.size(); ++b)
      for (const std::size_t c : all[b]) of[c] = b;
  }
  std::vector<Block> all;
  std::vector<std::size_t> of;
};

class CycleFallback {
 public:
  /// All arguments must outlive the object.
  CycleFallback(motion::StateSystems& systems, motion::JetMaker& jets, const ContactBlocks& blocks)
      : model_(systems.model()), systems_(systems), jets_(jets), blocks_(blocks) {}

  /// Takes the next step. A refusal means that there is none.
  [[nodiscard]] Refusal next_step(SolverState& solver_state);

 private:
  [[nodiscard]] Refusal enumerate(std::size_t block, SolverState& solver_state);
  [[nodiscard]] bool release(std::size_t block, SolverState& solver_state);

  const Model& model_;
  motion::StateSystems& systems_;
  motion::JetMaker& jets_;
  const ContactBlocks& blocks_;
};

// Order of state changes if several contacts change at one instant.
//
//   p' = 0: it stops   ->   |T| <= f|N| in stick?   no: it slips, in the other direction or in the same
//
// While a stopped contact is tried as sticking, it pulls at others with a force that is later found not to exist.
// Contacts that only this force pushes beyond a limit have no reason to change: they are decided after the state of the
// stopped contact is known.

/// If a contact that was decided before is beyond the limit of rigid friction, removes failures of other contacts of
/// its block that were not decided before: failures of values, not of rates. visited: one entry per contact; block_of:
/// its block.
void defer_pushed_failures(const Model& model, const std::vector<bool>& visited,
                           const std::vector<std::size_t>& block_of, std::vector<FailedGuard>& failed);

}  // namespace signorini::decide
