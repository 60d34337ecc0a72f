#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "program.hpp"

using nlohmann::json;
using signorini::cli_test::belt;
using signorini::cli_test::Ending;
using signorini::cli_test::exists;
using signorini::cli_test::has;
using signorini::cli_test::Shell;

TEST_SUITE_BEGIN("cli/study");

TEST_CASE("cli study: errors fall with the setting, every run is a row, all files are there") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const Ending ending = shell.run({"study", "belt.toml", "--engines", "exact,ida,newmark", "--rtol",
                                   "1e-5,1e-9", "--dt", "1e-1:1e-2", "--repeats", "2"});
  CHECK(ending.code == 0);
  CHECK(ending.err.empty());
  CHECK(has(ending.out, "errors against exact"));
  CHECK(has(ending.out, "is cheapest"));
  for (const char* name : {"study.csv", "study.json", "study.md", "runs/003-ida-rtol-1e-09/events.csv",
                           "runs/001-exact/summary.json", "plots/work-precision.gp", "plots/line-1.csv"}) {
    CAPTURE(name);
    CHECK(exists(shell, std::string("belt-study/") + name));
  }
  if (std::system("command -v gnuplot >/dev/null 2>&1") == 0)
    CHECK(shell.read("belt-study/plots/work-precision.png").size() > 4000);
  const json study = json::parse(shell.read("belt-study/study.json"));
  CHECK(study["reference"] == "exact");
  const json& rows = study["rows"];
  REQUIRE(rows.size() == 5);
  const auto error = [&](std::size_t row, const char* quantity) {
    return rows[row]["errors"][quantity]["value"].get<double>();
  };
  for (const char* quantity : {"event_time", "displacement", "force_away", "energy"}) {
    CAPTURE(quantity);
    CHECK(error(0, quantity) < 1e-12);  // exact, masses changed in their last digits
    CHECK(error(2, quantity) < 0.1 * error(1, quantity));
    CHECK(error(4, quantity) < 0.1 * error(3, quantity));
    CHECK(error(2, quantity) > 0.0);
  }
  for (const json& row : rows) {
    CHECK(row["complete"] == true);
    CHECK(row["wall_times"].size() == 2);
  }
  CHECK(study["frontier"]["event_time"].back() == "exact");
}

TEST_CASE("cli study: outputs have errors, too") {
  const Shell shell;
  shell.write("belt.toml", belt(20) + R"([[output]]
name = "speed"
kind = "velocity"
at = "block"
direction = [1.0, 0.0]
)");
  const Ending ending = shell.run({"study", "belt.toml", "--engines", "exact,ida", "--rtol", "1e-5,1e-9",
                                   "--repeats", "1", "--no-plots"});
  CHECK(ending.code == 0);
  const json study = json::parse(shell.read("belt-study/study.json"));
  const json& rows = study["rows"];
  REQUIRE(rows.size() == 3);
  const auto error = [&](std::size_t row) {
    REQUIRE(rows[row]["errors"].contains("response:speed"));
    return rows[row]["errors"]["response:speed"]["value"].get<double>();
  };
  CHECK(error(0) < 1e-12);
  CHECK(error(2) > 0.0);
  CHECK(error(2) < 0.1 * error(1));
}

TEST_CASE("cli study: the table alone, for papers") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const std::vector<std::string> study{"study", "belt.toml", "--engines", "exact,ida", "--rtol",
                                       "1e-6",  "--repeats", "1",         "--no-plots"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), study.begin(), study.end());
    return shell.run(more);
  };
  const Ending good = with({"--table", "markdown"});
  CHECK(good.code == 0);
  CHECK(good.out.rfind("| ", 0) == 0);
  CHECK(std::count(good.out.begin(), good.out.end(), '\n') == 4);  // header, rule, two runs
  CHECK(has(good.out, "| exact |"));
  const Ending tex = with({"--table", "latex", "--force"});
  CHECK(tex.out.rfind("\\begin{tabular}{", 0) == 0);
  CHECK(has(tex.out, "\\end{tabular}\n"));
  CHECK(with({"--table", "latex", "--json", "--force"}).code == 2);
}

