// components.hpp: names of the motion components of a node; the counterpart of a contact.
//
//   displacement, rate:  0  ux, vx    1  uy, vy    2  rz, wz (rotation)      degrees of freedom of [matrices]: u, v
//
//   motion_named("A.wz")   // rate of a rotation, unit 1 / time
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/quantities.hpp"
#include "scene/readers.hpp"
#include "signorini/scene.hpp"

namespace signorini::scene {

struct PlaneComponent {
  const char* displacement;
  const char* velocity;
  bool rotation;
};

inline constexpr std::array plane_components = {
    PlaneComponent{"ux", "vx", false}, PlaneComponent{"uy", "vy", false}, PlaneComponent{"rz", "wz", true}};

/// Meaning of a component's name: index into plane_components; rate: the name is that of the velocity.
struct NamedComponent {
  std::size_t index = 0;
  bool rate = false;

  [[nodiscard]] constexpr const PlaneComponent& component() const { return plane_components[index]; }
  [[nodiscard]] constexpr std::string_view name() const {
    return rate ? component().velocity : component().displacement;
  }
};

/// Part of a name after its last dot; the whole name if it has no dot.
[[nodiscard]] constexpr std::string_view last_part(std::string_view name) {
  return name.substr(name.rfind('.') + 1);
}

/// Component for a name such as "ux" or "A.ux"; nullopt if the name ends in no component.
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

/// Type of a motion by its name. A name that is not a component of a node is a length or its rate: "d0.u",
/// "d0.v", "first.slip".
[[nodiscard]] constexpr NamedMotion motion_named(std::string_view name) {
  if (const auto named = component_named(name)) return {named->component().rotation, named->rate};
  return {false, last_part(name) == "v"};
}

/// True for displacement columns of tables: "A.ux", "d0.u".
[[nodiscard]] constexpr bool is_displacement(std::string_view column) {
  const auto named = component_named(column);
  return named ? !named->rate : column.ends_with(".u");
}

/// Index into Scene::bodies of the body to which a node belongs; nullopt if it belongs to no body. node: index into
/// Scene::nodes.
[[nodiscard]] inline std::optional<std::size_t> body_of_node(const Scene& scene, std::size_t node) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodySpec& body = scene.bodies[i];
    if (node >= body.first_node && node < body.first_node + body.node_count) return i;
  }
  return std::nullopt;
}

// The counterpart of a contact that does not touch the ground: a node, or a point on a segment.
//
//   u_b = sum_j w_j u_j,   segment B-C:  w = (1 - x, x),  x = (P - B).(C - B) / |C - B|^2,  0 <= x <= 1
//
// P: the undeformed position of the contact's own node. Displacements are small, so x is constant.

/// Nodes and weights from the key `against`. Errors: SceneError for unknown or equal nodes, a segment of length zero, a
/// point outside the segment.
[[nodiscard]] std::vector<std::pair<std::string, double>> read_counterpart(Table& contact, const Scene& scene,
                                                                           const NameScope& space,
                                                                           const std::string& node);

}  // namespace signorini::scene
