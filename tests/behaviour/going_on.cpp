// Runs that go on from a state of another: whole, in the same units, of the same structure; in halves they are the run.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "behaviour/halves.hpp"
#include "behaviour/scene_parts.hpp"
#include "own_folder.hpp"
#include "result/run_directory.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::going_on {
namespace {

using namespace parts;

/// Runs the scene into the folder, which another may go on from.
Model keep(const std::filesystem::path& folder, const Scene& scene) {
  Model model = build_model(scene);
  result::RunDirectory directory(folder, scene, model, {true, {"test"}});
  const Report report = simulate(model, scene.run, directory);
  static_cast<void>(directory.finish(report));
  return model;
}

/// The events of the second half are those of the whole after t.
void check_halves(const std::string& whole, double t,
                  const std::function<std::string(const std::string&)>& second) {
  const OwnFolder own;
  const auto folder = own.path() / "first";
  const Scene scene = parse_scene(whole, "whole.toml");
  const Model model = keep(folder, scene);
  const Result all = simulate(model, scene.run);
  std::size_t first = 0;
  while (first < all.events.size() && all.events[first].t <= t) ++first;
  REQUIRE(all.events.size() - first > 5);
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Scene later = parse_scene(second(folder.string()), "second.toml", {{"run.engine", engine}});
    const Model rest_of = build_model(later);
    const Result rest = simulate(rest_of, later.run);
    CHECK(rest_of.warnings == model.warnings);
    REQUIRE(rest.events.size() == all.events.size() - first);
    for (std::size_t i = 0; i < rest.events.size(); ++i) {
      CHECK(std::abs(rest.events[i].t + t - all.events[first + i].t) < (engine[0] == 'e' ? 1e-12 : 1e-9));
      CHECK(rest.events[i].to == all.events[first + i].to);
    }
    REQUIRE(rest.responses.empty() == all.responses.empty());
    for (std::size_t i = 0; i < model.outputs.size(); ++i) {
      const double last = all.responses.back().values[i];
      CHECK(std::abs(rest.responses.back().values[i] - last) <
            (engine[0] == 'e' ? 1e-9 : 1e-6) * std::abs(last));
    }
  }
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  REQUIRE(text.find(from) != std::string::npos);
  return text.replace(text.find(from), from.size(), to);
}

constexpr const char* every_model[] = {"belt",     "chain",      "coulomb-pad", "den-hartog", "lift-off",
                                       "matrices", "oscillator", "pipeline",    "piping",     "rigid-frame"};

std::vector<std::string> all_scenes() {
  std::vector<std::string> files;
  for (const char* name : every_model) files.push_back(fmt::format(SIGNORINI_MODELS "/{}.toml", name));
  for (const auto& entry : std::filesystem::directory_iterator(SIGNORINI_TEST_DATA "/cases"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  std::sort(files.begin() + std::size(every_model), files.end());
  return files;
}

/// only: these models; else all without those whose rounding or errors of the engine grow too far to tell, or that take minutes.
struct Chosen {
  std::vector<std::string> without, only = {};
};

void check_all(const std::vector<Override>& settings, double part, double time, double state,
               const Chosen& chosen = {}) {
  for (const std::string& file : all_scenes()) {
    CAPTURE(file);
    const auto in = [&](const std::vector<std::string>& names) {
      return std::any_of(names.begin(), names.end(),
                         [&](const std::string& name) { return file.ends_with("/" + name + ".toml"); });
    };
    if (in(chosen.without) || (!chosen.only.empty() && !in(chosen.only))) continue;
    // Of piping to 10 s: after that its certificate has errors of up to 1e-4 s, and later no event is certain.
    std::vector<Override> own = settings;
    if (file.ends_with("/piping.toml")) own.push_back({"run.t_end", "10"});
    const halves::Difference d = halves::split(file, own, part);
    INFO(d.first);
    CHECK(d.events_agree);
    CHECK(d.time <= time);
    CHECK(d.state <= state);
  }
}

void check_split(const std::string& text, double part, double time, double state) {
  using Way = std::pair<std::string, std::string>;
  for (const Way& way : {Way("exact", "taylor"), Way("exact", "auto"), Way("ida", "auto")}) {
    const std::string &engine = way.first, &flow = way.second;
    CAPTURE(engine);
    CAPTURE(flow);
    const double rough = engine == "ida" ? 1e3 : 1.0;
    const halves::Difference d =
        halves::split_text(text, {{"run.engine", engine}, {"run.flow", flow}, {"run.rtol", "1e-10"}}, part);
    INFO(d.first);
    CHECK(d.events_agree);
    CHECK(d.events > 0);
    CHECK(d.time <= rough * time);
    CHECK(d.state <= rough * state);
  }
}

const std::string si = "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n";

}  // namespace

TEST_SUITE_BEGIN("behaviour/going_on");

TEST_CASE("a run in two halves has the events of the whole") {
  const std::string whole = two_sliders(R"([run]
t_end = 4.0
output_dt = 0.1
frames = [1.7]
engine = "exact"
rtol = 1e-12
initial = "frictional"
)",
                                        R"([[loads]]
node = "A"
direction = [1.0, 0.0]
amplitude = 1.5
history = { type = "harmonic", omega = 5.0, end = 9.0 }
[[stops]]
name = "guide"
node = "B"
law = "compliant"
direction = [1.0, 0.0]
gap = 0.004
normal_stiffness = 500.0
)");
  check_halves(whole, 1.7, [&](const std::string& run) {
    std::string second = with(whole, "t_end = 4.0", "t_end = 2.3");
    second = with(second, "frames = [1.7]\n", "");
    second =
        with(second, "initial = \"frictional\"", fmt::format("initial = {{ run = \"{}\", t = 1.7 }}", run));
    return with(second, "end = 9.0", "end = 9.0, shift = -1.7");
  });
}

