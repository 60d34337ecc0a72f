// signorini orbit: files, exit codes, and a run.toml that computes the orbit once more.
#include <doctest/doctest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "cli/program.hpp"

using namespace signorini::cli_test;

TEST_SUITE_BEGIN("cli/orbit");

namespace {

/// A forced oscillator with a slider; one line in [run] more.
std::string rubbed(const std::string& load, const std::string& run = "") {
  return "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
         "9.0\nengine = "
         "\"exact\"\n" +
         run +
         "\n[matrices]\nmass = [[1.0]]\nstiffness = [[1.0]]\ndamping = [[0.02]]\n[[contacts]]\nname = "
         "\"pad\"\nlaw = "
         "\"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 1.0\ntangential_stiffness = "
         "20.0\n" +
         load + "[[output]]\nname = \"x\"\nkind = \"displacement\"\ndirection = { d0 = 1.0 }\n";
}

std::string harmonic(const std::string& more = "") {
  return "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 3.0\nhistory = { type = \"harmonic\", omega = "
         "1.5" +
         more + " }\n";
}

std::size_t rows_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("cli orbit: a run of one period, its multipliers, and a run.toml that begins on the orbit") {
  for (const std::string& more : {std::string(), std::string(", start = 2.5")}) {
    CAPTURE(more);
    const Shell shell;
    shell.write("s.toml", rubbed(harmonic(more), "initial = { u = [0.3], v = [0.1] }"));
    const Ending ending = shell.run({"orbit", "s.toml", "--no-plots"});
    CAPTURE(ending.err);
    REQUIRE(ending.code == 0);
    CHECK(ending.out.find("stable (greatest multiplier") != std::string::npos);
    const nlohmann::json orbit = nlohmann::json::parse(shell.read("s-orbit/orbit.json"));
    CHECK(orbit.at("stable") == true);
    CHECK(orbit.at("residual").get<double>() <= 1e-12);
    CHECK(orbit.at("multipliers").size() == 2);
    CHECK(orbit.at("sequence").size() == 4);
    const Ending again = shell.run({"run", "s-orbit/run.toml", "-o", "again", "--no-plots"});
    CAPTURE(again.err);
    CHECK(again.code == 0);
    CHECK(shell.read("again/events.csv") == shell.read("s-orbit/events.csv"));
    // It closes: the last row of states.csv is the state that the run began with.
    std::istringstream first(shell.read("s-orbit/start/states.csv")), last(shell.read("s-orbit/states.csv"));
    std::string header, start, end;
    std::getline(first, header);
    std::getline(first, start);
    std::getline(last, header);
    std::getline(last, end);
    double t0 = 0.0, u0 = 0.0, t1 = 0.0, u1 = 0.0;
    REQUIRE(std::sscanf(start.c_str(), "%lf,%lf", &t0, &u0) == 2);
    REQUIRE(std::sscanf(end.c_str(), "%lf,%lf", &t1, &u1) == 2);
    CHECK(std::abs(u1 - u0) <= 1e-12);
    CHECK(shell.run({"report", "s-orbit", "-o", "page.html"}).code == 0);
    const std::string page = shell.read("page.html");
    CHECK(page.find("<h2>Periodic motion</h2>") != std::string::npos);
    CHECK(page.find("The greatest of 2 Floquet multipliers") != std::string::npos);
    const Ending refused = shell.run({"orbit", "s.toml", "--no-plots"});
    CHECK(refused.code == 6);
    CHECK(shell.run({"orbit", "s.toml", "--no-plots", "--force", "--quiet"}).code == 0);
  }
}

TEST_CASE("cli orbit: the first interrupt ends it while it draws, and the orbit and the branch are kept") {
  for (const std::string over : {"", " --over loads.1.amplitude=2.9:3.0"}) {
    CAPTURE(over);
    const Shell shell;
    shell.write("s.toml", rubbed(harmonic(), "initial = { u = [0.3], v = [0.1] }"));
    std::filesystem::create_directory(shell / "bin");
    shell.write("bin/gnuplot", "#!/bin/sh\ntouch '" + (shell / "drawing").string() + "'\nexec sleep 45\n");
    std::filesystem::permissions(shell / "bin/gnuplot", std::filesystem::perms::owner_all);
    const auto begin = std::chrono::steady_clock::now();
    CHECK(line(shell, "PATH=\"$PWD/bin:$PATH\"; $SIGNORINI orbit s.toml" + over +
                          " >.out 2>.err & p=$!; i=0; while [ $i -lt 400 ] && ! [ -e drawing ]; do sleep "
                          "0.1; i=$((i + 1)); "
                          "done; kill -INT $p; wait $p") == 130);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(40));
    CHECK(exists(shell, "drawing"));
    CHECK(exists(shell, over.empty() ? "s-orbit/orbit.json" : "s-orbit/branch.json"));
  }
}

