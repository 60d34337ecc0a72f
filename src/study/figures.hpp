// figures.hpp: figures that a run may not have, in tables and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

namespace signorini {

/// For a cell; absent ones stay so.
template <class Value>
[[nodiscard]] std::optional<double> number_of(const std::optional<Value>& value) {
  if (!value) return std::nullopt;
  return static_cast<double>(*value);
}

/// null where absent.
template <class Value>
[[nodiscard]] nlohmann::ordered_json json_of(const std::optional<Value>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

}  // namespace signorini