TEST_CASE("what slips below its static limit slips on: kinetic friction is lower") {
  // At t = 0.25 T is the kinetic limit, 2, half of the static one: T alone would be a stick.
  const std::string whole = head + R"(gravity = [0.0, -10.0]
[run]
t_end = 2.0
initial = { b = { uy = -0.001 } }
engine = "exact"
rtol = 1e-12
output_dt = 0.25
frames = [0.25]
[nodes]
b = [0.0, 0.0]
[[masses]]
node = "b"
mass = 1.0
[[springs]]
node = "b"
direction = [1.0, 0.0]
stiffness = 40.0
[[contacts]]
name = "c"
node = "b"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e4
tangential_stiffness = 5e3
friction = { static = 0.4, kinetic = 0.2 }
[[loads]]
node = "b"
direction = [1.0, 0.0]
amplitude = 15.0
)";
  check_halves(whole, 0.25, [&](const std::string& run) {
    std::string second = with(whole, "t_end = 2.0", "t_end = 1.75");
    second = with(second, "frames = [0.25]\n", "");
    return with(second, "{ b = { uy = -0.001 } }", fmt::format("{{ run = \"{}\", t = 0.25 }}", run));
  });
}

TEST_CASE("a run in other units is refused, one of another structure taken with a warning") {
  const OwnFolder own;
  const auto folder = own.path() / "first";
  const std::string first = head + run_table(0.3, 0.1) + section(1e5, 3e3, 0.3) +
                            nodes({{"A", 0, 0}, {"B", 3, 1}}) + member("A, B") + fixed("A", "ux, uy, rz") +
                            "[[loads]]\nnode = \"B\"\ndirection = [1.0, 0.0]\namplitude = 1.0\n";
  const Model model = keep(folder, parse_scene(first, "first.toml"));
  const std::string on =
      with(first, "[run]\n", fmt::format("[run]\ninitial = {{ run = \"{}\" }}\n", folder.string()));

  CHECK(build_model(parse_scene(on, "second.toml")).warnings == model.warnings);
  // Loads may be others, and so may what drives supports.
  CHECK(build_model(parse_scene(with(on, "amplitude = 1.0", "amplitude = 2.0"), "second.toml")).warnings ==
        model.warnings);
  const auto warnings =
      build_model(parse_scene(with(on, "EA = 100000", "EA = 200000"), "second.toml")).warnings;
  REQUIRE(warnings.size() == model.warnings.size() + 1);
  CHECK(warnings.back().find("whose scene has other sections:") != std::string::npos);
  try {
    static_cast<void>(
        parse_scene(with(with(on, "length = \"m\"", "length = \"mm\""), "force = \"kN\"", "force = \"N\""),
                    "second.toml"));
    FAIL("other units");
  } catch (const SceneError& error) {
    CHECK(std::string(error.what())
              .find("run.initial.run: found a run in the units kN, t, m, s, expected the units of "
                    "this scene, N, t, mm, s") != std::string::npos);
  }
}

