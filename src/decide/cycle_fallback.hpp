// cycle_fallback.hpp: continues a decision whose states repeat.
//
//   16 times the noise -> sliders decided with the rigid contacts -> all combinations of states of a block
//                      -> massless parts leave a contact instantaneously
//
// States repeat if rounding separates the zeros of several guards that are zero at the same time. Each step is tried only if
// states repeat after the previous step. If the last step fails, the decision is refused.
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
  /// Blocks of the model: groups of contacts that are coupled (assembly/parts.hpp).
  explicit ContactBlocks(const Model& model)
      : all(assembly::coupled_contacts(model)), of(model.contacts.size()) {
    for (std::size_t b = 0; b < all.size(); ++b)
      for (const std::size_t c : all[b]) of[c] = b;
  }
  /// Largest number of rigidly sticking contacts in a block; the constraint rows of two of them may be linearly dependent. If
  /// any contact takes impulses, the result is the largest std::size_t, because such a contact is always decided with its
  /// block.
  [[nodiscard]] std::size_t max_rigid(const Model& model) const;

  std::vector<Block> all;
  std::vector<std::size_t> of;
};

class CycleFallback {
 public:
  /// All arguments must outlive the object.
  CycleFallback(motion::StateSystems& systems, motion::JetMaker& jets, const ContactBlocks& blocks)
      : model_(systems.model()), systems_(systems), jets_(jets), blocks_(blocks) {}

  /// Takes the next step. If no step is left, returns a refusal.
  [[nodiscard]] Refusal next_step(SolverState& solver_state);

 private:
  [[nodiscard]] Refusal enumerate(std::size_t block, SolverState& solver_state);
  [[nodiscard]] bool release(std::size_t block, SolverState& solver_state);

  const Model& model_;
  motion::StateSystems& systems_;
  motion::JetMaker& jets_;
  const ContactBlocks& blocks_;
};

// Order of state changes if several contacts change their states at one instant.
//
//   p' = 0: the contact stops   ->   |T| <= f|N| in stick?   no: it slips, in either direction
//
// A stopped contact is first tried as sticking. If it does not stick, its sticking force on other contacts does not exist. So
// other contacts that only this force pushes beyond a limit keep their states until the stopped contact is decided.

/// If a contact that can stick rigidly has changed its state and is beyond its friction limit, removes failures of other
/// contacts in its block: those of contacts that have not changed yet and whose guards fail in value (order 0). visited:
/// contacts that have changed; block_of: block of each contact.
void defer_pushed_failures(const Model& model, const std::vector<bool>& visited,
                           const std::vector<std::size_t>& block_of, std::vector<FailedGuard>& failed);

}  // namespace signorini::decide
