// Rows, what a sweep refuses, going on, maps.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "sweep_rows.hpp"

using nlohmann::json;
using signorini::cli_test::belt;
using signorini::cli_test::Ending;
using signorini::cli_test::exists;
using signorini::cli_test::has;
using signorini::cli_test::line;
using signorini::cli_test::line_of;
using signorini::cli_test::lines;
using signorini::cli_test::on_path;
using signorini::cli_test::rows;
using signorini::cli_test::Shell;
using signorini::cli_test::sliding_block;
using signorini::cli_test::vary;

TEST_SUITE_BEGIN("cli/sweep");

TEST_CASE("cli sweep: one row a value, as table, CSV, JSON and pictures") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const Ending ending = shell.run({"sweep", "belt.toml", "--vary", vary});
  CHECK(ending.code == 0);
  CHECK(ending.err.empty());
  CHECK(has(ending.out, "contacts.belt.friction.static"));
  CHECK(lines(shell.read("belt-sweep/sweep.csv")) == 6);
  CHECK(shell.read("belt-sweep/sweep.csv")
            .rfind("row,contacts.belt.friction.static,outcome,t,reason,events,", 0) == 0);
  const json list = rows(shell, "belt-sweep");
  REQUIRE(list.size() == 5);
  CHECK(list[1]["values"][0] == "1.25");
  CHECK(list[1]["outcome"] == "done");
  CHECK(list[1]["contacts"][0]["name"] == "belt");
  CHECK(list[1]["contacts"][0]["tangential"].get<double>() > 0.0);
  CHECK_FALSE(exists(shell, "belt-sweep/runs"));
  for (const char* name : {"motion", "forces", "losses"}) {
    CAPTURE(name);
    CHECK(exists(shell, std::string("belt-sweep/plots/") + name + ".gp"));
    if (on_path("gnuplot")) CHECK(shell.read(std::string("belt-sweep/plots/") + name + ".png").size() > 2000);
  }
}

TEST_CASE("cli sweep: rows are what `run` computes, whatever the number of jobs") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  REQUIRE(shell.run({"sweep", "belt.toml", "--vary", vary, "-o", "one", "--jobs", "1", "--no-plots"}).code ==
          0);
  REQUIRE(
      shell.run({"sweep", "belt.toml", "--vary", vary, "-o", "four", "--jobs", "4", "--no-plots", "--keep"})
          .code == 0);
  CHECK(rows(shell, "one") == rows(shell, "four"));
  REQUIRE(shell
              .run({"run", "belt.toml", "-o", "run", "--set", "contacts.belt.friction.static=1.5",
                    "--no-plots", "--set", "run.certify=false"})
              .code == 0);
  CHECK(shell.read("run/events.csv") == shell.read("four/runs/000003/events.csv"));
  const json summary = json::parse(shell.read("run/summary.json"));
  CHECK(rows(shell, "one")[2]["contacts"][0]["friction_work"] == summary["contacts"][0]["friction_work"]);
}

TEST_CASE("cli sweep: a product, and a list of words") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  const Ending ending = shell.run({"sweep", "belt.toml", "--vary", "run.engine=ida,exact", "--vary",
                                   "contacts.belt.surface_velocity=0.1,0.2,0.3", "--json"});
  CHECK(ending.code == 0);
  const json report = json::parse(ending.out);
  REQUIRE(report["rows"].size() == 6);
  CHECK(report["rows"][4]["values"] == json({"exact", "0.2"}));
  CHECK(ending.out == shell.read("belt-sweep/results.json"));
}

TEST_CASE("cli sweep: a run that is refused is a row with its reason") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  const Ending ending =
      shell.run({"sweep", "belt.toml", "--vary", "contacts.belt.friction.static=0.5,1.5", "--no-plots"});
  CHECK(ending.code == 0);
  CHECK(has(ending.err, "note: 1 of 2 runs did not reach the end"));
  CHECK(has(ending.out, "row 1: refused: "));
  const json list = rows(shell, "belt-sweep");
  CHECK(list[0]["outcome"] == "refused");
  CHECK(has(list[0]["reason"], "expected at most the static coefficient"));
  CHECK(list[1]["outcome"] == "done");
}

