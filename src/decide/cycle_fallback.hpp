// cycle_fallback.hpp: continues a decision whose states repeat.
//
//   16 times the noise -> sliders decided with the others -> all combinations of states of a block
//                      -> massless parts leave the contact instantaneously
//
// Contact states repeat if rounding separates the zeros of several guards that are zero together. Each step
// is tried only if states repeat after the one before. If the last one fails, the decision is refused.
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
  /// Groups of contacts that are coupled (assembly/parts.hpp).
  explicit ContactBlocks(const Model& model)
      : all(assembly::coupled_contacts(model)), of(model.contacts.size()) {
    for (std::size_t b = 0; b < all.size(); ++b)
      for (const std::size_t c : all[b]) of[c] = b;
  }
  /// Largest number of contacts in a block that can stick rigidly: the rows of two may be dependent. A contact
  /// that takes impulses is always decided with its block; the result is then the largest number of the type.
  [[nodiscard]] std::size_t max_rigid(const Model& model) const;

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
//   p' = 0: the contact stops   ->   |T| <= f|N| in stick?   no: it slips, in the other or the same direction
//
// A stopped contact is first tried as sticking. If it does not stick, its force on other contacts does not
// exist. Other contacts that only this force pushes beyond a limit keep their states until the state of the
// stopped contact is known.

/// Acts if a contact with a rigid tangent that has changed its state is beyond its friction limit. It removes
/// the failures of all contacts of this block that have not changed yet, if their guards fail in value (order
/// 0). visited: contacts that have changed; block_of: block of each contact.
void defer_pushed_failures(const Model& model, const std::vector<bool>& visited,
                           const std::vector<std::size_t>& block_of, std::vector<FailedGuard>& failed);

/// True if the guard did not reach zero continuously: it was above its rounding just before, and another contact's new
/// state made it jump below zero.
[[nodiscard]] bool is_pushed(const FailedGuard& f, const Instant& instant, const ContactMotion& before,
                             const ContactMotion& noise);

}  // namespace signorini::decide
