#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.hpp"

using nlohmann::json;
using signorini::cli_test::belt;
using signorini::cli_test::Ending;
using signorini::cli_test::Shell;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> models() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(SIGNORINI_MODELS))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string pipeline = SIGNORINI_MODELS "/pipeline.toml";

}  // namespace

TEST_SUITE_BEGIN("cli/check");

TEST_CASE("cli check: every model can be run, as text and as JSON, and nothing is written") {
  const Shell shell;
  REQUIRE(models().size() >= 4);
  for (const fs::path& model : models()) {
    CAPTURE(model.string());
    const Ending text = shell.run({"check", model.string()});
    CHECK(text.code == 0);
    CHECK_FALSE(contains(text.out, "\\n"));
    CHECK(text.err.empty());
    CHECK(contains(text.out, "lowest frequencies:"));
    CHECK(contains(text.out, "cost: "));
    for (const std::string nonsense : {"nan", "inf ", "inf\n"}) CHECK_FALSE(contains(text.out, nonsense));
    const Ending as_json = shell.run({"check", model.string(), "--json"});
    CHECK(as_json.code == 0);
    const json facts = json::parse(as_json.out);
    CHECK(facts["degrees_of_freedom"].get<int>() > 0);
    CHECK(facts["columns"][0] == "t");
  }
  CHECK(shell.list().empty());
}

TEST_CASE("cli check: the pipeline in an engineer's words") {
  const Shell shell;
  const Ending ending = shell.run({"check", pipeline, "--columns"});
  for (const char* words : {"51 degrees of freedom, none massless; 2 contacts",
                            "mass: 9.6 t, centre at (6.75, 5.25) m, weight 94.176 kN", "58.86", "35.316",
                            "horizontal motion held at contacts 'first' and 'second'", "3 free motions",
                            "alpha = 17.81", "jump  load 1", "1201 rows of history.csv", "A.wz  rad/s"}) {
    CAPTURE(words);
    CHECK(contains(ending.out, words));
  }
  CHECK_FALSE(contains(shell.run({"check", pipeline}).out, "A.wz"));
}

TEST_CASE("cli check: --set counts") {
  const Shell shell;
  const Ending ending = shell.run({"check", pipeline, "--json", "--set", "contacts.*.normal_stiffness=2e6"});
  CHECK(ending.code == 0);
  CHECK(json::parse(ending.out)["stiffness"][0]["contact_stiffness"] == 2e6);
  CHECK(shell.run({"check", pipeline, "--set", "run.rtoll=1"}).code == 2);
  CHECK(shell.run({"check", pipeline, "--set", "run.rtol"}).code == 2);
}

TEST_CASE("cli check: refusals are 3 and say what would go wrong") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  shell.write("wrong.toml", belt(10) + "frction = 0.3\n");
  const Ending pulls = shell.run({"check", pipeline, "--set", "gravity=[0.0, 9.81]"});
  CHECK(pulls.code == 3);
  CHECK(contains(pulls.err, "contact 'first' would have to pull with 58.86 kN"));
  CHECK(contains(pulls.err, "drive the vertical motion"));
  const Ending driven = shell.run({"check", pipeline, "--set", "gravity=[1.0, -9.81]"});
  CHECK(driven.code == 3);
  CHECK(contains(driven.err, "drive the horizontal motion with 9.6 kN"));
  CHECK(shell.run({"check", "wrong.toml"}).code == 3);

  shell.write("two.toml", belt(10) + R"([[contacts]]
name = "again"
node = "block"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 1.0
friction = 0.4
surface_velocity = 0.2
)");
  const Ending twice = shell.run({"check", "two.toml", "--set", "run.initial={block={vx=0.2}}"});
  CHECK(twice.code == 3);
  CHECK(twice.out.empty());
  CHECK(twice.err.rfind("error: two.toml:", 0) == 0);
  CHECK(contains(twice.err, "'belt' and 'again' restrain the same motion when they stick rigidly"));
}

TEST_CASE("cli check: warnings of the run's start, and where the static start puts the contacts") {
  const Shell shell;
  const std::vector<std::string> shear = {pipeline, "--set", "contacts.second.initial_shear=100.0"};
  const std::string words = "contact 'second': initial_shear = 100 kN is above the friction limit at t = 0";
  const Ending checked = shell.run({"check", shear[0], shear[1], shear[2]});
  CHECK(checked.code == 0);
  CHECK(contains(checked.out, "warning: " + words));
  const Ending ran =
      shell.run({"run", shear[0], shear[1], shear[2], "--set", "run.t_end=1e-3", "--no-plots", "-o", "out"});
  CHECK(contains(ran.err, "warning: " + words));
  const Ending plain = shell.run({"check", pipeline});
  CHECK(contains(plain.out, "warning: mass-proportional damping (alpha = "));
  CHECK(plain.out.find("warning") == plain.out.rfind("warning"));
  CHECK(contains(plain.out, "ut [m]"));
  CHECK(contains(plain.out, "0.00177643"));
  const json facts = json::parse(shell.run({"check", pipeline, "--json"}).out);
  // The feet are 2.84228 mm farther apart than the pipe unloaded; the motion along the ground is shared by their |N|.
  const double first = facts["contacts"][0]["ut"], second = facts["contacts"][1]["ut"];
  const double N_first = facts["contacts"][0]["N"], N_second = facts["contacts"][1]["N"];
  CHECK(second - first == doctest::Approx(0.00284228).epsilon(1e-5));
  CHECK(N_first * first + N_second * second == doctest::Approx(0.0).epsilon(1e-9));
}

