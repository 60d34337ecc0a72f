// loss_rates.hpp: what an instant takes out of the motion at once, and how that moves with a parameter.
//
//   impact     L = v-^T M v-/2 - v+^T M v+/2 + sum Pt s'
//   friction   L = (T-^2 - T+^2)/2kt                where a force drops
//   parts without mass, which move at once (run/audit.hpp):
//   friction   L = T+ (slip+ - slip-)               where a load jumps, L = what is released where friction drops;
//                                                   of several their own and an equal part of the rest
//   loads      W += sum of L - what is released     where a load jumps, else W += P . (u+ - u-), which is released, too
//
// DL: along the moving instant, as all that happens at it.
#pragma once

#include <optional>

#include "sensitivity/tangent_event.hpp"
#include "sensitivity/work_rates.hpp"

namespace signorini {

class LossRates {
 public:
  /// All must outlive it. massless: moves_at_once(model).
  LossRates(const Model& model, const ModelDerivative& derivative, bool massless)
      : model_(model), derivative_(derivative), massless_(massless) {}

  /// Across an instant; `works` from what they are at fixed time before it to what they are after it.
  /// Returned: what they are along it, everything lost.
  WorkRates pass(const InstantMotion& motion, const TangentBefore& before, const TangentAfter& after,
                 WorkTangent& works) const;

 private:
  struct Sides;
  void add_impact(const Sides& sides, WorkRates& works) const;
  [[nodiscard]] std::optional<double> drop_by(const Sides& sides, std::size_t contact) const;
  [[nodiscard]] double driven_by(const Sides& sides) const;
  void add_drops(const Sides& sides, WorkTangent& works) const;

  const Model& model_;
  const ModelDerivative& derivative_;
  bool massless_;
};

}  // namespace signorini
