// [[pendulums]]: bearings that slide on a curved surface, made of a slider or contact, a spring and stops.
//
//   T = friction of N,   restoring force N u / R,   |u| <= stop
//
// If N is constant, the restoring force is a spring N / R. If N varies, by a history or as the reaction of the
// structure, the spring has the stiffness for the force at rest, and the contact's bowl adds the rest.
#include <fmt/core.h>

#include "scene/contact_tables.hpp"
#include "scene/history_from_spec.hpp"

namespace signorini {

namespace {

/// A contact of the pendulum without its friction; node, against and name are set.
ContactSpec part_of(const Table& table, const std::string& name) {
  ContactSpec part;
  part.name = name;
  part.place = table.place();
  part.table = table.path();
  return part;
}

Direction along(const Table& table, const std::string& node, const std::string& against,
                std::array<double, 2> vector) {
  Direction direction;
  direction.node = node;
  direction.vector = vector;
  direction.place = table.place();
  if (!against.empty()) direction.against = {{against, 1.0}};
  return direction;
}

/// Reads the source of a varying N. Returns the force that the spring is for.
double read_force(Table& table, ContactSpec& contact, double radius, const Scene& scene) {
  const bool bears = table.has("normal_stiffness");
  if (!bears) table.require("normal_force", " (required without normal_stiffness)");
  const bool given = table.has("normal_force");
  if (given) {
    contact.normal_force = read_standing_history(table, "normal_force", scene);
    check_pressing(table, contact.normal_force, scene.run.t_end);
  }
  const History history = make_history(contact.normal_force, table.path("normal_force"));
  const double carried = history.value(0.0);
  if (!bears) {
    contact.law = Law::slider;
    contact.normal.reset();
    if (history.is_constant()) return carried;
    contact.bowl = Bowl{radius, carried};
    return carried;
  }
  if (given && !history.is_constant())
    table.fail("normal_force",
               "found a history beside normal_stiffness, expected the number that is carried at rest");
  contact.law = Law::compliant;
  contact.normal_stiffness = table.number("normal_stiffness");
  contact.normal_damping = table.number("normal_damping");
  contact.normal_force = constant_history(0.0);
  if (contact.friction.any())
    table.require("tangential_stiffness", " (required for normal_stiffness with friction)");
  contact.bowl = Bowl{radius, carried};
  return carried;
}

/// Reads the rim on both sides; the first contact is met along the tangent.
void read_rim(Table& table, const ContactSpec& contact, Names& names, Scene& scene) {
  const auto stop = table.optional_number("stop"), stiffness = table.optional_number("stop_stiffness");
  if (!stop) {
    if (stiffness) table.fail("stop_stiffness", "has no meaning without stop");
    return;
  }
  for (const double side : {1.0, -1.0}) {
    ContactSpec rim = part_of(table, contact.name + (side > 0.0 ? "+" : "-"));
    rim.law = stiffness ? Law::compliant : Law::rigid;
    rim.normal = contact.tangent;
    for (double& x : rim.normal->vector) x *= -side;
    rim.tangent = tangent_of(*rim.normal);
    rim.gap = *stop;
    rim.normal_stiffness = stiffness.value_or(0.0);
    add_contact(table, rim, names, scene);
  }
}

}  // namespace

void read_pendulums(Table& top, Scene& scene, RecordedScene& record) {
  const Space space = space_of(scene);
  Names names = names_of(scene);
  std::size_t number = 0;
  for (Table& table : tables_of(top, "pendulums")) {
    if (space.matrices)
      table.fail("", "has no meaning with [matrices]: give a slider and N / R in the stiffness");
    ContactSpec contact = part_of(table, read_contact_name(table, "pendulum", ++number));
    const std::string node = read_node(table, "node", space);
    const std::string against = table.has("against") ? read_node(table, "against", space) : "";
    if (against == node) table.wrong("against", "another node than the pendulum's own");
    contact.normal = along(table, node, against, read_unit_vector(table, "normal"));
    contact.tangent = tangent_of(*contact.normal);
    const double radius = table.number("radius");
    contact.friction = read_friction(table);
    const double carried = read_force(table, contact, radius, scene);
    read_elements(table, contact);
    Spring spring;
    spring.place = table.place();
    spring.node = node;
    spring.against = against;
    spring.direction = contact.tangent->vector;
    spring.stiffness = carried / radius;
    if (spring.stiffness > 0.0) scene.springs.push_back(spring);
    add_contact(table, contact, names, scene);
    read_rim(table, contact, names, scene);
    table.finish("has no meaning without normal_stiffness");
    record.add("pendulums", "[[pendulums]]", table.record());
  }
}

}  // namespace signorini