TEST_CASE("cli sweep: where every run is refused the sweep is, by the code of a wrong scene") {
  const Shell shell;
  shell.write(
      "falls.toml",
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\ngravity = "
      "[0.0, -9.81]\n[run]\nt_end = 1.0\ninitial = \"static\"\n[nodes]\nb = [0.0, 0.0]\n[[masses]]\nnode "
      "= \"b\"\nmass = 1.0\n");
  const Ending ending = shell.run({"sweep", "falls.toml", "--vary", "masses.1.mass=1,2", "--no-plots"});
  CHECK(ending.code == 3);
  CHECK(has(ending.err, "every run of the sweep was refused; reason of the first run: "));
  CHECK(has(ending.err, "nothing restrains the"));
  const json list = rows(shell, "falls-sweep");
  REQUIRE(list.size() == 2);
  CHECK(list[0]["outcome"] == "refused");
  CHECK(list[1]["outcome"] == "refused");
}

TEST_CASE("cli sweep: a run whose file is not there is refused, and costs no other") {
  const Shell shell;
  shell.write("there.csv", "t,value\n0,0\n1,2\n2,0\n");
  shell.write("pushed.toml", sliding_block +
                                 "[[loads]]\nnode = \"block\"\ndirection = [1.0, 0.0]\namplitude = 3.0\n"
                                 "history = { type = \"table\", file = \"there.csv\" }\n");
  for (const char* order : {"there.csv,gone.csv", "gone.csv,there.csv"}) {
    CAPTURE(order);
    const Ending ending = shell.run({"sweep", "pushed.toml", "--vary",
                                     std::string("loads.1.history.file=") + order, "--no-plots", "--force"});
    CHECK_MESSAGE(ending.code == 0, ending.err);
    const json list = rows(shell, "pushed-sweep");
    REQUIRE(list.size() == 2);
    for (const json& row : list) {
      const bool there = row["values"][0] == "there.csv";
      CHECK(row["outcome"] == (there ? "done" : "refused"));
      CHECK(has(row["reason"].get<std::string>(), there ? "" : "gone.csv"));
    }
  }
}

TEST_CASE("cli sweep: resumes where it was; a differing specification is refused") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  const std::vector<std::string> command = {"sweep", "belt.toml", "--vary", vary, "--no-plots"};
  REQUIRE(shell.run(command).code == 0);
  const json before = rows(shell, "belt-sweep");
  const auto row = [&](int n) { return line_of(shell, "belt-sweep", n); };
  const std::string kept = row(1);
  shell.write("belt-sweep/rows.jsonl", row(4) + kept + row(2) + row(5).substr(0, 40));  // the last one half
  const Ending again = shell.run(command);
  CHECK(again.code == 0);
  CHECK(again.err == "note: 3 rows of 5 already computed, 2 left\n");
  CHECK(row(1) == kept);  // wall time and all: not computed again
  CHECK(rows(shell, "belt-sweep") == before);
  for (const int n : {3, 5}) CHECK(has(row(n), "\"outcome\":\"done\""));

  const auto refused = [&](const std::vector<std::string>& line, const std::string& message) {
    const Ending ending = shell.run(line);
    CAPTURE(ending.err);
    CHECK(ending.code == 6);
    CHECK(has(ending.err, "contains another sweep: " + message));
    CHECK(row(1) == kept);
  };
  refused({"sweep", "belt.toml", "--vary", "contacts.belt.friction.static=1:2:0.5"}, "--vary was");
  refused({"sweep", "belt.toml", "--vary", vary, "--set", "run.rtol=1e-7"},
          "--set was (none), is run.rtol=1e-7");
  refused({"sweep", "belt.toml", "--vary", vary, "--share", "1/2", "-o", "belt-sweep"},
          "--share was 1/1, is 1/2");
  shell.write("belt.toml", belt(11));
  refused(command, "the content of the scene belt.toml has changed");
  std::vector<std::string> forced = command;
  forced.push_back("--force");
  CHECK(shell.run(forced).code == 0);
  CHECK(row(1) != kept);
}

