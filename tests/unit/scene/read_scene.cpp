// What the reader fills in, and mistakes that no scene of the corpus can hold.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "own_folder.hpp"
#include "signorini/scene.hpp"

using namespace signorini;

namespace {

const std::string head =
    "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n";
const std::string block = head + R"(
[nodes]
A = [0.0, 0.0]

[[masses]]
node = "A"
mass = 1.0

[run]
t_end = 1.0
)";

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml"); }

RunSpec run_with(const std::string& keys) { return scene_of(block + keys).run; }

}  // namespace

TEST_SUITE_BEGIN("unit/scene/read_scene");

TEST_CASE("defaults") {
  const Scene scene = scene_of(block);
  CHECK(scene.title.empty());
  CHECK(scene.gravity == std::array{0.0, 0.0});
  CHECK(scene.run.engine == Engine::ida);
  CHECK(scene.run.rtol == 1e-8);
  CHECK(scene.run.output_dt == 1e-3);
  CHECK_FALSE(scene.run.max_order);
  CHECK_FALSE(scene.run.atol.force);
  CHECK_FALSE(scene.initial.is_static);
  CHECK(scene.damping.alpha == 0.0);
}

TEST_CASE("the main scene") {
  const Scene scene = read_scene(SIGNORINI_MODELS "/pipeline.toml");
  REQUIRE(scene.contacts.size() == 2);
  const ContactSpec& first = scene.contacts[0];
  CHECK(first.name == "first");
  CHECK(first.place.line > 0);
  CHECK(first.normal->node == "A");
  CHECK(first.tangent->vector == std::array{1.0, -0.0});
  CHECK(first.friction.kinetic == 0.3);
  CHECK(first.tangential_stiffness == 1e6);
  CHECK(first.surface_velocity.amplitude == 0.0);
  REQUIRE(scene.members.size() == 1);
  CHECK(scene.members[0].elements == std::vector{4, 12});
  CHECK(scene.damping.alpha_over_omega1 == 0.2);
  CHECK(scene.initial.is_static);
  REQUIRE(scene.loads.size() == 1);
  CHECK(scene.loads[0].history.type == HistoryType::rectangle);
  CHECK(scene.loads[0].history.end == 0.1);
  CHECK(scene.run.grid().size() == 1201);
}

TEST_CASE("names keep the order of the file") {
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/good/order.toml");
  REQUIRE(scene.nodes.size() == 3);
  CHECK(scene.nodes[0].name == "Z");
  CHECK(scene.nodes[2].name == "B");
  CHECK(scene.sections[0].name == "z");
  CHECK(scene.contacts[0].name == "zz");
  CHECK(scene.members[0].elements == std::vector{3, 3});
  CHECK(scene.springs[0].direction == std::array{0.0, -1.0});
  CHECK(scene.resolved.find("[[contacts]]") < scene.resolved.find("[nodes]"));
}

TEST_CASE("directions of node scenes are unit vectors, the tangent is (ny, -nx)") {
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/good/histories.toml");
  CHECK(scene.loads[0].direction.vector[0] == doctest::Approx(0.6).epsilon(1e-15));
  REQUIRE(scene.contacts.size() == 1);
  CHECK(scene.contacts[0].name == "contact1");
  CHECK_FALSE(scene.contacts[0].normal);
  CHECK(scene.contacts[0].tangent->vector[0] == 1.0);
  CHECK(scene.contacts[0].friction.kinetic == 0.5);
  CHECK(scene.contacts[0].normal_force.offset == 1.0);
}

TEST_CASE("a constant without start holds since ever") {
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/good/histories.toml");
  CHECK_FALSE(scene.loads[0].history.start_given);
  CHECK(scene.loads[1].history.start_given);
  CHECK(scene.loads[2].history.start_given);
  CHECK(scene.loads[4].history.end == 0.2);
  CHECK(scene.loads[5].history.end == 0.3);
  CHECK(scene.loads[6].history.omega == 2.0 * M_PI * 3.3);
}

TEST_CASE("matrices from files") {
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/good/matrices.toml");
  REQUIRE(scene.matrices);
  CHECK(scene.matrices->dofs == std::vector<std::string>{"d0", "d1", "d2"});
  CHECK(scene.matrices->mass.entries.size() == 2);
  CHECK(scene.matrices->damping.size == 3);
  CHECK(scene.matrices->damping.entries.empty());
  REQUIRE(scene.matrices->stiffness.entries.size() == 7);
  CHECK(scene.matrices->stiffness.entries[1].column == 1);
  CHECK(scene.matrices->stiffness.entries[1].value == -1.0);
  CHECK(scene.contacts[0].normal->dofs[0].first == "d1");
}

