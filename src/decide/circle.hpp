// circle.hpp: ways on where the modes of a decision repeat.
//
//   blurred zeros -> sliders with the others -> all combinations of states of a block -> without mass: let go
//
// Guards that fail in turns are zeros that rounding has told too sharply. Where no combination of states holds either, the
// decision is refused.
#pragma once

#include "decide/course.hpp"
#include "decide/enumeration.hpp"
#include "model/assembly/parts.hpp"

namespace signorini {

/// Contacts that are decided together, and the block of each.
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
  /// All must outlive it.
  CircleExit(ModeSystems& systems, JetMaker& jets, const ContactBlocks& blocks)
      : model_(systems.model()), systems_(systems), jets_(jets), blocks_(blocks) {}

  /// One way further. A refusal says that there is none.
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
