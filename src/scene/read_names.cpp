// Reads names of nodes, and directions, for contacts, loads and springs.
#include <fmt/core.h>

#include <cmath>

#include "base/text.hpp"
#include "scene/data_file.hpp"
#include "scene/matrix_market.hpp"
#include "scene/readers.hpp"

namespace signorini::scene {

NameScope name_scope(const Scene& scene) {
  NameScope space;
  space.matrices = scene.matrices.has_value();
  space.directory = directory_of(scene);
  if (scene.matrices) {
    for (const std::string& name : scene.matrices->dofs) space.names.add(name);
  } else {
    for (const Node& node : scene.nodes) space.names.add(node.name);
    for (const BodySpec& body : scene.bodies) {
      NameScope::Body& known = space.bodies.emplace_back();
      known.name = body.name;
      const std::string& file = scene.nodes[body.first_node].place.file;  // of a mesh from a file: that file
      if (file != body.place.file) known.mesh = file;
      for (const PlaneMesh::Group& group : body.mesh.groups) known.groups.push_back(group.name);
      for (const PlaneMesh::Group& group : body.mesh.groups)
        for (const int n : group.nodes)
          space.groups[body.name + "." + group.name].push_back(scene.nodes[static_cast<std::size_t>(n)].name);
      std::vector<std::string>& all = space.groups[body.name];
      for (std::size_t i = 0; i < body.node_count; ++i) all.push_back(scene.nodes[body.first_node + i].name);
    }
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

std::string read_node(Table& table, std::string_view key, const NameScope& space) {
  const std::string name = table.text(key);
  check_node(name, space, table.place(key), table.path(key));
  return name;
}

namespace {

/// Letters and number of a name: ("P", 12) for "P12"; the number is -1 if the name does not end in a number.
std::pair<std::string, long long> numbered(const std::string& name) {
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  const auto number = base::parse_integer(name.substr(digits));
  return {name.substr(0, digits), number && name.size() - digits < 9 ? *number : -1};
}

/// Adds the node names that a range means: "P0", "P3", "P6", "P9" for "P0..P9:3".
void add_range(const std::string& text, const Table& table, std::string_view key, const NameScope& space,
               std::vector<std::string>& names) {
  const std::size_t dots = text.find(".."), colon = text.find(':', dots);
  const auto [first, from] = numbered(text.substr(0, dots));
  const auto [last, to] = numbered(text.substr(dots + 2, colon - dots - 2));
  const auto step =
      colon == std::string::npos ? std::optional<long long>(1) : base::parse_integer(text.substr(colon + 1));
  if (first != last || from < 0 || to < from || !step || *step < 1)
    table.fail(key, fmt::format("found \"{}\", expected a row of nodes with one name and ascending numbers, "
                                "such as \"P0..P9\" or \"P0..P9:3\"",
                                text));
  for (long long i = from; i <= to; i += *step) {
    names.push_back(fmt::format("{}{}", first, i));
    check_node(names.back(), space, table.place(key), table.path(key));
  }
}

}  // namespace

std::vector<std::string> read_node_names(Table& table, std::string_view key, const NameScope& space) {
  std::vector<std::string> names;
  constexpr std::size_t most = 1'000'000;
  for (const std::string& text : table.texts(key)) {
    if (names.size() > most) table.fail(key, fmt::format("found more than {} nodes", most));
    if (text.find("..") != std::string::npos) {
      add_range(text, table, key, space, names);
    } else if (const auto group = space.groups.find(text); group != space.groups.end()) {
      names.insert(names.end(), group->second.begin(), group->second.end());
    } else {
      check_node(text, space, table.place(key), table.path(key), true);
      names.push_back(text);
    }
  }
  return names;
}

std::vector<std::string> read_one_or_more_nodes(Table& table, const NameScope& space) {
  if (!table.has("nodes")) {
    table.require("node", "");
    return {read_node(table, "node", space)};
  }
  if (table.has("node")) table.fail("nodes", "cannot be combined with node; give only one of them");
  std::vector<std::string> names = read_node_names(table, "nodes", space);
  if (names.empty()) table.wrong("nodes", "the name of at least one node");
  return names;
}

std::vector<double> read_vector_file(Table& table, std::string_view key, const NameScope& space) {
  const std::size_t size = space.names.size();
  const std::filesystem::path path = space.directory / table.raw(key)->value_or(std::string());
  std::ifstream in = open_data_file(table, key, path);
  std::vector<double> values = read_market_vector(in, path.string(), table.path(key));
  if (values.size() != size)
    table.fail(key, fmt::format("found a file of {}, expected {}, one for each degree of freedom",
                                base::count_text(values.size(), "row"), size));
  return values;
}

Direction read_direction(Table& table, std::string_view key, const NameScope& space) {
  const toml::node* node = table.raw(key);
  if (!node) table.require(key, "");
  Direction direction;
  direction.place = table.place(key);
  if (!space.matrices) {
    if (!node->is_array()) table.wrong(key, "an array [x, y]");
    direction.vector = read_unit_vector(table, key);
    return direction;
  }
  ResolvedTable record;
  if (node->is_string()) {
    const std::vector<double> values = read_vector_file(table, key, space);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] == 0.0) continue;
      direction.dofs.emplace_back(space.names.list()[i], values[i]);
      record.set(space.names.list()[i], toml_number(values[i]));
    }
    if (direction.dofs.empty()) table.fail(key, "found a vector of length zero, expected a direction");
    table.record(key, record.inline_table());
    return direction;
  }
  if (!node->is_table()) table.wrong(key, "with [matrices] a table { degree of freedom = number }");
  bool zero = true;
  for (const Entry& entry : entries_of(*node->as_table())) {
    const std::string path = table.path(key) + "." + entry.name;
    check_known(entry.name, space.names, "degree of freedom", entry.place(), path);
    const double factor = finite_number(*entry.node, path, "a number");
    direction.dofs.emplace_back(entry.name, factor);
    record.set(entry.name, toml_number(factor));
    zero = zero && !std::isnormal(factor);
  }
  if (zero) table.fail(key, "found a vector of length zero, expected a direction");
  table.record(key, record.inline_table());
  return direction;
}

}  // namespace signorini::scene
