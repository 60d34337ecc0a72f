// readers.hpp: one reader per concept; each fills its part of the scene and records the values it read.
//
//   read_units(top, scene, record);   read_run(top, scene, record);   ...
//
// Order matters: nodes, sections and matrices are read before tables that refer to them.
#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/record_header.hpp"
#include "scene/resolved_scene.hpp"
#include "scene/table.hpp"
#include "signorini/scene.hpp"

namespace signorini::scene {

/// Names that can be referred to: nodes, or degrees of freedom of [matrices].
struct NameScope {
  bool matrices = false;
  Names names;
  std::unordered_map<std::string, std::vector<std::string>> groups;  ///< nodes of "BODY.GROUP" and of "BODY"
  std::filesystem::path directory;                                   ///< directory of relative file names
  /// A body, for messages about names that are not known.
  struct Body {
    std::string name, mesh;           ///< mesh: the file; empty for a rectangle or a ring
    std::vector<std::string> groups;  ///< without the name of the body
  };
  std::vector<Body> bodies;
};
/// Names in the part of the scene that has been read so far.
[[nodiscard]] NameScope name_scope(const Scene& scene);

/// Directory of the scene's own file, in which relative file names are looked up.
[[nodiscard]] std::filesystem::path directory_of(const Scene& scene);

void read_units(Table& top, Scene& scene, ResolvedScene& record);
void read_run(Table& top, Scene& scene, ResolvedScene& record);
/// Reads the initial state, which is a part of the table [run].
void read_initial(Table& run, Scene& scene);
void read_damping(Table& top, Scene& scene, ResolvedScene& record);
void read_reduction(Table& top, Scene& scene, ResolvedScene& record);
void read_sections(Table& top, Scene& scene, ResolvedScene& record);
void read_nodes(Table& top, Scene& scene, ResolvedScene& record);
void read_lines(Table& top, Scene& scene, ResolvedScene& record);
/// Must be called after all named nodes are read, because meshes add nodes.
void read_bodies(Table& top, Scene& scene, ResolvedScene& record);
/// Must be called after read_matrices().
void read_surfaces(Table& top, Scene& scene, ResolvedScene& record);
/// Must be called after contacts, stops and pendulums are read, because seams add contacts.
void read_seams(Table& top, Scene& scene, ResolvedScene& record);
/// Must be called before tables that refer to centres are read, because centres may be new nodes.
void read_rigid(Table& top, Scene& scene, ResolvedScene& record);
void read_members(Table& top, Scene& scene, ResolvedScene& record);
void read_masses(Table& top, Scene& scene, ResolvedScene& record);
void read_springs(Table& top, Scene& scene, ResolvedScene& record);
void read_supports(Table& top, Scene& scene, ResolvedScene& record);
void read_matrices(Table& top, Scene& scene, ResolvedScene& record);
void read_contacts(Table& top, Scene& scene, ResolvedScene& record);
/// Must be called after the contacts are read, because each stop adds two contacts.
void read_stops(Table& top, Scene& scene, ResolvedScene& record);
/// Must be called after the stops are read, because each pendulum adds a contact, a spring and two stops.
void read_pendulums(Table& top, Scene& scene, ResolvedScene& record);
void read_loads(Table& top, Scene& scene, ResolvedScene& record);
/// Must be called after all tables that outputs refer to are read.
void read_outputs(Table& top, Scene& scene, ResolvedScene& record);
void read_base_motion(Table& top, Scene& scene, ResolvedScene& record);

/// Index of the node with this name. Errors: SceneError that suggests a node, or a group if `groups` says that the key
/// takes groups, too.
std::size_t check_node(const std::string& name, const NameScope& space, const SourcePlace& place,
                       const std::string& path, bool groups = false);
/// Text for the end of a message about an unknown group "BODY.GROUP": "; did you mean ...?", or the groups there are, or how
/// groups arise. `edges`: only groups with edges.
[[nodiscard]] std::string groups_of_bodies_text(const std::string& name, const Scene& scene, bool edges);

/// Reads a vector [x, y] and normalises it.
[[nodiscard]] std::array<double, 2> read_unit_vector(Table& table, std::string_view key);
/// Reads the name of an existing node; the key is required.
[[nodiscard]] std::string read_node(Table& table, std::string_view key, const NameScope& space);
/// Reads node names and expands "P0..P9", "P0..P9:3" and groups "BODY.GROUP"; records the key as given.
[[nodiscard]] std::vector<std::string> read_node_names(Table& table, std::string_view key,
                                                       const NameScope& space);
/// Reads `node` or `nodes`; one of the two is required.
[[nodiscard]] std::vector<std::string> read_one_or_more_nodes(Table& table, const NameScope& space);
/// Reads a direction: with [nodes] a unit vector (Direction::node stays empty); with [matrices] degrees of
/// freedom by name, or the name of a file with one column.
[[nodiscard]] Direction read_direction(Table& table, std::string_view key, const NameScope& space);
/// Reads the Matrix Market file that the key names: one number for each degree of freedom of [matrices].
[[nodiscard]] std::vector<double> read_vector_file(Table& table, std::string_view key,
                                                   const NameScope& space);

/// A boundary "BODY.GROUP": index of the body in Scene::bodies, and the group of its mesh.
struct BoundaryRef {
  std::size_t body = 0;
  const PlaneMesh::Group* group = nullptr;
};
/// Finds the boundary with this name, a group that has edges. Errors: SceneError that lists the existing boundaries.
[[nodiscard]] BoundaryRef find_boundary(const Table& table, std::string_view key, const std::string& name,
                                        const Scene& scene);

/// Reads the history of a load, with offset 0 and amplitude 1. The scene provides the directory of files, t_end and
/// the units.
[[nodiscard]] HistorySpec read_load_history(Table& table, std::string_view key, const Scene& scene);
/// Reads a history that has its own offset and amplitude, or a number. An absent key gives its default, or zero. With a
/// quantity the values may come from a record of this quantity, or have a `unit`.
[[nodiscard]] HistorySpec read_number_or_history(Table& table, std::string_view key, const Scene& scene,
                                                 RecordQuantity quantity = RecordQuantity::none);
[[nodiscard]] HistorySpec constant_history(double value);

// Readers shared by the tables that make contacts: [[contacts]], [[stops]], [[pendulums]].
//
//   contact.friction = read_friction(table);
//   read_elements(table, contact);
//   add_contact(table, contact, names, scene);

/// Reads a number, { static, kinetic, stribeck_velocity }, { slow, fast, velocity } or { light, heavy, force }.
[[nodiscard]] Friction read_friction(Table& table);
/// Reads the spring and the dashpot along the tangent; must be called after read_friction().
void read_elements(Table& table, ContactSpec& contact);
/// Refuses a normal force that would be tensile at any time of the run.
void check_applied_normal_force(const Table& table, const HistorySpec& spec, double t_end);
/// The tangent (ny, -nx) for the normal (nx, ny).
[[nodiscard]] Direction tangent_of(const Direction& normal);

/// Names of all contacts read so far.
[[nodiscard]] Names contact_names(const Scene& scene);
/// The given name, or the default name, kind and number ("contact3"). Records the name.
[[nodiscard]] std::string read_contact_name(Table& table, const char* kind, std::size_t number);
/// Adds the contact; refuses a name that another contact has.
void add_contact(Table& table, ContactSpec contact, Names& names, Scene& scene);

}  // namespace signorini::scene
