// modal_memory.hpp: open modes, and complex modes of contact states, kept for all runs of one structure.
//
//   ModalMemory memory;      ListenerNeeds::modal->memory = &memory: successive runs, e.g. of orbits and their branches
//
// Computing a state's complex modes costs as much as simulating many periods with them. They depend on the structure
// alone, except for the sums of roots whose pairs are slow relative to the run: kept modes belong to a run at least as
// long, and at most 1e4 times as long. In the shortest runs this costs digits of the works of such pairs, none of the
// motion.
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
    const Model model;  ///< load histories and start are unused; directions of loads count
    const OpenBasis basis;
    const double t_end;
    std::unique_ptr<DampedSystem> damped;  ///< created on request
  };

  /// Kept data for this structure, whose runs end at t_end.
  [[nodiscard]] std::shared_ptr<Kept> of(const Model& model, double t_end);

 private:
  std::shared_ptr<Kept> kept_;
};

/// Data shared by the engine and a listener of its run.
struct ModalShare {
  ModalMemory* memory = nullptr;  ///< from earlier runs; null: none
  ModalSystem* modes = nullptr;   ///< set by the engine: its modes; null: none, or complex ones
};

}  // namespace signorini
