// readers.hpp: one reader a concept; each fills its part of the scene and records what it understood.
//
//   read_units(top, scene.units, record);   read_run(top, scene, record);   ...
//
// Order matters: nodes, sections and matrices come before what refers to them.
#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/record.hpp"
#include "scene/table.hpp"
#include "signorini/scene.hpp"

namespace signorini {

/// What may be referred to by name: nodes, or degrees of freedom of [matrices].
struct Space {
  bool matrices = false;
  Names names;
  std::unordered_map<std::string, std::vector<std::string>> groups;  ///< "BODY.GROUP": its nodes
  std::filesystem::path directory;                                   ///< where files are looked for
};
[[nodiscard]] Space space_of(const Scene& scene);

/// Where the scene's own files are looked for.
[[nodiscard]] std::filesystem::path directory_of(const Scene& scene);

void read_units(Table& top, Scene& scene, RecordedScene& record);
void read_run(Table& top, Scene& scene, RecordedScene& record);
/// Part of [run]; `run` is that table.
void read_initial(Table& run, Scene& scene);
void read_damping(Table& top, Scene& scene, RecordedScene& record);
void read_reduction(Table& top, Scene& scene, RecordedScene& record);
void read_sections(Table& top, Scene& scene, RecordedScene& record);
void read_nodes(Table& top, Scene& scene, RecordedScene& record);
void read_lines(Table& top, Scene& scene, RecordedScene& record);
/// After all named nodes: their meshes add more.
void read_bodies(Table& top, Scene& scene, RecordedScene& record);
/// After the matrices.
void read_surfaces(Table& top, Scene& scene, RecordedScene& record);
/// After contacts, stops and pendulums: each makes contacts.
void read_seams(Table& top, Scene& scene, RecordedScene& record);
/// Before what refers to centres, which may be new nodes.
void read_rigid(Table& top, Scene& scene, RecordedScene& record);
void read_members(Table& top, Scene& scene, RecordedScene& record);
void read_masses(Table& top, Scene& scene, RecordedScene& record);
void read_springs(Table& top, Scene& scene, RecordedScene& record);
void read_supports(Table& top, Scene& scene, RecordedScene& record);
void read_matrices(Table& top, Scene& scene, RecordedScene& record);
void read_contacts(Table& top, Scene& scene, RecordedScene& record);
/// After the contacts: each makes two of them.
void read_stops(Table& top, Scene& scene, RecordedScene& record);
/// After the stops: each makes a contact, a spring and two stops.
void read_pendulums(Table& top, Scene& scene, RecordedScene& record);
void read_loads(Table& top, Scene& scene, RecordedScene& record);
/// After all that outputs refer to.
void read_outputs(Table& top, Scene& scene, RecordedScene& record);
void read_base_motion(Table& top, Scene& scene, RecordedScene& record);

/// A vector [x, y] made a unit vector.
[[nodiscard]] std::array<double, 2> read_unit_vector(Table& table, std::string_view key);
/// The name of a node, required.
[[nodiscard]] std::string read_node(Table& table, std::string_view key, const Space& space);
/// Names of nodes, "P0..P9" and "P0..P9:3" and groups "BODY.GROUP" written out; recorded as given.
[[nodiscard]] std::vector<std::string> read_node_names(Table& table, std::string_view key,
                                                       const Space& space);
/// `node`, or all of `nodes`; one of the two is required.
[[nodiscard]] std::vector<std::string> read_one_or_more_nodes(Table& table, const Space& space);
/// With [nodes] a unit vector (the node's name is left empty), with [matrices] degrees of freedom by name, or
/// the name of a file with one column.
[[nodiscard]] Direction read_direction(Table& table, std::string_view key, const Space& space);
/// The column of numbers in the Matrix Market file that the key names, `size` of them.
[[nodiscard]] std::vector<double> read_vector_file(Table& table, std::string_view key, const Space& space);

/// A boundary of a body, "BODY.GROUP", with edges. Errors: SceneError, with the groups that there are.
struct BoundaryRef {
  std::size_t body = 0;
  const PlaneMesh::Group* group = nullptr;
};
[[nodiscard]] BoundaryRef find_boundary(const Table& table, std::string_view key, const std::string& name,
                                        const Scene& scene);

/// A load's history: offset 0, amplitude 1. The scene says where files are looked for, t_end and the units.
[[nodiscard]] HistorySpec read_load_history(Table& table, std::string_view key, const Scene& scene);
/// A history that stands alone: a number, or a table with offset and amplitude. Absent: the default, or zero.
[[nodiscard]] HistorySpec read_standing_history(Table& table, std::string_view key, const Scene& scene);
/// The same, which may be given in units of g.
[[nodiscard]] HistorySpec read_acceleration(Table& table, std::string_view key, const Scene& scene);
[[nodiscard]] HistorySpec constant_history(double value);

}  // namespace signorini
