// figures.hpp: figures that a run may not have, in tables and JSON.
#pragma once

#include <optional>

#include "base/json.hpp"

namespace signorini {

/// For a cell; absent ones stay so.
template <class Value>
[[nodiscard]] std::optional<double> number_of(const std::optional<Value>& value) {
  if (!value) return std::nullopt;
  return static_cast<double>(*value);
}

/// null where absent.
template <class Value>
[[nodiscard]] Json json_of(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

}  // namespace signorini
