// [[loads]]: forces, moments, forces per length; [base_motion].

#include <fmt/core.h>

#include "base/text.hpp"
#include "scene/readers.hpp"

namespace signorini::scene {
namespace {

void read_force(Table& table, LoadSpec& load, const NameScope& space) {
  if (!space.matrices) table.require("node", "");
  const std::string node = space.matrices ? "" : read_node(table, "node", space);
  table.require("direction", "");
  load.direction = read_direction(table, "direction", space);
  load.direction.node = node;
  table.require("amplitude", "");
  load.amplitude = table.number("amplitude");
}

void read_moment(Table& table, LoadSpec& load, const NameScope& space) {
  load.type = LoadType::moment;
  table.require("node", " (required for a moment)");
  load.direction.node = read_node(table, "node", space);
  load.direction.place = table.place("node");
  load.amplitude = table.number("moment");
}

void read_distributed(Table& table, LoadSpec& load, const NameScope& space) {
  load.type = LoadType::distributed;
  table.require("nodes", " (required for a distributed load)");
  load.pieces = read_node_names(table, "nodes", space);
  if (load.pieces.size() < 2) table.wrong("nodes", "the names of two or more nodes");
  table.require("direction", "");
  load.direction = read_direction(table, "direction", space);
  load.member_axes = table.choice("axes") == "member";
  load.amplitude = table.number("distributed");
}

/// Reads a traction or a pressure on a boundary of a body.
void read_traction(Table& table, LoadSpec& load, const NameScope& space, const Scene& scene) {
  load.type = LoadType::traction;
  load.pressure = table.has("pressure");
  table.require("group", load.pressure ? " (required for a pressure)" : " (required for a traction)");
  load.group = table.text("group");
  static_cast<void>(find_boundary(table, "group", load.group, scene));
  if (!load.pressure) {
    table.require("direction", " (required for a traction)");
    load.direction = read_direction(table, "direction", space);
  }
  load.amplitude = table.number(load.pressure ? "pressure" : "traction");
}

BaseMotionSpec read_one_motion(Table& table, const Scene& scene) {
  BaseMotionSpec motion;
  motion.place = table.place();
  motion.direction = read_direction(table, "direction", name_scope(scene));
  table.require("acceleration", "");
  motion.acceleration = read_number_or_history(table, "acceleration", scene, RecordQuantity::acceleration);
  table.finish();
  return motion;
}

/// Adds the name that the user gave to a load; refuses names that stages use for all loads of a kind.
void take_name(const Table& table, const std::string& name, Names& names) {
  if (name.empty()) return;
  for (const char* kind : {"gravity", "temperature", "supports"})
    if (name == kind)
      table.fail(
          "name",
          fmt::format("found \"{}\", which in run.stages means all loads of this kind; expected another name",
                      name));
  if (!names.add(name))
    table.fail("name", fmt::format("found \"{}\" twice, expected each load to have its own name", name));
}

/// Refuses names that collide with generated ones: numbers of unnamed loads, and names of loads from other tables.
void refuse_given_names(const std::vector<Table>& tables, const std::vector<LoadSpec>& loads) {
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const std::string& name = loads[i].name;
    for (std::size_t k = 0; k < loads.size(); ++k)
      if (loads[k].name.empty() && name == fmt::format("load {}", k + 1))
        tables[i].fail("name", fmt::format("found \"{}\", which is generated as the name of load {} because "
                                           "that load has no `name`; expected "
                                           "another name",
                                           name, k + 1));
    for (const char* kind : {"base motion", "preload of spring ", "initial strain of member ",
                             "temperature of member ", "temperature of body "})
      if (name.starts_with(kind))
        tables[i].fail(
            "name",
            fmt::format(
                "found \"{}\", expected a name that does not begin with \"{}\", because generated names "
                "of loads begin so",
                name, kind));
  }
}

}  // namespace

void read_loads(Table& top, Scene& scene, ResolvedScene& record) {
  const NameScope space = name_scope(scene);
  Names names;
  std::vector<Table> tables = tables_of(top, "loads");
  for (Table& table : tables) {
    LoadSpec load;
    load.place = table.place();
    load.name = table.optional_text("name").value_or("");
    take_name(table, load.name, names);
    const bool moment = table.has("moment"), distributed = table.has("distributed");
    for (const char* other : {"amplitude", "distributed"})
      if (table.has(other) && (moment || (distributed && table.has("amplitude"))))
        table.fail(other, fmt::format("cannot be combined with {}; give only one of them",
                                      moment ? "moment" : "distributed"));
    const bool traction = table.has("traction") || table.has("pressure");
    for (const char* other : {"amplitude", "moment", "distributed", "traction"})
      if (traction && table.has(other) && (table.has("pressure") || std::string_view(other) != "traction"))
        table.fail(other, fmt::format("cannot be combined with {}; give only one of them",
                                      table.has("pressure") ? "pressure" : "traction"));
    if (!space.matrices && traction)
      read_traction(table, load, space, scene);
    else if (space.matrices || !(moment || distributed))
      read_force(table, load, space);
    else if (moment)
      read_moment(table, load, space);
    else
      read_distributed(table, load, space);
    load.history = read_load_history(table, "history", scene);
    table.finish(space.matrices ? "has no meaning with [matrices]"
                 : traction     ? "has no meaning for a load on a boundary"
                 : moment       ? "has no meaning for a moment"
                 : distributed  ? "has no meaning for a distributed load"
                                : "has no meaning for a force at a node");
    scene.loads.push_back(std::move(load));
    record.add("loads", "[[loads]]", table.record());
  }
  refuse_given_names(tables, scene.loads);
}

void read_base_motion(Table& top, Scene& scene, ResolvedScene& record) {
  const toml::node* node = top.raw("base_motion");
  if (!node) return;
  if (node->is_table()) {
    Table table = top.child("base_motion");
    scene.base_motion.push_back(read_one_motion(table, scene));
    record.add("base_motion", "[base_motion]", table.record());
    return;
  }
  const toml::array* array = node->as_array();
  if (!array) top.wrong("base_motion", describe_type(*find_key("", "base_motion")));
  for (const toml::node& item : *array) {
    const std::string path = fmt::format("base_motion.{}", scene.base_motion.size() + 1);
    if (!item.is_table()) refuse(place_of(item), path, "found " + describe(item) + ", expected a table");
    Table table(item.as_table(), "base_motion", path, place_of(item));
    scene.base_motion.push_back(read_one_motion(table, scene));
    record.add("base_motion", "[[base_motion]]", table.record());
  }
}

}  // namespace signorini::scene