TEST_CASE("cli study: runs that lose events, are refused or too slow are rows, too") {
  const Shell shell;
  std::string scene = belt(20);
  const std::string kinetic = "kinetic = 1.0";
  scene.insert(scene.find(kinetic) + kinetic.size(), ", stribeck_velocity = 0.5");
  shell.write("stribeck.toml", scene);
  const Ending ending = shell.run({"study", "stribeck.toml", "--engines", "exact,ida,newmark", "--rtol",
                                   "1e-6", "--dt", "1", "--repeats", "1", "--no-plots", "--json"});
  CHECK(ending.code == 0);
  const json study = json::parse(ending.out);
  CHECK(study["reference"] == "ida rtol=1e-07");
  CHECK(study["rows"][0]["outcome"] == "refused");
  CHECK(has(study["rows"][0]["reason"], "stribeck"));
  CHECK(study["rows"][1]["complete"] == true);
  CHECK(study["rows"][2]["outcome"] == "refused");
  CHECK(has(study["notes"].dump(), "exact is not the reference"));

  shell.write("belt.toml", belt(100));
  const Ending coarse = shell.run({"study", "belt.toml", "--engines", "friction-iteration", "--dt", "1",
                                   "--repeats", "1", "--json", "--no-plots"});
  const json lost = json::parse(coarse.out);
  CHECK(lost["rows"][0]["complete"] == false);
  CHECK(has(lost["rows"][0]["split"]["how"], "exact has belt "));
  CHECK(lost["rows"][0]["wall_times"].size() == 1);

  const Ending slow = shell.run({"study", "belt.toml", "--engines", "newmark,exact", "--dt", "1e-7",
                                 "--repeats", "1", "--time-limit", "0.2", "--force", "--json", "--no-plots"});
  CHECK(slow.code == 0);
  const json late = json::parse(slow.out);
  CHECK(late["rows"][0]["outcome"] == "too slow");
  CHECK(late["rows"][1]["complete"] == true);
}

TEST_CASE("cli study: a key varied against the unvaried reference") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  const Ending ending =
      shell.run({"study", "belt.toml", "--engines", "exact", "--vary", "springs.1.stiffness=1.0,1.001",
                 "--repeats", "1", "--no-plots", "--json"});
  CHECK(ending.code == 0);
  const json study = json::parse(ending.out);
  REQUIRE(study["rows"].size() == 3);  // the first one unvaried
  CHECK(study["rows"][0]["run"] == "exact");
  CHECK(study["rows"][1]["errors"]["displacement"]["value"].get<double>() < 1e-12);
  CHECK(study["rows"][2]["errors"]["displacement"]["value"].get<double>() > 1e-5);
}

TEST_CASE("cli study: wrong command lines are told before anything is written") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  const auto wrong = [&](std::vector<std::string> arguments, const char* said) {
    arguments.insert(arguments.begin(), {"study", "belt.toml"});
    const Ending ending = shell.run(arguments);
    CAPTURE(ending.err);
    CHECK(ending.code == 2);
    CHECK(has(ending.err, said));
    CHECK_FALSE(exists(shell, "belt-study"));
  };
  wrong({"--engines", "idea"}, "--engines idea");
  wrong({"--engines", "ida,ida"}, "is given twice");
  wrong({"--engines", ",", "-o", "st"}, "--engines: found \",\", expected engines by name");
  wrong({"--engines", "exact,,ida"}, "--engines: found \"exact,,ida\", expected engines by name");
  wrong({"--rtol", "1e-4:0"}, "--rtol 1e-4:0: found \"0\"");
  wrong({"--dt", "x"}, "--dt x");
  wrong({"--repeats", "0"}, "--repeats 0");
  wrong({"--time-limit", "-1"}, "--time-limit");
  wrong({"--vary", "run.rtol=1,2"},
        "--vary run.rtol: is not allowed, because --rtol and --dt set the accuracy");
  wrong({"--vary", "spring.1.stiffness=1,2"}, "--vary spring.1.stiffness=1: unknown key");
  wrong({"--set", "run.engine=ida"}, "choose the engines with --engines");
  shell.write("note.txt", "mine");
  CHECK(shell.run({"study", "belt.toml", "-o", "note.txt"}).code == 6);
  std::filesystem::create_directory(shell / "mine");
  shell.write("mine/file", "x");
  CHECK(shell.run({"study", "belt.toml", "-o", "mine", "--force"}).code == 6);
  CHECK(shell.read("mine/file") == "x");
}

