// static_reaction.hpp: -N of a contact before the motion.
//
//   a slider    its compression at t = 0, which is given
//   others      that of static equilibrium, where the run begins with it
#pragma once

#include <cstddef>
#include <optional>

#include "signorini/model.hpp"

namespace signorini {

/// Unit: force. Nothing where the run begins with given motions and the contact is no slider.
[[nodiscard]] inline std::optional<double> static_reaction(const Model& model, std::size_t contact) {
  const Contact& c = model.contacts[contact];
  if (c.normal_force_given()) return c.normal_force.value(0.0);
  if (model.static_start && contact < model.statics.reactions.size()) return model.statics.reactions[contact];
  return std::nullopt;
}

}  // namespace signorini
