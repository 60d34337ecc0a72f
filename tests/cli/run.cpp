#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "program.hpp"

using nlohmann::json;
using signorini::cli_test::belt;
using signorini::cli_test::Ending;
using signorini::cli_test::exists;
using signorini::cli_test::has;
using signorini::cli_test::lines;
using signorini::cli_test::Shell;

TEST_SUITE_BEGIN("cli/run");

TEST_CASE("cli run: tables on stdout, nothing on stderr, the whole directory") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const Ending ending = shell.run({"run", "belt.toml"});
  CHECK(ending.code == 0);
  CHECK(ending.err.empty());
  CHECK(ending.out.find("Block on a moving belt") == 0);
  CHECK(ending.out.find("slip") != std::string::npos);
  CHECK(ending.out.find("belt-run") != std::string::npos);
  CHECK(ending.out.find('\x1b') == std::string::npos);
  for (const char* name : {"events.csv", "history.csv", "contacts.csv", "energy.csv", "summary.json",
                           "run.toml", "plots/displacement.gp", "plots/contact-belt.gp", "plots/energy.gp"}) {
    CAPTURE(name);
    CHECK(exists(shell, std::string("belt-run/") + name));
  }
  CHECK(lines(shell.read("belt-run/history.csv")) == 202);
  CHECK(shell.read("belt-run/history.csv").rfind("t,block.ux,block.vx\n0,0,0\n", 0) == 0);
}

TEST_CASE("cli run: the cutoff that a tolerance found is said, in check that none was looked for") {
  const Shell shell;
  const std::string pipeline = std::string(SIGNORINI_MODELS) + "/pipeline.toml";
  const std::vector<std::string> asked{pipeline, "--set", "reduction.tolerance=1e-2", "--set",
                                       "run.t_end=2e-3"};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.begin() + 1, asked.begin(), asked.end());
    return shell.run(words);
  };
  const Ending ending = with({"run", "--engine", "exact", "--no-plots", "-o", "cut"});
  CHECK(ending.code == 0);
  const json reduction = json::parse(shell.read("cut/summary.json"))["reduction"];
  CHECK(reduction["error"] <= 1e-2);
  CHECK(reduction["tried"].size() >= 2);
  CHECK(ending.out.find("reduction: " + std::to_string(reduction["modes_kept"].get<int>()) +
                        " modes, up to ") != std::string::npos);
  CHECK(ending.out.find("of the greatest displacement (" + std::to_string(reduction["tried"].size()) +
                        " trials)") != std::string::npos);
  CHECK(ending.out.find("they would change displacements at contacts by about ") != std::string::npos);
  CHECK(reduction["left_out_at_contacts"]["displacement"].get<double>() > 0.0);
  const Ending certified = with({"run", "--engine", "exact", "--certify", "--no-plots", "-o", "certified"});
  CHECK(certified.out.find("reduced model certified to the end") != std::string::npos);
  const Ending page = shell.run({"report", "certified"});
  CHECK(page.code == 0);
  CHECK(shell.read("certified/report.html").find("the sequence of events of the reduced model") !=
        std::string::npos);
  const Ending checked = with({"check"});
  CHECK(checked.code == 0);
  CHECK((checked.out + checked.err).find("reduction.tolerance: this command uses the full model") !=
        std::string::npos);
}

