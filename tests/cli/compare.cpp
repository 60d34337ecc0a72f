#include <doctest/doctest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "program.hpp"

using nlohmann::json;
using signorini::cli_test::belt;
using signorini::cli_test::Ending;
using signorini::cli_test::exists;
using signorini::cli_test::has;
using signorini::cli_test::Shell;

TEST_SUITE_BEGIN("cli/compare");

TEST_CASE("cli compare: response quantities have differences and limits; tables for papers") {
  const Shell shell;
  shell.write("belt.toml", belt(20) +
                               "\n[[output]]\nname = \"x_block\"\nkind = \"displacement\"\nat = \"block\"\n"
                               "direction = [2.0, 0.0]\n");
  const Ending good = shell.run({"compare", "belt.toml", "--engines", "ida,exact", "--no-plots", "--limit",
                                 "response:x_block=1e-5", "--table", "markdown"});
  CHECK(good.err.empty());
  CHECK(good.code == 0);
  CHECK(good.out.rfind("| run | outcome | events |", 0) == 0);
  CHECK(has(good.out, "|---|---|---:|"));
  CHECK(has(good.out, "| response:x_block | m | "));
  CHECK(has(good.out, "| \\|T\\| > T_U |"));
  const json report = json::parse(shell.read("belt-compare/compare.json"));
  const json& difference = report["comparisons"][0]["differences"]["response:x_block"];
  CHECK(difference["unit"] == "m");
  // The same as that of the column of history.csv; but rows at events may be a little worse.
  const double column = report["comparisons"][0]["columns"]["block.ux"]["value"].get<double>();
  CHECK(column > 0.0);
  CHECK(difference["value"].get<double>() >= 0.999 * column);
  CHECK(difference["value"].get<double>() < 1e-5);
  const Ending tex = shell.run({"compare", "belt-compare/ida", "belt-compare/exact", "-o", "again",
                                "--no-plots", "--table", "latex", "--limit", "response:x_block=1e-30"});
  CHECK(tex.code == 5);
  CHECK(has(tex.err, "response:x_block"));
  CHECK(tex.out.rfind("\\begin{tabular}{llrrr", 0) == 0);
  CHECK(has(tex.out, "response:x\\_block & m & "));
  CHECK(has(tex.out, "$|$T$|$ $>$ T\\_U"));
  CHECK(shell
            .run({"compare", "belt-compare/ida", "belt-compare/exact", "-o", "third", "--no-plots", "--quiet",
                  "--limit", "response:y=1"})
            .code == 5);
  const Ending unknown = shell.run(
      {"compare", "belt.toml", "--engines", "ida,exact", "-o", "unknown", "--limit", "response:x_blok=1"});
  CHECK(unknown.code == 2);
  CHECK(has(unknown.err, "no [[output]] is called \"x_blok\""));
  CHECK(has(unknown.err, "x_block"));
  CHECK_FALSE(exists(shell, "unknown"));
  CHECK(shell.run({"compare", "belt-compare/ida", "belt-compare/exact", "-o", "fourth", "--table", "html"})
            .code == 2);
}

