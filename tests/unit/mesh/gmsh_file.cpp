// Files of Gmsh: both versions give the same mesh; what is wrong is refused with its line.
#include <doctest/doctest.h>

#include <sstream>

#include "mesh/gmsh_file.hpp"

using namespace signorini;

namespace {

// Two squares side by side, the right one of two triangles; numbers with holes.
const char* const new_file = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
0 9 "tip"
1 3 "foot"
2 5 "steel"
2 6 "other steel"
$EndPhysicalNames
$Entities
1 1 2 0
7 2 1 0 1 9
1 0 0 0 2 0 0 1 3 0
1 0 0 0 1 1 0 1 5 0
2 1 0 0 2 1 0 1 6 0
$EndEntities
$Nodes
2 6 10 15
0 7 0 1
15
2 1 0
2 1 0 5
10
11
12
13
14
0 0 0
1 0 0
1 1 0
0 1 0
2 0 0
$EndNodes
$Elements
4 6 1 6
0 7 15 1
1 15
1 1 1 2
2 11 10
3 11 14
2 1 3 1
4 10 11 12 13
2 2 2 2
5 11 14 12
6 14 15 12
$EndElements
)";

const char* const old_file = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
0 9 "tip"
1 3 "foot"
2 5 "steel"
2 6 "other steel"
$EndPhysicalNames
$Nodes
6
15 2 1 0
10 0 0 0
11 1 0 0
12 1 1 0
13 0 1 0
14 2 0 0
$EndNodes
$Elements
6
1 15 2 9 7 15
2 1 2 3 1 11 10
3 1 2 3 1 11 14
4 3 2 5 1 10 11 12 13
5 2 2 6 2 11 14 12
6 2 2 6 2 14 15 12
$EndElements
)";

PlaneMesh read_text(const std::string& text, const std::vector<std::string>& surfaces = {}) {
  std::istringstream in(text);
  return mesh::read_gmsh(in, "m.msh", "bodies.b.mesh", surfaces);
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

void check_refused(const std::string& text, const std::string& message,
                   const std::vector<std::string>& surfaces = {}) {
  CAPTURE(message);
  try {
    static_cast<void>(read_text(text, surfaces));
    FAIL_CHECK("it was read");
  } catch (const SceneError& error) {
    const std::string said = error.what();
    CAPTURE(said);
    CHECK(said.find(message) != std::string::npos);
  }
}

}  // namespace

TEST_SUITE_BEGIN("unit/mesh/gmsh_file");

TEST_CASE("versions 4.1 and 2.2: nodes, elements, groups by name, edges with the body to their left") {
  for (const char* text : {new_file, old_file}) {
    const PlaneMesh mesh = read_text(text);
    REQUIRE(mesh.nodes.size() == 6);
    REQUIRE(mesh.elements.size() == 3);
    CHECK(mesh.elements[0].shape == PlaneShape::q4);
    CHECK(mesh.elements[2].shape == PlaneShape::t3);
    REQUIRE(mesh.groups.size() == 2);
    const auto& foot = mesh.groups[0].name == "foot" ? mesh.groups[0] : mesh.groups[1];
    const auto& tip = mesh.groups[0].name == "foot" ? mesh.groups[1] : mesh.groups[0];
    CHECK(tip.name == "tip");
    CHECK(tip.edges.empty());
    REQUIRE(tip.nodes.size() == 1);
    CHECK(mesh.nodes[static_cast<std::size_t>(tip.nodes[0])].number == 15);
    CHECK(foot.nodes.size() == 3);
    REQUIRE(foot.edges.size() == 2);
    for (const auto& edge : foot.edges)  // the file has one of them the other way
      CHECK(mesh.nodes[static_cast<std::size_t>(edge.nodes[1])].x >
            mesh.nodes[static_cast<std::size_t>(edge.nodes[0])].x);
  }
}

TEST_CASE("groups without a name are called by kind and tag, so that nodes keep their numbers") {
  const std::string unnamed = changed(old_file, "\n4\n0 9 \"tip\"\n1 3 \"foot\"", "\n2");
  const PlaneMesh mesh = read_text(unnamed);
  REQUIRE(mesh.groups.size() == 2);
  CHECK(mesh.groups[0].name == "point9");
  CHECK(mesh.groups[1].name == "curve3");
  check_refused(changed(old_file, "\"foot\"", "\"13\""),
                "m.msh:7: bodies.b.mesh: found a physical group named \"13\"");
}