TEST_CASE("cli run: response quantities as table, CSV, JSON and picture") {
  const Shell shell;
  shell.write("belt.toml", belt(20) +
                               "\n[[output]]\nname = \"x\"\nkind = \"displacement\"\nat = \"block\"\n"
                               "direction = [2.0, 0.0]\n[[output]]\nname = \"pull\"\nkind = \"contact\"\n"
                               "at = \"belt\"\nquantity = \"T\"\n");
  const Ending ending = shell.run({"run", "belt.toml"});
  CHECK(ending.code == 0);
  CHECK(ending.out.find("response") != std::string::npos);
  CHECK(ending.out.find("response.csv, contacts.csv, motion.csv, energy.csv, curves.csv, ") !=
        std::string::npos);
  CHECK(exists(shell, "belt-run/plots/response.gp"));
  CHECK(shell.read("belt-run/response.csv").rfind("t,x,pull\n0,0,", 0) == 0);
  const json summary = json::parse(shell.read("belt-run/summary.json"));
  REQUIRE(summary["response"].size() == 2);
  const json& x = summary["response"][0];
  CHECK(x["name"] == "x");
  CHECK(x["kind"] == "displacement");
  CHECK(x["unit"] == summary["units"]["length"]);
  CHECK(summary["response"][1]["unit"] == summary["units"]["force"]);
  // Its greatest value is at or a little above that of the rows of history.csv.
  std::istringstream history(shell.read("belt-run/history.csv"));
  std::string row;
  double greatest = 0.0;
  std::getline(history, row);
  while (std::getline(history, row)) greatest = std::max(greatest, std::stod(row.substr(row.find(',') + 1)));
  CHECK(x["maximum"]["value"].get<double>() >= greatest);
  CHECK(x["maximum"]["value"].get<double>() < 1.001 * greatest);
  const json pull = summary["response"][1];
  CHECK(std::max(pull["maximum"]["value"].get<double>(), -pull["minimum"]["value"].get<double>()) ==
        doctest::Approx(summary["contacts"][0]["peaks"]["T"].get<double>()).epsilon(1e-9));
  const json again = [&] {
    REQUIRE(shell.run({"run", "belt-run/run.toml", "-o", "again", "--no-plots"}).code == 0);
    return json::parse(shell.read("again/summary.json"));
  }();
  CHECK(again["response"] == summary["response"]);
  CHECK(shell.read("again/response.csv") == shell.read("belt-run/response.csv"));
  REQUIRE(
      shell
          .run({"run", "belt.toml", "-o", "belt-run", "--force", "--no-plots", "--set", "run.engine=\"ida\""})
          .code == 0);
  CHECK_FALSE(exists(shell, "belt-run/plots"));
}

TEST_CASE("cli run: nothing but the tables, whole, for papers") {
  const Shell shell;
  shell.write("belt.toml", belt(800) +
                               "\n[[output]]\nname = \"x_block\"\nkind = \"displacement\"\nat = \"block\"\n"
                               "direction = [2.0, 0.0]\n");
  const Ending good = shell.run({"run", "belt.toml", "--engine", "exact", "--table", "markdown"});
  CHECK(good.code == 0);
  CHECK(good.out.rfind("| support loads | N at rest [N] | N min [N] | at t [s] |", 0) == 0);
  const std::string head =
      "| t [s] | contact | event | from -> to | N [N] | T [N] |\n|---:|---|---|---|---:|---:|\n";
  const std::size_t at = good.out.find(head);
  REQUIRE(at != std::string::npos);
  const std::string table = good.out.substr(at, good.out.find("\n\n", at) + 1 - at);
  const long events = lines(shell.read("belt-run/events.csv")) - 1;
  CHECK(events > 100);  // more than the table on a terminal shows
  CHECK(good.out.find("\n\n| greatest displacement relative to the start |") != std::string::npos);
  CHECK(good.out.find("\n\n| response | unit | maximum |") != std::string::npos);
  CHECK(good.out.find("\n\n| audit: greatest violation |") != std::string::npos);
  CHECK(lines(table) == events + 2);
  const Ending tex =
      shell.run({"run", "belt.toml", "--engine", "exact", "--table", "latex", "--force", "--no-plots"});
  CHECK(tex.out.find("\n\\begin{tabular}{rlllrr}\n") != std::string::npos);
  CHECK(tex.out.find("x\\_block & m & ") != std::string::npos);
  CHECK(shell.run({"run", "belt.toml", "--table", "html"}).code == 2);
  CHECK(shell.run({"run", "belt.toml", "--table", "latex", "--json", "--force"}).code == 2);
}

