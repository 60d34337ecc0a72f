// modal_memory.hpp: open modes, and complex modes of contact states, kept from run to run of one structure.
//
//   ModalMemory memory;      ListenerNeeds::modal->memory = &memory: run after run, as of orbits and their branches
//
// A state's complex modes cost as much as many periods in them. They depend on the structure alone, but for sums of
// roots whose pairs are slow beside the run: kept ones are of a run at least as long, and at most 1e4 times so. They cost digits
// of the works of such pairs in the shortest runs, none of the motion.
#pragma once

#include "engine/exact/modal/damped_system.hpp"

namespace signorini {

class ModalSystem;

class ModalMemory {
 public:
  struct Kept {
    Kept(const Model& of, double longest) : model(of), basis(model), t_end(longest) {}
    Kept(const Kept&) = delete;
    Kept& operator=(const Kept&) = delete;
    const Model model;  ///< loads and the start mean nothing, but for directions of loads
    const OpenBasis basis;
    const double t_end;
    std::unique_ptr<DampedSystem> damped;  ///< made when it is asked for
  };

  /// Of this structure, whose runs end at t_end.
  [[nodiscard]] std::shared_ptr<Kept> of(const Model& model, double t_end);

 private:
  std::shared_ptr<Kept> kept_;
};

/// What the engine and who observes its run share.
struct ModalShare {
  ModalMemory* memory = nullptr;  ///< of earlier runs; null: nothing is kept
  ModalSystem* modes =
      nullptr;  ///< told by the engine: those that it follows motions in; null: none, or it is another
};

}  // namespace signorini
