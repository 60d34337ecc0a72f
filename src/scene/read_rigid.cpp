// Rigid bodies: nodes that move rigidly with a centre.
#include <fmt/core.h>

#include <algorithm>

#include "scene/readers.hpp"

namespace signorini {
namespace {

/// m = density width height thickness,  J = m (width^2 + height^2)/12
void read_box(Table& table, PointMass& mass) {
  for (const char* key : {"mass", "inertia"})
    if (table.has(key))
      table.fail(
          key,
          fmt::format("cannot be combined with box, which defines mass and inertia; remove {} or box", key));
  Table box = table.child("box");
  const double width = box.number("width"), height = box.number("height");
  mass.mass = box.number("density") * width * height * box.number("thickness");
  mass.inertia = mass.mass * (width * width + height * height) / 12.0;
  box.finish();
  table.record("box", box.record().inline_table());
}

/// The centre is a node, or a place: then it is a new node, named after the body.
std::string read_centre(Table& table, const std::string& name, Scene& scene, Names& nodes) {
  table.require("centre", "");
  if (!table.raw("centre")->is_array()) {
    const std::string centre = table.text("centre");
    check_known(centre, nodes, "node", table.place("centre"), table.path("centre"));
    return centre;
  }
  const auto [x, y] = table.vector("centre");
  if (!nodes.add(name))
    table.fail("name", fmt::format("found \"{}\", which is the name of a node; expected another name, "
                                   "because the centre becomes a node with the name of the body",
                                   name));
  scene.nodes.push_back({name, x, y, table.place("centre")});
  return name;
}

}  // namespace

void read_rigid(Table& top, Scene& scene, RecordedScene& record) {
  Names bodies;
  for (Table& table : tables_of(top, "rigid")) {
    const Space space = space_of(scene);
    Names nodes = space.names;
    RigidBody body;
    body.name = table.text("name");
    if (!bodies.add(body.name)) table.fail("name", fmt::format("found \"{}\" twice", body.name));
    for (const BodySpec& other : scene.bodies)
      if (other.name == body.name)
        table.fail("name", fmt::format("found \"{}\", which one of [[bodies]] is called", body.name));
    table.require("nodes", "");
    body.place = table.place("nodes");
    body.nodes = read_node_names(table, "nodes", space);
    if (body.nodes.empty()) table.wrong("nodes", "names of nodes");
    body.centre = read_centre(table, body.name, scene, nodes);
    std::erase(body.nodes, body.centre);
    if (body.nodes.empty())
      table.fail("nodes",
                 "found the centre alone, expected other nodes; a point with inertia stands in [[masses]]");
    PointMass mass;
    mass.place = table.place();
    mass.key = table.path();
    mass.node = body.centre;
    if (table.has("box")) {
      read_box(table, mass);
    } else {
      for (const char* key : {"mass", "inertia"}) table.require(key, " (required without box)");
      mass.mass = table.number("mass");
      mass.inertia = table.number("inertia");
    }
    table.finish();
    scene.masses.push_back(std::move(mass));
    scene.rigid.push_back(std::move(body));
    record.add("rigid", "[[rigid]]", table.record());
  }
}

}  // namespace signorini
