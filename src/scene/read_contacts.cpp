// [[contacts]]: what each law needs, and what has no meaning for it.
#include <fmt/core.h>

#include <cmath>

#include "base/history/history_internal.hpp"
#include "base/number.hpp"
#include "scene/history_from_spec.hpp"
#include "scene/readers.hpp"
#include "scene/touched_segment.hpp"

namespace signorini {

namespace {

Friction read_friction(Table& contact) {
  Friction friction;
  const toml::node* node = contact.raw("friction");
  if (node && node->is_table()) {
    Table table = contact.child("friction");
    friction.static_ = table.number("static");
    friction.kinetic = table.optional_number("kinetic").value_or(friction.static_);
    friction.stribeck_velocity = table.optional_number("stribeck_velocity");
    if (friction.kinetic > friction.static_) {
      table.fail("kinetic", fmt::format("found the number {}, expected at most the static coefficient {}",
                                        shortest(friction.kinetic), shortest(friction.static_)));
    }
    table.finish();
  } else {
    const std::string expected = describe_type(*find_key("contacts[]", "friction"));
    const double value = node ? finite_number(*node, contact.path("friction"), expected) : 0.0;
    if (value < 0.0) contact.wrong("friction", expected);
    friction = {value, value};
  }
  Record record;
  record.set("static", toml_number(friction.static_));
  record.set("kinetic", toml_number(friction.kinetic));
  if (friction.stribeck_velocity) record.set("stribeck_velocity", toml_number(*friction.stribeck_velocity));
  contact.record("friction", record.inline_table());
  return friction;
}

/// Refuses a compression that would pull at any time of the run.
void check_pressing(const Table& table, const HistorySpec& spec, double t_end) {
  const History history = make_history(spec, table.path("normal_force"));
  const double t = negative_at(history, t_end);
  if (t < 0.0) return;
  const std::string found = history.is_constant() ? shortest(history.value(t))
                                                  : fmt::format("{:.6g} at time {:.6g}", history.value(t), t);
  table.fail("normal_force", fmt::format("found {}, expected a compression >= 0", found));
}

Direction tangent_of(const Direction& normal) {
  Direction tangent = normal;
  tangent.vector = {normal.vector[1], -normal.vector[0]};
  return tangent;
}

/// Normal, tangent and gap of a contact that opens.
void read_gap(Table& table, ContactSpec& contact, const Space& space, const std::string& law) {
  table.require("normal", " (" + law + ")");
  contact.normal = read_direction(table, "normal", space);
  if (space.matrices) {
    const bool needed = contact.friction.any();
    if (needed) table.require("tangent", " (needed with friction)");
    if (table.has("tangent")) contact.tangent = read_direction(table, "tangent", space);
  } else {
    if (table.has("tangent")) {
      table.fail("tangent", "has no meaning beside normal; the tangent is (ny, -nx)");
    }
    contact.tangent = tangent_of(*contact.normal);
  }
  contact.gap = table.number("gap");
}

void read_rigid(Table& table, ContactSpec& contact, const Space& space) {
  read_gap(table, contact, space, "rigid");
  contact.restitution = table.number("restitution");
  contact.capture_velocity = table.optional_number("capture_velocity");
}

/// The frame-rod element of a seam: a bar of its area and thickness across, the same in shear along.
void read_seam(Table& table, ContactSpec& contact) {
  for (const char* key : {"normal_stiffness", "tangential_stiffness"})
    if (table.has(key)) table.fail(key, "stands beside seam, expected one of the two");
  Table seam = table.child("seam");
  const bool friction = contact.friction.any();
  if (friction) seam.require("G", " (with friction)");
  const double E = seam.number("E"), thickness = seam.number("thickness"), area = seam.number("area");
  const std::optional<double> G = seam.optional_number("G");
  seam.finish();
  contact.normal_stiffness = E * area / thickness;
  if (G) contact.tangential_stiffness = *G * area / thickness;
  for (const double k : {contact.normal_stiffness, contact.tangential_stiffness.value_or(1.0)})
    if (!std::isnormal(k))
      table.fail("seam", fmt::format("found a stiffness of {}, expected a number > 0", k));
  table.record("seam", seam.record().inline_table());
}

void read_compliant(Table& table, ContactSpec& contact, const Space& space) {
  read_gap(table, contact, space, "compliant");
  if (table.has("seam")) {
    read_seam(table, contact);
    contact.normal_damping = table.number("normal_damping");
    return;
  }
  table.require("normal_stiffness", " (compliant)");
  contact.normal_stiffness = table.number("normal_stiffness");
  contact.normal_damping = table.number("normal_damping");
  if (contact.friction.any()) table.require("tangential_stiffness", " (compliant with friction)");
}

/// What lies between the contact's node and the ground, or takes the ground's place.
void read_against(Table& table, ContactSpec& contact, const Scene& scene, const Space& space,
                  const std::string& node) {
  const auto touched = read_touched(table, scene, space, node);
  if (contact.normal) contact.normal->against = touched;
  if (contact.tangent) contact.tangent->against = touched;
}

void read_elements(Table& table, ContactSpec& contact) {
  if (!table.has("seam")) contact.tangential_stiffness = table.optional_number("tangential_stiffness");
  if (contact.tangential_stiffness) {
    contact.initial_shear = table.number("initial_shear");
    contact.tangential_damping = table.number("tangential_damping");
  } else {
    for (const char* key : {"initial_shear", "tangential_damping"})
      if (table.has(key)) table.fail(key, "has no meaning without tangential_stiffness");
  }
  // Friction that falls with the slip rate, at a sliding point without mass, lets that point jump.
  if (contact.tangential_stiffness && contact.friction.stribeck_velocity)
    table.fail("friction",
               "found a stribeck_velocity, expected none beside tangential_stiffness: the sliding "
               "point has no mass, so friction that falls with its rate leaves its motion undecided");
}

void read_slider(Table& table, ContactSpec& contact, const Space& space, const Scene& scene) {
  const bool from_normal = !space.matrices && table.has("normal");
  if (from_normal && table.has("tangent")) {
    table.fail("normal", "stands beside tangent, expected one of the two for a slider");
  }
  if (!from_normal) table.require("tangent", " (slider)");
  contact.tangent = from_normal ? tangent_of(read_direction(table, "normal", space))
                                : read_direction(table, "tangent", space);
  table.require("normal_force", " (slider)");
  contact.normal_force = read_standing_history(table, "normal_force", directory_of(scene));
  check_pressing(table, contact.normal_force, scene.run.t_end);
}

}  // namespace

void read_contacts(Table& top, Scene& scene, RecordedScene& record) {
  const Space space = space_of(scene);
  Names names;
  for (Table& table : tables_of(top, "contacts")) {
    ContactSpec contact;
    contact.place = table.place();
    const std::string fallback = fmt::format("contact{}", names.size() + 1);
    contact.name = table.optional_text("name").value_or(fallback);
    if (!table.has("name")) table.record("name", toml_string(fallback));
    if (!names.add(contact.name)) {
      table.fail("name",
                 fmt::format("found \"{}\" twice, expected each contact to have its own name", contact.name));
    }

    if (!space.matrices) table.require("node", "");
    const std::string node = space.matrices ? "" : read_node(table, "node", space);
    const std::string law = table.choice("law");
    contact.law = law == "slider" ? Law::slider : law == "rigid" ? Law::rigid : Law::compliant;
    contact.friction = read_friction(table);
    contact.normal_force = constant_history(0.0);
    switch (contact.law) {
      case Law::compliant:
        read_compliant(table, contact, space);
        break;
      case Law::rigid:
        read_rigid(table, contact, space);
        break;
      case Law::slider:
        read_slider(table, contact, space, scene);
        break;
    }
    if (!takes_impulses(contact.law)) read_elements(table, contact);
    contact.surface_velocity = read_standing_history(table, "surface_velocity", directory_of(scene));
    if (!space.matrices && table.has("against")) read_against(table, contact, scene, space, node);
    if (contact.normal) contact.normal->node = node;
    if (contact.tangent) contact.tangent->node = node;
    const bool stray_node = space.matrices && (table.has("node") || table.has("against"));
    table.finish(stray_node ? "has no meaning with [matrices]"
                            : fmt::format("has no meaning for a contact with law = \"{}\"", law));
    scene.contacts.push_back(std::move(contact));
    record.add("contacts", "[[contacts]]", table.record());
  }
}

}  // namespace signorini
