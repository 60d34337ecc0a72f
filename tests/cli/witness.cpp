// signorini witness: a run is checked by its files alone; each alteration of one is found.
#include <doctest/doctest.h>

#include <cmath>
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

}  // namespace

TEST_CASE("cli witness: a run that nobody touched keeps all laws, by its files alone") {
  for (const char* text : {scene_text, sliders_text, feet_text, held_text})
    for (const char* engine : {"exact", "ida", "newmark"}) {
      CAPTURE(text);
      CAPTURE(engine);
      const Shell shell;
      shell.write("planted.toml", text);
      REQUIRE(shell.run({"run", "planted.toml", "-o", "kept", "--instants", "--engine", engine}).code == 0);
      const Ending ending = shell.run({"witness", "kept"});
      CHECK(ending.code == 0);
      CHECK(ending.out.find("all laws hold") != std::string::npos);
      CHECK(ending.err == "");
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
    REQUIRE(shell.run({"run", "two.toml", "-o", "kept", "--instants", "--engine", engine}).code == 4);
    const Ending ending = shell.run({"witness", "kept"});
    CHECK(ending.code == 0);
    if (ending.code != 0) MESSAGE(ending.out);
    // A run that came to its end has no such rows (`ida` has looked at the ends of its steps).
    if (engine != std::string("exact")) continue;
    std::string summary = shell.read("kept/summary.json");
    const std::size_t kind = summary.find("\"stopped\"");
    REQUIRE(kind != std::string::npos);
    shell.write("kept/summary.json", summary.replace(kind, 9, "\"done\""));
    CHECK(shell.run({"witness", "kept"}).out.find("peak") != std::string::npos);
  }
}

TEST_CASE("cli witness: every alteration of a file is found") {
  const Shell shell;
  shell.write("planted.toml", scene_text);
  REQUIRE(shell.run({"run", "planted.toml", "-o", "kept", "--instants", "--engine", "exact"}).code == 0);
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
  REQUIRE(shell.run({"run", "planted.toml", "-o", "kept", "--no-plots"}).code == 0);
  refused("kept/instants.csv: not found; `signorini run --instants` writes it");
  REQUIRE(shell.run({"run", "planted.toml", "-o", "kept", "--no-plots", "--instants", "--force"}).code == 0);
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
