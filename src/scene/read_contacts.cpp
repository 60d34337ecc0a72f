// [[contacts]], [[stops]] and [[pendulums]]: required and refused keys of each law.

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/history/pieces.hpp"
#include "base/text.hpp"
#include "contact/law/data_laws.hpp"
#include "scene/components.hpp"
#include "scene/history_from_spec.hpp"
#include "scene/readers.hpp"

namespace signorini::scene {
namespace {

/// A law of friction that varies between two coefficients: its keys are required, keys of other laws are
/// refused.
struct VaryingFriction {
  std::array<const char*, 3> keys;  // keys of Friction::static_, Friction::kinetic and *constant
  std::optional<double> Friction::*constant;
  const char* required;
  std::span<const char* const> others;
  const char* apart;  // message that refuses `others`

  [[nodiscard]] bool has_key_in(const Table& table) const {
    return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return table.has(key); });
  }
  void read(Table& table, Friction& friction) const {
    for (const char* key : others)
      if (table.has(key)) table.fail(key, apart);
    for (const char* key : keys) table.require(key, required);
    friction.static_ = table.number(keys[0]);
    friction.kinetic = table.number(keys[1]);
    friction.*constant = table.number(keys[2]);
  }
};

constexpr std::array keys_refused_with_rising = {"static", "kinetic", "stribeck_velocity"};
constexpr std::array keys_refused_with_force = {"static", "kinetic", "stribeck_velocity",
                                                "slow",   "fast",    "velocity"};

constexpr VaryingFriction rising = {
    {"slow", "fast", "velocity"},
    &Friction::velocity,
    " (required for friction that rises with the slip rate)",
    keys_refused_with_rising,
    "cannot be combined with slow, fast or velocity: use static, kinetic and stribeck_velocity "
    "(friction falls with the slip rate), or slow, fast and velocity (friction rises)"};
constexpr VaryingFriction by_force = {
    {"light", "heavy", "force"},
    &Friction::force,
    " (required for friction that depends on the normal force)",
    keys_refused_with_force,
    "cannot be combined with light, heavy or force: friction depends on the slip rate or on the "
    "normal force, not on both"};

void read_rising_friction(Table& table, Friction& friction) {
  rising.read(table, friction);
  if (friction.kinetic < friction.static_)
    table.fail("fast",
               fmt::format("found the number {}, expected at least the slow coefficient {}",
                           base::format_number(friction.kinetic), base::format_number(friction.static_)));
}

void read_falling_friction(Table& table, Friction& friction) {
  table.require("static", "");
  friction.static_ = table.number("static");
  friction.kinetic = table.optional_number("kinetic").value_or(friction.static_);
  friction.stribeck_velocity = table.optional_number("stribeck_velocity");
  if (friction.kinetic > friction.static_) {
    table.fail("kinetic",
               fmt::format("found the number {}, expected at most the static coefficient {}",
                           base::format_number(friction.kinetic), base::format_number(friction.static_)));
  }
}

}  // namespace

Friction read_friction(Table& contact) {
  Friction friction;
  const toml::node* node = contact.raw("friction");
  if (node && node->is_table()) {
    Table table = contact.child("friction");
    by_force.has_key_in(table) ? by_force.read(table, friction)
    : rising.has_key_in(table) ? read_rising_friction(table, friction)
                               : read_falling_friction(table, friction);
    table.finish();
  } else {
    const std::string expected = describe_type(*find_key("contacts[]", "friction"));
    const double value = node ? finite_number(*node, contact.path("friction"), expected) : 0.0;
    if (value < 0.0) contact.wrong("friction", expected);
    friction = {value, value};
  }
  ResolvedTable record;
  const VaryingFriction* law = friction.is_load_dependent()       ? &by_force
                               : friction.is_rate_strengthening() ? &rising
                                                                  : nullptr;
  record.set(law ? law->keys[0] : "static", toml_number(friction.static_));
  record.set(law ? law->keys[1] : "kinetic", toml_number(friction.kinetic));
  for (const FrictionConstant& constant : friction_constants)
    if (const auto& value = friction.*constant.value)
      record.set(std::string(constant.key), toml_number(*value));
  contact.record("friction", record.inline_table());
  // With equal coefficients friction is constant: the exponential law is not needed.
  if (law && friction.kinetic == friction.static_) (friction.*law->constant).reset();
  return friction;
}

