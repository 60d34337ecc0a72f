// components.hpp: what moves at a node, and how it is called.
//
//   0  ux, vx    1  uy, vy    2  rz, wz (a rotation)      degrees of freedom of [matrices]: u, v
//
//   motion_named("A.wz")   // a rotation, its rate: 1 / time
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "scene/quantities.hpp"

namespace signorini {

struct PlaneComponent {
  const char* displacement;
  const char* velocity;
  bool rotation;
};

inline constexpr std::array plane_components = {
    PlaneComponent{"ux", "vx", false}, PlaneComponent{"uy", "vy", false}, PlaneComponent{"rz", "wz", true}};

/// What one of these names stands for: index into plane_components, and whether its rate.
struct NamedComponent {
  std::size_t index = 0;
  bool rate = false;

  [[nodiscard]] constexpr const PlaneComponent& component() const { return plane_components[index]; }
  [[nodiscard]] constexpr std::string_view name() const {
    return rate ? component().velocity : component().displacement;
  }
};

/// What is behind the last dot of a name.
[[nodiscard]] constexpr std::string_view last_part(std::string_view name) {
  return name.substr(name.rfind('.') + 1);
}

/// Of "ux" or "A.ux"; none of other names.
[[nodiscard]] constexpr std::optional<NamedComponent> component_named(std::string_view name) {
  for (std::size_t i = 0; i < plane_components.size(); ++i)
    for (const NamedComponent named : {NamedComponent{i, false}, NamedComponent{i, true}})
      if (last_part(name) == named.name()) return named;
  return std::nullopt;
}

struct NamedMotion {
  bool rotation = false, rate = false;

  [[nodiscard]] constexpr Unit unit() const { return {0, rotation ? 0 : 1, rate ? -1 : 0}; }
};

/// Of a motion by its name; what is no component of a node is a length, or its rate: "d0.u", "d0.v", "first.slip".
[[nodiscard]] constexpr NamedMotion motion_named(std::string_view name) {
  if (const auto named = component_named(name)) return {named->component().rotation, named->rate};
  return {false, last_part(name) == "v"};
}

/// Among columns of tables: "A.ux", "d0.u".
[[nodiscard]] constexpr bool is_displacement(std::string_view column) {
  const auto named = component_named(column);
  return named ? !named->rate : column.ends_with(".u");
}

}  // namespace signorini
