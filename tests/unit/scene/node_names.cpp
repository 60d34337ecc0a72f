// Names of groups and nodes of meshes that a scene misspells.
#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "own_folder.hpp"
#include "signorini/error.hpp"
#include "signorini/scene.hpp"

namespace signorini::tests::node_names {
namespace {

/// Two triangles, with a physical surface, and physical curves "Fixed_bottom" and "Lateral" if `groups` says so.
std::string mesh(bool groups) {
  const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n";
  if (!groups)
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + nodes +
           "$Elements\n2\n1 2 2 0 1 1 2 3\n2 2 2 0 1 1 3 4\n$EndElements\n";
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"Fixed_bottom\"\n1 2 \"Lateral\"\n2 "
         "3 \"All\"\n"
         "$EndPhysicalNames\n" +
         nodes +
         "$Elements\n4\n1 1 2 1 1 1 2\n2 1 2 2 2 2 3\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 3 4\n$EndElements\n";
}

class Meshed {
 public:
  Meshed() {
    std::ofstream(own_.path() / "with.msh") << mesh(true);
    std::ofstream(own_.path() / "without.msh") << mesh(false);
  }
  /// Message of the refusal of a scene with a body of this mesh; "none" if it is read.
  [[nodiscard]] std::string refusal(const std::string& file, const std::string& more,
                                    const std::string& initial = "") const {
    const std::string text =
        "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
        "1.0\n" +
        initial +
        "[nodes]\nTop = [0.5, 2.0]\n[[masses]]\nnode = \"Top\"\nmass = 1.0\n[[bodies]]\nname = \"b\"\nmesh = "
        "\"" +
        (own_.path() / file).string() + "\"\nE = 2e9\nnu = 0.3\ndensity = 2000.0\nplane = \"stress\"\n" +
        more;
    try {
      (void)parse_scene(text, "test.toml");
    } catch (const SceneError& error) {
      return error.what();
    }
    return "none";
  }

 private:
  OwnFolder own_;
};

std::string support(const std::string& name) {
  return "[[supports]]\nnodes = [\"" + name + "\"]\nfix = [\"ux\", \"uy\"]\n";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_SUITE_BEGIN("unit/scene/node_names");

TEST_CASE("a misspelt group is answered with the group that was meant, not with the nodes of the mesh") {
  const Meshed meshed;
  REQUIRE(meshed.refusal("with.msh", support("b.Fixed_bottom")) == "none");
  const auto answer = [&](const std::string& name) { return meshed.refusal("with.msh", support(name)); };
  CHECK(has(answer("b.Fixed_botom"),
            "supports.1.nodes: unknown group or node \"b.Fixed_botom\"; did you mean \"b.Fixed_bottom\"?"));
  CHECK(has(answer("Fixed_bottom"), "did you mean \"b.Fixed_bottom\"?"));
  CHECK(has(answer("b.roof"),
            "unknown group or node \"b.roof\"; groups of body \"b\": Fixed_bottom and Lateral; its nodes are "
            "numbered, \"b.1\" to \"b.4\""));
  CHECK(has(answer("b.77"), "unknown node \"b.77\"; its nodes are numbered, \"b.1\" to \"b.4\""));
  CHECK(has(answer("Tip"), "unknown node \"Tip\"; did you mean \"Top\"?"));
  CHECK(has(answer("elsewhere"), "unknown node \"elsewhere\"; known: Top, b, b.Fixed_bottom, b.Lateral"));
  CHECK(has(meshed.refusal("with.msh", "", "[run.initial]\n\"b.Latera\" = { vx = 1.0 }\n"),
            "did you mean \"b.Lateral\"?"));
}

TEST_CASE("a key that takes one node") {
  const Meshed meshed;
  const auto answer = [&](const std::string& name) {
    return meshed.refusal("with.msh",
                          "[[loads]]\nnode = \"" + name + "\"\ndirection = [1.0, 0.0]\namplitude = 1.0\n");
  };
  CHECK(answer("b.1") == "none");
  CHECK(has(answer("b.Lateral"), "found \"b.Lateral\", a group of nodes, expected the name of one node"));
  CHECK(has(answer("b.9"), "unknown node \"b.9\"; its nodes are numbered, \"b.1\" to \"b.4\""));
}

TEST_CASE("a mesh without physical groups: the message says how groups arise") {
  const Meshed meshed;
  const std::string answer = meshed.refusal("without.msh", support("b.bottom"));
  CAPTURE(answer);
  CHECK(has(answer, "unknown group or node \"b.bottom\"; body \"b\" has no groups, because "));
  CHECK(has(
      answer,
      "without.msh has no physical curves or points; in Gmsh, write for example Physical Curve(\"bottom\")"));
  CHECK(has(answer, "its nodes are numbered, \"b.1\" to \"b.4\""));
  const std::string load = "[[loads]]\ngroup = \"b.bottom\"\npressure = 1.0\n";
  CHECK(has(meshed.refusal("without.msh", load),
            "no boundary is named \"b.bottom\"; body \"b\" has no groups"));
  CHECK(has(meshed.refusal("with.msh", "[[loads]]\ngroup = \"b.Lateral_\"\npressure = 1.0\n"),
            "did you mean \"b.Lateral\"?"));
  CHECK(has(meshed.refusal("without.msh", "groups = [\"foot\"]\n"),
            "write for example Physical Curve(\"foot\") = {1}"));
  CHECK(has(meshed.refusal("with.msh", "groups = [\"Latral\"]\n"), "did you mean \"Lateral\"?"));
}

TEST_SUITE_END();

}  // namespace signorini::tests::node_names
