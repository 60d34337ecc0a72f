#include "report/load_cases.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "signorini/error.hpp"

using namespace signorini;

namespace fs = std::filesystem;

namespace {

std::string summary(const char* rest, const char* least, const char* slip, const char* force = "kN") {
  return std::string(R"({"outcome": {"kind": "done", "t": 2.0}, "title": "line", "events": {"total": 7},
    "units": {"force": ")") +
         force + R"(", "length": "m", "time": "s"},
    "contacts": [{"name": "shoe <1>", "static_reaction": )" +
         rest + R"(, "friction_work": 0.5, "load": {"N": {"least": {"value": )" + least +
         R"(, "t": 1.25}, "greatest": {"value": 1e-18, "t": 0.5}},
      "T": {"least": {"value": -3.0, "t": 0.25}, "greatest": {"value": 2.0, "t": 0.75}}, "residual_slip": )" +
         slip + R"(}}],
    "response": [{"name": "M", "kind": "envelope", "unit": "kN m",
                  "maximum": {"value": 4.0, "t": 0.125, "at": ["A", "B"], "station": 0.5, "fibre": "left"},
                  "minimum": {"value": -1.0, "t": 0.0, "at": ["A", "B"], "station": 0.0}, "last": 2.0},
                 {"name": "x", "kind": "displacement", "unit": "m", "maximum": {"value": 0.25, "t": 1.0},
                  "minimum": {"value": 0.0, "t": 0.0}, "last": 0.125}]})";
}

struct Runs {
  fs::path path;
  Runs() {
    std::string pattern = (fs::temp_directory_path() / "signorini-cases-XXXXXX").string();
    path = mkdtemp(pattern.data());
  }
  ~Runs() { fs::remove_all(path); }
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;
  fs::path add(const std::string& name, const std::string& text) const {
    fs::create_directories(path / name);
    std::ofstream(path / name / "summary.json", std::ios::binary) << text;
    return path / name;
  }
};

}  // namespace