TEST_CASE("cli orbit: no period, no orbit and a wrong range have their exit codes and reasons") {
  const Shell shell;
  shell.write("still.toml", rubbed(""));
  const Ending still = shell.run({"orbit", "still.toml"});
  CHECK(still.code == 3);
  CHECK(still.err.find("--period") != std::string::npos);
  // Resonance without damping: nothing repeats itself.
  shell.write("grows.toml",
              "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" "
              "}\n[run]\nt_end = 9.0\nengine = "
              "\"exact\"\n[matrices]\nmass = [[1.0]]\nstiffness = [[1.0]]\n[[loads]]\ndirection = { d0 = 1.0 "
              "}\namplitude = "
              "1.0\nhistory = { type = \"harmonic\", omega = 1.0 }\n");
  const Ending grows = shell.run({"orbit", "grows.toml"});
  CHECK(grows.code == 4);
  CHECK(grows.err.find("no orbit found in grows.toml") != std::string::npos);
  shell.write("s.toml", rubbed(harmonic()));
  for (const char* over : {"loads.1.amplitude", "loads.1.amplitude=3", "=3:4", "loads.1.amplitude=3:3"}) {
    CAPTURE(over);
    CHECK(shell.run({"orbit", "s.toml", "--over", over, "--force"}).code == 2);
  }
}

TEST_CASE(
    "cli orbit: a branch on which the given period is not that of the loads, or on which they settle later, "
    "is refused") {
  const Shell shell;
  shell.write("s.toml", rubbed(harmonic()));
  const Ending period = shell.run({"orbit", "s.toml", "--period", "4.1887902047863905", "--over",
                                   "loads.1.history.omega=1.5:1.8", "--no-plots"});
  CAPTURE(period.err);
  CHECK(period.code == 3);
  CHECK(period.err.find("expected a history with this period") != std::string::npos);
  shell.write("late.toml",
              rubbed(harmonic() + "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.5\nhistory = { type = "
                                  "\"rectangle\", start = 0.5, end = 1.0 }\n"));
  const Ending late = shell.run({"orbit", "late.toml", "--over", "loads.2.history.end=1:500", "--no-plots"});
  CAPTURE(late.err);
  CHECK(late.code == 4);  // on the way: what was found before is kept
  CHECK(late.err.find("loads that are periodic only from t = ") != std::string::npos);
}

TEST_CASE("cli orbit: a branch that the scene refuses on the way is resumed where the scene no longer does") {
  const Shell shell;
  shell.write("s.toml", rubbed(harmonic()));
  // No friction below 0: the branch ends there; nothing to resume in another range.
  const Ending early =
      shell.run({"orbit", "s.toml", "--over", "contacts.1.friction=0.4:-0.1", "-o", "b", "--no-plots"});
  CHECK(early.code == 4);
  REQUIRE(exists(shell, "b/last/start/run.toml"));
  const std::size_t before = rows_of(shell.read("b/branch.csv"));
  const Ending other = shell.run(
      {"orbit", "s.toml", "--over", "contacts.1.friction=0.4:0.1", "-o", "b", "--no-plots", "--resume"});
  CHECK(other.code == 2);
  CHECK(other.err.find("--resume") != std::string::npos);
  const Ending again = shell.run(
      {"orbit", "s.toml", "--over", "contacts.1.friction=0.4:-0.1", "-o", "b", "--no-plots", "--resume"});
  CAPTURE(again.err);
  CHECK(again.code == 4);  // refused again, and no point is lost
  CHECK(rows_of(shell.read("b/branch.csv")) >= before);
  CHECK(shell.run({"orbit", "s.toml", "--resume"}).code == 2);
}

