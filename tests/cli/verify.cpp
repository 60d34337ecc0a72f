// `run --certify` and `verify` as a shell sees them.
#include <doctest/doctest.h>

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

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

TEST_SUITE_BEGIN("cli/certify");

TEST_CASE("cli run --certify: two columns more, errors.csv, and until when") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  REQUIRE(shell.run({"run", "belt.toml", "-o", "plain", "--no-plots", "--set", "run.certify=false"}).code ==
          0);
  const Ending ending = shell.run({"run", "belt.toml", "-o", "sure", "--no-plots", "--certify"});
  CHECK(ending.code == 0);
  CHECK(has(ending.out, "certified to the end"));
  CHECK(first_line(shell.read("sure/events.csv")) ==
        first_line(shell.read("plain/events.csv")) + ",t_error,certain");
  std::istringstream sure(shell.read("sure/events.csv")), plain(shell.read("plain/events.csv"));
  std::size_t rows = 0;
  for (std::string a, b; std::getline(sure, a) && std::getline(plain, b); ++rows) {
    CHECK(a.compare(0, b.size() + 1, b + ",") == 0);
    if (rows > 0) CHECK(a.substr(a.size() - 2) == ",1");
  }
  CHECK(rows > 3);
  CHECK(first_line(shell.read("sure/errors.csv")) == first_line(shell.read("sure/history.csv")));
  CHECK_FALSE(exists(shell, "plain/errors.csv"));
  const json j = json::parse(shell.read("sure/summary.json"));
  CHECK(j["certified"]["until"] == 20.0);
  CHECK(j["certified"]["complete"] == true);
  CHECK(j["certified"]["companion"] == "exact");
  CHECK(j["certified"]["events"] == rows - 1);
  CHECK(j["contacts"][0]["peaks"]["errors"]["N"].is_number());
  CHECK(json::parse(shell.read("plain/summary.json"))["certified"].is_null());
}

TEST_CASE("cli verify: a verdict, its files, and its exit code") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  const Ending agree = shell.run({"verify", "belt.toml", "--set", "run.dt=0.004", "--no-plots"});
  INFO(agree.out);
  CHECK(agree.code == 0);
  CHECK(has(agree.out, "agree: "));
  const json j = json::parse(shell.read("belt-verify/verify.json"));
  CHECK(j["verdict"] == "agree");
  CHECK(j["orders"]["event_time"].get<double>() == doctest::Approx(2.0).epsilon(0.05));
  CHECK(j["dt"].size() == 3);
  CHECK(exists(shell, "belt-verify/events.csv"));
  CHECK(shell.run({"verify", "belt.toml", "--set", "run.dt=0.004"}).code == 6);  // it is there
  const Ending undecided =
      shell.run({"verify", "belt.toml", "--set", "run.dt=2.5", "--no-plots", "--force", "--json"});
  CHECK(undecided.code == 4);
  CHECK(json::parse(undecided.out)["verdict"] == "undecided");
  CHECK(has(undecided.err, "undecided"));
}

TEST_CASE("cli compare: one engine several times") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  const Ending ending = shell.run(
      {"compare", "belt.toml", "--engines", "newmark:dt=0.004,newmark:dt=0.002", "--no-plots", "--quiet"});
  CHECK(ending.code == 0);
  CHECK(has(shell.read("belt-compare/compare.json"), "newmark:dt=0.002"));
  CHECK(shell.run({"compare", "belt.toml", "--engines", "newmark:dt,ida", "--force"}).code == 2);
}

TEST_CASE("cli verify: a scene that newmark does not take is told what else there is") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  const Ending ending =
      shell.run({"verify", "belt.toml", "--no-plots", "--set",
                 "contacts.belt.friction={ static = 1.5, kinetic = 1.0, stribeck_velocity = 0.5 }"});
  CHECK(ending.code == 3);
  CHECK(has(ending.err, "depends on its slip rate"));
  CHECK(has(ending.err, "signorini run --certify"));
  CHECK_FALSE(has(ending.err, "use \"ida\""));
}
