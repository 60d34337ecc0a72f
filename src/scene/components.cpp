#include "scene/components.hpp"

#include <fmt/core.h>

namespace signorini {
namespace {

constexpr std::string_view against = "against";
constexpr double beside = 1e-9;  // relative to the segment's length: rounding of coordinates in a file

std::string node_name(Table& contact, const toml::node& item, const Space& space, const std::string& node) {
  if (!item.is_string()) contact.wrong(against, describe_type(*find_key("contacts[]", against)));
  const std::string name = item.as_string()->get();
  check_known(name, space.names, "node", place_of(item), contact.path(against));
  if (name == node) contact.wrong(against, "another node than the contact's own");
  return name;
}

const Node& find(const Scene& scene, const Space& space, const std::string& name) {
  return scene.nodes[*space.names.index(name)];
}

}  // namespace

std::vector<std::pair<std::string, double>> read_touched(Table& contact, const Scene& scene,
                                                         const Space& space, const std::string& node) {
  const toml::node* found = contact.raw(against);
  if (const toml::array* array = found->as_array(); array != nullptr && array->size() == 2) {
    const std::string b = node_name(contact, (*array)[0], space, node);
    const std::string c = node_name(contact, (*array)[1], space, node);
    if (b == c) contact.wrong(against, "two different nodes");
    contact.record(against, toml_strings({b, c}));
    const Node &from = find(scene, space, b), &to = find(scene, space, c), &at = find(scene, space, node);
    const double dx = to.x - from.x, dy = to.y - from.y, square = dx * dx + dy * dy;
    if (!(square > 0.0)) contact.wrong(against, "two nodes at different places");
    const double x = ((at.x - from.x) * dx + (at.y - from.y) * dy) / square;
    if (x < -beside || x > 1.0 + beside)
      contact.fail(against,
                   fmt::format("node '{}' projects beside the segment from '{}' to '{}', at {:.4g} of "
                               "its length, expected 0 to 1",
                               node, b, c, x));
    return {{b, 1.0 - x}, {c, x}};
  }
  const std::string name = node_name(contact, *found, space, node);
  contact.record(against, toml_string(name));
  return {{name, 1.0}};
}

}  // namespace signorini