TEST_CASE("cli run: run.toml gives the same bytes of events.csv") {
  const Shell shell;
  shell.write("belt.toml", belt(30));
  REQUIRE(shell.run({"run", "belt.toml", "--no-plots", "--set", "contacts.belt.friction=0.9"}).code == 0);
  REQUIRE(shell.run({"run", "belt-run/run.toml", "-o", "again", "--no-plots"}).code == 0);
  CHECK(lines(shell.read("again/events.csv")) > 1);
  CHECK(shell.read("again/events.csv") == shell.read("belt-run/events.csv"));
  CHECK(shell.read("again/run.toml") == shell.read("belt-run/run.toml"));
}

TEST_CASE("cli run: where no states can be decided summary.json says why") {
  const Shell shell;
  // Painleve's rod, as in tests/behaviour/rigid.cpp: sliding with this friction, pressing digs it in.
  const auto rod = [](const char* load) {
    return std::string(
               "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n") +
           "[run]\nt_end = 1.0\ninitial = { u = [0.0, 0.0], v = [1.0, 0.0] }\n[matrices]\n"
           "mass = [[0.34847735667203295, 0.2532986927066816], [0.2532986927066816, 0.9015226433279672]]\n"
           "stiffness = [[0.0, 0.0], [0.0, 0.0]]\n[[contacts]]\nname = \"tip\"\nlaw = \"rigid\"\n"
           "normal = { d1 = -1.0 }\ntangent = { d0 = 1.0 }\nfriction = 4.0\n[[loads]]\n"
           "direction = { d0 = 0.2532986927066816, d1 = 0.9015226433279672 }\namplitude = " +
           load + "\n";
  };
  shell.write("none.toml", rod("10.0"));
  CHECK(shell.run({"run", "none.toml", "--no-plots"}).code == 4);
  const json none = json::parse(shell.read("none-run/summary.json"));
  CHECK(none["refusal"]["kind"] == "paradox");
  CHECK(none["refusal"]["contacts"] == json::array({"tip"}));
  CHECK(none["refusal"]["reason"] == none["outcome"]["reason"]);
  // W = [[a, b], [b, c]] of M^-1: in units of its diagonal 1 and r = b/sqrt(a c), (1 + r)/(1 - r)
  const double r = 0.2532986927066816 / std::sqrt(0.34847735667203295 * 0.9015226433279672);
  CHECK(none["refusal"]["cond"].get<double>() == doctest::Approx((1.0 + r) / (1.0 - r)));
  CHECK(none["refusal"]["residual"].get<double>() > 1e12);
  CHECK(none["undecided"] == 0);
  shell.write("several.toml", rod("-10.0"));
  CHECK(shell.run({"run", "several.toml", "--no-plots"}).code == 4);
  const json several = json::parse(shell.read("several-run/summary.json"));
  CHECK(several["refusal"]["kind"] == "ambiguous");
  CHECK(several["refusal"]["residual"] == 0.0);
  shell.write("belt.toml", belt(5));
  CHECK(shell.run({"run", "belt.toml", "--no-plots"}).code == 0);
  const json done = json::parse(shell.read("belt-run/summary.json"));
  CHECK(done["undecided"] == 0);
  CHECK_FALSE(done.contains("refusal"));
}

TEST_CASE("cli run: --json prints summary.json, --quiet nothing") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  const Ending as_json = shell.run({"run", "belt.toml", "--json", "--no-plots"});
  CHECK(as_json.code == 0);
  CHECK(as_json.out == shell.read("belt-run/summary.json"));
  CHECK(json::parse(as_json.out)["outcome"]["kind"] == "done");
  CHECK_FALSE(exists(shell, "belt-run/plots"));
  const Ending quiet = shell.run({"run", "belt.toml", "--quiet", "--force", "--no-plots"});
  CHECK(quiet.code == 0);
  CHECK(quiet.out.empty());
  CHECK(quiet.err.empty());
}

