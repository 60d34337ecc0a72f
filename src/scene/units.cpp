#include "scene/units.hpp"

#include <algorithm>
#include <charconv>

#include "scene/quantities.hpp"

namespace signorini::scene {
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

namespace {

constexpr int highest_power = 9;

std::optional<Unit> unit_named(std::string_view name, const Units& names) {
  if (name == names.force) return unit::force;
  if (name == names.length) return unit::length;
  if (name == names.time) return unit::time;
  if (name == names.mass) return unit::mass;
  if (name == "1" || name == "rad") return unit::plain;
  return std::nullopt;
}

/// Multiplies `unit` by a word such as "m^2" to the power of `sign`, 1 or -1. False if the word is not a unit.
bool add_word(std::string_view word, int sign, const Units& names, Unit& unit) {
  int power = 1;
  if (const std::size_t at = word.find('^'); at != std::string_view::npos) {
    const std::string_view digits = word.substr(at + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), power);
    if (error != std::errc() || end != digits.data() + digits.size() || power < 1 || power > highest_power)
      return false;
    word = word.substr(0, at);
  }
  const std::optional<Unit> one = unit_named(word, names);
  if (!one) return false;
  power *= sign;
  unit = {unit.force + power * one->force, unit.length + power * one->length, unit.time + power * one->time};
  return true;
}

bool add_words(std::string_view words, int sign, const Units& names, Unit& unit) {
  bool any = false;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find_first_of(" *"), words.size());
    if (end > 0 && !add_word(words.substr(0, end), sign, names, unit)) return false;
    any = any || end > 0;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return any;
}

}  // namespace

std::optional<Unit> unit_of_text(std::string_view text, const Units& names) {
  Unit unit;
  const std::size_t slash = text.find('/');
  if (!add_words(text.substr(0, slash), 1, names, unit)) return std::nullopt;
  if (slash != std::string_view::npos && !add_words(text.substr(slash + 1), -1, names, unit))
    return std::nullopt;
  return unit;
}

}  // namespace signorini::scene
