// loss_rates.hpp: energy lost at an instant, and its derivative by a parameter.
//
//   impact     L = v-^T M v-/2 - v+^T M v+/2 + sum Pt s'
//   friction   L = (T-^2 - T+^2)/2kt                at a drop of a force
//   parts without mass, which respond immediately (run/audit.hpp):
//   friction   L = T+ (slip+ - slip-)               at a jump of a load; L = released energy at a drop of friction;
//                                                   several contacts: each its own and an equal part of the rest
//   loads      W += sum of L - released energy      at a jump of a load, else W += P . (u+ - u-), which is released,
// too
//
// DL: along the moving instant, like everything at it.
#pragma once

#include <optional>

#include "sensitivity/tangent_event.hpp"
#include "sensitivity/work_rates.hpp"

namespace signorini {

class LossRates {
 public:
  /// All arguments must outlive the object. massless: moves_at_once(model).
  LossRates(const Model& model, const ModelDerivative& derivative, bool massless)
      : model_(model), derivative_(derivative), massless_(massless) {}

  /// Crosses an instant; `works` changes from the derivatives at fixed time before it to those after it. Returns the
  /// derivatives along the instant, all losses included.
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