TEST_CASE("cli run: an earlier run is kept unless forced") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  REQUIRE(shell.run({"run", "belt.toml", "--no-plots"}).code == 0);
  const std::string before = shell.read("belt-run/history.csv");
  const Ending refused = shell.run({"run", "belt.toml", "--set", "run.t_end=2"});
  CHECK(refused.code == 6);
  CHECK(refused.out.empty());
  CHECK(refused.err.find("--force") != std::string::npos);
  CHECK(shell.read("belt-run/history.csv") == before);
  CHECK(shell.run({"run", "belt.toml", "--set", "run.t_end=2", "--force", "--no-plots"}).code == 0);
  CHECK(lines(shell.read("belt-run/history.csv")) == 22);
}

TEST_CASE("cli run: --force replaces runs, and neither the scene nor a folder of other files") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  REQUIRE(shell.run({"run", "belt.toml", "--no-plots"}).code == 0);
  const std::string scene = shell.read("belt-run/run.toml"), history = shell.read("belt-run/history.csv");
  const Ending own = shell.run({"run", "belt-run/run.toml", "-o", "belt-run", "--force", "--no-plots"});
  CHECK(own.code == 6);
  CHECK(own.err.find("--force would replace belt-run/run.toml, the scene of this run") != std::string::npos);
  CHECK(shell.read("belt-run/run.toml") == scene);
  CHECK(shell.read("belt-run/history.csv") == history);

  std::filesystem::create_directory(shell / "mine");
  shell.write("mine/history.csv", "my own\n");
  const Ending mine = shell.run({"run", "belt.toml", "-o", "mine", "--force"});
  CHECK(mine.code == 6);
  CHECK(mine.err.find("contains no run (no summary.json)") != std::string::npos);
  CHECK(shell.read("mine/history.csv") == "my own\n");
}

TEST_CASE("cli run: a start that fails claims nothing and leaves nothing") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  // No file can have even one byte: the directory can be made, and nothing written in it.
  const Ending ending =
      shell.wait(shell.start({"run", "belt.toml", "-o", "a/b", "--no-plots", "--quiet"}, ".out", 1));
  CHECK(ending.code == 6);
  CHECK(shell.list() == std::vector<std::string>{"belt.toml"});
  const Ending nowhere = shell.run({"run", "belt.toml", "-o", "/proc/x"});
  CHECK(nowhere.code == 6);
  CHECK(nowhere.err.rfind("error: /proc/x: ", 0) == 0);
  CHECK(nowhere.err.find("kept") == std::string::npos);
}