TEST_CASE("cli compare: two engines agree, in tables, CSV and JSON") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const Ending ending =
      shell.run({"compare", "belt.toml", "--engines", "ida,exact", "--limit", "event_time=1e-4", "--limit",
                 "displacement=1e-5", "--limit", "sequence=0"});
  CHECK(ending.code == 0);
  CHECK(ending.err.empty());
  CHECK(has(ending.out, "exact against ida"));
  CHECK(has(ending.out, "sequence: the same, "));
  CHECK(has(ending.out, "event time"));
  for (const char* name :
       {"ida/events.csv", "exact/history.csv", "runs.csv", "differences.csv", "columns.csv", "events.csv",
        "compare.json", "plots/differences.gp", "plots/contact-1-belt.gp"}) {
    CAPTURE(name);
    CHECK(exists(shell, std::string("belt-compare/") + name));
  }
  if (std::system("command -v gnuplot >/dev/null 2>&1") == 0) {
    CHECK(shell.read("belt-compare/plots/differences.png").size() > 2000);
    CHECK(shell.read("belt-compare/plots/contact-1-belt.png").size() > 2000);
  }
  const json report = json::parse(shell.read("belt-compare/compare.json"));
  CHECK(report["reference"] == "ida");
  CHECK(report["runs"].size() == 2);
  CHECK(report["comparisons"][0]["first_difference"].is_null());
  CHECK(report["comparisons"][0]["differences"]["displacement"]["value"].get<double>() < 1e-5);
  CHECK(report["comparisons"][0]["columns"].contains("block.ux"));
  CHECK(report["comparisons"][0]["columns"].contains("belt.T"));
  CHECK(report["exceeded"].empty());
}

TEST_CASE("cli compare: a limit that is exceeded is 5, and named") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const Ending ending = shell.run({"compare", "belt.toml", "--engines", "exact,ida", "--no-plots", "--limit",
                                   "displacement=0", "--limit", "sequence=0", "--json"});
  CHECK(ending.code == 5);
  CHECK(has(ending.err, "error: limit exceeded: ida: displacement "));
  CHECK_FALSE(has(ending.err, "sequence"));
  CHECK(ending.out == shell.read("belt-compare/compare.json"));
  CHECK(json::parse(ending.out)["exceeded"].size() == 1);
  CHECK_FALSE(exists(shell, "belt-compare/plots/differences.gp"));
}

TEST_CASE("cli compare: a setting for one engine, and the first difference of the sequence") {
  const Shell shell;
  shell.write("belt.toml", belt(30));
  const Ending ending =
      shell.run({"compare", "belt.toml", "--engines", "exact,ida", "--no-plots", "--set",
                 "ida:contacts.belt.friction=1.2", "--set", "run.t_end=25", "--limit", "sequence=0"});
  CHECK(ending.code == 5);
  CHECK(has(ending.out, "first difference at t = "));
  CHECK(has(ending.err, "ida: the sequence of events differs from t = "));
  const json report = json::parse(shell.read("belt-compare/compare.json"));
  const json& first = report["comparisons"][0]["first_difference"];
  CHECK(first["unaligned"].get<int>() > 0);
  CHECK(first["reference"]["contact"] == "belt");
  CHECK(report["comparisons"][0]["t_end"] == 25.0);
  // Without a partner no event time can be kept.
  const Ending times = shell.run({"compare", "belt-compare/exact", "belt-compare/ida", "--no-plots", "-o",
                                  "c2", "--limit", "event_time=1e9"});
  CHECK(times.code == 5);
  CHECK(has(times.err, " no matching event"));
}

TEST_CASE("cli compare: directories, of different length") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  REQUIRE(shell.run({"run", "belt.toml", "-o", "long", "--no-plots"}).code == 0);
  REQUIRE(shell
              .run({"run", "belt.toml", "-o", "short", "--no-plots", "--set", "run.t_end=10", "--engine",
                    "exact"})
              .code == 0);
  const Ending ending = shell.run({"compare", "long/", "short", "long/../long", "--no-plots"});
  CHECK(ending.code == 0);
  CHECK(has(ending.out, "short against long"));
  CHECK(has(ending.out, "note: compared up to t = 10, the end of short; long ends at 20"));
  const json report = json::parse(shell.read("long-compare/compare.json"));
  CHECK(report["comparisons"][0]["first_difference"].is_null());
  CHECK(report["comparisons"][0]["common_times"] == 101);
  CHECK(report["comparisons"][1]["differences"]["displacement"]["value"] == 0.0);
}

