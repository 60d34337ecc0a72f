// static_reaction.hpp: -N of a contact before the motion starts.
//
//   a slider    its given normal force at t = 0
//   others      reaction in static equilibrium, if the run begins with it
#pragma once

#include <cstddef>
#include <optional>

#include "signorini/model.hpp"

namespace signorini {

/// Unit: force. nullopt if the run begins with a given motion and the contact is no slider.
[[nodiscard]] inline std::optional<double> static_reaction(const Model& model, std::size_t contact) {
  const Contact& c = model.contacts[contact];
  if (c.normal_force_given()) return c.normal_force.value(0.0);
  if (model.static_start && contact < model.statics.reactions.size()) return model.statics.reactions[contact];
  return std::nullopt;
}

}  // namespace signorini