TEST_CASE("cli sweep: an interrupt keeps the finished rows") {
  const Shell shell;
  shell.write("belt.toml", belt(1000));  // a row takes longer than the test's look at the first one
  const std::vector<std::string> command = {"sweep",  "belt.toml",
                                            "--vary", "contacts.belt.friction.static=1.2:1.58:0.02",
                                            "--jobs", "1",
                                            "--keep", "--no-plots",
                                            "--set",  "run.output_dt=1"};
  const pid_t child = shell.start(command);
  for (int i = 0; i < 3000 && line_of(shell, "belt-sweep", 1).empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  const Ending ending = shell.wait(child);
  CHECK(ending.code == 130);
  CHECK(has(ending.err, "the same command continues"));
  CHECK(exists(shell, "belt-sweep/sweep.csv"));
  const Ending again = shell.run(command);
  CHECK(again.code == 0);
  CHECK(has(again.err, " already computed, "));
  CHECK(rows(shell, "belt-sweep").size() == 20);
}

TEST_CASE("cli sweep: what is wrong is told before anything is written") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  struct Wrong {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Wrong> wrong = {
      {{"belt.toml"}, "expected --vary"},
      {{"--vary", "run.rtol=1e-8"}, "expected SCENE"},
      {{"belt.toml", "--vary", "run.rtol"}, "expected path=start:stop:step"},
      {{"belt.toml", "--vary", "contacts.belt.friction=0:1:-1"}, "never reach 1"},
      {{"belt.toml", "--vary", "contacts.bult.friction=0:1:1"},
       "--vary contacts.bult.friction=0: contacts has 1 entry, but no \"bult\""},
      {{"belt.toml", "--vary", "run.rtoll=1,2"}, "did you mean \"rtol\"?"},
      {{"belt.toml", "--vary", "contacts.belt.friction=0.1-0.5"},
       "found \"0.1-0.5\", expected start:stop:step, such as 0.1:0.5:0.1"},
      {{"belt.toml", "--vary", "contacts.belt.friction=1e-3..1e-2"}, "such as 1e-3:1e-2:0.002"},
      {{"belt.toml", "--vary", "contacts.belt.friction=0.5:0.1"}, "such as 0.5:0.1:-0.1"},
      {{"belt.toml", "--vary", "run.engine=ida,exact", "--engine", "ida"}, "--engine ida: has no effect"},
      {{"belt.toml", "--vary", "run.rtol=1e-8", "--engine", "idda"}, "run.engine=idda"},
      {{"belt.toml", "--vary", "run.rtol=1e-8", "--share", "4/3"}, "expected K/N"},
      {{"belt.toml", "--vary", "run.rtol=1e-8", "--jobs", "0"}, "expected at least 1"},
      {{"--merge", "a", "b"}, "expected -o DIR"},
      {{"belt.toml", "--merge", "a", "-o", "b"}, "expected neither SCENE"},
  };
  for (const Wrong& w : wrong) {
    CAPTURE(w.message);
    std::vector<std::string> arguments = w.arguments;
    arguments.insert(arguments.begin(), "sweep");
    const Ending ending = shell.run(arguments);
    CHECK(ending.code == 2);
    CHECK(ending.out.empty());
    CHECK(has(ending.err, w.message));
    CHECK(shell.list() == std::vector<std::string>{"belt.toml"});
  }
  CHECK(shell.run({"sweep", "--merge", "missing", "-o", "b"}).code == 6);
  CHECK(shell.run({"sweep", "missing.toml", "--vary", "run.rtol=1e-8"}).code == 6);
  std::filesystem::create_directory(shell / "mine");
  shell.write("mine/sweep.csv", "mine");
  const Ending mine = shell.run({"sweep", "belt.toml", "--vary", "run.rtol=1e-8", "-o", "mine", "--force"});
  CHECK(mine.code == 6);
  CHECK(has(mine.err, "contains no sweep"));
  CHECK(shell.read("mine/sweep.csv") == "mine");
}

TEST_CASE("cli sweep: over two keys of numbers it is drawn as maps") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  REQUIRE(shell
              .run({"sweep", "belt.toml", "--vary", "contacts.belt.friction.static=1.2,1.5,2.0", "--vary",
                    "contacts.belt.surface_velocity=0.1:0.3:0.1"})
              .code == 0);
  const std::string cells = shell.read("belt-sweep/plots/map.csv");
  CHECK(std::count(cells.begin(), cells.end(), '\n') == 10);
  CHECK(has(cells, "\n1.35,1.75,"));
  CHECK(has(shell.read("belt-sweep/plots/motion.gp"), "fillcolor palette"));
  if (!on_path("gnuplot")) return;
  CHECK(shell.read("belt-sweep/plots/forces.png").size() > 2000);
  // For a paper they are drawn again from the rows; there is no part of a time to show.
  const Ending again = shell.run({"plot", "belt-sweep", "--size", "85", "--format", "svg", "--no-title"});
  CAPTURE(again.err);
  CHECK(again.code == 0);
  CHECK(has(shell.read("belt-sweep/plots/forces.svg"), "width=\"321\""));  // 85 mm of 96 pixels an inch
  CHECK_FALSE(exists(shell, "belt-sweep/plots/forces.png"));
  CHECK(shell.run({"plot", "belt-sweep", "--from", "1"}).code == 2);
}

