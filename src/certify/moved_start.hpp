// moved_start.hpp: change of a static start by a perturbation of its data.
//
//   r = P - K u0 - sum_closed n N - sum_stuck t T,   N = kn g of springs, for rigid contacts from the start;  T:
// initial_shear
//   (K' + sum_closed kn' n' n'^T + sum_stuck kt' t' t'^T) w = r' - r,   n' . w = 0 for closed rigid contacts, and for
//   touching contacts without force;   T' = T kt'/kt + kt' t' . w: the sliding point is unchanged
//
// The error of u0 is the condition of K times a rounding: ten million roundings if a frame stands on springs that are
// ten million times softer. Companions with the same initial state would not show this. The contact states of the start
// do not change.
#pragma once

#include <optional>
#include <vector>

#include "signorini/model.hpp"

namespace signorini {

struct MovedStart {
  Vector w;                    ///< change of near.u0
  std::vector<double> shears;  ///< T' of each contact
};
/// near: the model with perturbed data and the same closed gaps. nullopt: the start is not static, or friction in it is
/// at its limit or holds rigidly, or its matrix is singular, or a contact's state would change.
[[nodiscard]] std::optional<MovedStart> moved_start(const Model& model, const Model& near);

}  // namespace signorini
