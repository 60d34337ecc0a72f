#include "differential/relation.hpp"

#include <algorithm>

namespace signorini::differential {
namespace {

const OutputSpec& first_term(const Scene& scene, const OutputSpec& combination) {
  const std::string& name = combination.terms.front().first;
  return *std::find_if(scene.outputs.begin(), scene.outputs.end(),
                       [&](const OutputSpec& output) { return output.name == name; });
}

}  // namespace

Unit unit_of(const Scene& scene, const OutputSpec& output) {
  const auto turning = [&](const Unit& moved, const Unit& turned) {
    return output.rotation ? turned : moved;
  };
  switch (output.kind) {
    case OutputKind::displacement:
    case OutputKind::relative:
      return turning(unit::length, unit::plain);
    case OutputKind::velocity:
      return turning(unit::velocity, unit::rate);
    case OutputKind::acceleration:
      return turning(unit::acceleration, Unit{0, 0, -2});
    case OutputKind::member_force:
      return output.quantity == OutputQuantity::M ? unit::energy : unit::force;
    case OutputKind::reaction:
    case OutputKind::spring:
      return turning(unit::force, unit::energy);
    case OutputKind::contact:
      return output.quantity == OutputQuantity::loss ? unit::energy
             : output.quantity == OutputQuantity::gap || output.quantity == OutputQuantity::slip
                 ? unit::length
                 : unit::force;
    case OutputKind::combination:
      break;
  }
  return unit_of(scene, first_term(scene, output));
}

double mirror_sign(const Scene& scene, const OutputSpec& output) {
  if (output.kind == OutputKind::combination) return mirror_sign(scene, first_term(scene, output));
  const bool turns = output.quantity == OutputQuantity::V || output.quantity == OutputQuantity::M ||
                     output.quantity == OutputQuantity::T || output.quantity == OutputQuantity::slip;
  return output.rotation || turns ? -1.0 : 1.0;
}

}  // namespace signorini::differential
