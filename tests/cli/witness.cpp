// signorini witness: a run is checked by its files alone; each alteration of one is found.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "behaviour/witness_scenes.hpp"
#include "cli/program.hpp"

using namespace signorini::cli_test;
using signorini::tests::witnessed::feet_text;
using signorini::tests::witnessed::held_text;
using signorini::tests::witnessed::scene_text;
using signorini::tests::witnessed::sliders_text;

TEST_SUITE_BEGIN("cli/witness");

namespace {

using Cells = std::vector<std::string>;

/// A table without quotes.
std::vector<Cells> cells_of(const std::string& text) {
  std::vector<Cells> table;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    Cells row;
    std::string cell;
    for (const char c : line + ",") {
      if (c == ',')
        row.push_back(std::exchange(cell, ""));
      else
        cell += c;
    }
    table.push_back(row);
  }
  return table;
}

std::string text_of_table(const std::vector<Cells>& table) {
  std::string text;
  for (const Cells& row : table) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + row[i];
    text += "\n";
  }
  return text;
}

std::size_t column_called(const std::vector<Cells>& table, const std::string& name) {
  const auto found = std::find(table[0].begin(), table[0].end(), name);
  REQUIRE(found != table[0].end());
  return static_cast<std::size_t>(found - table[0].begin());
}

/// The first row from the middle on for which this holds.
std::size_t row_with(const std::vector<Cells>& table, const std::function<bool(const Cells&)>& wanted) {
  for (std::size_t i = table.size() / 2; i < table.size(); ++i)
    if (wanted(table[i])) return i;
  FAIL("no such row");
  return 0;
}

std::string times(const std::string& number, double factor) {
  std::ostringstream text;
  text.precision(17);
  text << std::stod(number) * factor;
  return text.str();
}

using Alteration = std::function<void(std::vector<Cells>&)>;

/// Multiplies a cell of the first row from the middle on that is of an event of this type, or of this state.
Alteration scaled(const std::string& key, const std::string& value, const std::string& name, double factor) {
  return [=](std::vector<Cells>& table) {
    const std::size_t k = column_called(table, key), x = column_called(table, name);
    const std::size_t row = row_with(table, [&](const Cells& c) {
      return c[k] == value && !c[x].empty() && std::abs(std::stod(c[x])) > 1e-7;
    });
    table[row][x] = times(table[row][x], factor);
  };
}

Alteration dropped(const std::string& key, const std::string& value) {
  return [=](std::vector<Cells>& table) {
    const std::size_t k = column_called(table, key);
    table.erase(table.begin() +
                static_cast<std::ptrdiff_t>(row_with(table, [&](const Cells& c) { return c[k] == value; })));
  };
}

/// The cell of such a row is this text.
Alteration written_as(const std::string& key, const std::string& value, const std::string& name,
                      const std::string& text) {
  return [=](std::vector<Cells>& table) {
    const std::size_t k = column_called(table, key), x = column_called(table, name);
    table[row_with(table, [&](const Cells& c) { return c[k] == value && !c[x].empty(); })][x] = text;
  };
}

/// An instant, at which a contact changes its state, is in no file: its rows of instants.csv and events.csv, its counts.
void forget_an_event(const Shell& shell) {
  std::vector<Cells> events = cells_of(shell.read("kept/events.csv"));
  const std::size_t type = column_called(events, "event");
  const std::string t = events[row_with(events, [&](const Cells& c) { return c[type] == "stick"; })][0];
  auto summary = nlohmann::ordered_json::parse(shell.read("kept/summary.json"));
  for (const Cells& row : events) {
    if (row[0] != t) continue;
    summary["events"]["total"] = summary["events"]["total"].get<long>() - 1;
    summary["events"]["by_type"][row[type]] = summary["events"]["by_type"][row[type]].get<long>() - 1;
  }
  std::vector<Cells> instants = cells_of(shell.read("kept/instants.csv"));
  for (std::vector<Cells>* table : {&events, &instants})
    std::erase_if(*table, [&](const Cells& row) { return row[0] == t; });
  shell.write("kept/events.csv", text_of_table(events));
  shell.write("kept/instants.csv", text_of_table(instants));
  shell.write("kept/summary.json", summary.dump());
}