TEST_CASE("large matrices stay in their file, found from anywhere") {
  const signorini::tests::OwnFolder own;
  const std::filesystem::path& folder = own.path();
  std::ofstream file(folder / "I.mtx");
  file << "%%MatrixMarket matrix coordinate real symmetric\n200 200 200\n";
  for (int i = 1; i <= 200; ++i) file << i << " " << i << " 1.0\n";
  file.close();
  const std::string text = head + "[matrices]\nmass = \"I.mtx\"\nstiffness = \"I.mtx\"\n[run]\nt_end = 1.0\n";
  const Scene scene = parse_scene(text, (folder / "scene.toml").string());
  CHECK(scene.resolved.find("/I.mtx\"") != std::string::npos);
  const Scene again = parse_scene(scene.resolved, "/nowhere/run.toml");
  CHECK(again.resolved == scene.resolved);
  CHECK(again.matrices->mass.entries.size() == 200);
}

TEST_CASE("grid: multiples, not sums; t_end last and once") {
  const std::vector<double> grid = run_with("output_dt = 0.1").grid();
  REQUIRE(grid.size() == 11);
  for (int k = 0; k < 10; ++k) CHECK(grid[static_cast<std::size_t>(k)] == k * 0.1);
  CHECK(grid.back() == 1.0);
  CHECK(run_with("output_dt = 0.3").grid().size() == 5);
  CHECK(run_with("output_dt = 5.0").grid() == std::vector{0.0, 1.0});
  CHECK(run_with("output_times = [0.25]").grid() == std::vector{0.25, 1.0});
  CHECK(run_with("output_times = [0.25, 1.0]").grid() == std::vector{0.25, 1.0});
  for (const double dt : {0.1 / 3.0, 1.0 / 7.0, 1e-3, 1.0 / 49.0}) {
    RunSpec run;
    run.t_end = 1.0;
    run.output_dt = dt;
    const std::vector<double> times = run.grid();
    CHECK(times.size() == static_cast<std::size_t>(std::lround(1.0 / dt)) + 1);
    CHECK(times.back() == 1.0);
  }
}

TEST_CASE("files that are no scenes") {
  CHECK_THROWS_WITH_AS((void)scene_of(""), "test.toml:1:1: schema: the file is empty, expected schema = 1",
                       SceneError);
  CHECK_THROWS_WITH_AS((void)scene_of("# only a comment\n"), doctest::Contains("empty"), SceneError);
  CHECK_THROWS_WITH_AS((void)scene_of(std::string("schema = 1\n\0x", 13)),
                       "test.toml:2: found binary data, expected TOML text", SceneError);
  CHECK_THROWS_WITH_AS((void)scene_of("\x7f"
                                      "ELF\xff\xfe"),
                       doctest::Contains("not TOML"), SceneError);
  CHECK_THROWS_WITH_AS((void)read_scene(SIGNORINI_TEST_DATA), doctest::Contains("is a directory"), FileError);
  CHECK_THROWS_WITH_AS((void)read_scene("/no/such.toml"), "/no/such.toml: No such file or directory",
                       FileError);
  CHECK_THROWS_AS((void)scene_of(block + "x = " + std::string(100000, '[')), SceneError);
  std::string deep = "a";
  for (int i = 0; i < 300000; ++i) deep += ".a";
  CHECK_THROWS_WITH_AS((void)scene_of(head + deep + " = 1\n"), doctest::Contains("more than 1000 parts"),
                       SceneError);
}

TEST_CASE("a missing matrix file is a file error that names its key") {
  const std::string text = head + "[run]\nt_end = 1.0\n[matrices]\nmass = [[1.0]]\nstiffness = \"no.mtx\"\n";
  CHECK_THROWS_WITH_AS((void)parse_scene(text, "/nowhere/a.toml"),
                       "/nowhere/a.toml:7:13: matrices.stiffness: /nowhere/no.mtx: No such file or directory",
                       FileError);
}

TEST_CASE("tables nested beyond any use are refused before they can overflow the stack") {
  std::string key = "a";
  for (int i = 0; i < 900; ++i) key += ".a";
  std::string nested = "x = ";
  for (int i = 0; i < 150; ++i) nested += "{ " + key + " = ";
  nested += "1" + std::string(150, '}') + "\n";
  CHECK_THROWS_WITH_AS((void)scene_of(block + nested), doctest::Contains("nested deeper than 1000"),
                       SceneError);
  // Dots and brackets in strings and comments are no keys.
  const std::string dots(2000, '.'), brackets(2000, '[');
  for (const std::string quote : {"\"", "'", "\"\"\"", "'''"})
    CHECK(scene_of("schema = 1\ntitle = " + quote + dots + brackets + quote + " # " + brackets + "\n" +
                   block.substr(block.find('\n') + 1))
              .title == dots + brackets);
}

TEST_CASE("a name of a megabyte is refused, and not printed") {
  const std::string name(1 << 20, 'n');
  try {
    (void)scene_of(block + "[[contacts]]\nname = \"" + name + "\"\n");
    FAIL("no error");
  } catch (const SceneError& error) {
    CHECK(std::string(error.what()).find("found a name of 1048576 bytes, expected at most 255") !=
          std::string::npos);
    CHECK(std::string(error.what()).size() < 500);
  }
  try {
    (void)scene_of(block + "[sections]\n" + name + " = { EA = 1.0, EI = 1.0, mass_per_length = 1.0 }\n");
    FAIL("no error");
  } catch (const SceneError& error) {
    CHECK(std::string(error.what()).size() < 500);
  }
}

TEST_SUITE_END();