TEST_CASE("cli plot: sensitivities and comparisons are drawn again from their tables, the same to the byte") {
  if (!on_path("gnuplot")) return;
  const Shell shell;
  shell.write("belt.toml", belt(10));
  REQUIRE(shell
              .run({"sensitivity", "belt.toml", "--sigma", "contacts.1.friction.static=0.01", "--parameter",
                    "contacts.1.friction.kinetic"})
              .code == 0);
  REQUIRE(shell.run({"compare", "belt.toml", "--engines", "exact,ida"}).code == 0);
  for (const std::string picture :
       {"belt-sensitivity/plots/tornado.gp", "belt-sensitivity/plots/tornado-1.csv",
        "belt-sensitivity/plots/times-1.csv", "belt-sensitivity/plots/times-1.gp",
        "belt-compare/plots/differences.gp", "belt-compare/plots/contact-1-belt.gp"}) {
    CAPTURE(picture);
    const std::string first = shell.read(picture);
    REQUIRE_FALSE(first.empty());
    CHECK(shell.run({"plot", picture.substr(0, picture.find('/'))}).code == 0);
    CHECK(shell.read(picture) == first);
  }
}

TEST_CASE("cli sweep: what another key would overwrite is refused, under whichever name") {
  const Shell shell;
  shell.write("block.toml", sliding_block);
  const auto tried = [&](const std::vector<std::string>& more, const std::string& why) {
    std::vector<std::string> all{"sweep", "block.toml", "--no-plots", "--quiet", "--force"};
    all.insert(all.end(), more.begin(), more.end());
    const Ending ending = shell.run(all);
    CHECK_MESSAGE(has(ending.err, why), ending.err);
    return ending.code;
  };
  const std::string name = "contacts.floor.friction=0.2,0.3";
  for (const char* other :
       {"contacts.*.friction=0.5,0.6", "contacts.1.friction=0.5", "contacts.floor.friction.static=0.5"}) {
    CAPTURE(std::string(other));
    CHECK(tried({"--vary", name, "--vary", other}, "--vary contacts.floor.friction varies") == 2);
    CHECK(tried({"--vary", other, "--vary", name}, "already") == 2);
  }
  CHECK(tried({"--vary", name, "--sample", "contacts.*.friction=uniform(0.1,0.2)", "--samples", "2",
               "--response", "end:x"},
              "--sample contacts.*.friction=uniform(0.1,0.2): --vary contacts.floor.friction") == 2);
  for (const char* setting :
       {"contacts.floor.friction=0.9", "contacts.*.friction=0.9", "contacts.1.friction.static=0.9"}) {
    CAPTURE(std::string(setting));
    CHECK(tried({"--vary", name, "--set", setting}, "has no effect") == 2);
  }
  CHECK(shell.list().size() == 1);
  // What is left of a setting counts: friction's other half.
  CHECK(tried({"--vary", "contacts.floor.friction.static=0.6,0.7", "--set", "contacts.floor.friction=0.5"},
              "") == 0);
  CHECK(tried({"--vary", "contacts.floor.friction.static=0.6,0.7", "--vary",
               "contacts.*.friction.kinetic=0.1,0.2"},
              "") == 0);
}

TEST_CASE("cli sweep: a bifurcation diagram, there and back") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const std::vector<std::string> command = {"sweep", "belt.toml", "--vary", vary,      "--strobe",
                                            "0.5",   "--settle",  "5",      "--carry", "--back",
                                            "-o",    "out",       "--jobs", "2"};
  const Ending ending = shell.run(command);
  CHECK(ending.code == 0);
  CHECK(ending.err.empty());
  CHECK(has(ending.out, "strobe.csv"));
  const std::string table = shell.read("out/strobe.csv");
  CHECK(table.rfind("row,contacts.belt.friction.static,way,t,", 0) == 0);
  CHECK(has(table, ",there,"));
  CHECK(has(table, ",back,"));
  const json list = rows(shell, "out");
  REQUIRE(list.size() == 10);
  CHECK(list[4]["values"] == list[5]["values"]);
  CHECK(list[0]["values"] == list[9]["values"]);
  CHECK(exists(shell, "out/plots/strobe.gp"));
  if (on_path("gnuplot")) CHECK(shell.read("out/plots/strobe.png").size() > 2000);

  // A chain that is not whole is computed anew, with the same points.
  std::string others;
  for (const int n : {1, 2, 3, 5, 6, 7, 8, 9, 10}) others += line_of(shell, "out", n);
  shell.write("out/rows.jsonl", others);
  CHECK(shell.run(command).code == 0);
  CHECK(shell.read("out/strobe.csv") == table);
  // Other points are another sweep.
  std::vector<std::string> other = command;
  other[7] = "6";
  const Ending refused = shell.run(other);
  CHECK(refused.code == 6);
  CHECK(has(refused.err, "--settle"));
}

