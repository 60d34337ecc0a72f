// history_turns.hpp: extreme values of contacts inside a BDF step.
//
//   N, T, g and ut are linear in y, so their polynomials through the last steps are those of the step
//
// Looked for only where a polynomial may leave what was seen, and does not go one way (its Bernstein coefficients).
#pragma once

#include <vector>

#include "engine/falls/step_history.hpp"
#include "engine/falls/turning_points.hpp"

namespace signorini {

class HistoryTurns {
 public:
  /// The scalars of the history from `first` on are those of the contacts, in the order of TurningPoints::watched.
  HistoryTurns(std::size_t contacts, std::size_t first)
      : contacts_(contacts), first_(first), turns_(contacts) {}

  [[nodiscard]] std::size_t count() const { return TurningPoints::watched.size() * contacts_; }
  void start(const Decision& decision) { turns_.start(decision); }
  /// The part [0, x_end] of the last step.
  void find(const StepHistory& history, double x_end);
  /// Ascending, of the last step.
  [[nodiscard]] const std::vector<double>& times() const { return turns_.times(); }

 private:
  void look_at(std::size_t shown, const StepHistory& history, double x_end);

  std::size_t contacts_, first_;
  TurningPoints turns_;
};

}  // namespace signorini
