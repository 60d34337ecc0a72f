// figures.hpp: optional figures of a run, in tables and JSON.
#pragma once

#include <optional>

#include "base/json.hpp"

namespace signorini {

/// Value for a cell; empty if absent.
template <class Value>
[[nodiscard]] std::optional<double> number_of(const std::optional<Value>& value) {
  if (!value) return std::nullopt;
  return static_cast<double>(*value);
}

/// JSON value; null if absent.
template <class Value>
[[nodiscard]] Json json_of(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

}  // namespace signorini
