// optional_values.hpp: optional values of a run in tables and JSON, and units of keys.
#pragma once

#include <optional>
#include <string>

#include "base/json.hpp"
#include "signorini/scene.hpp"

namespace signorini::study {

/// The value as a number for a table's cell; nullopt if absent.
template <class Value>
[[nodiscard]] std::optional<double> number_of(const std::optional<Value>& value) {
  if (!value) return std::nullopt;
  return static_cast<double>(*value);
}

/// JSON value; null if absent.
template <class Value>
[[nodiscard]] base::Json json_of(const std::optional<Value>& value) {
  return value ? base::Json(*value) : base::Json();
}

/// Unit of the scene's key at `path`, in the scene's unit names. Empty if the key has no unit, or if the path
/// is not a key.
///
///   key_unit("contacts.left.normal_stiffness", units) == "kN/m"
///   key_unit("contacts.*.friction", units) == ""
[[nodiscard]] std::string key_unit(const std::string& path, const Units& units);
/// "PATH [UNIT]"; "PATH" if the key has no unit.
[[nodiscard]] std::string key_with_unit(const std::string& path, const Units& units);

}  // namespace signorini::study