TEST_CASE("cli run: an interrupt keeps what was computed, says so, and ends with 130") {
  int signal = 0;
  SUBCASE("SIGINT") { signal = SIGINT; }
  SUBCASE("SIGTERM") { signal = SIGTERM; }
  const Shell shell;
  shell.write("belt.toml", belt(5e6));
  const pid_t child = shell.start({"run", "belt.toml"});
  for (int i = 0; i < 1000 && lines(shell.read("belt-run/events.csv")) < 5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(child, signal);
  const Ending ending = shell.wait(child);
  CHECK(ending.code == 130);
  CHECK(ending.err.rfind("error: interrupted at t = ", 0) == 0);
  CHECK(ending.err.find("kept in belt-run") != std::string::npos);
  const json summary = json::parse(shell.read("belt-run/summary.json"));
  CHECK(summary["outcome"]["kind"] == "interrupted");
  CHECK(summary["outcome"]["exit_code"] == 130);
  CHECK(summary["outcome"]["t"].get<double>() > 0.0);
  CHECK(shell.read("belt-run/history.csv").back() == '\n');
}

TEST_CASE("cli run: an energy balance at rest is relative to the scene's scales") {
  const Shell shell;
  const Ending ending =
      shell.run({"run", SIGNORINI_TEST_DATA "/scenes/robust/pump.toml", "--set", "loads.1.amplitude=0.0",
                 "--set", "run.t_end=0.2", "--no-plots", "-o", "out"});
  CHECK(ending.code == 0);
  const json energy = json::parse(shell.read("out/summary.json"))["audit"]["energy"];
  CHECK(energy["relative"].get<double>() <= 1e-9);
  CHECK(energy["scale"].get<double>() > 0.0);
}

TEST_CASE("cli run: a killed run leaves whole rows, but for a last one that ends with a page of the file") {
  const Shell shell;
  shell.write("belt.toml", belt(5e6));
  const pid_t child = shell.start({"run", "belt.toml"});
  for (int i = 0; i < 1000 && lines(shell.read("belt-run/events.csv")) < 5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(child, SIGKILL);
  CHECK(shell.wait(child).code == 128 + SIGKILL);
  for (const char* name : {"events.csv", "history.csv", "contacts.csv", "energy.csv"}) {
    const std::string text = shell.read(std::string("belt-run/") + name);
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    CHECK((text.back() == '\n' || text.size() % page == 0));
  }
  CHECK(json::parse(shell.read("belt-run/summary.json"))["outcome"]["kind"] == "running");
  CHECK(exists(shell, "belt-run/run.toml"));
  // Whatever the page had left of the last row: it is no row, for pictures and comparisons.
  for (const char* name : {"events.csv", "history.csv", "contacts.csv", "energy.csv"}) {
    CAPTURE(name);
    const std::string file = std::string("belt-run/") + name, text = shell.read(file);
    shell.write(file, text.substr(0, text.find_last_of(',') + 2));
  }
  CHECK(shell.run({"plot", "belt-run"}).code == 0);
  std::filesystem::copy(shell / "belt-run", shell / "copy", std::filesystem::copy_options::recursive);
  CHECK(shell.run({"compare", "belt-run", "copy"}).code == 0);
  // The kill may have come between the tables.
  const long rows =
      std::min(lines(shell.read("belt-run/history.csv")), lines(shell.read("belt-run/contacts.csv"))) - 1;
  CHECK(has(shell.read("belt-run/plots/displacement.gp"), "::" + std::to_string(rows - 1) + " using"));
}

TEST_CASE("cli run: a disk that fills up during a run leaves whole rows, and a message with the time") {
  const Shell shell;
  shell.write("belt.toml", belt(400));
  // Past the limit a write fails as on a full disk; the limit is the child's alone.
  const pid_t child = shell.start({"run", "belt.toml", "--no-plots"}, ".out", 40000);
  const Ending ending = shell.wait(child);
  CHECK(ending.code == 6);
  CHECK(ending.err.find("cannot be written: ") != std::string::npos);
  CHECK(ending.err.find("the run stopped at t = ") != std::string::npos);
  CHECK(ending.err.find("are kept in belt-run") != std::string::npos);
  const json outcome = json::parse(shell.read("belt-run/summary.json"))["outcome"];
  CHECK(outcome["kind"] == "stopped");
  CHECK(outcome["exit_code"] == 6);
  CHECK(outcome["t"].get<double>() > 0.0);
  CHECK(outcome["reason"].get<std::string>().find("cannot be written: ") != std::string::npos);
  for (const char* name : {"events.csv", "history.csv", "contacts.csv", "energy.csv"}) {
    CAPTURE(name);
    const std::string text = shell.read(std::string("belt-run/") + name);
    REQUIRE(!text.empty());
    CHECK(text.back() == '\n');
    CHECK(text.size() <= 40000);
  }
  CHECK(lines(shell.read("belt-run/history.csv")) > 100);
}

TEST_CASE("cli run: a certified run that stops says so in every file, and to where it is certain") {
  // Three balls that land within ten resolutions of the clock, where two such instants are allowed.
  const Shell shell;
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\ngravity = [0.0, "
      "-10.0]\n[run]\nt_end = 2.0\noutput_dt = 0.1\nmax_events_at_once = 2\n[nodes]\na = [0.0, 0.0]\n"
      "b = [0.0, 0.0]\nc = [0.0, 0.0]\n";
  const char* gaps[] = {"0.8", "0.80000000000016", "0.80000000000032"};  // 4e-14 s apart
  for (int i = 0; i < 3; ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    text += "[[masses]]\nnode = \"" + name + "\"\nmass = 1.0\n[[contacts]]\nname = \"" + name +
            "\"\nnode = \"" + name +
            "\"\nlaw = \"rigid\"\nnormal = [0.0, 1.0]\nrestitution = 0.5\ngap = " + gaps[i] + "\n";
  }
  shell.write("balls.toml", text);
  // Together: apart, none of them stands still.
  const Ending ending =
      shell.run({"run", "balls.toml", "--no-plots", "--certify", "--engine", "exact", "--instants"});
  CHECK(ending.code == 4);
  CHECK(has(ending.err, "the computation stopped early, at t = 0.4 s: 2 events at one instant"));
  // The companion stops as the run does, some roundings earlier or later.
  CHECK(has(ending.out, "certified until t = 0.4 s: 2 of 2 events, times within "));
  CHECK_FALSE(has(ending.out, "certified to the end"));
  const json summary = json::parse(shell.read("balls-run/summary.json"));
  CHECK(summary["outcome"]["kind"] == "stopped");
  const json& refusal = summary["refusal"];
  CHECK(refusal["kind"] == "standstill");
  CHECK(refusal["contacts"] == json({"a", "b", "c"}));
  CHECK(refusal["cond"].get<double>() == doctest::Approx(1.0));
  CHECK(refusal["residual"] == 0.0);
  CHECK(refusal["reason"] == summary["outcome"]["reason"]);
  CHECK(summary["certified"]["until"].get<double>() == doctest::Approx(0.4));
  CHECK(summary["certified"]["events"] == 2);
  CHECK(has(shell.read("balls-run/events.csv"), ",t_error,certain\n"));
  CHECK(lines(shell.read("balls-run/errors.csv")) == lines(shell.read("balls-run/history.csv")));
}

TEST_CASE("cli run: what is certain of a run that stops is certain to there, not to its end") {
  const Shell shell;
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "1.0\n"
      "initial = { u = [0.0], v = [0.0] }\n[matrices]\nmass = [[1.0]]\nstiffness = [[1.0]]\n";
  for (const char* name : {"a", "b"})
    text += std::string("[[contacts]]\nname = \"") + name +
            "\"\nlaw = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nfriction = 0.4\n"
            "surface_velocity = { type = \"rectangle\", start = 50.0, end = 60.0, amplitude = 1.0 }\n";
  shell.write("two.toml", text);
  const Ending ending = shell.run({"run", "two.toml", "--no-plots", "--certify", "--engine", "exact"});
  CHECK(ending.code == 4);
  CHECK(has(ending.out, "certified to t = 0 s, where the run ended: no event"));
  const json summary = json::parse(shell.read("two-run/summary.json"));
  CHECK(summary["certified"]["complete"] == true);
  CHECK(summary["refusal"]["kind"] == "dependent");
}

TEST_CASE("cli run: --trace writes the rounds of each decision, a JSON object a line") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  REQUIRE(shell.run({"run", "belt.toml", "--no-plots", "--trace", "rounds.jsonl"}).code == 0);
  const std::string text = shell.read("rounds.jsonl");
  std::istringstream stream(text);
  bool slips = false;
  double last = 0.0;
  for (std::string line; std::getline(stream, line);) {
    const json round = json::parse(line);
    CHECK(round["t"].get<double>() >= last);
    last = round["t"];
    CHECK(round["holds"] == round["failed"].empty());
    // The block sticks until its friction limit falls, and slips in the next round.
    slips = slips || (round["round"] == 1 && round["holds"] && round["tried"]["belt"] == "slip-") ||
            (round["round"] == 1 && round["holds"] && round["tried"]["belt"] == "slip+");
  }
  CHECK(slips);
}

TEST_CASE("cli run: a trace that cannot be written is exit code 6, before anything is computed") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  const Ending ending = shell.run({"run", "belt.toml", "--no-plots", "--trace", "nowhere/rounds.jsonl"});
  CHECK(ending.code == 6);
  CHECK(ending.err.find("nowhere/rounds.jsonl") != std::string::npos);
  CHECK_FALSE(exists(shell, "belt-run/events.csv"));
}

TEST_SUITE_END();
