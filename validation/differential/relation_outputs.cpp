#include "differential/relation.hpp"

#include <algorithm>

namespace signorini::differential {
namespace {

const OutputSpec& first_term(const Scene& scene, const OutputSpec& combination) {
  const std::string& name = combination.terms.front().name;
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
    case OutputKind::stress:
      return Unit{1, -2, 0};
    case OutputKind::envelope:
      return output.quantity == OutputQuantity::stress ? Unit{1, -2, 0}
             : output.quantity == OutputQuantity::M    ? unit::energy
                                                       : unit::force;
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
  const Unit of = unit_of(scene, first_term(scene, output)), factor = output.terms.front().unit;
  return {of.force + factor.force, of.length + factor.length, of.time + factor.time};
}

double mirror_sign(const Scene& scene, const OutputSpec& output) {
  if (output.kind == OutputKind::combination) return mirror_sign(scene, first_term(scene, output));
  // The fibres change sides; an envelope has magnitudes.
  if (output.kind == OutputKind::stress || output.kind == OutputKind::envelope) return 1.0;
  const bool turns = output.quantity == OutputQuantity::V || output.quantity == OutputQuantity::M ||
                     output.quantity == OutputQuantity::T || output.quantity == OutputQuantity::slip;
  return output.rotation || turns ? -1.0 : 1.0;
}

}  // namespace signorini::differential