TEST_CASE("supports that accelerations drive go on where they were, as fast as they were") {
  const std::string quake =
      "{ type = \"harmonic\", omega = 11.0, phase = -1.5707963, amplitude = 3.0, end = 9.0 }";
  const std::string whole =
      head + run_table(2.0, 0.1) + "engine = \"exact\"\nrtol = 1e-12\nframes = [0.617]\n" +
      "[damping]\nalpha = 0.3\nbeta = 1e-4\n" + section(1e5, 3e3, 0.3) + nodes({{"A", 0, 0}, {"B", 3, 1}}) +
      member("A, B") + fixed("A", "ux, rz") + fixed("A", "uy", "acceleration = " + quake + "\n") +
      "[[contacts]]\nname = \"c\"\nnode = \"B\"\nlaw = \"compliant\"\nnormal = [0.0, 1.0]\n"
      "gap = 1e-3\nnormal_stiffness = 900.0\ntangential_stiffness = 700.0\nfriction = 0.2\n" +
      "[[output]]\nname = \"where\"\nkind = \"displacement\"\nat = \"A\"\ndirection = [0.0, 1.0]\n" +
      "[[output]]\nname = \"bears\"\nkind = \"reaction\"\nat = \"A\"\ndirection = [0.0, 1.0]\n";
  check_halves(whole, 0.617, [&](const std::string& run) {
    std::string second = with(whole, "t_end = 2", "t_end = 1.383");
    second =
        with(second, "frames = [0.617]\n", fmt::format("initial = {{ run = \"{}\", t = 0.617 }}\n", run));
    return with(second, "end = 9.0", "end = 9.0, shift = -0.617");
  });
}

TEST_CASE("scales stay those of the first run, so that rebounds end where they did") {
  const std::string whole = head + "gravity = [0.0, -9.81]\n" + run_table(1.5, 0.1) +
                            "engine = \"exact\"\nframes = [0.31]\n" + nodes({{"b", 0, 0}}) +
                            point_mass("b", 1.0) +
                            "[[contacts]]\nname = \"c\"\nnode = \"b\"\nlaw = \"rigid\"\nnormal = [0.0, 1.0]\n"
                            "gap = 0.1\nrestitution = 0.6\n" +
                            spring("b", "[1.0, 0.0]", 10.0);
  const auto on = [&](const std::string& run) {
    std::string second = with(whole, "t_end = 1.5", "t_end = 1.19");
    return with(second, "frames = [0.31]\n", fmt::format("initial = {{ run = \"{}\", t = 0.31 }}\n", run));
  };
  const OwnFolder own;
  const auto folder = own.path() / "first";
  const Model model = keep(folder, parse_scene(whole, "whole.toml"));
  const Model later = build_model(parse_scene(on(folder.string()), "second.toml"));
  CHECK(later.scales.velocity == model.scales.velocity);
  CHECK(later.scales.displacement == model.scales.displacement);
  CHECK(later.scales.force == model.scales.force);
  // Of another structure the scales are its own.
  const Model other =
      build_model(parse_scene(with(on(folder.string()), "mass = 1", "mass = 2"), "second.toml"));
  CHECK(other.scales.force != model.scales.force);
}

TEST_CASE("a spring and a dashpot at the ground go on as they were deformed, open ones too") {
  // Open from 0.3 on: the element comes to rest with ct / kt = 0.5.
  const std::string block = si + R"(gravity = [0.0, -10.0]
[run]
t_end = 1.0
[nodes]
b = [0.0, 0.0]
[[masses]]
node = "b"
mass = 1.0
[[springs]]
node = "b"
direction = [1.0, 0.0]
stiffness = 100.0
[[contacts]]
name = "c"
node = "b"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 10000.0
tangential_stiffness = 100.0
tangential_damping = 50.0
friction = 0.8
gap = -0.001
[[loads]]
node = "b"
direction = [1.0, 0.0]
amplitude = 5.0
history = { type = "rectangle", start = 0.0, end = 0.3 }
[[loads]]
node = "b"
direction = [0.0, 1.0]
amplitude = 30.0
history = { type = "rectangle", start = 0.3, end = 0.35 }
)";
  check_split(block, 0.35, 1e-12, 1e-10);
  check_split(block, 0.237, 1e-12, 1e-10);
  check_split(with(block, "[run]\n", "[reduction]\ncutoff_omega = 1e3\n[run]\n"), 0.35, 1e-12, 1e-10);
  const std::string slider = si + R"([run]
t_end = 3.0
[nodes]
b = [0.0, 0.0]
[[masses]]
node = "b"
mass = 1.0
[[supports]]
node = "b"
fix = ["uy"]
[[contacts]]
name = "c"
node = "b"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 20.0
friction = 0.5
tangential_stiffness = 100.0
tangential_damping = 2.0
surface_velocity = { type = "harmonic", omega = 3.0, amplitude = 0.05 }
[[loads]]
node = "b"
direction = [1.0, 0.0]
amplitude = 10.0
history = { type = "harmonic", omega = 7.0 }
)";
  check_split(slider, 0.4, 1e-12, 1e-10);
  check_split(slider, 0.25, 1e-12, 1e-10);
}