void check_applied_normal_force(const Table& table, const HistorySpec& spec, double t_end) {
  const History history = make_history(spec, table.path("normal_force"));
  const double t = history::find_negative_time(history, t_end);
  if (t < 0.0) return;
  const std::string found = history.is_constant() ? base::format_number(history.value(t))
                                                  : fmt::format("{:.6g} at time {:.6g}", history.value(t), t);
  table.fail("normal_force", fmt::format("found {}, expected a compression >= 0", found));
}

Direction tangent_of(const Direction& normal) {
  Direction tangent = normal;
  tangent.vector = {normal.vector[1], -normal.vector[0]};
  return tangent;
}

namespace {

/// Reads normal, tangent and gap of a contact that can open.
void read_gap(Table& table, ContactSpec& contact, const NameScope& space, const std::string& law) {
  const char* key = table.is("stops[]") ? "direction" : "normal";
  table.require(key, " (required for law = \"" + law + "\")");
  contact.normal = read_direction(table, key, space);
  if (space.matrices) {
    const bool needed = contact.friction.any() && !table.is("stops[]");
    if (needed) table.require("tangent", " (required with friction)");
    if (table.is("stops[]") && contact.friction.any())
      table.fail("friction",
                 "a stop cannot have friction with [matrices]; give two contacts instead of the stop");
    if (!table.is("stops[]") && table.has("tangent"))
      contact.tangent = read_direction(table, "tangent", space);
  } else {
    if (!table.is("stops[]") && table.has("tangent")) {
      table.fail("tangent", "has no meaning together with normal; the tangent is (ny, -nx)");
    }
    contact.tangent = tangent_of(*contact.normal);
  }
  if (!table.is("stops[]") || !table.has("gaps")) contact.gap = table.number("gap");
}

void read_rigid(Table& table, ContactSpec& contact, const NameScope& space) {
  read_gap(table, contact, space, "rigid");
  contact.restitution = table.number("restitution");
  contact.capture_velocity = table.optional_number("capture_velocity");
}

/// Stiffnesses of the material in a seam: normal E area / thickness, tangential G area / thickness.
void read_seam(Table& table, ContactSpec& contact) {
  for (const char* key : {"normal_stiffness", "tangential_stiffness"})
    if (table.has(key)) table.fail(key, "cannot be combined with seam; give only one of them");
  Table seam = table.child("seam");
  const bool friction = contact.friction.any();
  if (friction) seam.require("G", " (required with friction)");
  const double E = seam.number("E"), thickness = seam.number("thickness"), area = seam.number("area");
  const std::optional<double> G = seam.optional_number("G");
  seam.finish();
  contact.normal_stiffness = E * area / thickness;
  if (G) contact.tangential_stiffness = *G * area / thickness;
  for (const double k : {contact.normal_stiffness, contact.tangential_stiffness.value_or(1.0)})
    if (!std::isnormal(k))
      table.fail("seam", fmt::format("these values give a stiffness of {}, expected a finite number > 0", k));
  table.record("seam", seam.record().inline_table());
}

void read_compliant(Table& table, ContactSpec& contact, const NameScope& space) {
  read_gap(table, contact, space, "compliant");
  if (table.has("seam")) {
    read_seam(table, contact);
    contact.normal_damping = table.number("normal_damping");
    return;
  }
  table.require("normal_stiffness", " (required for law = \"compliant\")");
  contact.normal_stiffness = table.number("normal_stiffness");
  contact.normal_damping = table.number("normal_damping");
  if (contact.friction.any())
    table.require("tangential_stiffness", " (required for law = \"compliant\" with friction)");
}

/// Reads a law made of data. Its constants determine the law, so Table::finish() refuses all keys that are not read
/// here.
void read_data_law(Table& table, ContactSpec& contact, const NameScope& space, const DataLaw& law) {
  const std::string required = fmt::format(" (required for law = \"{}\")", law.name);
  read_gap(table, contact, space, std::string(law.name));
  table.require("normal_stiffness", required);
  for (const DataLawConstant& constant : law.constants) table.require(constant.key, required);
  contact.normal_stiffness = table.number("normal_stiffness");
  std::vector<double> constants;
  for (const DataLawConstant& constant : law.constants) constants.push_back(table.number(constant.key));
  if (const auto objection = law.validate(contact.normal_stiffness, constants))
    table.fail(objection->first, objection->second);
  contact.user_law = std::make_shared<const UserContactLaw>(law.make(contact.normal_stiffness, constants));
}

/// Reads the counterpart of the contact's node: another node, or a segment, instead of the ground.
void read_against(Table& table, ContactSpec& contact, const Scene& scene, const NameScope& space,
                  const std::string& node) {
  const auto touched = read_counterpart(table, scene, space, node);
  if (contact.normal) contact.normal->against = touched;
  if (contact.tangent) contact.tangent->against = touched;
}

}  // namespace

