// said.hpp: computed values in the scene's units, for messages.
//
//   value in scene units = value * factor of its unit          Model::unit; for whole results: run/physical.hpp
#pragma once

#include "scene/quantities.hpp"
#include "signorini/model.hpp"

namespace signorini {

[[nodiscard]] inline double said(const Model& model, double value, const Unit& of) {
  return value * factor_of(of, model.unit);
}
[[nodiscard]] inline double said_time(const Model& model, double t) { return said(model, t, unit::time); }

}  // namespace signorini