TEST_CASE("a line that stands twice counts once, one inside of the body has nodes and no edges") {
  const std::string twice = changed(changed(old_file, "$Elements\n6", "$Elements\n7"), "2 1 2 3 1 11 10\n",
                                    "2 1 2 3 1 11 10\n9 1 2 3 1 10 11\n");
  const PlaneMesh once = read_text(twice);
  for (const auto& g : once.groups)
    if (g.name == "foot") CHECK(g.edges.size() == 2);
  // 11 to 12 lies between the square and a triangle.
  const std::string inside = changed(changed(old_file, "$Elements\n6", "$Elements\n7"), "2 1 2 3 1 11 10\n",
                                     "2 1 2 3 1 11 10\n9 1 2 4 1 12 11\n");
  const PlaneMesh mesh = read_text(inside);
  bool found = false;
  for (const auto& g : mesh.groups) {
    if (g.name != "curve4") continue;
    found = true;
    CHECK(g.edges.empty());
    CHECK(g.nodes.size() == 2);
  }
  CHECK(found);
  check_refused(changed(inside, "9 1 2 4 1 12 11", "9 1 2 3 1 12 11"),
                "m.msh:24: bodies.b.mesh: line 9 of the physical curve \"foot\" has elements on both sides");
  // Of the square alone it is a boundary.
  for (const auto& g : read_text(inside, {"steel"}).groups)
    if (g.name == "curve4") CHECK(g.edges.size() == 1);
}

TEST_CASE("a body of one surface has its nodes and its part of the groups alone") {
  const PlaneMesh mesh = read_text(new_file, {"steel"});
  CHECK(mesh.nodes.size() == 4);
  REQUIRE(mesh.groups.size() == 1);
  CHECK(mesh.groups[0].edges.size() == 1);
}

TEST_CASE("elements that all run clockwise are turned round") {
  std::string text = changed(old_file, "10 11 12 13", "13 12 11 10");
  text = changed(text, "2 11 14 12", "2 14 11 12");
  text = changed(text, "14 15 12\n", "15 14 12\n");
  const PlaneMesh mesh = read_text(text);
  for (const auto& e : mesh.elements) {
    double area = 0.0;
    for (std::size_t i = 0; i < e.nodes.size(); ++i) {
      const auto &a = mesh.nodes[static_cast<std::size_t>(e.nodes[i])],
                 &b = mesh.nodes[static_cast<std::size_t>(e.nodes[(i + 1) % e.nodes.size()])];
      area += 0.5 * (a.x * b.y - b.x * a.y);
    }
    CHECK(area > 0.0);
  }
}

TEST_CASE("bad meshes are refused with file and line") {
  check_refused(changed(old_file, "10 11 12 13", "13 12 11 10"),
                "m.msh:25: bodies.b.mesh: element 4 is inverted");
  check_refused(changed(old_file, "10 11 12 13", "10 11 13 12"),
                "m.msh:25: bodies.b.mesh: element 4 is folded or flat");
  check_refused(changed(old_file, "4 3 2 5", "4 10 2 5"), "m.msh:25: bodies.b.mesh: element 4 has type 10");
  check_refused(changed(old_file, "6\n15 2 1 0", "7\n99 5 5 0\n15 2 1 0"),
                "m.msh:13: bodies.b.mesh: node 99 belongs to no element");
  check_refused(changed(old_file, "14 15 12\n", "14 77 12\n"),
                "m.msh:27: bodies.b.mesh: element 6 has node 77");
  check_refused(changed(old_file, "2.2 0 8", "2.2 1 8"), "m.msh:2: bodies.b.mesh: found a binary mesh");
  check_refused(changed(old_file, "2.2 0 8", "3.0 0 8"), "m.msh:2: bodies.b.mesh: found version 3");
  check_refused(changed(new_file, "1 1 0\n0 1 0", "1 1 0.5\n0 1 0"), "found z = 0.5 of node 12");
  check_refused(changed(new_file, "1 1 0\n0 1 0", "1 x 0\n0 1 0"), "found \"x\", expected y, a number");
  check_refused(changed(new_file, "2 11 10\n3 11 14", "2 11 13\n3 11 14"),
                "m.msh:40: bodies.b.mesh: line 2 from node 11 to node 13 is not an edge of an element");
  check_refused(new_file, "no physical surface is named \"wood\"; known: other steel, steel", {"wood"});
  check_refused("MeshFormat", "m.msh:1: bodies.b.mesh: found \"MeshFormat\", expected a section");
  check_refused(std::string(old_file).substr(0, 300), "found the end of the file");
}

TEST_SUITE_END();
