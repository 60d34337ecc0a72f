// moved_start.hpp: how far a static start moves with the data that it follows from.
//
//   r = P - K u0 - sum_closed n N - sum_stuck t T,   N = kn g of springs, of rigid ones that of the start;  T: initial_shear
//   (K' + sum_closed kn' n' n'^T + sum_stuck kt' t' t'^T) w = r' - r,   n' . w = 0 of rigid ones that are closed, and of what
//   touches and bears nothing;   T' = T kt'/kt + kt' t' . w: the sliding point stays
//
// u0 is known to the condition of K times a rounding: where a frame stands on springs that are ten million times softer, to
// ten million roundings. Companions that begin where their run begins would not see that. The states of the start stay.
#pragma once

#include <optional>
#include <vector>

#include "signorini/model.hpp"

namespace signorini {

struct MovedStart {
  Vector w;                    ///< near.u0 is to be moved by it
  std::vector<double> shears;  ///< T' of each contact
};
/// near: the model with other data and the same closed gaps. Nothing: the start is not static, or friction is at its limit
/// in it or holds rigidly, or its matrix is singular, or a contact's state would change.
[[nodiscard]] std::optional<MovedStart> moved_start(const Model& model, const Model& near);

}  // namespace signorini
