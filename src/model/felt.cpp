#include "model/felt.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/history/history_internal.hpp"
#include "model/modes/held.hpp"
#include "model/statics/null_motions.hpp"

namespace signorini {
namespace {

/// Loads that last longer than this fraction of 1/w keep their amplitude: scales are orders of magnitude, accurate
/// within this factor for longer pulses.
constexpr double full_above = 1.0 / 16.0;

/// rad: a motion that rotates by less than 1 rad during the run counts as free, with this value for the limit of its
/// pulses. A thousandth of the run then counts in full.
constexpr double of_free = 64.0;

/// Effective over full amplitude at this frequency.
double share_at(const History& f, double amplitude, double t_end, double omega) {
  return std::min(1.0, omega * greatest_impulse(f, t_end, 1.0 / omega) / (full_above * amplitude));
}

/// Frequencies of the oscillations along the static responses to loads; 0 if there is none.
class Swings {
 public:
  Swings(const Model& model, const Holding& holding) : model_(model) {
    const SparseMatrix k = with_springs(model.stiffness, holding.springs);
    if (null_motions(with_grips(k, holding.fixed)).cols() == 0) structure_.emplace(k, holding.fixed);
  }
  [[nodiscard]] double along(const Vector& p) const {
    if (!structure_) return 0.0;
    const Vector u = structure_->solve(p);
    const double squared = u.dot(p) / u.dot(model_.mass * u);
    return std::isfinite(squared) && squared > 0.0 ? std::sqrt(squared) : 0.0;
  }

 private:
  const Model& model_;
  std::optional<HeldStructure> structure_;
};

}  // namespace

Felt felt_amplitudes(const Model& model, const Holding& holding, double omega, double t_end) {
  std::optional<Swings> swings;
  const auto own = [&](double along) { return along * t_end > 1.0 ? along : of_free / t_end; };
  // The share increases with the frequency, and the lowest frequency is known.
  const double lowest = std::max(omega, 1.0 / t_end);
  const auto lasts = [&](const History& f, double amplitude) {
    return f.is_constant() || !(amplitude > 0.0) || share_at(f, amplitude, t_end, lowest) == 1.0;
  };
  Felt felt;
  for (const Load& load : model.loads) {
    FeltLoad& part = felt.loads.emplace_back();
    const double amplitude = magnitude(load.history, t_end);
    if (lasts(load.history, amplitude)) continue;
    if (!swings) swings.emplace(model, holding);
    const double along = swings->along(full(load.direction, model.size()));
    part.share = share_at(load.history, amplitude, t_end, own(along > 0.0 ? along : omega));
    if (part.share < 1.0) part.thrown = share_at(load.history, amplitude, t_end, 1.0 / t_end);
  }
  for (const Contact& contact : model.contacts) {
    double& share = felt.compressions.emplace_back(1.0);
    const double amplitude = contact.normal_force_given() ? magnitude(contact.normal_force, t_end) : 0.0;
    if (!lasts(contact.normal_force, amplitude))
      share = share_at(contact.normal_force, amplitude, t_end, own(omega));
  }
  return felt;
}

}  // namespace signorini
