// contact_tables.hpp: readers shared by the tables that make contacts: [[contacts]], [[stops]], [[pendulums]].
//
//   contact.friction = read_friction(table);   read_elements(table, contact);   add_contact(table, contact, names, scene);
#pragma once

#include "scene/readers.hpp"

namespace signorini {

/// A number, { static, kinetic, stribeck_velocity } or { slow, fast, velocity }.
[[nodiscard]] Friction read_friction(Table& table);
/// Reads the spring and the dashpot along the tangent; to be called after the friction.
void read_elements(Table& table, ContactSpec& contact);
/// Refuses a normal force that would be tensile at any time of the run.
void check_pressing(const Table& table, const HistorySpec& spec, double t_end);
/// The tangent (ny, -nx) of a normal.
[[nodiscard]] Direction tangent_of(const Direction& normal);

/// Names of all contacts read so far.
[[nodiscard]] Names names_of(const Scene& scene);
/// The given name, or the default name by number; recorded.
[[nodiscard]] std::string read_contact_name(Table& table, const char* kind, std::size_t number);
/// Adds the contact; refuses a name that another contact has.
void add_contact(Table& table, ContactSpec contact, Names& names, Scene& scene);

}  // namespace signorini
