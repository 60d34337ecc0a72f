// Answers as columns, samples and their quantiles.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "sweep_rows.hpp"

using nlohmann::json;
using signorini::cli_test::belt;
using signorini::cli_test::Ending;
using signorini::cli_test::exists;
using signorini::cli_test::has;
using signorini::cli_test::line_of;
using signorini::cli_test::on_path;
using signorini::cli_test::rows;
using signorini::cli_test::Shell;
using signorini::cli_test::sliding_block;
using signorini::cli_test::vary;

namespace {

/// The first process that a process has started; 0: none now.
pid_t child_of(pid_t process) {
  std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", process));
  pid_t first = 0;
  children >> first;
  return first;
}

}  // namespace

TEST_SUITE_BEGIN("cli/sweep_samples");

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

TEST_CASE("cli sweep: keys of one --sample share its draws; --engine is that of all runs") {
  const Shell shell;
  shell.write("block.toml", sliding_block);
  const auto sweep = [&](const std::string& directory, const std::string& keys, const std::string& engine) {
    const Ending ending = shell.run({"sweep",      "block.toml",
                                     "--sample",   keys + "=uniform(1,3)",
                                     "--sample",   "contacts.floor.friction=normal(0.5,0.05)",
                                     "--samples",  "20",
                                     "--seed",     "5",
                                     "--sequence", "sobol",
                                     "--response", "residual:floor",
                                     "--engine",   engine,
                                     "--quiet",    "--no-plots",
                                     "-o",         directory});
    CAPTURE(ending.err);
    REQUIRE(ending.code == 0);
  };
  sweep("both", "run.initial.block.vx, masses.1.mass", "exact");
  sweep("one", "run.initial.block.vx", "exact");
  const json both = rows(shell, "both"), one = rows(shell, "one");
  REQUIRE(both.size() == 20);
  for (std::size_t i = 0; i < both.size(); ++i) {
    const json& values = both[i]["values"];
    CHECK(values[0] == values[1]);
    CHECK(values[0] == one[i]["values"][0]);  // a key more moves no other draw
    CHECK(values[2] == one[i]["values"][1]);
    const double v = std::stod(values[0].get<std::string>()), f = std::stod(values[2].get<std::string>());
    // The slider is pressed by 10: m v^2 / 2 = 10 f s, with m = v.
    CHECK(both[i]["responses"][0].get<double>() == doctest::Approx(v * v * v / (20.0 * f)).epsilon(1e-11));
  }
  CHECK(has(shell.read("both/sweep.json"), "run.engine=exact"));
  CHECK(shell.run({"sweep", "block.toml", "--sample", "a,,b=uniform(1,3)", "--response", "max:x"}).code == 2);
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
  const auto started = [&](int row) {
    const pid_t child = shell.start(command);
    for (int i = 0; i < 600 && line_of(shell, "belt-sweep", row).empty(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return child;
  };
  const pid_t killed = started(1);
  kill(killed, SIGKILL);
  (void)shell.wait(killed);
  const pid_t hurt = started(3);
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

TEST_CASE("cli sweep: where a process dies within rows that go on from each other, those before stay") {
  const Shell shell;
  shell.write("belt.toml", belt(200));
  const auto command = [](int count, const char* directory) {
    return std::vector<std::string>{
        "sweep",   "belt.toml",
        "--vary",  fmt::format("contacts.belt.friction.static=1.2:{}:0.01", 1.195 + 0.01 * count),
        "--carry", "--no-plots",
        "--quiet", "-o",
        directory};
  };
  constexpr int all = 80;
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  REQUIRE(shell.run(command(8, "few")).code == 0);
  const auto for_some = Clock::now() - begin;  // long enough for some rows of many
  const pid_t child = shell.start(command(all, "hurt"));
  std::this_thread::sleep_for(for_some);
  const pid_t worker = child_of(child);
  REQUIRE(worker > 0);
  kill(worker, SIGKILL);
  CHECK(shell.wait(child).code == 0);
  const json hurt = rows(shell, "hurt");
  REQUIRE(hurt.size() == all);
  std::size_t done = 0;
  while (done < hurt.size() && hurt[done]["outcome"] == "done") ++done;
  CHECK(done > 0);
  CHECK(done < hurt.size());
  for (std::size_t i = done; i < hurt.size(); ++i) {
    CHECK(hurt[i]["outcome"] == "crashed");
    CHECK(has(hurt[i]["reason"].get<std::string>(), "signal 9"));
  }
  // The same command computes the chain from its start.
  REQUIRE(shell.run(command(all, "hurt")).code == 0);
  REQUIRE(shell.run(command(all, "whole")).code == 0);
  const json again = rows(shell, "hurt"), whole = rows(shell, "whole");
  CHECK(again == whole);
  for (std::size_t i = 0; i < done; ++i) CHECK(hurt[i] == whole[i]);
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
  refused({"--vary", vary_mass, "--response", "max:x", "--response", "max:x"}, "given twice");
  refused({"--vary", vary_mass, "--together"}, "expected two or more --vary");
  refused({"--vary", vary_mass, "--vary", "run.rtol=1e-6,1e-7,1e-8", "--together"},
          "expected equally many values");
  refused({"--vary", vary_mass, "--samples", "5"}, "has no meaning without --sample");
  refused({"--vary", vary_mass, "--seed", "5"}, "has no meaning without --sample");
  refused({"--sample", "masses.1.mass=normal(2,0.1)"}, "--sample needs at least one --response");
  refused({"--sample", "masses.1.mass=normal(2,0)", "--response", "max:x"}, "standard deviation > 0");
  refused({"--sample", "masses.1.mas=normal(2,0.1)", "--response", "max:x"}, "masses.1.mas");
  refused({"--sample", "masses.1.mass=normal(2,0.1)", "--response", "max:x", "--sequence", "halton"},
          "expected random or sobol");
  refused({"--sample", "masses.1.mass=normal(2,0.1)", "--response", "max:x", "--samples", "0"},
          "expected an integer from 1 to 1000000");
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
  CHECK_MESSAGE(has(other.err, " has changed ("), other.err);
  REQUIRE(before("0.1").code == 0);
  std::vector<std::string> longer = sweep;
  longer[3] += ",0.4";
  longer.back() = "longer";
  REQUIRE(shell.run(longer).code == 0);
  shell.write("swept/rows.jsonl", shell.read("swept/rows.jsonl") + line_of(shell, "longer", 3));
  const Ending beyond = shell.run(sweep);
  CHECK(beyond.code == 6);
  CHECK_MESSAGE(has(beyond.err, "rows.jsonl: line 3: row 3 is not a row of this sweep, which has 2"),
                beyond.err);
}

TEST_SUITE_END();
