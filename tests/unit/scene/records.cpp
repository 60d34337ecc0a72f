// Records in files, rows of nodes, stops: what the reader makes of them.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "own_folder.hpp"
#include "scene/history_from_spec.hpp"
#include "scene/saved_state.hpp"
#include "scene/time_table.hpp"
#include "signorini/model.hpp"

namespace signorini::tests::records {
namespace {

Scene says() { return read_scene(SIGNORINI_TEST_DATA "/scenes/good/says.toml"); }

std::string refusal(const std::string& text, const scene::TableLayout& layout) {
  std::istringstream in(text);
  try {
    (void)scene::read_time_table(in, "file", "key", layout);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

/// A PEER file of acceleration, as `base_motion` takes it.
scene::TableLayout peer(bool unit_given = false) {
  scene::TableLayout layout;
  layout.peer = true;
  layout.wanted = scene::RecordQuantity::acceleration;
  layout.unit_given = unit_given;
  return layout;
}

const std::string heading = "PEER\nmade up\nACCELERATION TIME SERIES IN UNITS OF G\n";

}  // namespace

TEST_SUITE_BEGIN("unit/scene/records");

TEST_CASE("a record of PEER, in g") {
  const Scene scene = says();
  const HistorySpec& quake = scene.base_motion.at(0).acceleration;
  CHECK(quake.times == std::vector<double>{0.0, 0.05, 2 * 0.05, 3 * 0.05, 4 * 0.05, 5 * 0.05});
  const double in_g[] = {0.0, 0.01, -0.025, 0.04, -0.01, 0.0};
  REQUIRE(quake.values.size() == 6);
  for (std::size_t i = 0; i < 6; ++i)
    CHECK(quake.values[i] == doctest::Approx(in_g[i] * 9.80665).epsilon(1e-15));
  CHECK(quake.amplitude == 2.0);
  std::istringstream older(heading + "    3    0.0100   NPTS, DT\n 1 2 3\n");
  const scene::TimeTable table = scene::read_time_table(older, "file", "key", peer());
  CHECK(table.unit.value().name == "g");
  CHECK(table.times == std::vector<double>{0.0, 0.01, 0.02});
  CHECK(refusal(heading + "NPTS= 4, DT= .01\n1 2 3\n", peer()).find("expected 4, the number given by NPTS") !=
        std::string::npos);
  CHECK(refusal(heading + "no numbers\n1 2 3\n", peer()).find("in the fourth line of the PEER file") !=
        std::string::npos);
}

TEST_CASE("columns, values alone, periods and shifts") {
  const Scene scene = says();
  const HistorySpec& up = scene.base_motion.at(1).acceleration;
  CHECK(up.values == std::vector<double>{1.0, 2.0, 3.0});
  const History f = scene::make_history(up, "f");
  for (const double t : {1.05, 1.25, 1.45, 1.85})
    CHECK(f.value(t) == doctest::Approx(1.5 * 9.80665).epsilon(1e-12));
  CHECK(f.value(0.9) == 0.0);
  const HistorySpec& wind = scene.loads.at(2).history;
  CHECK(wind.values == std::vector<double>{0.0, 1.0, 4.0, 9.0, 16.0, 25.0});
  CHECK(wind.times.back() == 0.625);
  const History pulses = scene::make_history(scene.loads.at(1).history, "f");
  CHECK(pulses.value(0.3) == 0.0);
  CHECK(pulses.value(0.4) == 1.0);
  CHECK(pulses.value(0.7) == 0.0);
  CHECK(pulses.value(0.9) == 1.0);
  const History heat = scene::make_history(scene.members.at(0).temperature, "f");
  CHECK(heat.value(0.5) == 50.0);
  CHECK(heat.value(7.0) == 60.0);
  CHECK(refusal("0 1\n1 2 3\n", {3, 0.0, false}).find("a value in column 3") != std::string::npos);
}

TEST_CASE("a heading of times and values is none of values alone") {
  for (const char* text : {"t,a\n0,0\n0.5,1\n", "# m\nTime (s); force\n0;0\n0.5;1\n"}) {
    CHECK(refusal(text, {0, 0.25, false}).find("expected values only, because time_step is given") !=
          std::string::npos);
    CHECK(refusal(text, {}) == "none");
  }
  for (const char* text : {"force\n0 0\n0.5 1\n", "t\n0 0\n", "total force\n0 0\n"})
    CHECK(refusal(text, {0, 0.25, false}) == "none");
}

TEST_CASE("rows of nodes, contacts on many, stops on both sides") {
  const Scene scene = says();
  CHECK(scene.nodes.size() == 8);
  CHECK(scene.nodes.at(4).name == "P3");
  CHECK(scene.nodes.at(4).x == 6.0);
  CHECK(scene.members.at(0).nodes.size() == 7);
  std::vector<std::string> names;
  for (const ContactSpec& c : scene.contacts) names.push_back(c.name);
  CHECK(names == std::vector<std::string>{"rack-P2", "rack-P4", "rack-P6", "rack-P5", "guide-P4+",
                                          "guide-P4-", "line+", "line-"});
  const ContactSpec &forth = scene.contacts.at(4), &back = scene.contacts.at(5);
  CHECK(forth.normal->vector[0] == -1.0);
  CHECK(forth.gap == 0.01);
  CHECK(back.normal->vector[0] == 1.0);
  CHECK(back.gap == 0.02);
  CHECK(scene.contacts.at(7).restitution == 0.2);
}

TEST_CASE("vectors from files") {
  const Scene scene = read_scene(SIGNORINI_TEST_DATA "/scenes/good/vectors.toml");
  CHECK(scene.initial.u == std::vector<double>{0.5, -1.0});
  CHECK(scene.loads.at(0).direction.dofs.at(1).second == -1.0);
}

TEST_CASE("a record of PEER in other units, and what is no acceleration") {
  const auto with = [](const std::string& unit) {
    return "PEER\nmade up\n" + unit + "\nNPTS= 2, DT= .01\n1 2\n";
  };
  const auto factor = [&](const std::string& unit) {
    std::istringstream in(with("ACCELERATION TIME HISTORY IN UNITS OF " + unit));
    return scene::read_time_table(in, "file", "key", peer()).unit.value().si;
  };
  CHECK(factor("G") == 9.80665);
  CHECK(factor("cm/s/s") == 0.01);
  CHECK(factor("CM/SEC**2") == 0.01);
  CHECK(factor("CM/SEC/SEC") == 0.01);
  CHECK(factor("GAL") == 0.01);
  CHECK(factor("MM / S^2") == 0.001);
  CHECK(factor("M/S2") == 1.0);
  for (const char* unit :
       {"VELOCITY IN UNITS OF CM/S", "DISPLACEMENT IN UNITS OF CM", "IN UNITS OF", "IN UNITS OF GG"})
    CHECK(refusal(with(unit), peer()).find("file:3: key: found \"" + std::string(unit) + "\"") == 0);
  CHECK(refusal(with("no unit"), peer()).find("file:3:") == 0);
  CHECK(refusal(with("no unit"), peer(true)) == "none");  // the scene says it
}

TEST_CASE("a record in cm/s^2 is one in the scene's units, written out or not") {
  const signorini::tests::OwnFolder own;
  const auto file = own.path() / "record.at2";
  std::ofstream(file)
      << "PEER\nmade up\nACCELERATION TIME SERIES IN UNITS OF CM/SEC/SEC\nNPTS= 3, DT= .01\n0 50 -25\n";
  const auto text = [&](const std::string& more) {
    return "schema = 1\nunits = { force = \"N\", mass = \"t\", length = \"mm\", time = \"s\" }\n[run]\nt_end "
           "= "
           "1.0\n[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = 1.0\n[base_motion]\ndirection = "
           "[1.0, "
           "0.0]\nacceleration = { type = \"table\", file = \"" +
           file.string() + "\"" + more + " }\n";
  };
  const Scene scene = parse_scene(text(""), "test.toml");
  CHECK(scene.base_motion.at(0).acceleration.values == std::vector<double>{0.0, 500.0, -250.0});
  CHECK(scene.base_motion.at(0).acceleration.amplitude == 1.0);
  CHECK(parse_scene(scene.resolved, "run.toml").base_motion.at(0).acceleration.values ==
        scene.base_motion.at(0).acceleration.values);
  CHECK_THROWS_AS((void)parse_scene(text(", unit = \"g\""), "test.toml"), SceneError);
  // Its step is in seconds: in a scene in milliseconds it is ten of them. kN = kg mm/ms^2
  std::string fast = text("");
  for (const auto& [from, to] : {std::pair("\"s\"", "\"ms\""), {"\"t\"", "\"kg\""}, {"\"N\"", "\"kN\""}})
    fast.replace(fast.find(from), std::string(from).size(), to);
  const HistorySpec quick = parse_scene(fast, "test.toml").base_motion.at(0).acceleration;
  CHECK(quick.times == std::vector<double>{0.0, 10.0, 20.0});
  CHECK(quick.values.at(1) == doctest::Approx(5e-4).epsilon(1e-15));
}

TEST_CASE(
    "the offset of a record is in the scene's units, whatever unit its header names; with unit it is in g") {
  const signorini::tests::OwnFolder own;
  const auto read = [&](const std::string& unit, const std::string& rows, const std::string& more) {
    const auto file = own.path() / "record.at2";
    std::ofstream(file) << "PEER\nmade up\nACCELERATION TIME SERIES IN UNITS OF " << unit
                        << "\nNPTS= 3, DT= .01\n"
                        << rows << "\n";
    return parse_scene(
        "schema = 1\nunits = { force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }\n"
        "[run]\nt_end = 1.0\n[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = 1.0\n"
        "[base_motion]\ndirection = [1.0, 0.0]\nacceleration = { type = \"table\", file = \"" +
            file.string() + "\", amplitude = 1.5, offset = 0.7" + more + " }\n",
        "test.toml");
  };
  const auto value = [](const Scene& scene, double t) {
    return scene::make_history(scene.base_motion.at(0).acceleration, "f").value(t);
  };
  const Scene in_g = read("G", "0.1 0.3 -0.2", ""), in_cm = read("CM/S/S", "98.0665 294.1995 -196.133", "");
  const Scene all_in_g = read("G", "0.1 0.3 -0.2", ", unit = \"g\"");
  const Scene again = parse_scene(in_g.resolved, "run.toml"),
              all_again = parse_scene(all_in_g.resolved, "run.toml");
  for (const auto& [t, a] : {std::pair(0.0, 0.1), {0.005, 0.2}, {0.01, 0.3}, {0.015, 0.05}}) {
    CAPTURE(t);
    const double shaken = 1.5 * a * 9.80665;
    CHECK(value(in_g, t) == doctest::Approx(shaken + 0.7).epsilon(1e-14));
    CHECK(value(in_cm, t) == doctest::Approx(shaken + 0.7).epsilon(1e-14));
    CHECK(value(again, t) == value(in_g, t));
    CHECK(value(all_in_g, t) == doctest::Approx(shaken + 0.7 * 9.80665).epsilon(1e-14));
    CHECK(value(all_again, t) == value(all_in_g, t));
  }
}

TEST_CASE("cells may be parted by blanks, not be empty") {
  CHECK(refusal("0.0 , 1.0\n0.2;2.0,\n0.4\t \t3.0\n", {}) == "none");
  for (const char* line : {"0.2,,1.0", ",0.2,1.0", "0.2, ; 1.0"})
    CHECK(refusal(std::string("0.0,1.0\n") + line + "\n", {}).find("expected no empty cell") !=
          std::string::npos);
}

TEST_CASE("hold beside a period: the last value holds until the shape begins anew") {
  HistorySpec spec;
  spec.type = HistoryType::table;
  spec.times = {1.0, 1.2};
  spec.values = {0.0, 4.0};
  spec.hold = true;
  spec.period = 0.5;
  spec.rounds = 3;
  const History f = scene::make_history(spec, "f");
  CHECK(f.value(1.3) == 4.0);
  CHECK(f.value(1.6) == doctest::Approx(2.0).epsilon(1e-13));
  CHECK(f.value(1.9) == 4.0);
  CHECK(f.value(9.0) == 4.0);
}

TEST_CASE("a saved state: the time asked for, or the last") {
  const std::string file = "t,A.ux,A.vx,c.T\n0.5,1,2,3\n1.5,4,5,6\n";
  std::istringstream first(file), last(file), none(file);
  CHECK(scene::read_saved_states(first, "file", "key", 0.5).state.value().motions.at(1).second == 2.0);
  CHECK(scene::read_saved_states(last, "file", "key", std::nullopt).state.value().shears.at(0).second == 6.0);
  const scene::SavedStates others = scene::read_saved_states(none, "file", "key", 0.7);
  CHECK_FALSE(others.state);
  CHECK(others.times == std::vector<std::string>{"0.5", "1.5"});
  std::istringstream cut(file + "2.5,7,8"), wrong(file + "2.5,7,x,9\n");
  CHECK(scene::read_saved_states(cut, "file", "key", std::nullopt).state.value().shears.at(0).second == 6.0);
  CHECK_THROWS_WITH_AS((void)scene::read_saved_states(wrong, "file", "key", 0.5),
                       "file:4: key: found \"x\", expected a number", SceneError);
}

TEST_SUITE_END();

}  // namespace signorini::tests::records