TEST_CASE("cli orbit: options of a branch are refused without --over") {
  const Shell shell;
  shell.write("s.toml", rubbed(harmonic()));
  for (const auto& [option, value] :
       {std::pair{"--switch", "1"}, {"--switch", "0"}, {"--step", "0.1"}, {"--most-points", "5"}}) {
    CAPTURE(std::string(option));
    const Ending ending = shell.run({"orbit", "s.toml", option, value, "--no-plots"});
    CHECK(ending.code == 2);
    CHECK(ending.err.find(option) != std::string::npos);
    CHECK(ending.err.find("--over") != std::string::npos);
    CHECK(!exists(shell, "s-orbit"));
  }
}

TEST_CASE("cli orbit: a killed branch is resumed without a row twice or missing") {
  const Shell shell;
  shell.write("s.toml", rubbed(harmonic()));
  const auto over = [](std::vector<std::string> more) {
    std::vector<std::string> line{"orbit", "s.toml", "--over",    "loads.1.amplitude=3.0:3.5",
                                  "-o",    "b",      "--no-plots"};
    line.insert(line.end(), more.begin(), more.end());
    return line;
  };
  const pid_t child = shell.start(over({"--step", "1e-5", "--most-points", "1000000"}));
  for (int i = 0;
       i < 2000 && !(exists(shell, "b/last/mark.json") && rows_of(shell.read("b/branch.csv")) > 40); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGKILL);
  CHECK(shell.wait(child).code == 128 + SIGKILL);
  CHECK(nlohmann::json::parse(shell.read("b/branch.json")).empty());
  const Ending ending = shell.run(over({"--resume", "--step", "0.1"}));
  CAPTURE(ending.err);
  REQUIRE(ending.code == 0);
  const std::string table = shell.read("b/branch.csv");
  double before = 2.9;
  std::istringstream rows(table.substr(table.find('\n') + 1));
  for (std::string row; std::getline(rows, row);) {
    const double parameter = std::stod(row);
    CHECK(parameter > before);
    before = parameter;
  }
  CHECK(before == 3.5);
  const nlohmann::json branch = nlohmann::json::parse(shell.read("b/branch.json"));
  CHECK(branch.at("complete") == true);
  CHECK(rows_of(table) == branch.at("points").get<std::size_t>() + 1);
  // A branch of its own ends there, too.
  const Ending whole = shell.run(
      {"orbit", "s.toml", "--over", "loads.1.amplitude=3.0:3.5", "-o", "w", "--no-plots", "--step", "0.1"});
  REQUIRE(whole.code == 0);
  const auto amplitude = [](const std::string& text) {
    const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
    double p = 0.0, T = 0.0, a = 0.0;
    REQUIRE(std::sscanf(last.c_str(), "%lf,%lf,%lf", &p, &T, &a) == 3);
    return a;
  };
  CHECK(std::abs(amplitude(table) - amplitude(shell.read("w/branch.csv"))) <= 1e-9);
}

TEST_CASE("cli orbit: steps and points of a branch are those that were asked for") {
  const Shell shell;
  shell.write("s.toml", rubbed(harmonic()));
  const Ending few = shell.run({"orbit", "s.toml", "--over", "loads.1.amplitude=3.0:3.5", "-o", "b",
                                "--no-plots", "--most-points", "3"});
  CHECK(few.code == 4);
  CHECK(few.err.find("stopped at the requested maximum of 3 points") != std::string::npos);
  CHECK(rows_of(shell.read("b/branch.csv")) == 4);
  for (const char* wrong : {"--step=0", "--step=2", "--most-points=0"}) {
    CAPTURE(wrong);
    CHECK(shell.run({"orbit", "s.toml", "--over", "loads.1.amplitude=3:4", wrong, "--force"}).code == 2);
  }
  CHECK(shell.run({"orbit", "s.toml", "--step=0.1", "--force"}).code == 2);
}

