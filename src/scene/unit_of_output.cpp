#include "scene/unit_of_output.hpp"

#include <algorithm>

#include "scene/quantities.hpp"

namespace signorini {
namespace {

constexpr Unit stress{1, -2, 0}, angular_acceleration{0, 0, -2};

Unit unit_of(OutputQuantity quantity) {
  switch (quantity) {
    case OutputQuantity::M:
    case OutputQuantity::loss:
      return unit::energy;
    case OutputQuantity::gap:
    case OutputQuantity::slip:
      return unit::length;
    case OutputQuantity::stress:
    case OutputQuantity::xx:
    case OutputQuantity::yy:
    case OutputQuantity::xy:
      return stress;
    case OutputQuantity::none:
    case OutputQuantity::N:
    case OutputQuantity::V:
    case OutputQuantity::T:
      break;
  }
  return unit::force;
}

}  // namespace

bool same_unit(const Unit& a, const Unit& b) {
  return a.force == b.force && a.length == b.length && a.time == b.time;
}

Unit product_of_units(const Unit& a, const Unit& b) {
  return {a.force + b.force, a.length + b.length, a.time + b.time};
}

Unit unit_of_term(const OutputTerm& term, const std::vector<OutputSpec>& all) {
  const auto of = std::find_if(all.begin(), all.end(),
                               [&](const OutputSpec& output) { return output.name == term.name; });
  return product_of_units(unit_of_output(*of, all), term.unit);
}

Unit unit_of_output(const OutputSpec& spec, const std::vector<OutputSpec>& all) {
  switch (spec.kind) {
    case OutputKind::displacement:
    case OutputKind::relative:
      return spec.rotation ? unit::plain : unit::length;
    case OutputKind::velocity:
      return spec.rotation ? unit::rate : unit::velocity;
    case OutputKind::acceleration:
      return spec.rotation ? angular_acceleration : unit::acceleration;
    case OutputKind::reaction:
    case OutputKind::spring:
      return spec.rotation ? unit::energy : unit::force;
    case OutputKind::stress:
      return stress;
    case OutputKind::combination:
      return unit_of_term(spec.terms.front(), all);
    case OutputKind::member_force:
    case OutputKind::envelope:
    case OutputKind::contact:
      break;
  }
  return unit_of(spec.quantity);
}

}  // namespace signorini