void read_elements(Table& table, ContactSpec& contact) {
  if (!table.has("seam")) contact.tangential_stiffness = table.optional_number("tangential_stiffness");
  if (contact.tangential_stiffness) {
    contact.initial_shear = table.number("initial_shear");
    contact.tangential_damping = table.number("tangential_damping");
  } else {
    for (const char* key : {"initial_shear", "tangential_damping"})
      if (table.has(key)) table.fail(key, "has no meaning without tangential_stiffness");
  }
  // Friction that decreases with the slip rate would let a massless sliding point jump.
  if (contact.tangential_stiffness && contact.friction.stribeck_velocity)
    table.fail(
        "friction",
        "stribeck_velocity cannot be combined with tangential_stiffness: the sliding point is massless, so "
        "its motion would not be unique. Remove one of the two keys");
}

namespace {

void read_slider(Table& table, ContactSpec& contact, const NameScope& space, const Scene& scene) {
  const bool from_normal = !space.matrices && table.has("normal");
  if (from_normal && table.has("tangent")) {
    table.fail("normal", "cannot be combined with tangent; give only one of them");
  }
  if (!from_normal) table.require("tangent", " (required for law = \"slider\")");
  contact.tangent = from_normal ? tangent_of(read_direction(table, "normal", space))
                                : read_direction(table, "tangent", space);
  table.require("normal_force", " (required for law = \"slider\")");
  contact.normal_force = read_number_or_history(table, "normal_force", scene);
  check_applied_normal_force(table, contact.normal_force, scene.run.t_end);
}

/// Reads a contact except its name and nodes; `table` is that of a contact or of a stop.
ContactSpec read_laws(Table& table, const NameScope& space, const Scene& scene, const std::string& law) {
  ContactSpec contact;
  contact.place = table.place();
  contact.table = table.path();
  contact.of_stop = table.is("stops[]");
  contact.law = law == "slider" ? Law::slider : law == "rigid" ? Law::rigid : Law::compliant;
  contact.normal_force = constant_history(0.0);
  if (const DataLaw* data = find_data_law(law)) {
    read_data_law(table, contact, space, *data);
    return contact;
  }
  contact.friction = read_friction(table);
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
  if (!contact.capabilities().takes_impulses) read_elements(table, contact);
  contact.surface_velocity =
      read_number_or_history(table, "surface_velocity", scene, RecordQuantity::velocity);
  return contact;
}

void set_node(ContactSpec& contact, const std::string& node) {
  if (contact.normal) contact.normal->node = node;
  if (contact.tangent) contact.tangent->node = node;
}

}  // namespace

