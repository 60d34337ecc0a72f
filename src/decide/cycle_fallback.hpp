// cycle_fallback.hpp: continues a decision whose states repeat.
//
//   1. increase the noise (rounding errors) by a factor of 16
//   2. decide sliders together with the rigid contacts
//   3. try all combinations of states of a block
//   4. let massless parts leave a contact instantaneously
//
// States repeat if several guards are zero at the same time but rounding separates their zeros. A step is taken only if states
// still repeat after the previous step. If the last step fails, the decision is refused.
#pragma once

#include <vector>

#include "decide/guard_signs.hpp"
#include "decide/solver_state.hpp"
#include "decide/state_enumeration.hpp"
#include "model/assembly/parts.hpp"
#include "signorini/model.hpp"

namespace signorini::decide {

/// Blocks: groups of contacts that are decided together. all: the blocks; of: index of the block of each contact.
struct ContactBlocks {
  /// Blocks of the model: groups of contacts that are coupled (assembly/parts.hpp).
  explicit ContactBlocks(const Model& model)
      : all(assembly::coupled_contacts(model)), of(model.contacts.size()) {
    for (std::size_t b = 0; b < all.size(); ++b)
      for (const std::size_t c : all[b]) of[c] = b;
  }
  /// The largest number, over all blocks, of contacts in one block that can stick rigidly. The constraint rows of two or more
  /// such contacts may be linearly dependent. If any contact takes impulses, the result is the largest std::size_t, because such a contact is always decided
  /// together with its block.
  [[nodiscard]] std::size_t max_rigid(const Model& model) const;

  std::vector<Block> all;
  std::vector<std::size_t> of;
};

class CycleFallback {
 public:
  /// All arguments must outlive the object.
  CycleFallback(motion::StateSystems& systems, motion::JetMaker& jets, const ContactBlocks& blocks)
      : model_(systems.model()), systems_(systems), jets_(jets), blocks_(blocks) {}

  /// Takes the next step of the list above. Returns a refusal if the last step fails.
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
//   p' = 0: the contact stops   ->   |T| <= f|N| in stick: the contact sticks; otherwise it slips, in either direction
//
// A stopped contact is first tried in stick. Its force T may then be too large, and push other contacts beyond their limits.
// These contacts keep their states until the stopped contact is decided.

/// If a rigidly sticking contact that has changed its state exceeds its friction limit, removes from `failed` other contacts of
/// its block: contacts that have not changed their state yet and whose guards are negative in value (order 0). visited: true
/// for contacts that have changed their state; block_of: block of each contact.
void defer_pushed_failures(const Model& model, const std::vector<bool>& visited,
                           const std::vector<std::size_t>& block_of, std::vector<FailedGuard>& failed);

/// True if the guard did not reach zero continuously: it was above its rounding just before, and another contact's new
/// state made it jump below zero.
[[nodiscard]] bool is_pushed(const FailedGuard& f, const Instant& instant, const ContactMotion& before,
                             const ContactMotion& noise);

}  // namespace signorini::decide