TEST_CASE("cli compare: a limit of what is not in both runs is 5, and says what was compared") {
  const Shell shell;
  const std::string scene = belt(10);
  std::string renamed = scene;
  for (std::size_t at; (at = renamed.find("block")) != std::string::npos;) renamed.replace(at, 5, "blok");
  shell.write("a.toml", scene);
  shell.write("b.toml", renamed);
  for (const char* name : {"a", "b"})
    REQUIRE(
        shell.run({"run", std::string(name) + ".toml", "-o", name, "--no-plots", "--engine", "exact"}).code ==
        0);
  const Ending ending = shell.run({"compare", "a", "b", "--no-plots", "--limit", "displacement=1e9"});
  CHECK(ending.code == 5);
  CHECK(has(ending.err, "the limit of displacement cannot be checked: "));
  CHECK(has(ending.err, "only one of the two runs has"));
  CHECK(has(ending.out, "rows compared: history.csv 101, contacts.csv 101"));
  const std::string contacts = shell.read("b/contacts.csv");
  std::filesystem::remove(shell / "b/manifest.json");
  shell.write("b/contacts.csv", contacts.substr(0, contacts.find('\n', contacts.find('\n') + 1) + 1));
  const Ending cut = shell.run({"compare", "a", "b", "--no-plots", "--force", "--limit", "force=1e9"});
  CHECK(cut.code == 5);
  CHECK(has(cut.err, "contacts.csv of b has 1 row, expected 101"));
  const json rows = json::parse(shell.read("a-compare/compare.json"))["comparisons"][0]["rows"];
  CHECK(rows["contacts.csv"] == json{{"compared", 1}, {"reference", 101}, {"run", 1}});
}

TEST_CASE("cli compare: a run that stopped early is a row, and keeps no limit") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  for (const char* name : {"whole", "cut"})
    REQUIRE(shell.run({"run", "belt.toml", "-o", name, "--no-plots"}).code == 0);
  std::filesystem::remove(shell / "cut/manifest.json");
  json summary = json::parse(shell.read("cut/summary.json"));
  summary["outcome"] = {
      {"kind", "stopped"}, {"t", 12.0}, {"t_end", 20.0}, {"reason", "made up"}, {"exit_code", 4}};
  shell.write("cut/summary.json", summary.dump());
  const Ending plain = shell.run({"compare", "whole", "cut", "--no-plots"});
  CHECK(plain.code == 0);
  CHECK(has(plain.out, "cut: stopped at t = 12: made up"));
  const Ending limited =
      shell.run({"compare", "whole", "cut", "--no-plots", "--force", "--limit", "displacement=1"});
  CHECK(limited.code == 5);
  CHECK(has(limited.err, "cut: stopped at t = 12"));
}

TEST_CASE("cli compare: engines that stop early or refuse the scene are rows") {
  const std::string contact =
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.4\n";
  const std::string scene =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "10.0\n"
      "output_dt = 0.1\ninitial = { u = [3.0], v = [0.0] }\n[matrices]\nmass = [[1.0]]\nstiffness = [[1.0]]\n"
      "[[contacts]]\nname = \"one\"\n" +
      contact;
  const Shell shell;
  // On a belt that starts later it shares no force with the first.
  shell.write("twice.toml",
              scene + "[[contacts]]\nname = \"other\"\n" + contact +
                  "surface_velocity = { type = \"rectangle\", start = 50.0, end = 60.0, amplitude = 1.0 }\n");
  const Ending stopped = shell.run({"compare", "twice.toml", "--engines", "exact,ida", "--no-plots", "--set",
                                    "exact:contacts.other.friction=0"});
  CHECK(stopped.code == 4);
  CHECK(has(stopped.out, "ida: stopped at t = 0: the constraints of the contacts"));
  CHECK(has(stopped.out, "sequence: the same, 0 events up to t = 0\n"));
  CHECK(has(stopped.err, "a computation stopped early"));
  CHECK(exists(shell, "twice-compare/exact/events.csv"));

  std::string zeros;
  for (int i = 0; i < 29; ++i) zeros += "0.0, ";
  shell.write("steep.toml", scene +
                                "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 1e-40\nhistory = { type = "
                                "\"polynomial\", coefficients = [" +
                                zeros + "1.0] }\n");
  const Ending row = shell.run({"compare", "steep.toml", "--engines", "ida,exact", "--no-plots"});
  CHECK(row.code == 0);
  CHECK(has(row.out, "exact: refused: steep.toml:"));
  CHECK(json::parse(shell.read("steep-compare/compare.json"))["runs"][1]["outcome"] == "refused");
  const Ending reference =
      shell.run({"compare", "steep.toml", "--engines", "exact,ida", "--no-plots", "-o", "nothing"});
  CHECK(reference.code == 3);
  CHECK(has(reference.err, "the reference, exact, refuses the scene: steep.toml:"));
  CHECK_FALSE(exists(shell, "nothing"));
}

