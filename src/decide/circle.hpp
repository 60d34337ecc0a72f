// circle.hpp: continues a decision whose modes repeat.
//
//   blurred zeros -> sliders with the others -> all combinations of states of a block -> massless parts let go
//
// Guards that fail in turns are zeros that rounding has separated too sharply. If no combination of states is
// consistent either, the decision is refused.
#pragma once

#include "decide/course.hpp"
#include "decide/enumeration.hpp"
#include "model/assembly/parts.hpp"

namespace signorini {

/// Groups of contacts that are decided together, and the block of each contact.
struct ContactBlocks {
  explicit ContactBlocks(const Model& model) : all(coupled_contacts(model)), of(model.contacts.size()) {
    for (std::size_t b = 0; b < all.size(); ++b)
      for (const std::size_t c : all[b]) of[c] = b;
  }
  std::vector<Block> all;
  std::vector<std::size_t> of;
};

class CircleExit {
 public:
  /// All arguments must outlive the object.
  CircleExit(ModeSystems& systems, JetMaker& jets, const ContactBlocks& blocks)
      : model_(systems.model()), systems_(systems), jets_(jets), blocks_(blocks) {}

  /// Takes the next step. A refusal means that there is none.
  [[nodiscard]] Refusal leave(DecisionCourse& course);

 private:
  [[nodiscard]] Refusal enumerate(std::size_t block, DecisionCourse& course);
  [[nodiscard]] bool release(std::size_t block, DecisionCourse& course);

  const Model& model_;
  ModeSystems& systems_;
  JetMaker& jets_;
  const ContactBlocks& blocks_;
};

}  // namespace signorini
