// contact_tables.hpp: what tables that make contacts have in common: [[contacts]], [[stops]], [[pendulums]].
//
//   contact.friction = read_friction(table);   read_elements(table, contact);   add_contact(table, contact, names, scene);
#pragma once

#include "scene/readers.hpp"

namespace signorini {

/// A number, { static, kinetic, stribeck_velocity } or { slow, fast, velocity }.
[[nodiscard]] Friction read_friction(Table& table);
/// Spring and dashpot along the tangent; after the friction.
void read_elements(Table& table, ContactSpec& contact);
/// Refuses a compression that would pull at any time of the run.
void check_pressing(const Table& table, const HistorySpec& spec, double t_end);
/// (ny, -nx)
[[nodiscard]] Direction tangent_of(const Direction& normal);

/// Of all contacts so far.
[[nodiscard]] Names names_of(const Scene& scene);
/// The name that is given or that of its number, recorded.
[[nodiscard]] std::string read_contact_name(Table& table, const char* kind, std::size_t number);
/// Refuses a name that another contact has.
void add_contact(Table& table, ContactSpec contact, Names& names, Scene& scene);

}  // namespace signorini
