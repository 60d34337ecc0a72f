// [[bodies]]: plane continua, and their boundaries.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "mesh/gmsh_file.hpp"
#include "mesh/grids.hpp"
#include "mesh/shape_functions.hpp"
#include "scene/data_file.hpp"
#include "scene/readers.hpp"

namespace signorini::scene {

namespace {

constexpr int most_cells = 1'000'000;
constexpr double rad_of_degree = std::numbers::pi / 180.0;

mesh::GridSpec read_grid(Table& table) {
  mesh::GridSpec grid;
  const std::string shape = table.choice("shape");
  grid.shape = shape == "t3"   ? PlaneShape::t3
               : shape == "t6" ? PlaneShape::t6
               : shape == "q8" ? PlaneShape::q8
                               : PlaneShape::q4;
  table.require("elements", " (required without mesh)");
  const std::vector<double> counts = *table.numbers("elements");
  const bool whole = std::all_of(counts.begin(), counts.end(),
                                 [](double n) { return n >= 1.0 && n <= most_cells && n == std::floor(n); });
  if (counts.size() != 2 || !whole || counts[0] * counts[1] > most_cells)
    table.wrong("elements", "two integers >= 1 whose product is at most 1e6");
  grid.elements = {static_cast<int>(counts[0]), static_cast<int>(counts[1])};
  grid.grading = table.vector("grading");
  if (!(grid.grading[0] > 0.0 && grid.grading[1] > 0.0)) table.wrong("grading", "two numbers > 0");
  return grid;
}

PlaneMesh read_rectangle(Table& table) {
  Table keys = table.child("rectangle");
  mesh::RectangleSpec rectangle;
  rectangle.from = keys.vector("from");
  rectangle.size = keys.vector("size");
  if (!(rectangle.size[0] > 0.0 && rectangle.size[1] > 0.0)) keys.wrong("size", "two numbers > 0");
  rectangle.angle = rad_of_degree * keys.number("degrees");
  keys.finish();
  table.record("rectangle", keys.record().inline_table());
  return mesh::rectangle_mesh(rectangle, read_grid(table));
}

PlaneMesh read_ring(Table& table) {
  Table keys = table.child("ring");
  mesh::RingSpec ring;
  ring.centre = keys.vector("centre");
  ring.inner = keys.number("inner");
  ring.outer = keys.number("outer");
  if (!(ring.outer > ring.inner))
    keys.fail("outer", fmt::format("found the number {}, expected more than the inner radius, {}",
                                   base::format_number(ring.outer), base::format_number(ring.inner)));
  const auto [start, end] = keys.vector("degrees");
  if (!(end > start && end - start <= 360.0))
    keys.wrong("degrees", "two angles [start, end] with start < end <= start + 360");
  ring.start = rad_of_degree * start;
  ring.end = end - start == 360.0 ? ring.start + 2.0 * std::numbers::pi : rad_of_degree * end;
  keys.finish();
  table.record("ring", keys.record().inline_table());
  const mesh::GridSpec grid = read_grid(table);
  const double widest = (end - start) / grid.elements[1];
  if (!(widest < 180.0))
    table.fail("elements", fmt::format("found elements of {:.4g} degrees, expected less than 180", widest));
  return mesh::ring_mesh(ring, grid);
}

PlaneMesh read_mesh_file(Table& table, const Scene& scene) {
  const toml::node* name = table.raw("mesh");  // recorded below with its full path
  if (!name->is_string()) table.wrong("mesh", "the name of a file");
  const std::filesystem::path path = directory_of(scene) / name->value_or(std::string());
  std::ifstream in = open_data_file(table, "mesh", path);
  const std::vector<std::string> surfaces = table.texts("surfaces");
  PlaneMesh mesh = mesh::read_gmsh(in, path.string(), table.path("mesh"), surfaces);
  table.record("mesh", toml_string(std::filesystem::absolute(path).lexically_normal().string()));
  for (const std::string& wanted : table.texts("groups")) {
    std::vector<std::string> there;
    for (const PlaneMesh::Group& group : mesh.groups) there.push_back(group.name);
    if (std::find(there.begin(), there.end(), wanted) != there.end()) continue;
    table.fail(
        "groups",
        fmt::format("{} has no physical curve or point \"{}\" on this body{}", path.string(), wanted,
                    there.empty() ? "; it has none at all: in Gmsh, write for example Physical Curve(\"" +
                                        wanted + "\") = {1}"
                                  : base::suggestion(wanted, there)));
  }
  return mesh;
}

/// Reads one of the three keys that define the elements.
PlaneMesh read_mesh(Table& table, const Scene& scene) {
  const char* found = nullptr;
  for (const char* key : {"mesh", "rectangle", "ring"}) {
    if (!table.has(key)) continue;
    if (found) table.fail(key, fmt::format("cannot be combined with {}; give only one of them", found));
    found = key;
  }
  if (!found) table.fail("mesh", "missing, expected mesh, rectangle or ring");
  if (table.has("mesh")) return read_mesh_file(table, scene);
  PlaneMesh mesh = table.has("rectangle") ? read_rectangle(table) : read_ring(table);
  for (PlaneMesh::Node& node : mesh.nodes) node.place = table.place();
  for (PlaneMesh::Element& element : mesh.elements) element.place = table.place();
  mesh::check_elements(mesh, table.path());
  return mesh;
}

void read_material(Table& table, BodySpec& body, const Scene& scene) {
  body.E = table.number("E");
  body.nu = table.number("nu");
  if (!(body.nu >= 0.0 && body.nu < 0.5)) table.wrong("nu", "a number >= 0 and < 0.5");
  body.density = table.number("density");
  body.thickness = table.number("thickness");
  body.plane_strain = table.choice("plane") == "strain";
  body.mass = table.choice("mass") == "lumped" ? MassKind::lumped : MassKind::consistent;
  if (table.has("temperature") && !table.has("thermal_expansion"))
    table.fail("temperature", "needs thermal_expansion in the same table");
  body.thermal_expansion = table.number("thermal_expansion");
  body.temperature = read_number_or_history(table, "temperature", scene);
}

/// Gives names to the nodes at the places in [bodies.points].
void read_points(Table& table, const BodySpec& body, Names& names, Scene& scene) {
  if (!table.has("points")) return;
  Table points = table.child("points");
  const std::size_t first = body.first_node, end = first + body.node_count;
  double size = 0.0;
  for (std::size_t i = first; i < end; ++i)
    size = std::max(
        size, std::hypot(scene.nodes[i].x - scene.nodes[first].x, scene.nodes[i].y - scene.nodes[first].y));
  for (const Entry& entry : entries_of(points.node())) {
    check_name(entry.name, entry.place(), points.path(entry.name));
    const auto [x, y] = points.vector(entry.name);
    const auto distance = [&, px = x, py = y](const Node& n) { return std::hypot(n.x - px, n.y - py); };
    Node& nearest =
        *std::min_element(scene.nodes.begin() + static_cast<std::ptrdiff_t>(first),
                          scene.nodes.begin() + static_cast<std::ptrdiff_t>(end),
                          [&](const Node& a, const Node& b) { return distance(a) < distance(b); });
    // Tolerance of positions, relative to the body's size: scenes give positions with six digits or more.
    constexpr double digits = 1e-6;
    if (distance(nearest) > digits * size)
      points.fail(entry.name,
                  fmt::format("no node is at this place, expected the place of a node; the nearest "
                              "node is {} at [{:.9g}, {:.9g}]",
                              nearest.name, nearest.x, nearest.y));
    if (!nearest.is_mesh_node)
      points.fail(entry.name, fmt::format("the node at this place already has the name \"{}\"; use that name",
                                          nearest.name));
    if (!names.add(entry.name))
      points.fail(entry.name, fmt::format("node \"{}\" exists already; expected another name", entry.name));
    nearest.name = entry.name;
    nearest.is_mesh_node = false;
  }
  points.finish();
  table.record("points", points.record().inline_table());
}

/// Moves the mesh's nodes to the nodes of the scene.
void take_mesh(PlaneMesh mesh, BodySpec& body, Scene& scene) {
  body.first_node = scene.nodes.size();
  body.node_count = mesh.nodes.size();
  for (const PlaneMesh::Node& n : mesh.nodes)
    scene.nodes.push_back({fmt::format("{}.{}", body.name, n.number), n.x, n.y, n.place, true});
  const auto shift = [&](std::vector<int>& nodes) {
    for (int& n : nodes) n += static_cast<int>(body.first_node);
  };
  for (PlaneMesh::Element& element : mesh.elements) shift(element.nodes);
  for (PlaneMesh::Group& group : mesh.groups) {
    shift(group.nodes);
    for (PlaneMesh::Edge& edge : group.edges) shift(edge.nodes);
  }
  mesh.nodes.clear();
  body.mesh = std::move(mesh);
}

}  // namespace

void read_bodies(Table& top, Scene& scene, ResolvedScene& record) {
  Names names;
  for (const Node& node : scene.nodes) names.add(node.name);
  for (Table& table : tables_of(top, "bodies")) {
    BodySpec body;
    body.place = table.place();
    body.name = table.text("name");
    if (!names.add(body.name))
      table.fail("name", fmt::format("found \"{}\", which another body or a node has; expected another name",
                                     body.name));
    take_mesh(read_mesh(table, scene), body, scene);
    read_material(table, body, scene);
    read_points(table, body, names, scene);
    table.finish(table.has("mesh") ? "has no meaning together with mesh" : "has no meaning without mesh");
    scene.bodies.push_back(std::move(body));
    record.add("bodies", "[[bodies]]", table.record());
  }
}

BoundaryRef find_boundary(const Table& table, std::string_view key, const std::string& name,
                          const Scene& scene) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    for (const PlaneMesh::Group& group : scene.bodies[b].mesh.groups)
      if (!group.edges.empty() && scene.bodies[b].name + "." + group.name == name) return {b, &group};
  table.fail(key,
             fmt::format("no boundary is named \"{}\"{}", name, groups_of_bodies_text(name, scene, true)));
}

}  // namespace signorini::scene