TEST_SUITE("unit/report/load_cases") {
  TEST_CASE("load cases: one run's tables have signs, times that are buttons, and escaped names") {
    const base::Json json = base::parse_json(summary("7.5", "-9.0", "-0.01"));
    const std::string loads = report::support_loads_html(json);
    CHECK(loads.find("<td>shoe &lt;1&gt;</td><td class=n>-7.5</td><td class=n>-9</td><td class=n "
                     "data-t=\"1.25\">1.25</td>"
                     "<td class=n>0</td>") != std::string::npos);  // 1e-18 beside 9 is rounding
    CHECK(loads.find("<th>N min<br>[kN]</th><th>at t<br>[s]</th>") != std::string::npos);
    CHECK(loads.find("<th>friction loss<br>[kN m]</th>") != std::string::npos);
    const std::string envelopes = report::responses_html(json, true),
                      others = report::responses_html(json, false);
    CHECK(envelopes.find("<td>A-B 0.5 left</td>") != std::string::npos);
    CHECK(envelopes.find("<td>x</td>") == std::string::npos);
    CHECK(others.find("<td>x</td><td>m</td><td class=n>0.25</td><td class=n data-t=\"1\">1</td>") !=
          std::string::npos);
    CHECK(report::support_loads_html(base::parse_json(std::string("{}"))).empty());
    CHECK(report::responses_html(base::parse_json(std::string("{}")), false).empty());
  }

  TEST_CASE("load cases: side by side, each figure with the case that governs it") {
    const Runs runs;
    const auto cold = runs.add("cold", summary("7.5", "-9.0", "-0.01"));
    const auto hot = runs.add("hot, too", summary("8.5", "-8.75", "0.002"));
    const std::vector<report::LoadCase> cases = report::read_load_cases({cold, hot / ""});  // "hot, too/"
    const std::string csv = report::load_cases_csv(cases);
    CHECK(csv.rfind("item,quantity,unit,cold,cold t,\"hot, too\",\"hot, too t\",governing\n", 0) == 0);
    CHECK(csv.find("\nshoe <1>,N at rest,kN,-7.5,,-8.5,,\"hot, too\"\n") != std::string::npos);
    CHECK(csv.find("\nshoe <1>,N min,kN,-9,1.25,-8.75,1.25,cold\n") != std::string::npos);
    CHECK(csv.find("\nshoe <1>,residual slip,m,-0.01,,0.002,,cold\n") != std::string::npos);
    CHECK(csv.find("\nM,maximum,kN m,4,0.125,4,0.125,cold\n") != std::string::npos);
    CHECK(csv.find("\nx,") < csv.find("\nM,"));  // responses before envelopes
    const std::string page = report::load_cases_html(cases);
    CHECK(page.find("<h2>Support loads</h2>") != std::string::npos);
    CHECK(page.find("<td class=\"n most\">-9</td>") != std::string::npos);
    CHECK(page.find("<td class=\"n\">-8.75</td>") != std::string::npos);
  }

  TEST_CASE(
      "load cases: a case that stopped early governs nothing, other structures are told, overrides name a "
      "case") {
    const Runs runs;
    const auto whole = runs.add("whole", summary("7.5", "-9.0", "0"));
    std::string text = summary("8.5", "-20.0", "0");
    const std::string done = R"("outcome": {"kind": "done", "t": 2.0})";
    text.replace(text.find(done), done.size(),
                 R"("outcome": {"kind": "interrupted", "t": 0.25, "t_end": 2.0}, "engine": "exact",
                    "command_line": ["signorini", "run", "x.toml", "--set", "run.t_end=1", "--set=a<b=0"])");
    const auto cut = runs.add("cut", text);
    const std::vector<report::LoadCase> cases = report::read_load_cases({whole, cut});
    CHECK(report::load_cases_csv(cases).find("\nshoe <1>,N min,kN,-9,1.25,-20,1.25,whole\n") !=
          std::string::npos);
    // Zero in all cases: none governs.
    CHECK(report::load_cases_csv(cases).find("\nshoe <1>,residual slip,m,0,,0,,\n") != std::string::npos);
    const auto doubts = report::load_case_warnings(cases);
    REQUIRE(doubts.size() == 1);
    CHECK(
        doubts[0] ==
        "case cut ended at t = 0.25 of 2 (interrupted); values of case cut are not used as governing values");
    const std::string page = report::load_cases_html(cases);
    CHECK(page.find("<td>run.t_end=1, a&lt;b=0</td><td>exact</td><td><b>interrupted</b></td>") !=
          std::string::npos);
    CHECK(page.find(doubts[0]) != std::string::npos);
    CHECK(page.find("N &lt; 0 is compression") != std::string::npos);
    std::string other = summary("7.5", "-9.0", "0");
    other.replace(other.find("shoe <1>"), 8, "guide");
    CHECK(report::load_case_warnings(report::read_load_cases({whole, runs.add("other", other)})) ==
          std::vector<std::string>{
              "cases whole and other have different contacts; check that they describe the same structure"});
    CHECK(report::load_case_warnings(
              report::read_load_cases({whole, runs.add("same", summary("1", "-1", "0"))}))
              .empty());
  }

  TEST_CASE("load cases: what cannot stand side by side is refused with its directory") {
    const Runs runs;
    const auto one = runs.add("one", summary("1", "-1", "0"));
    CHECK_THROWS_WITH_AS(report::read_load_cases({one, runs.path / "none"}),
                         doctest::Contains("not a directory"), FileError);
    CHECK_THROWS_WITH_AS(report::read_load_cases({one, one}), doctest::Contains("of another load case"),
                         FileError);
    const auto newtons = runs.add("newtons", summary("1", "-1", "0", "N"));
    CHECK_THROWS_WITH_AS(report::read_load_cases({one, newtons}),
                         doctest::Contains("has the units N, m, s, but "), FileError);
    fs::create_directories(runs.path / "empty");
    CHECK_THROWS_WITH_AS(report::read_load_cases({one, runs.path / "empty"}),
                         doctest::Contains("contains no run"), FileError);
    const auto broken = runs.add("broken", "{");
    CHECK_THROWS_WITH_AS(report::read_load_cases({one, broken}), doctest::Contains("is not JSON"), FileError);
  }
}
