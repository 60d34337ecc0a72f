#include "model/outputs/member_cuts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "model/element/line_member.hpp"
#include "scene/quantities.hpp"

namespace signorini {
namespace {

void add(Cut& to, const Cut& from, double factor) {
  to.forces += factor * from.forces;
  to.acceleration += factor * from.acceleration;
  to.deflection += factor * from.deflection;
  for (std::size_t c = 0; c < 2; ++c) to.load[c] += factor * from.load[c];
}

}  // namespace

Wanted wanted_by(const OutputSpec& spec, Fibre fibre) {
  Wanted wanted{spec.kind == OutputKind::stress ? OutputQuantity::stress : spec.quantity, fibre};
  if (spec.kind == OutputKind::stress && spec.quantity == OutputQuantity::N) wanted.of_M = 0.0;
  if (spec.kind == OutputKind::stress && spec.quantity == OutputQuantity::M) wanted.of_N = 0.0;
  wanted.intensification = spec.intensification;
  return wanted;
}

/// The distributed load is constant, inertia linear along an element and cubic across it (line_element.hpp).
std::size_t points_of(OutputQuantity quantity) {
  return quantity == OutputQuantity::N ? 3 : quantity == OutputQuantity::V ? 5 : 6;
}

std::size_t MemberCuts::element_of(const Way& way, std::size_t k) {
  return way.piece->first + (way.backwards ? way.piece->count - 1 - k : k);
}

std::pair<std::size_t, double> MemberCuts::place_of(const Way& way, double station) {
  const auto count = static_cast<double>(way.piece->count);
  // Between two elements: the next one along the way.
  const double element = std::clamp(std::floor(station * count), 0.0, count - 1.0);
  return {static_cast<std::size_t>(element), station * count - element};
}

Cut MemberCuts::force(const Way& way, std::size_t k, double x, OutputQuantity quantity) const {
  const std::size_t number = element_of(way, k);
  const FiniteElement& e = map_.mesh.element(number);
  Cut cut(e.unknowns().size());
  // In the opposite direction, left and right are exchanged.
  const double sign = way.backwards && quantity == OutputQuantity::M ? -1.0 : 1.0;
  add(cut, e.cut(quantity, {way.backwards ? 1.0 - x : x, 0.0}, map_.frozen_in(number)), sign);
  return cut;
}

Cut MemberCuts::cut(const Way& way, std::size_t k, double x, const Wanted& wanted, const SourcePlace& place,
                    const std::string& key) const {
  if (wanted.quantity != OutputQuantity::stress) return force(way, k, x, wanted.quantity);
  const FiniteElement& e = map_.mesh.element(element_of(way, k));
  const Member& member = scene_.members[static_cast<std::size_t>(e.member())];
  const Section& section = section_of(scene_, member);
  if ((wanted.of_N != 0.0 && section.area == 0.0) || (wanted.of_M != 0.0 && section.modulus == 0.0))
    throw SceneError(place, key,
                     fmt::format("stresses of section '{}' cannot be computed: give it a shape (pipe, box, i "
                                 "or round), or area and modulus in addition to EA and EI",
                                 section.name));
  const std::optional<Bend>& bend = member.bend;
  const double i = wanted.intensification.value_or(bend ? bend->intensification : 1.0);
  const double side = wanted.fibre == Fibre::left ? -1.0 : 1.0;
  Cut cut(e.unknowns().size());
  if (wanted.of_N != 0.0) add(cut, force(way, k, x, OutputQuantity::N), wanted.of_N / section.area);
  if (wanted.of_M != 0.0)
    add(cut, force(way, k, x, OutputQuantity::M), side * i * wanted.of_M / section.modulus);
  return cut;
}

}  // namespace signorini
