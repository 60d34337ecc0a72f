#include "scene/components.hpp"

#include <fmt/core.h>

namespace signorini::scene {
namespace {

constexpr std::string_view against_key = "against";
// Tolerance relative to the segment's length, for coordinates rounded in a file.
constexpr double beside = 1e-9;

std::string node_name(Table& contact, const toml::node& item, const NameScope& space,
                      const std::string& node) {
  if (!item.is_string()) contact.wrong(against_key, describe_type(*find_key("contacts[]", against_key)));
  const std::string name = item.as_string()->get();
  check_node(name, space, place_of(item), contact.path(against_key));
  if (name == node) contact.wrong(against_key, "a node other than the contact's own node");
  return name;
}

const Node& find(const Scene& scene, const NameScope& space, const std::string& name) {
  return scene.nodes[*space.names.index(name)];
}

}  // namespace

std::vector<std::pair<std::string, double>> read_counterpart(Table& contact, const Scene& scene,
                                                             const NameScope& space,
                                                             const std::string& node) {
  const toml::node* found = contact.raw(against_key);
  if (const toml::array* array = found->as_array(); array != nullptr && array->size() == 2) {
    const std::string b = node_name(contact, (*array)[0], space, node);
    const std::string c = node_name(contact, (*array)[1], space, node);
    if (b == c) contact.wrong(against_key, "two different nodes");
    contact.record(against_key, toml_strings({b, c}));
    const Node &from = find(scene, space, b), &to = find(scene, space, c), &at = find(scene, space, node);
    const double dx = to.x - from.x, dy = to.y - from.y, square = dx * dx + dy * dy;
    if (!(square > 0.0)) contact.wrong(against_key, "two nodes at different places");
    const double x = ((at.x - from.x) * dx + (at.y - from.y) * dy) / square;
    if (x < -beside || x > 1.0 + beside)
      contact.fail(against_key,
                   fmt::format("node '{}' projects outside the segment from '{}' to '{}', at {:.4g} of "
                               "its length, expected 0 to 1",
                               node, b, c, x));
    return {{b, 1.0 - x}, {c, x}};
  }
  const std::string name = node_name(contact, *found, space, node);
  contact.record(against_key, toml_string(name));
  return {{name, 1.0}};
}

}  // namespace signorini::scene