TEST_CASE("cli compare: what is wrong is told before anything is written") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  struct Wrong {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Wrong> wrong = {
      {{"compare", "belt.toml"}, "expected --engines"},
      {{"compare", "belt.toml", "--engines", "ida"}, "expected two or more"},
      {{"compare", "belt.toml", "--engines", "ida,ida"}, "is given twice"},
      {{"compare", "belt.toml", "--engines", "ida,exat"}, "--engines exat: run.engine: "},
      {{"compare", "belt.toml", "--engines", "ida,exat"}, "did you mean \"exact\"?"},
      {{"compare", "belt.toml", "--engines", "ida,ida:rtol=0"}, "--engines ida:rtol=0: run.rtol: "},
      {{"compare", "belt.toml", "--engines", "ida,exact", "--limit", "evnt_time=1"},
       "did you mean \"event_time\"?"},
      {{"compare", "belt.toml", "--engines", "ida,exact", "--limit", "event_time=-1"},
       "expected a number >= 0"},
      {{"compare", "belt.toml", "--engines", "ida,exact", "--limit", "event_time"}, "expected NAME=NUMBER"},
      {{"compare", "belt.toml", "--engines", "ida,exact", "--set", "exat:run.rtol=1e-9"},
       "did you mean \"exact\"?"},
      {{"compare", "belt.toml", "--engines", "ida,exact", "--set", "run.engine=ida"},
       "choose the engines with --engines"},
      {{"compare", "belt.toml", "--engines", "ida,exact", "--instant", "-1"}, "expected a time >= 0"},
      {{"compare", "belt.toml", "belt.toml", "--engines", "ida,exact"}, "found 2 scenes"},
  };
  for (const Wrong& w : wrong) {
    CAPTURE(w.message);
    const Ending ending = shell.run(w.arguments);
    CHECK(ending.code == 2);
    CHECK(ending.out.empty());
    CHECK(has(ending.err, w.message));
    CHECK(shell.list() == std::vector<std::string>{"belt.toml"});
  }
  CHECK(shell.run({"compare", "missing", "other"}).code == 6);
  CHECK(shell.run({"compare", "missing.toml", "--engines", "ida,exact"}).code == 6);
  CHECK(shell.list() == std::vector<std::string>{"belt.toml"});
}

TEST_CASE("cli compare: an earlier comparison is kept unless forced, other files always") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  const std::vector<std::string> line = {"compare", "belt.toml", "--engines", "ida,exact", "--no-plots"};
  REQUIRE(shell.run(line).code == 0);
  CHECK(shell.run(line).code == 6);
  std::vector<std::string> forced = line;
  forced.push_back("--force");
  shell.write("belt-compare/mine.txt", "mine");
  CHECK(shell.run(forced).code == 0);
  CHECK(shell.read("belt-compare/mine.txt") == "mine");
  std::filesystem::create_directory(shell / "other");
  shell.write("other/events.csv", "mine");
  forced.insert(forced.end(), {"-o", "other"});
  CHECK(shell.run(forced).code == 6);
  CHECK(shell.read("other/events.csv") == "mine");
}

TEST_SUITE_END();