/// The table up to a part of its rows.
std::string first_rows(const std::string& text, double part) {
  std::vector<Cells> table = cells_of(text);
  table.resize(1 + static_cast<std::size_t>(part * static_cast<double>(table.size() - 1)));
  return text_of_table(table);
}

void halve_a_blow(std::vector<Cells>& table) {
  const std::size_t x = column_called(table, "floor.blows");
  const std::size_t row =
      row_with(table, [&](const Cells& c) { return c[x].find(':') != std::string::npos; });
  const std::size_t colon = table[row][x].find(':'), next = table[row][x].find(':', colon + 1);
  table[row][x] = table[row][x].substr(0, colon + 1) +
                  times(table[row][x].substr(colon + 1, next - colon - 1), 0.5) + table[row][x].substr(next);
}

/// Both sides of an instant a millionth later.
void shift_an_instant(std::vector<Cells>& table) {
  const std::size_t side = column_called(table, "side");
  const std::size_t row = row_with(table, [&](const Cells& c) { return c[side] == "before"; });
  table[row][0] = table[row + 1][0] = times(table[row][0], 1.0 + 1e-6);
}

void forget_a_velocity(std::vector<Cells>& table) {
  const std::size_t side = column_called(table, "side"), v = column_called(table, "A.vy");
  const std::size_t row = row_with(table, [&](const Cells& c) { return c[side] == "after"; });
  table[row][v] = times(table[row][v], 1.0 + 1e-9);
}

/// A run without its manifest, so that the laws alone notice alterations of its files.
Ending forged(const Shell& shell, const std::vector<std::string>& arguments) {
  Ending ending = shell.run(arguments);
  std::filesystem::remove(shell / "kept/manifest.json");
  return ending;
}

/// What the witness says of a run of this scene.
Ending witness_of_untouched(const char* text, const char* engine) {
  const Shell shell;
  shell.write("planted.toml", text);
  REQUIRE(shell.run({"run", "planted.toml", "-o", "kept", "--instants", "--engine", engine}).code == 0);
  return shell.run({"witness", "kept"});
}

}  // namespace

TEST_CASE("cli witness: a run that nobody touched keeps all laws, by its files alone") {
  for (const char* text : {scene_text, sliders_text, feet_text, held_text})
    for (const char* engine : {"exact", "ida", "newmark"}) {
      CAPTURE(text);
      CAPTURE(engine);
      const Ending ending = witness_of_untouched(text, engine);
      CHECK(ending.code == 0);
      CHECK(ending.out.find("all laws hold") != std::string::npos);
      CHECK(ending.err == "");
      if (ending.code != 0) MESSAGE(ending.out);
    }
}

TEST_CASE(
    "cli witness: a pendulum under a force that varies, and a surface that moves far between two instants") {
  const char* pendulum = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 3.0
rtol = 1e-11
initial = { a = { ux = 0.038242109364224425, uy = 0.03221088436188455, vx = 0.1529684374568977, vy = 0.1288435374475382 } }
[nodes]
a = [0.3, -0.2]
[[masses]]
node = "a"
mass = 2.0
[[springs]]
node = "a"
direction = [-0.644217687237691, 0.7648421872844885]
stiffness = 1000.0
[[loads]]
node = "a"
direction = [0.7648421872844885, 0.644217687237691]
amplitude = 6.0
history = { type = "harmonic", omega = 4.0 }
[[pendulums]]
name = "p"
node = "a"
normal = [-1.932653061713073, 2.2945265618534654]
radius = 0.5
normal_force = { type = "harmonic", offset = 20.0, amplitude = 12.0, omega = 7.0 }
tangential_stiffness = 400.0
friction = { static = 0.1, kinetic = 0.07 }
)";
  const char* surface = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1.5
output_dt = 0.5
rtol = 1e-10
[nodes]
a = [0.0, 0.0]
[[masses]]
node = "a"
mass = 2.5
[[supports]]
node = "a"
fix = ["uy"]
[[contacts]]
name = "c"
node = "a"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 1000.0
friction = 0.9
tangential_stiffness = 40.0
surface_velocity = { type = "harmonic", frequency = 2.1, start = 0.2, end = 1.4, amplitude = 0.8, offset = 0.15 }
)";
  for (const auto& [text, engine] :
       {std::pair(pendulum, "ida"), std::pair(surface, "exact"), std::pair(surface, "ida")}) {
    CAPTURE(text);
    CAPTURE(engine);
    const Ending ending = witness_of_untouched(text, engine);
    CHECK(ending.code == 0);
    if (ending.code != 0) MESSAGE(ending.out);
  }
}

