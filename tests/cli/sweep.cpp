#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"

using nlohmann::json;
using signorini::cli_test::belt;
using signorini::cli_test::Ending;
using signorini::cli_test::exists;
using signorini::cli_test::has;
using signorini::cli_test::Shell;

namespace {

long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

const std::string vary = "contacts.belt.friction.static=1:2:0.25";  // five rows

/// The rows without what differs from machine to machine.
json rows(const Shell& shell, const std::string& directory) {
  json list = json::parse(shell.read(directory + "/results.json"))["rows"];
  for (json& row : list) row.erase("wall_time");
  return list;
}

bool on_path(const char* program) {
  return std::system((std::string("command -v ") + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// A shell line in the folder; the program is $SIGNORINI.
int line(const Shell& shell, const std::string& text) {
  const std::string command =
      "cd '" + (shell / "").string() + "' && SIGNORINI='" + SIGNORINI_PROGRAM + "' && " + text;
  return std::system(command.c_str());
}

}  // namespace

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

TEST_CASE("cli sweep: resumes where it was; a differing specification is refused") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  const std::vector<std::string> command = {"sweep", "belt.toml", "--vary", vary, "--no-plots"};
  REQUIRE(shell.run(command).code == 0);
  const json before = rows(shell, "belt-sweep");
  const auto row = [&](int n) { return "belt-sweep/rows/00000" + std::to_string(n) + ".json"; };
  const std::string kept = shell.read(row(1));
  std::filesystem::remove(shell / row(3));
  std::filesystem::remove(shell / row(5));
  shell.write(row(5) + ".part", "{ half a row");
  const Ending again = shell.run(command);
  CHECK(again.code == 0);
  CHECK(again.err == "note: 3 rows of 5 there already, 2 to go\n");
  CHECK(shell.read(row(1)) == kept);  // wall time and all: not computed again
  CHECK(rows(shell, "belt-sweep") == before);

  const auto refused = [&](const std::vector<std::string>& line, const std::string& message) {
    const Ending ending = shell.run(line);
    CAPTURE(ending.err);
    CHECK(ending.code == 6);
    CHECK(has(ending.err, "holds another sweep: " + message));
    CHECK(shell.read(row(1)) == kept);
  };
  refused({"sweep", "belt.toml", "--vary", "contacts.belt.friction.static=1:2:0.5"}, "--vary was");
  refused({"sweep", "belt.toml", "--vary", vary, "--set", "run.rtol=1e-7"},
          "--set was (none), is run.rtol=1e-7");
  refused({"sweep", "belt.toml", "--vary", vary, "--share", "1/2", "-o", "belt-sweep"},
          "--share was 1/1, is 1/2");
  shell.write("belt.toml", belt(11));
  refused(command, "the scene belt.toml has another content now");
  std::vector<std::string> forced = command;
  forced.push_back("--force");
  CHECK(shell.run(forced).code == 0);
  CHECK(shell.read(row(1)) != kept);
}

TEST_CASE("cli sweep: an interrupt keeps the finished rows") {
  const Shell shell;
  shell.write("belt.toml", belt(4000));  // some tenths of a second a row
  const std::vector<std::string> command = {"sweep",  "belt.toml",
                                            "--vary", "run.rtol=1e-11,1e-10,1e-9,1e-8,1e-7",
                                            "--jobs", "1",
                                            "--keep", "--no-plots",
                                            "--set",  "run.output_dt=1"};
  const pid_t child = shell.start(command);
  for (int i = 0; i < 600 && !exists(shell, "belt-sweep/rows/000001.json"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  kill(child, SIGINT);
  const Ending ending = shell.wait(child);
  if (ending.code == 0) return;  // a machine so fast that all was done
  CHECK(ending.code == 130);
  CHECK(has(ending.err, "the same command goes on"));
  CHECK(exists(shell, "belt-sweep/sweep.csv"));
  const Ending again = shell.run(command);
  CHECK(again.code == 0);
  CHECK(has(again.err, " there already, "));
  CHECK(rows(shell, "belt-sweep").size() == 5);
}

TEST_CASE("cli sweep: shares are merged, what is missing is named") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  REQUIRE(shell.run({"sweep", "belt.toml", "--vary", vary, "--no-plots", "-o", "whole"}).code == 0);
  for (const char* share : {"1/3", "2/3", "3/3"})
    REQUIRE(shell.run({"sweep", "belt.toml", "--vary", vary, "--no-plots", "--share", share}).code == 0);
  CHECK(rows(shell, "belt-sweep-1-of-3").size() == 2);
  const Ending part =
      shell.run({"sweep", "--merge", "belt-sweep-1-of-3", "belt-sweep-3-of-3", "-o", "part", "--no-plots"});
  CHECK(part.code == 4);
  CHECK(has(part.err, "2 of 5 rows missing (2, 5)") == true);
  CHECK(shell.run({"sweep", "belt.toml", "--vary", vary, "--no-plots", "-o", "part"}).code == 0);
  CHECK(rows(shell, "part") == rows(shell, "whole"));
  const Ending all = shell.run({"sweep", "--merge", "belt-sweep-1-of-3", "belt-sweep-2-of-3",
                                "belt-sweep-3-of-3", "-o", "all", "--no-plots"});
  CHECK(all.code == 0);
  CHECK(rows(shell, "all") == rows(shell, "whole"));

  REQUIRE(
      shell.run({"sweep", "belt.toml", "--vary", "run.rtol=1e-7,1e-8", "-o", "foreign", "--no-plots"}).code ==
      0);
  const Ending foreign = shell.run({"sweep", "--merge", "belt-sweep-1-of-3", "foreign", "-o", "mixed"});
  CHECK(foreign.code == 6);
  CHECK(has(foreign.err, "foreign: is no share of the same sweep"));
  CHECK_FALSE(exists(shell, "mixed"));
}

TEST_CASE("cli sweep: spread by GNU parallel") {
  // moreutils has another program of that name
  if (std::system("parallel --version 2>/dev/null | grep -q GNU") != 0) {
    MESSAGE("skipped: no GNU parallel on PATH (Debian package parallel)");
    return;
  }
  const Shell shell;
  shell.write("belt.toml", belt(10));
  REQUIRE(line(shell, "$SIGNORINI sweep belt.toml --vary " + vary + " --no-plots --quiet -o whole") == 0);
  REQUIRE(line(shell, "parallel --will-cite -j 2 $SIGNORINI sweep belt.toml --vary " + vary +
                          " --jobs 1 --no-plots --quiet --share {}/3 ::: 1 2 3") == 0);
  REQUIRE(line(shell, "$SIGNORINI sweep --merge belt-sweep-*-of-3 -o joined --no-plots --quiet") == 0);
  CHECK(rows(shell, "joined") == rows(shell, "whole"));
}

TEST_CASE("cli sweep: spread by mpirun") {
  if (!on_path("mpirun")) {
    MESSAGE("skipped: no mpirun on PATH (Debian package openmpi-bin)");
    return;
  }
  const Shell shell;
  shell.write("belt.toml", belt(10));
  const std::string quoted =
      "$SIGNORINI sweep belt.toml --sample 'contacts.belt.friction.static=uniform(1.1,1.9)' --samples 6 "
      "--response residual:belt --no-plots --quiet ";
  REQUIRE(line(shell, quoted + "-o whole") == 0);
  REQUIRE(line(shell, "mpirun --allow-run-as-root --oversubscribe -n 2 " + quoted +
                          "--share auto 2>/dev/null") == 0);
  REQUIRE(line(shell, "$SIGNORINI sweep --merge belt-sweep-*-of-2 -o joined --no-plots --quiet") == 0);
  CHECK(rows(shell, "joined") == rows(shell, "whole"));
  CHECK(shell.read("joined/quantiles.csv") == shell.read("whole/quantiles.csv"));
}

TEST_CASE("cli sweep: a rank takes its share from the environment") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  for (const char* rank : {"0", "1"})
    REQUIRE(line(shell, std::string("OMPI_COMM_WORLD_RANK=") + rank +
                            " OMPI_COMM_WORLD_SIZE=2 $SIGNORINI sweep " + "belt.toml --vary " + vary +
                            " --share auto --no-plots --quiet") == 0);
  CHECK(rows(shell, "belt-sweep-1-of-2").size() == 3);
  CHECK(rows(shell, "belt-sweep-2-of-2").size() == 2);
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
      {{"belt.toml", "--vary", "contacts.belt.friction=0:1:-1"}, "does not lead from 0 to 1"},
      {{"belt.toml", "--vary", "contacts.bult.friction=0:1:1"},
       "--vary contacts.bult.friction=0: there is no \"bult\""},
      {{"belt.toml", "--vary", "run.rtoll=1,2"}, "did you mean \"rtol\"?"},
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
  CHECK(has(mine.err, "holds no sweep"));
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
  if (on_path("gnuplot")) CHECK(shell.read("belt-sweep/plots/forces.png").size() > 2000);
}

/// A block of 2 kg that slides at v on a floor, pressed by 10 N with friction 0.5: it stops after v^2 / 5.
const std::string sliding_block = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 4.0
engine = "exact"
output_dt = 4.0
initial = { block = { vx = 1.0 } }
[nodes]
block = [0.0, 0.0]
[[masses]]
node = "block"
mass = 2.0
[[supports]]
node = "block"
fix = ["uy"]
[[contacts]]
name = "floor"
node = "block"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 10.0
friction = 0.5
[[output]]
name = "x"
kind = "displacement"
at = "block"
direction = [1.0, 0.0]
[[output]]
name = "v"
kind = "velocity"
at = "block"
direction = [1.0, 0.0]
)";

TEST_CASE("cli sweep: answers are columns; keys vary in step") {
  const Shell shell;
  shell.write("block.toml", sliding_block);
  const Ending ending = shell.run({"sweep",
                                   "block.toml",
                                   "--vary",
                                   "run.initial.block.vx=1,2,3",
                                   "--vary",
                                   "masses.1.mass=2,4,6",
                                   "--together",
                                   "--response",
                                   "residual:floor",
                                   "--response",
                                   "max:x",
                                   "--response",
                                   "tmax:x",
                                   "--response",
                                   "end:v",
                                   "--response",
                                   "abs:v",
                                   "--response",
                                   "count:stick",
                                   "--response",
                                   "count:slip@floor",
                                   "--json"});
  CHECK(ending.err.empty());
  REQUIRE(ending.code == 0);
  const json report = json::parse(ending.out);
  REQUIRE(report["rows"].size() == 3);
  CHECK(report["responses"][0] == json({{"name", "residual:floor"}, {"unit", "m"}}));
  CHECK(report["responses"][2]["unit"] == "s");
  CHECK(report["responses"][5]["unit"] == "");
  for (std::size_t i = 0; i < 3; ++i) {
    const double v = 1.0 + static_cast<double>(i), m = 2.0 * v, way = m * v * v / 10.0;
    const json& answers = report["rows"][i]["responses"];
    CAPTURE(i);
    CHECK(answers[0].get<double>() == doctest::Approx(way).epsilon(1e-12));
    CHECK(answers[1].get<double>() == doctest::Approx(way).epsilon(1e-12));
    CHECK(std::abs(answers[2].get<double>() - m * v / 5.0) < 1e-7);
    CHECK(answers[3].get<double>() == 0.0);
    CHECK(answers[4].get<double>() == doctest::Approx(v));
    CHECK(answers[5].get<double>() == 1.0);
    CHECK(answers[6].get<double>() == 0.0);
  }
  CHECK(has(shell.read("block-sweep/sweep.csv"), ",residual:floor,max:x,tmax:x,end:v,abs:v,count:stick,"));
  CHECK(exists(shell, "block-sweep/plots/responses.gp"));
  const Ending paper = shell.run({"sweep", "block.toml", "--vary", "masses.1.mass=2,4", "--response", "max:x",
                                  "-o", "paper", "--table", "latex", "--no-plots"});
  CHECK(paper.code == 0);
  CHECK(paper.out ==
        "\\begin{tabular}{rlrr}\n\\hline\nmasses.1.mass & outcome & events & max:x [m] \\\\\n\\hline\n"
        "2 & done & 1 & 0.2 \\\\\n4 & done & 1 & 0.4 \\\\\n\\hline\n\\end{tabular}\n");
  // The sweep is its queries, too.
  const Ending other = shell.run({"sweep", "block.toml", "--vary", "run.initial.block.vx=1,2,3", "--vary",
                                  "masses.1.mass=2,4,6", "--together", "--response", "max:x"});
  CHECK(other.code == 6);
  CHECK(has(other.err, "--response was residual:floor max:x"));
}

TEST_CASE("cli sweep: quantiles of samples, against the closed form, whoever computes them") {
  const Shell shell;
  shell.write("block.toml", sliding_block);
  const auto sweep = [&](const std::string& directory, const std::vector<std::string>& more) {
    std::vector<std::string> command{"sweep",      "block.toml",
                                     "--sample",   "run.initial.block.vx=uniform(1,3)",
                                     "--sample",   "contacts.floor.friction=normal(0.5,0.05)",
                                     "--samples",  "200",
                                     "--seed",     "5",
                                     "--response", "residual:floor",
                                     "--response", "max:v",
                                     "--quiet",    "-o",
                                     directory};
    command.insert(command.end(), more.begin(), more.end());
    return shell.run(command).code;
  };
  REQUIRE(sweep("one", {"--jobs", "1"}) == 0);
  REQUIRE(sweep("two", {"--jobs", "2", "--no-plots"}) == 0);
  for (const char* share : {"1/3", "2/3", "3/3"})
    REQUIRE(sweep(std::string("part") + share[0], {"--share", share, "--no-plots"}) == 0);
  REQUIRE(shell.run({"sweep", "--merge", "part1", "part2", "part3", "-o", "joined", "--quiet", "--no-plots"})
              .code == 0);
  for (const char* other : {"two", "joined"}) {
    CHECK(rows(shell, other) == rows(shell, "one"));
    for (const char* table : {"/quantiles.csv", "/exceedance.csv"})
      CHECK(shell.read(std::string(other) + table) == shell.read(std::string("one") + table));
  }
  CHECK(exists(shell, "one/plots/exceedance.gp"));
  if (on_path("gnuplot")) CHECK(shell.read("one/plots/exceedance.png").size() > 2000);
  for (const json& row : rows(shell, "one")) {
    const double v = std::stod(row["values"][0].get<std::string>()),
                 f = std::stod(row["values"][1].get<std::string>());
    CHECK(row["responses"][0].get<double>() == doctest::Approx(v * v / (10.0 * f)).epsilon(1e-11));
  }
  // max:v is uniform on [1, 3]: the quantile of p is 1 + 2 p.
  std::istringstream table(shell.read("one/quantiles.csv"));
  std::string row;
  int checked = 0;
  std::getline(table, row);
  CHECK(row == "quantity,unit,n,missing,probability,value,low,high");
  while (std::getline(table, row)) {
    std::vector<std::string> cells(1);
    for (const char c : row)
      if (c == ',')
        cells.emplace_back();
      else
        cells.back() += c;
    if (cells[0] != "max:v") continue;
    REQUIRE(cells.size() == 8);
    CHECK(cells[2] == "200");
    const double truth = 1.0 + 2.0 * std::stod(cells[4]);
    if (!cells[6].empty()) CHECK(std::stod(cells[6]) <= truth);
    if (!cells[7].empty()) CHECK(std::stod(cells[7]) >= truth);
    CHECK(std::abs(std::stod(cells[5]) - truth) < 0.3);
    ++checked;
  }
  CHECK(checked == 9);
}

TEST_CASE("cli sweep: a killed sweep goes on with the same samples; a row that crashes costs itself") {
  const Shell shell;
  shell.write("belt.toml", belt(2000));
  const std::vector<std::string> command = {"sweep",      "belt.toml",
                                            "--sample",   "contacts.belt.friction.static=uniform(1.2,1.8)",
                                            "--samples",  "6",
                                            "--response", "residual:belt",
                                            "--jobs",     "2",
                                            "--no-plots", "--quiet",
                                            "--set",      "run.rtol=1e-11"};
  const auto child_of = [](pid_t process) {
    std::ifstream children("/proc/" + std::to_string(process) + "/task/" + std::to_string(process) +
                           "/children");
    pid_t first = 0;
    children >> first;
    return first;
  };
  const auto started = [&](const char* file) {
    const pid_t child = shell.start(command);
    for (int i = 0; i < 600 && !exists(shell, file); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return child;
  };
  const pid_t killed = started("belt-sweep/rows/000001.json");
  kill(killed, SIGKILL);
  (void)shell.wait(killed);
  const pid_t hurt = started("belt-sweep/rows/000003.json");
  if (const pid_t worker = child_of(hurt); worker > 0) kill(worker, SIGKILL);
  CHECK(shell.wait(hurt).code == 0);
  const json first = rows(shell, "belt-sweep");
  REQUIRE(first.size() == 6);
  const auto crashed =
      std::count_if(first.begin(), first.end(), [](const json& row) { return row["outcome"] == "crashed"; });
  CHECK(crashed <= 1);
  if (crashed == 1) {
    const auto row =
        *std::find_if(first.begin(), first.end(), [](const json& r) { return r["outcome"] == "crashed"; });
    CHECK(has(row["reason"].get<std::string>(), "signal 9"));
  }
  REQUIRE(shell.run(command).code == 0);
  std::vector<std::string> whole = command;
  whole.insert(whole.end(), {"-o", "whole"});
  REQUIRE(shell.run(whole).code == 0);
  CHECK(rows(shell, "belt-sweep") == rows(shell, "whole"));
  CHECK(shell.read("belt-sweep/quantiles.csv") == shell.read("whole/quantiles.csv"));
}

TEST_CASE("cli sweep: what is wrong with queries and samples is told before anything is written") {
  const Shell shell;
  shell.write("block.toml", sliding_block);
  const auto refused = [&](std::vector<std::string> more, const std::string& why) {
    more.insert(more.begin(), {"sweep", "block.toml"});
    const Ending ending = shell.run(more);
    CAPTURE(why);
    CHECK(ending.code == 2);
    CHECK_MESSAGE(has(ending.err, why), ending.err);
    CHECK(shell.list().size() == 1);
  };
  const std::string vary_mass = "masses.1.mass=1,2";
  refused({"--vary", vary_mass, "--response", "maximum:x"}, "expected one of max:, min:");
  refused({"--vary", vary_mass, "--response", "max:y"}, "unknown output \"y\"");
  refused({"--vary", vary_mass, "--response", "residual:flor"}, "did you mean \"floor\"");
  refused({"--vary", vary_mass, "--response", "count:stik"}, "unknown event \"stik\"");
  refused({"--vary", vary_mass, "--response", "count:stick@x"}, "unknown contact \"x\"");
  refused({"--vary", vary_mass, "--response", "impulse:floor@0"}, "the number of a landing, from 1");
  refused({"--vary", vary_mass, "--response", "max:x", "--response", "max:x"}, "asked for twice");
  refused({"--vary", vary_mass, "--together"}, "expected two --vary or more");
  refused({"--vary", vary_mass, "--vary", "run.rtol=1e-6,1e-7,1e-8", "--together"}, "expected as many");
  refused({"--vary", vary_mass, "--samples", "5"}, "has no meaning without --sample");
  refused({"--vary", vary_mass, "--seed", "5"}, "has no meaning without --sample");
  refused({"--sample", "masses.1.mass=normal(2,0.1)"}, "expected --response");
  refused({"--sample", "masses.1.mass=normal(2,0)", "--response", "max:x"}, "standard deviation > 0");
  refused({"--sample", "masses.1.mas=normal(2,0.1)", "--response", "max:x"}, "masses.1.mas");
  refused({"--sample", "masses.1.mass=normal(2,0.1)", "--response", "max:x", "--sequence", "halton"},
          "expected random or sobol");
  refused({"--sample", "masses.1.mass=normal(2,0.1)", "--response", "max:x", "--samples", "0"},
          "expected 1 to 1000000");
  refused({"--sample", "masses.1.mass=normal(2,0.1)", "--vary", vary_mass, "--response", "max:x"},
          "varied already");
  refused({"--sample", "masses.1.mass=normal(-5,0.1)", "--response", "max:x"}, "--sample masses.1.mass=");
  refused({"--sample", "masses.1.mass=normal(2,0.1)", "--response", "max:x", "--samples", ""},
          "expected a number");
}

TEST_CASE(
    "cli sweep: another state to go on from is another sweep; a row beyond the last is none of its own") {
  const Shell shell;
  std::string scene = sliding_block;
  shell.write("first.toml", scene);
  const std::string initial = "initial = { block = { vx = 1.0 } }";
  scene.replace(scene.find(initial), initial.size(), "initial = { run = \"before\" }");
  shell.write("then.toml", scene);
  const auto before = [&](const char* t_end) {
    return shell.run({"run", "first.toml", "-o", "before", "--force", "--no-plots", "--set",
                      std::string("run.t_end=") + t_end});
  };
  const std::vector<std::string> sweep{"sweep",      "then.toml", "--vary", "contacts.floor.friction=0.2,0.3",
                                       "--no-plots", "--quiet",   "-o",     "swept"};
  REQUIRE(before("0.1").code == 0);
  REQUIRE(shell.run(sweep).code == 0);
  CHECK(shell.run(sweep).code == 0);
  REQUIRE(before("0.05").code == 0);
  const Ending other = shell.run(sweep);
  CHECK(other.code == 6);
  CHECK_MESSAGE(has(other.err, "has another content now"), other.err);
  REQUIRE(before("0.1").code == 0);
  shell.write("swept/rows/000021.json", shell.read("swept/rows/000001.json"));
  const Ending beyond = shell.run(sweep);
  CHECK(beyond.code == 6);
  CHECK_MESSAGE(has(beyond.err, "000021.json: is no row of this sweep, which has 2"), beyond.err);
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

TEST_SUITE_END();