TEST_CASE("a reduced model with a rigid contact goes on with the velocities that it had") {
  check_split(si + R"(gravity = [0.0, -9.81]
[run]
t_end = 2.0
initial = "static"
[damping]
alpha = 0.3
[sections]
s = { EA = 1e6, EI = 1e3, mass_per_length = 2.0 }
[nodes]
A = [0.0, 0.0]
B = [1.0, 0.0]
C = [2.0, 0.0]
[[members]]
nodes = ["A", "B", "C"]
section = "s"
elements = 8
[[supports]]
node = "A"
fix = ["ux", "rz", "uy"]
[[contacts]]
name = "c"
node = "C"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e5
tangential_stiffness = 1e4
friction = 0.3
[[contacts]]
name = "r"
node = "B"
law = "rigid"
normal = [0.0, -1.0]
gap = 0.02
friction = 0.2
restitution = 0.3
capture_velocity = 1e-6
[[loads]]
node = "C"
direction = [0.3, 1.0]
amplitude = 30.0
history = { type = "harmonic", omega = 11.0 }
[reduction]
cutoff_omega = 400.0
)",
              0.55, 1e-9, 1e-7);
}

TEST_CASE("damping by omega1 is that of the contacts that were closed at the very start") {
  // Closed at 0, open at the split: omega1 would be the lower one.
  check_split(si + R"([run]
t_end = 2.0
initial = { b = { uy = -0.01 } }
[damping]
alpha_over_omega1 = 0.05
[nodes]
b = [0.0, 0.0]
[[masses]]
node = "b"
mass = 1.0
[[supports]]
node = "b"
fix = ["ux"]
[[springs]]
node = "b"
direction = [0.0, 1.0]
stiffness = 100.0
[[contacts]]
name = "c"
node = "b"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e4
)",
              0.1, 1e-12, 1e-10);
}

TEST_CASE("what drives a structure is none of it: temperatures may go on") {
  const OwnFolder own;
  const auto folder = own.path() / "first";
  const std::string first =
      head + run_table(0.3, 0.1) + section(1e5, 3e3, 0.3) + nodes({{"A", 0, 0}, {"B", 3, 1}}) +
      member("A, B",
             "thermal_expansion = 1e-5\ntemperature = { type = \"harmonic\", omega = 9.0, "
             "amplitude = 80.0 }\n") +
      fixed("A", "ux, uy, rz");
  const Model model = keep(folder, parse_scene(first, "first.toml"));
  const std::string on = with(with(first, "amplitude = 80.0", "amplitude = 80.0, shift = -0.3"), "[run]\n",
                              fmt::format("[run]\ninitial = {{ run = \"{}\" }}\n", folder.string()));
  CHECK(build_model(parse_scene(on, "second.toml")).warnings == model.warnings);
  const std::string longer = with(on, "thermal_expansion = 1e-5", "thermal_expansion = 2e-5");
  CHECK(build_model(parse_scene(longer, "second.toml")).warnings.size() == model.warnings.size() + 1);
}

TEST_SUITE_END();

// Rounding of the split grows as that of the run does: most in the chain.
TEST_SUITE_BEGIN("slow/behaviour/going_on");

TEST_CASE("exact in halves by series") {
  check_all({{"run.engine", "exact"}, {"run.flow", "taylor"}, {"run.rtol", "1e-10"}}, 0.3819660112501051,
            1e-8, 1e-5);
}
TEST_CASE("exact in halves by modes where they can be") {
  check_all({{"run.engine", "exact"}, {"run.rtol", "1e-10"}}, 0.7236067977499789, 1e-8, 1e-5, {{"piping"}});
}
TEST_CASE("ida in halves") {
  check_all({{"run.engine", "ida"}, {"run.rtol", "1e-10"}}, 0.3819660112501051, 1e-5, 1e-4,
            {{"chain", "dry-joint", "piping"}});
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("deep/behaviour/going_on");

TEST_CASE("piping by modes and the dry joint by ida in halves") {
  check_all({{"run.engine", "exact"}, {"run.rtol", "1e-10"}}, 0.7236067977499789, 1e-8, 1e-5,
            {{}, {"piping"}});
  check_all({{"run.engine", "ida"}, {"run.rtol", "1e-10"}}, 0.3819660112501051, 1e-5, 1e-4,
            {{}, {"dry-joint"}});
}

TEST_SUITE_END();

}  // namespace signorini::tests::going_on