TEST_CASE("cli witness: a run that stops has rows of a step that leads to no instant, and no peak of it") {
  // Slides from 1.5 m/s until two sliders would stick on the one degree of freedom,
  // which share no force, as one is on a belt that starts later.
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "5.0\noutput_dt = 0.01\ninitial = { u = [0.0], v = [1.5] }\n[matrices]\nmass = [[1.0]]\n"
      "stiffness = [[1.0]]\n";
  for (const char* name : {"a", "b"})
    text += std::string("[[contacts]]\nname = \"") + name +
            "\"\nlaw = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 2.0\nfriction = 0.4\n";
  text += "surface_velocity = { type = \"rectangle\", start = 50.0, end = 60.0, amplitude = 1.0 }\n";
  for (const char* engine : {"exact", "ida"}) {
    CAPTURE(engine);
    const Shell shell;
    shell.write("two.toml", text);
    REQUIRE(forged(shell, {"run", "two.toml", "-o", "kept", "--instants", "--engine", engine}).code == 4);
    const Ending ending = shell.run({"witness", "kept"});
    CHECK(ending.code == 0);
    if (ending.code != 0) MESSAGE(ending.out);
    // A run that came to its end has an instant there, and no such rows.
    std::string summary = shell.read("kept/summary.json");
    const std::size_t kind = summary.find("\"stopped\"");
    REQUIRE(kind != std::string::npos);
    shell.write("kept/summary.json", summary.replace(kind, 9, "\"done\""));
    const Ending done = shell.run({"witness", "kept"});
    CHECK(done.code == 6);
    CHECK(done.err.find("found the end of the file, expected the instant at t = ") != std::string::npos);
  }
}

TEST_CASE("cli witness: every alteration of a file is found") {
  const Shell shell;
  shell.write("planted.toml", scene_text);
  REQUIRE(forged(shell, {"run", "planted.toml", "-o", "kept", "--instants", "--engine", "exact"}).code == 0);
  struct Altered {
    const char *file, *law;
    Alteration alter;
  };
  const std::vector<Altered> all = {
      {"events.csv", "row", scaled("event", "impact", "impulse_n", 0.5)},
      {"instants.csv", "momentum", halve_a_blow},
      {"events.csv", "record", scaled("event", "impact", "t", 1.0 + 1e-6)},
      {"instants.csv", "record", shift_an_instant},
      {"instants.csv", "momentum", forget_a_velocity},
      {"events.csv", "record", dropped("event", "slip")},
      {"events.csv", "count of", dropped("event", "impact")},
      {"events.csv", "row", scaled("event", "stick", "T_after", -1.0)},
      {"events.csv", "row", scaled("event", "impact", "vn_after", 0.9)},
      {"instants.csv", "friction", scaled("foot.state", "slip+", "foot.T", -1.0)},
      {"contacts.csv", "rows", dropped("contact", "foot")},
      {"contacts.csv", "friction force", scaled("state", "slip+", "T", -1.0)},
      {"contacts.csv", "friction force", scaled("state", "stick", "T", -1.0)},
      {"contacts.csv", "normal force", scaled("contact", "foot", "N", 1.001)},
      {"contacts.csv", "ratio", scaled("state", "slip+", "ratio", 1.001)},
      {"motion.csv", "ratio", scaled("state", "stick", "ratio", 1.001)},
      {"motion.csv", "peak", scaled("contact", "foot", "ut", 1e4)},
      {"events.csv", "row", scaled("event", "stick", "N", 1.001)},
      {"events.csv", "row", scaled("event", "stick", "N", -1.0)},
      {"events.csv", "row", scaled("event", "slip", "T", 1.001)},
      {"events.csv", "row", scaled("event", "slip", "T", -1.0)},
      {"events.csv", "row", scaled("event", "slip", "gap", 1.001)},
      {"events.csv", "row", written_as("event", "slip", "gap", "")},
      {"events.csv", "row", scaled("event", "slip", "vn", 1.0 + 1e-6)},
      {"instants.csv", "equilibrium", scaled("side", "after", "A.ux.acceleration", 1.01)},
      {"instants.csv", "equilibrium", scaled("side", "after", "B.uy.acceleration", 1.01)},
      {"instants.csv", "unbroken state", scaled("foot.state", "stick", "foot.p", 1.0 + 1e-9)},
      {"contacts.csv", "slip", scaled("state", "stick", "slip", 1.001)},
  };
  for (const Altered& one : all) {
    const std::string which = std::string(one.file) + ": " + one.law;
    CAPTURE(which);
    const std::string name = std::string("kept/") + one.file, text = shell.read(name);
    std::vector<Cells> table = cells_of(text);
    one.alter(table);
    shell.write(name, text_of_table(table));
    const Ending ending = shell.run({"witness", "kept"});
    CHECK(ending.code == 5);
    CHECK(ending.out.find(one.law) != std::string::npos);
    shell.write(name, text);
  }
  CHECK(shell.run({"witness", "kept"}).code == 0);
  // Older runs lack the last column of contacts.csv.
  const std::string kept = shell.read("kept/contacts.csv");
  std::vector<Cells> older = cells_of(kept);
  for (Cells& row : older) row.pop_back();
  shell.write("kept/contacts.csv", text_of_table(older));
  CHECK(shell.run({"witness", "kept"}).code == 0);
  shell.write("kept/contacts.csv", kept);
  auto summary = nlohmann::ordered_json::parse(shell.read("kept/summary.json"));
  summary["contacts"][1]["peaks"]["N"] = 0.5 * summary["contacts"][1]["peaks"]["N"].get<double>();
  shell.write("kept/summary.json", summary.dump());
  const Ending ending = shell.run({"witness", "kept"});
  CHECK(ending.code == 5);
  CHECK(ending.out.find("peak") != std::string::npos);
}