TEST_CASE("cli check: breakpoints in hundreds are a count") {
  const Shell shell;
  std::string table = "times = [", values = "values = [";
  for (int i = 0; i < 500; ++i) {
    table += (i > 0 ? ", " : "") + std::to_string(0.01 * i);
    values += (i > 0 ? ", " : "") + std::to_string(i % 3) + ".0";
  }
  shell.write("many.toml", belt(10) +
                               "[[loads]]\nnode = \"block\"\ndirection = [1.0, 0.0]\namplitude = 0.1\n" +
                               "history = { type = \"table\", " + table + "], " + values + "] }\n");
  const Ending ending = shell.run({"check", "many.toml"});
  CHECK(ending.code == 0);
  CHECK(contains(ending.out, "0 to 4.99  1 jump, 499 kinks  load 1"));
  const json facts = json::parse(shell.run({"check", "many.toml", "--json"}).out);
  CHECK(facts["discontinuities"].size() == 500);
}

TEST_CASE("cli check: what it advises can be followed") {
  const Shell shell;
  const std::string text = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
gravity = [0.0, -9.81]
run = { t_end = 1.0, engine = "exact" }
nodes = { a = [0.0, 0.0] }
masses = [{ node = "a", mass = 1.0 }]
contacts = [
  { name = "p", node = "a", normal = [0.0, 1.0], friction = 0.3, LAW },
  { name = "q", node = "a", normal = [0.0, 1.0], friction = 0.3, LAW },
]
)";
  const auto check_with = [&](const std::string& law) {
    std::string scene = text;
    for (std::size_t at; (at = scene.find("LAW")) != std::string::npos;) scene.replace(at, 3, law);
    shell.write("two.toml", scene);
    return shell.run({"check", "two.toml"});
  };
  const Ending rigid = check_with("law = \"rigid\"");
  CHECK(rigid.code == 3);
  CHECK(contains(rigid.err, "give all of them law = \"compliant\""));
  CHECK_FALSE(contains(rigid.err, "tangential_stiffness"));  // which "rigid" refuses
  CHECK(check_with("law = \"rigid\", tangential_stiffness = 1e5").code == 3);
  CHECK(check_with("law = \"compliant\", normal_stiffness = 1e5, tangential_stiffness = 1e5").code == 0);
}

TEST_CASE("cli check: parts without mass have no frequencies") {
  const Shell shell;
  const json facts = json::parse(
      shell.run({"check", SIGNORINI_TEST_DATA "/scenes/robust/massless-frame.toml", "--json"}).out);
  int count = 0;
  for (const auto& state : facts["frequencies"])
    for (const auto& mode : state["modes"]) {
      CHECK(mode["omega"].get<double>() < 500.0);  // 3e19 once
      ++count;
    }
  CHECK(count == 3);
}

TEST_CASE("cli check: --engine, as run has it") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  CHECK(contains(shell.run({"check", "belt.toml", "--engine", "ida"}).out, "engine ida"));
  CHECK(contains(shell.run({"check", "belt.toml", "--engine", "exact"}).out, "engine exact"));
  CHECK(shell.run({"check", "belt.toml", "--engine", "idea"}).code != 0);
}

TEST_CASE("cli check: command line and files") {
  const Shell shell;
  CHECK(shell.run({"check"}).code == 2);
  CHECK(shell.run({"check", pipeline, "-o", "x"}).code == 2);
  CHECK(shell.run({"check", "missing.toml"}).code == 6);
  CHECK(shell.run({"check", "--help"}).code == 0);
}

TEST_CASE("cli check, run, plot, witness: a pad that yields has the name of its law") {
  const Shell shell;
  shell.write("pad.toml", R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 0.2, output_dt = 0.01, initial = { block = { vy = -3.0 } } }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 2.0 }]
contacts = [{ name = "pad", node = "block", law = "yielding", normal = [0.0, 1.0], gap = 0.1, normal_stiffness = 1e4, yield_force = 150.0 }]
)");
  const Ending text = shell.run({"check", "pad.toml"});
  CHECK(text.code == 0);
  CHECK(contains(text.out, "pad      yielding  open"));
  const json facts = json::parse(shell.run({"check", "pad.toml", "--json"}).out);
  CHECK(facts["contacts"][0]["law"] == "yielding");
  CHECK(shell.run({"run", "pad.toml", "-o", "kept", "--instants", "--quiet"}).code == 0);
  const json summary = json::parse(shell.read("kept/summary.json"));
  CHECK(summary["contacts"][0]["law"] == "yielding");
  CHECK(summary["contacts"][0]["normal_stiffness"] == 1e4);
  CHECK(shell.run({"witness", "kept"}).code == 0);
  // What the run took for granted is a scene, too.
  CHECK(contains(shell.read("kept/run.toml"), "yield_force = 150.0"));
  CHECK(shell.run({"run", "kept/run.toml", "-o", "again", "--quiet"}).code == 0);
  CHECK(shell.read("again/events.csv") == shell.read("kept/events.csv"));
  // The state that it leaves is that of a block over a dent.
  shell.write("on.toml", R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 0.2, initial = { run = "kept" } }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 2.0 }]
contacts = [{ name = "pad", node = "block", law = "yielding", normal = [0.0, 1.0], gap = 0.1, normal_stiffness = 1e4, yield_force = 150.0 }]
loads = [{ node = "block", direction = [0.0, -1.0], amplitude = 40.0 }]
)");
  CHECK(shell.run({"run", "on.toml", "-o", "on", "--quiet"}).code == 0);
  const std::string events = shell.read("on/events.csv"), landing = ",pad,contact,open,closed,";
  REQUIRE(contains(events, landing));
  const double gap = std::stod(events.substr(events.find(landing) + landing.size()));
  CHECK(gap == doctest::Approx(-0.0525).epsilon(1e-6));  // (9 - 1.125) J / 150 N
}

TEST_SUITE_END();