TEST_CASE("cli orbit: a branch over the load has a row a point, up to the end of the range") {
  const Shell shell;
  shell.write("s.toml", rubbed(harmonic()));
  const Ending ending = shell.run({"orbit", "s.toml", "--over", "loads.1.amplitude=3.0:3.5", "-o", "branch"});
  CAPTURE(ending.err);
  REQUIRE(ending.code == 0);
  const std::string table = shell.read("branch/branch.csv");
  CHECK(table.starts_with("parameter,period,amplitude,x minimum,x maximum,max_multiplier,stable,"));
  const nlohmann::json branch = nlohmann::json::parse(shell.read("branch/branch.json"));
  CHECK(branch.at("complete") == true);
  CHECK(rows_of(table) == branch.at("points").get<std::size_t>() + 1);
  CHECK(table.find("\n3,") != std::string::npos);
  CHECK(table.find("\n3.5,") != std::string::npos);
  const std::string script = shell.read("branch/plots/branch.gp");
  CHECK(script.find("greatest multiplier") != std::string::npos);
  CHECK(script.find("x [m]") != std::string::npos);
  CHECK(rows_of(shell.read("branch/plots/branch.csv")) == rows_of(table));
  CHECK(shell.run({"report", "branch", "-o", "page.html"}).code == 0);
  CHECK(shell.read("page.html").find("<h2>branch.csv</h2>") != std::string::npos);
  const Ending none = shell.run({"orbit", "s.toml", "--over", "loads.1.amplitude=3.0:3.1", "-o", "branch",
                                 "--force", "--no-plots", "--switch", "1"});
  CAPTURE(none.err);
  CHECK(none.code == 0);
  CHECK(!exists(shell, "branch/plots/branch.gp"));
  CHECK(shell.run({"orbit", "s.toml", "--over", "loads.1.amplitude=3:4", "--switch", "-1"}).code == 2);
}

TEST_CASE("cli orbit: a branch is resumed with its own scene only") {
  const Shell shell;
  const std::string load =
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 3.0\nhistory = { type = \"table\", file = "
      "\"load.csv\", "
      "interpolation = \"linear\", period = 4.0 }\n";
  const std::string wave = "0,0\n1,1\n3,-1\n4,0\n";
  shell.write("load.csv", wave);
  shell.write("s.toml", rubbed(load));
  const auto resume = [&](std::vector<std::string> more, bool again = true) {
    std::vector<std::string> line{"orbit", "s.toml", "--over",    "loads.1.amplitude=3.0:3.5",
                                  "-o",    "b",      "--no-plots"};
    if (again) line.emplace_back("--resume");
    line.insert(line.end(), more.begin(), more.end());
    return shell.run(line);
  };
  const Ending few = resume({"--most-points", "3"}, false);
  CAPTURE(few.err);
  REQUIRE(few.code == 4);
  const std::string rows = shell.read("b/branch.csv");
  const auto refused = [&](const Ending& ending, const std::string& key) {
    CAPTURE(ending.err);
    CHECK(ending.code == 2);
    CHECK(ending.err.find("--resume") != std::string::npos);
    CHECK(ending.err.find(key) != std::string::npos);
    CHECK(shell.read("b/branch.csv") == rows);
  };
  refused(resume({"--set", "contacts.pad.friction=0.9"}), "contacts.pad.friction.kinetic (1.0, here 0.9)");
  refused(resume({"--set", "run.engine=ida"}), "run.engine");
  refused(resume({"--times", "2"}), "--times (1, here 2)");
  shell.write("s.toml",
              rubbed(load + "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.1\nhistory = { type = "
                            "\"constant\" }\n"));
  refused(resume({}), "loads.2");
  shell.write("s.toml", rubbed(load));
  shell.write("load.csv", "0,0\n1,1.01\n3,-1\n4,0\n");
  refused(resume({}), "loads.1.history.values");
  shell.write("load.csv", wave);
  shell.write("s.toml", "# its own scene again\n" + rubbed(load));
  const Ending own = resume({"--step", "0.1"});
  CAPTURE(own.err);
  CHECK(own.code == 0);
  CHECK(shell.read("b/branch.csv").starts_with(rows));
}

TEST_SUITE_END();