TEST_CASE(
    "cli witness: values before an event are known with an engine of tolerances, too, and to rigid "
    "contacts") {
  const Shell shell;
  for (const auto& [text, engine] :
       {std::pair(scene_text, "ida"), std::pair(feet_text, "exact"), std::pair(feet_text, "ida")}) {
    CAPTURE(engine);
    shell.write("planted.toml", text);
    REQUIRE(forged(shell, {"run", "planted.toml", "-o", "kept", "--instants", "--force", "--engine", engine})
                .code == 0);
    const std::string kept = shell.read("kept/events.csv");
    for (const char* force : {"N", "T"})
      for (const double factor : {100.0, -1.0, 1.01}) {
        CAPTURE(force);
        CAPTURE(factor);
        std::vector<Cells> table = cells_of(kept);
        scaled("event", "slip", force, factor)(table);
        shell.write("kept/events.csv", text_of_table(table));
        const Ending ending = shell.run({"witness", "kept"});
        CHECK(ending.code == 5);
        CHECK(ending.out.find("row") != std::string::npos);
      }
    for (const char* speed : {"vn", "vt"}) {
      if (text != scene_text) continue;
      CAPTURE(speed);
      std::vector<Cells> table = cells_of(kept);
      scaled("event", "stick", speed, 1.0 + 1e-6)(table);
      shell.write("kept/events.csv", text_of_table(table));
      CHECK(shell.run({"witness", "kept"}).code == 5);
    }
    shell.write("kept/events.csv", kept);
    CHECK(shell.run({"witness", "kept"}).code == 0);
  }
}

TEST_CASE("cli witness: an event that is in no file breaks the states before the next one") {
  const Shell shell;
  shell.write("planted.toml", scene_text);
  for (const char* engine : {"exact", "ida", "newmark"}) {
    CAPTURE(engine);
    REQUIRE(forged(shell, {"run", "planted.toml", "-o", "kept", "--instants", "--force", "--engine", engine})
                .code == 0);
    forget_an_event(shell);
    const Ending ending = shell.run({"witness", "kept"});
    CHECK(ending.code == 5);
    CHECK(ending.out.find("unbroken state") != std::string::npos);
    CHECK(ending.out.find("count of") == std::string::npos);
  }
}

