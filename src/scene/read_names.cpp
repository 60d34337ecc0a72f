// Nodes and directions, as contacts, loads and springs refer to them.
#include <cmath>

#include "scene/readers.hpp"

namespace signorini {

Space space_of(const Scene& scene) {
  Space space;
  space.matrices = scene.matrices.has_value();
  if (scene.matrices) {
    for (const std::string& name : scene.matrices->dofs) space.names.add(name);
  } else {
    for (const Node& node : scene.nodes) space.names.add(node.name);
  }
  return space;
}

std::filesystem::path directory_of(const Scene& scene) {
  return std::filesystem::path(scene.file).parent_path();
}

std::array<double, 2> read_unit_vector(Table& table, std::string_view key) {
  const auto [x, y] = table.vector(key);
  const double length = std::hypot(x, y);
  if (!std::isnormal(length)) table.fail(key, "found a vector of length zero, expected a direction");
  return {x / length, y / length};
}

std::string read_node(Table& table, std::string_view key, const Space& space) {
  const std::string name = table.text(key);
  check_known(name, space.names, "node", table.place(key), table.path(key));
  return name;
}

Direction read_direction(Table& table, std::string_view key, const Space& space) {
  const toml::node* node = table.raw(key);
  if (!node) table.require(key, "");
  Direction direction;
  direction.place = table.place(key);
  if (!space.matrices) {
    if (!node->is_array()) table.wrong(key, "an array [x, y]");
    direction.vector = read_unit_vector(table, key);
    return direction;
  }
  if (!node->is_table()) table.wrong(key, "with [matrices] a table { degree of freedom = number }");
  Record record;
  bool zero = true;
  for (const Entry& entry : entries_of(*node->as_table())) {
    const std::string path = table.path(key) + "." + entry.name;
    check_known(entry.name, space.names, "degree of freedom", entry.place, path);
    const double factor = finite_number(*entry.node, path, "a number");
    direction.dofs.emplace_back(entry.name, factor);
    record.set(entry.name, toml_number(factor));
    zero = zero && !std::isnormal(factor);
  }
  if (zero) table.fail(key, "found a vector of length zero, expected a direction");
  table.record(key, record.inline_table());
  return direction;
}

}  // namespace signorini