TEST_CASE("cli sweep: a note where --strobe is no period of the loads; --strobe loads has that of each run") {
  const Shell shell;
  shell.write("forced.toml", std::string(sliding_block) +
                                 "[[loads]]\nnode = \"block\"\ndirection = [1.0, 0.0]\namplitude = 30.0\n"
                                 "history = { type = \"harmonic\", omega = 8.0 }\n");
  const auto sweep = [&](const std::string& strobe, const std::vector<std::string>& more) {
    std::vector<std::string> command = {"sweep",   "forced.toml", "--strobe", strobe,  "--no-plots",
                                        "--force", "--engine",    "exact",    "--set", "run.t_end=20.0"};
    command.insert(command.end(), more.begin(), more.end());
    return shell.run(command);
  };
  const std::vector<std::string> over_load = {"--vary", "loads.1.amplitude=20,30"},
                                 over_period = {"--vary", "loads.1.history.omega=8,9", "--carry", "--back"};
  CHECK(has(sweep("0.5", over_load).err, "note: --strobe 0.5: the period of the loads is 0.785"));
  CHECK(sweep("0.7853981633974483", over_load).err.empty());
  CHECK(has(sweep("0.7853981633974483", {"--vary", "loads.1.history.omega=8,9"}).err, "--strobe loads"));
  const Ending ending = sweep("loads", over_period);
  CHECK(ending.code == 0);
  CHECK(ending.err.empty());
  CHECK(rows(shell, "forced-sweep").size() == 4);
}

TEST_CASE("cli sweep: what stroboscopic sweeps and carried states refuse") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const auto error = [&](std::vector<std::string> options) {
    std::vector<std::string> command = {"sweep", "belt.toml", "--vary", vary};
    command.insert(command.end(), options.begin(), options.end());
    const Ending ending = shell.run(command);
    CHECK(ending.code == 2);
    CHECK_FALSE(exists(shell, "belt-sweep"));
    return ending.err;
  };
  CHECK(has(error({"--strobe", "slp"}), "slip"));
  CHECK(has(error({"--strobe", "30"}), "longer than the run"));
  CHECK(has(error({"--settle", "1"}), "--strobe"));
  CHECK(has(error({"--strobe", "1", "--settle", "20"}), "--settle 20"));
  CHECK(has(error({"--back"}), "--carry"));
  CHECK(has(error({"--carry", "--keep"}), "--keep"));
  CHECK(has(error({"--carry", "--share", "1/2"}), "--share"));
  CHECK(has(error({"--carry", "--strobe", "3"}), "whole number"));
}

TEST_CASE("cli sweep: contacts.* varies the contacts of stops, too, and says how many tables it met") {
  const Shell shell;
  std::string text = sliding_block;
  text +=
      "[[stops]]\nnode = \"block\"\ndirection = [0.8, 0.6]\nlaw = \"compliant\"\ngap = 9.0\n"
      "normal_stiffness = 1e3\ntangential_stiffness = 1e3\nfriction = 0.1\n";
  shell.write("guided.toml", text);
  const Ending ending = shell.run({"sweep", "guided.toml", "--vary", "contacts.*.friction=0.2,0.4", "--keep",
                                   "--no-plots", "--set", "masses.*.mass=1.0"});
  CHECK(ending.code == 0);
  CHECK(
      has(ending.err, "note: --vary contacts.*.friction=0.2,0.4: matches 1 of [[contacts]], 1 of [[stops]]"));
  CHECK(has(ending.err, "note: --set masses.*.mass=1.0: matches 1 of [[masses]]"));
  const std::string run = shell.read("guided-sweep/runs/000002/run.toml");
  CHECK(has(run, "kinetic = 0.4"));
  CHECK_FALSE(has(run, "0.1"));
  CHECK(shell
            .run({"sweep", "guided.toml", "--vary", "contacts.*.friction=0.2,0.4", "-o", "other", "--quiet",
                  "--no-plots"})
            .err.empty());
}

TEST_SUITE_END();
