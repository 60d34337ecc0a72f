// moved_start.hpp: how far a static start moves with the data that it follows from.
//
//   r = P - K u0 - sum_closed n N,   N = kn g of springs, of rigid ones that of the start
//   (K' + sum_closed kn' n' n'^T) w = r' - r,   n' . w = 0 of rigid ones that are closed, and of what touches and bears nothing
//
// u0 is known to the condition of K times a rounding: where a frame stands on springs that are ten million times softer, to
// ten million roundings. Companions that begin where their run begins would not see that. The states of the start stay.
#pragma once

#include <optional>

#include "signorini/model.hpp"

namespace signorini {

/// w, which near.u0 is to be moved by; near: the model with other data and the same closed gaps. Nothing: the start is not
/// static, or friction has a part in it, or its matrix is singular, or a contact's state would change.
[[nodiscard]] std::optional<Vector> moved_start(const Model& model, const Model& near);

}  // namespace signorini