TEST_CASE("cli witness: a scene that is not that of the run") {
  const Shell shell;
  shell.write("planted.toml", scene_text);
  REQUIRE(forged(shell, {"run", "planted.toml", "-o", "kept", "--instants", "--engine", "exact"}).code == 0);
  const std::string kept = shell.read("kept/run.toml");
  struct Edit {
    const char *from, *to, *law;
  };
  const Edit edits[] = {
      {"gravity = [0.7, -9.6]", "gravity = [0.7, -9.61]", "equilibrium"},
      {"mass = 1.3", "mass = 1.3001", "equilibrium"},
      {"stiffness = 170.0", "stiffness = 170.1", "equilibrium"},
      {"amplitude = 27.0", "amplitude = 27.01", "equilibrium"},
      {"frequency = 3.1", "frequency = 3.101", "equilibrium"},
      {"vx = 1.3", "vx = 1.300001", "initial values"},
      {"engine = \"exact\"", "engine = \"ida\"", "engine"},
      {"t_end = 1.5", "t_end = 1.2", "rows"},
  };
  for (const Edit& edit : edits) {
    CAPTURE(edit.to);
    std::string text = kept;
    const std::size_t at = text.find(edit.from);
    REQUIRE(at != std::string::npos);
    shell.write("kept/run.toml", text.replace(at, std::string(edit.from).size(), edit.to));
    const Ending ending = shell.run({"witness", "kept"});
    CHECK(ending.code == 5);
    CHECK(ending.out.find(edit.law) != std::string::npos);
  }
}

TEST_CASE("cli witness: a summary that says something else than the tables") {
  const Shell shell;
  shell.write("planted.toml", scene_text);
  REQUIRE(forged(shell, {"run", "planted.toml", "-o", "kept", "--instants", "--engine", "exact"}).code == 0);
  const std::string kept = shell.read("kept/summary.json");
  const auto ends = [&](int code, const std::string& what,
                        const std::function<void(nlohmann::ordered_json&)>& alter) {
    auto summary = nlohmann::ordered_json::parse(kept);
    alter(summary);
    shell.write("kept/summary.json", summary.dump());
    const Ending ending = shell.run({"witness", "kept"});
    CAPTURE(what);
    CHECK(ending.code == code);
    CHECK((ending.out + ending.err).find(what) != std::string::npos);
  };
  using Json = nlohmann::ordered_json;
  ends(5, "count of events", [](Json& s) { s["events"]["total"] = s["events"]["total"].get<long>() + 1; });
  ends(5, "load", [](Json& s) { s["contacts"][1]["load"]["N"]["least"]["value"] = -1.0; });
  ends(6, "outcome.kind: found \"running\"", [](Json& s) { s["outcome"]["kind"] = "running"; });
  ends(6, "contacts: found 1, expected 2 as in run.toml", [](Json& s) { s["contacts"].erase(0); });
  ends(6, "units.force: found \"kN\", expected \"N\" as in run.toml",
       [](Json& s) { s["units"]["force"] = "kN"; });
}