TEST_CASE("cli study: an interrupt keeps what was measured") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const pid_t child = shell.start({"study", "belt.toml", "--engines", "exact,newmark", "--dt", "1e-2,1e-7"});
  for (int i = 0; i < 500 && !has(shell.read("belt-study/study.csv"), "newmark dt=0.01"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(child, SIGINT);
  const Ending ending = shell.wait(child);
  CHECK(ending.code == 130);
  CHECK(has(ending.err, "kept in belt-study"));
  const json study = json::parse(shell.read("belt-study/study.json"));
  CHECK(study["interrupted"] == true);
  CHECK(study["rows"].size() >= 2);
}

TEST_CASE("cli study: --force removes neither the scene nor what others put there") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  const std::vector<std::string> line = {"study", "belt.toml", "-o", "d",         "--engines",
                                         "exact", "--repeats", "1",  "--no-plots"};
  CHECK(shell.run(line).code == 0);
  shell.write("d/runs/001-exact/notes.txt", "mine");
  std::filesystem::create_directory(shell / "d/runs/own");
  shell.write("d/runs/own/summary.json", "mine");
  std::vector<std::string> again = line;
  again.emplace_back("--force");
  CHECK(shell.run(again).code == 0);
  CHECK(shell.read("d/runs/001-exact/notes.txt") == "mine");
  CHECK(shell.read("d/runs/own/summary.json") == "mine");
  CHECK(exists(shell, "d/runs/002-exact/events.csv"));
  for (const char* place :
       {"d/study.md", "d/study.json", "d/plots/line-1.csv", "d/runs/002-exact/run.toml"}) {
    std::filesystem::create_directories((shell / place).parent_path());
    shell.write(place, belt(10));
    again[1] = place;
    const Ending ending = shell.run(again);
    CAPTURE(place);
    CHECK(ending.code == 6);
    CHECK(has(ending.err, "lies in d"));
    CHECK(shell.read(place) == belt(10));
    if (std::string(place) == "d/study.json") std::filesystem::remove(shell / place);
    shell.write("d/study.json", "{}");
  }
}

TEST_CASE("cli study: exact in modes is measured against its series, as long as those are affordable") {
  const Shell shell;
  const std::string scene = SIGNORINI_MODELS "/pipeline.toml";
  const auto study = [&](const char* limit, const std::vector<std::string>& more = {},
                         const char* t_end = "run.t_end=0.02") {
    std::vector<std::string> words = {"study",   scene,       "--set", t_end,          "--engines",
                                      "exact",   "--repeats", "1",     "--no-plots",   "--quiet",
                                      "--force", "-o",        "s",     "--time-limit", limit};
    words.insert(words.end(), more.begin(), more.end());
    const Ending ending = shell.run(words);
    CHECK(ending.code == 0);
    return json::parse(shell.read("s/study.json"));
  };
  const json both = study("60");
  CHECK(both["reference"] == "exact run.flow=taylor");
  REQUIRE(both["rows"].size() == 2);
  CHECK(both["rows"][1]["setting"] == "");
  const double error = both["rows"][1]["errors"]["event_time"]["value"].get<double>();
  CHECK(error > 0.0);
  CHECK(error < 1e-12);

  // The series is estimated at 0.05 s; a reference may take ten times the limit.
  const json alone = study("0.04", {}, "run.t_end=0.2");
  CHECK(alone["reference"] == "exact");
  CHECK(alone["rows"].size() == 1);
  CHECK(has(alone["notes"].dump(), "exact run.flow=taylor is omitted: it would take"));

  const json asked = study("60", {"--set", "run.flow=modal"});
  CHECK(asked["reference"] == "exact");
  CHECK(asked["rows"].size() == 1);
}

TEST_CASE("cli study: what would take many time limits is named, not tried") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const Ending ending = shell.run({"study", "belt.toml", "--engines", "exact,newmark", "--dt", "1e-2,1e-10",
                                   "--repeats", "1", "--no-plots", "--time-limit", "20"});
  CHECK(ending.code == 0);
  const json rows = json::parse(shell.read("belt-study/study.json"))["rows"];
  REQUIRE(rows.size() == 3);
  CHECK(rows[1]["outcome"] == "done");
  CHECK(rows[2]["outcome"] == "too slow");
  CHECK(has(rows[2]["reason"].get<std::string>(), "not started: the run would take about"));
}