Names contact_names(const Scene& scene) {
  Names names;
  for (const ContactSpec& contact : scene.contacts) names.add(contact.name);
  return names;
}

std::string read_contact_name(Table& table, const char* kind, std::size_t number) {
  const std::string fallback = fmt::format("{}{}", kind, number);
  if (!table.has("name")) table.record("name", toml_string(fallback));
  return table.optional_text("name").value_or(fallback);
}

void add_contact(Table& table, ContactSpec contact, Names& names, Scene& scene) {
  if (!names.add(contact.name)) {
    table.fail("name",
               fmt::format("found \"{}\" twice, expected each contact to have its own name", contact.name));
  }
  scene.contacts.push_back(std::move(contact));
}

namespace {

/// The contact on the opposite side of a stop.
ContactSpec mirrored(ContactSpec contact) {
  for (double& x : contact.normal->vector) x = -x;
  for (auto& [dof, factor] : contact.normal->dofs) factor = -factor;
  if (contact.tangent) {
    for (double& x : contact.tangent->vector) x = -x;
    for (auto& [dof, factor] : contact.tangent->dofs) factor = -factor;
  }
  contact.surface_velocity.offset = -contact.surface_velocity.offset;
  contact.surface_velocity.amplitude = -contact.surface_velocity.amplitude;
  return contact;
}

}  // namespace

void read_contacts(Table& top, Scene& scene, ResolvedScene& record) {
  const NameScope space = name_scope(scene);
  Names names;
  std::size_t number = 0;
  for (Table& table : tables_of(top, "contacts")) {
    const std::string name = read_contact_name(table, "contact", ++number);
    const bool one = !table.has("nodes");
    if (one && names.index(name))
      table.fail("name", fmt::format("found \"{}\" twice, expected each contact to have its own name", name));
    const std::vector<std::string> nodes =
        space.matrices ? std::vector<std::string>{""} : read_one_or_more_nodes(table, space);
    const std::string law = table.choice("law");
    ContactSpec contact = read_laws(table, space, scene, law);
    if (!space.matrices && table.has("against")) {
      if (!one) table.fail("against", "has no meaning together with nodes");
      read_against(table, contact, scene, space, nodes.front());
    }
    const bool stray_node =
        space.matrices && (table.has("node") || table.has("nodes") || table.has("against"));
    table.finish(stray_node ? "has no meaning with [matrices]"
                            : fmt::format("has no meaning for a contact with law = \"{}\"", law));
    for (const std::string& node : nodes) {
      set_node(contact, node);
      contact.name = one ? name : name + "-" + node;
      add_contact(table, contact, names, scene);
    }
    record.add("contacts", "[[contacts]]", table.record());
  }
}

void read_stops(Table& top, Scene& scene, ResolvedScene& record) {
  const NameScope space = name_scope(scene);
  Names names = contact_names(scene);
  std::size_t number = 0;
  for (Table& table : tables_of(top, "stops")) {
    const std::string name = read_contact_name(table, "stop", ++number);
    const bool one = !table.has("nodes");
    const std::vector<std::string> nodes =
        space.matrices ? std::vector<std::string>{""} : read_one_or_more_nodes(table, space);
    const std::string law = table.choice("law");
    if (law == "slider")
      table.fail("law",
                 "found \"slider\", expected another law, because a slider has no gap and a stop needs one");
    ContactSpec forth = read_laws(table, space, scene, law);
    if (!space.matrices && table.has("against")) {
      if (!one) table.fail("against", "has no meaning together with nodes");
      read_against(table, forth, scene, space, nodes.front());
    }
    // `direction` was read as the normal, along which contacts open. It is the normal of NAME-; NAME+ is its mirror image.
    ContactSpec back = forth;
    forth = mirrored(std::move(forth));
    if (const auto gaps = table.numbers("gaps")) {
      if (table.has("gap")) table.fail("gaps", "cannot be combined with gap; give only one of them");
      if (gaps->size() != 2) table.wrong("gaps", "two numbers");
      forth.gap = (*gaps)[0];
      back.gap = (*gaps)[1];
    }
    table.finish(fmt::format("has no meaning for a stop with law = \"{}\"", law));
    for (const std::string& node : nodes)
      for (ContactSpec* side : {&forth, &back}) {
        set_node(*side, node);
        side->name = (one ? name : name + "-" + node) + (side == &forth ? "+" : "-");
        add_contact(table, *side, names, scene);
      }
    record.add("stops", "[[stops]]", table.record());
  }
}

