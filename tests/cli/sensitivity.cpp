// `sensitivity` as a shell sees it.
#include <doctest/doctest.h>

#include <cmath>
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

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_SUITE_BEGIN("cli/sensitivity");

TEST_CASE("cli sensitivity: tables, spreads, and its exit code") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const Ending ending = shell.run({"sensitivity", "belt.toml", "--parameter", "contacts.1.friction.static",
                                   "--sigma", "contacts.1.friction.kinetic=0.01"});
  INFO(ending.err);
  CHECK(ending.code == 0);
  CHECK(has(ending.out, "elasticity") == false);
  CHECK(has(ending.out, "up to"));
  CHECK(has(ending.out, "sigma"));
  const auto events = lines_of(shell.read("belt-sensitivity/events.csv"));
  const auto rates = lines_of(shell.read("belt-sensitivity/sensitivities.csv"));
  CHECK(rates[0].rfind("event_index,t,contact,event,parameter,dt_dp,", 0) == 0);
  CHECK(rates.size() == 2 * (events.size() - 1) + 1);
  const auto columns = lines_of(shell.read("belt-sensitivity/columns-1.csv"));
  CHECK(columns[0].find(".slip") != std::string::npos);
  CHECK(exists(shell, "belt-sensitivity/columns-2.csv"));
  CHECK(exists(shell, "belt-sensitivity/figures.csv"));
  const auto spread = lines_of(shell.read("belt-sensitivity/spread.csv"));
  CHECK(spread[0] == "what,contact,value,sigma");
  const json j = json::parse(shell.read("belt-sensitivity/sensitivity.json"));
  REQUIRE(j["parameters"].size() == 2);
  CHECK(j["parameters"][0]["path"] == "contacts.1.friction.static");
  CHECK(j["settings"]["engine"] == "ida");  // none was named: that of `run`
  CHECK(j["stretches"]["followed"] == j["stretches"]["series"]);
  CHECK(has(ending.out, "engine ida"));
  for (const char* picture : {"tornado", "times-1", "times-2", "sequence"})
    CHECK(exists(shell, std::string("belt-sensitivity/plots/") + picture + ".gp"));
  CHECK(lines_of(shell.read("belt-sensitivity/plots/tornado-1.csv"))[0] == "place,length,parameter");
  const auto sequence = lines_of(shell.read("belt-sensitivity/sequence.csv"));
  CHECK(sequence[0] == "parameter,value,change,kind,first,second,t");
  CHECK(sequence.size() > 1);
  CHECK(j["parameters"][0]["sigma"] == 0.0);
  CHECK(j["parameters"][1]["sigma"] == 0.01);
  // sigma of a time is |dt/dp| sigma_p: the second row of the first event is of the kinetic coefficient
  std::vector<std::string> cells;
  std::istringstream row(rates[2]);
  for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
  const double sigma = std::stod(spread[1].substr(spread[1].rfind(',') + 1));
  CHECK(sigma == doctest::Approx(std::abs(std::stod(cells[5])) * 0.01));
  CHECK(shell.run({"sensitivity", "belt.toml", "--parameter", "contacts.1.friction.static"}).code == 6);
  CHECK(shell
            .run({"sensitivity", "belt.toml", "--parameter", "contacts.1.friction.static", "--force",
                  "--quiet", "--no-plots", "--set", "run.engine=exact"})
            .code == 0);
  CHECK_FALSE(exists(shell, "belt-sensitivity/plots"));
  CHECK_FALSE(exists(shell, "belt-sensitivity/spread.csv"));
}

TEST_CASE("cli sensitivity: losses and landings, and the derivatives of steps") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  const Ending lost = shell.run({"sensitivity", "belt.toml", "--parameter", "contacts.1.friction.kinetic",
                                 "--losses", "--no-plots", "--set", "run.engine=exact"});
  INFO(lost.err);
  CHECK(lost.code == 0);
  CHECK(has(lost.out, "work of surfaces"));
  CHECK(has(shell.read("belt-sensitivity/figures.csv"), "lost by friction,,"));
  CHECK(has(lines_of(shell.read("belt-sensitivity/columns-1.csv"))[0], "energy.kinetic"));
  CHECK_FALSE(exists(shell, "belt-sensitivity/landings.csv"));  // a slider has none
  shell.write("ball.toml", R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1.0
initial = { u = [1.0], v = [0.0] }
[matrices]
mass = [[1.0]]
stiffness = [[0.0]]
[[contacts]]
name = "floor"
law = "rigid"
normal = { d0 = 1.0 }
restitution = 0.5
[[loads]]
direction = { d0 = 1.0 }
amplitude = -10.0
)");
  CHECK(shell
            .run({"sensitivity", "ball.toml", "--parameter", "contacts.floor.restitution", "--losses",
                  "--no-plots", "--set", "run.engine=exact"})
            .code == 0);
  const auto landings = lines_of(shell.read("ball-sensitivity/landings.csv"));
  REQUIRE(landings.size() == 3);
  CHECK(
      landings[0] ==
      "contact,landing,start,end,impulse,peak_force,parameter,dstart_dp,dend_dp,dimpulse_dp,dpeak_force_dp");
  CHECK(landings[2].rfind("floor,2,", 0) == 0);
  const auto steps = [&](const char* engine) {
    return shell.run({"sensitivity", "belt.toml", "--parameter", "contacts.1.friction.kinetic", "--discrete",
                      "--force", "--no-plots", "--set", std::string("run.engine=") + engine, "--set",
                      "run.dt=0.01"});
  };
  CHECK(steps("newmark").code == 0);
  const Ending wrong = steps("exact");
  CHECK(wrong.code == 2);
  CHECK(has(wrong.err, "newmark"));
}

TEST_CASE("cli sensitivity: what it refuses, it names") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const auto refused = [&](const std::vector<std::string>& more, int code, const std::string& said) {
    std::vector<std::string> line{"sensitivity", "belt.toml"};
    line.insert(line.end(), more.begin(), more.end());
    const Ending ending = shell.run(line);
    CAPTURE(ending.err);
    CHECK(ending.code == code);
    CHECK(has(ending.err, said));
  };
  refused({}, 2, "expected --parameter PATH");
  refused({"--parameter", "run.rtol"}, 2, "--parameter run.rtol: the motion does not depend on this key");
  refused({"--parameter", "contacts.1.frictoin"}, 2, "the scene has no \"frictoin\"");
  refused({"--parameter", "contacts.1.law"}, 2, "expected a key with a number");
  refused({"--sigma", "contacts.1.friction.static=-1"}, 2, "standard deviation");
}