TEST_CASE("cli witness: tables that end before the run does") {
  const Shell shell;
  shell.write("planted.toml", scene_text);
  REQUIRE(forged(shell, {"run", "planted.toml", "-o", "kept", "--instants", "--engine", "exact"}).code == 0);
  const auto cut = [&](const std::string& file, const std::string& left, const std::string& what) {
    const std::string name = "kept/" + file, whole = shell.read(name);
    CAPTURE(file);
    CAPTURE(what);
    shell.write(name, left);
    const Ending ending = shell.run({"witness", "kept"});
    CHECK(ending.code == 6);
    CHECK(ending.err.find(name + ": line ") != std::string::npos);
    CHECK(ending.err.find(what) != std::string::npos);
    CHECK(ending.err.find("the file is cut") != std::string::npos);
    CHECK(ending.out == "");
    shell.write(name, whole);
  };
  const std::string contacts = shell.read("kept/contacts.csv"), motion = shell.read("kept/motion.csv"),
                    events = shell.read("kept/events.csv"), instants = shell.read("kept/instants.csv");
  // 501 times of two contacts behind the header.
  cut("contacts.csv", first_rows(contacts, 0.5),
      "line 503: found the end of the file, expected the row of contact \"foot\" at t = 0.75");
  cut("contacts.csv", first_rows(contacts, 0.0),
      "line 2: found the end of the file, expected the row of contact \"floor\" at t = 0;");
  cut("contacts.csv", contacts.substr(0, contacts.size() - 1),
      "found no line break, expected the row of contact \"foot\" at t = 1.5");
  cut("motion.csv", first_rows(motion, 0.0),
      "line 2: found the end of the file, expected rows of contact \"floor\"");
  cut("motion.csv", first_rows(motion, 0.1), "expected rows of contact \"foot\"");
  cut("motion.csv", first_rows(motion, 0.9), "expected rows of contact \"foot\" up to t = 1.5");
  cut("motion.csv", motion.substr(0, motion.size() - 1), "found no line break");
  cut("events.csv", events.substr(0, events.size() - 1), "found no line break");
  cut("events.csv", first_rows(events, 0.5), "found the end of the file, expected ");
  cut("instants.csv", instants.substr(0, instants.size() - 1), "");
  std::vector<Cells> halves = cells_of(instants);
  halves.resize(1 + 2 * (halves.size() / 4));
  cut("instants.csv", text_of_table(halves), "expected the instant at t = 1.5");
  // Beside curves.csv, which is written together with it, motion.csv was there.
  std::filesystem::remove(shell / "kept/motion.csv");
  const Ending ending = shell.run({"witness", "kept"});
  CHECK(ending.code == 6);
  CHECK(ending.err.find("kept/motion.csv: not found, although curves.csv exists") != std::string::npos);
}

TEST_CASE("cli witness: JSON, for programs") {
  const Shell shell;
  shell.write("planted.toml", scene_text);
  REQUIRE(shell.run({"run", "planted.toml", "-o", "kept", "--instants"}).code == 0);
  const auto told = nlohmann::json::parse(shell.run({"witness", "kept", "--json"}).out);
  CHECK(told["instants"].get<long>() > 20);
  CHECK(told["events"].get<long>() > 20);
  CHECK(told["rows"].get<long>() > 500);
  CHECK(told["ended"] == true);
  CHECK(told["violated"] == 0);
  CHECK(told["violations"].empty());
}

TEST_CASE("cli witness: files that are missing, cut or no numbers end with 6 and their place") {
  const Shell shell;
  shell.write("planted.toml", scene_text);
  const auto refused = [&](const std::string& what) {
    const Ending ending = shell.run({"witness", "kept"});
    CHECK(ending.code == 6);
    CAPTURE(ending.err);
    CHECK(ending.err.find(what) != std::string::npos);
    CHECK(ending.out == "");
  };
  refused("kept/run.toml: not found");
  REQUIRE(forged(shell, {"run", "planted.toml", "-o", "kept", "--no-plots"}).code == 0);
  refused("kept/instants.csv: not found; `signorini run --instants` writes it");
  REQUIRE(forged(shell, {"run", "planted.toml", "-o", "kept", "--no-plots", "--instants", "--force"}).code ==
          0);
  const std::string text = shell.read("kept/instants.csv");
  const std::size_t last = text.rfind('\n', text.size() - 2);
  shell.write("kept/instants.csv", text.substr(0, last + 1));
  refused("the file is cut");
  std::vector<Cells> table = cells_of(text);
  table[1][column_called(table, "A.ux")] = "many";
  shell.write("kept/instants.csv", text_of_table(table));
  refused("kept/instants.csv: line 2: A.ux: found \"many\", expected a number");
  table = cells_of(text);
  table[0][9] = "Z.ux";
  shell.write("kept/instants.csv", text_of_table(table));
  refused("line 1, column 10: found \"Z.ux\", expected \"A.ux\"");
  shell.write("kept/instants.csv", text);
  const std::string events = shell.read("kept/events.csv");
  table = cells_of(events);
  table[1][1] = "nobody";
  shell.write("kept/events.csv", text_of_table(table));
  refused("kept/events.csv: line 2: contact: found \"nobody\", expected a contact of run.toml");
  shell.write("kept/events.csv", events);
  shell.write("kept/summary.json", "{");
  refused("kept/summary.json: is not the summary of a run");
  CHECK(shell.run({"witness"}).code == 2);
}

TEST_SUITE_END();