// [[pendulums]]: bearings that slide on a curved surface, made of a slider or contact, a spring and stops.
//
//   T = friction of N,   restoring force N u / R,   |u| <= stop
//
// If N is constant, the restoring force is a spring N / R. If N varies, by a history or as a reaction of the
// structure, the spring has the stiffness for the force at rest. The contact's curved surface (CurvedSurface)
// adds the difference.

namespace {

/// A contact of the pendulum with its name and source place; the caller sets directions, law and friction.
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

/// Reads the normal force: a number, a history, or the stiffness of a contact that carries it. Returns the force N
/// that defines the stiffness N / radius of the restoring spring.
double read_force(Table& table, ContactSpec& contact, double radius, const Scene& scene) {
  const bool bears = table.has("normal_stiffness");
  if (!bears) table.require("normal_force", " (required without normal_stiffness)");
  const bool given = table.has("normal_force");
  if (given) {
    contact.normal_force = read_number_or_history(table, "normal_force", scene);
    check_applied_normal_force(table, contact.normal_force, scene.run.t_end);
  }
  const History history = make_history(contact.normal_force, table.path("normal_force"));
  const double carried = history.value(0.0);
  if (!bears) {
    contact.law = Law::slider;
    contact.normal.reset();
    if (history.is_constant()) return carried;
    contact.pendulum_surface = CurvedSurface{radius, carried};
    return carried;
  }
  if (given && !history.is_constant())
    table.fail(
        "normal_force",
        "found a history together with normal_stiffness, expected the load at rest, which is a number");
  contact.law = Law::compliant;
  contact.normal_stiffness = table.number("normal_stiffness");
  contact.normal_damping = table.number("normal_damping");
  contact.normal_force = constant_history(0.0);
  if (contact.friction.any())
    table.require("tangential_stiffness", " (required for normal_stiffness with friction)");
  contact.pendulum_surface = CurvedSurface{radius, carried};
  return carried;
}

/// Reads the stops on both sides; the first one limits the motion along the tangent.
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

void read_pendulums(Table& top, Scene& scene, ResolvedScene& record) {
  const NameScope space = name_scope(scene);
  Names names = contact_names(scene);
  std::size_t number = 0;
  for (Table& table : tables_of(top, "pendulums")) {
    if (space.matrices)
      table.fail("",
                 "has no meaning with [matrices]; give a slider, and add N / radius to the stiffness matrix");
    ContactSpec contact = part_of(table, read_contact_name(table, "pendulum", ++number));
    const std::string node = read_node(table, "node", space);
    const std::string against = table.has("against") ? read_node(table, "against", space) : "";
    if (against == node) table.wrong("against", "a node other than the pendulum's own node");
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
    spring.restoring = true;
    if (spring.stiffness > 0.0) scene.springs.push_back(spring);
    add_contact(table, contact, names, scene);
    read_rim(table, contact, names, scene);
    table.finish("has no meaning without normal_stiffness");
    record.add("pendulums", "[[pendulums]]", table.record());
  }
}

}  // namespace signorini::scene
