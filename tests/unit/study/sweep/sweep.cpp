// What a sweep takes: ranges, shares.
#include <doctest/doctest.h>

#include <map>

#include "study/sweep/parameter_range.hpp"
#include "study/sweep/row_file.hpp"

using namespace signorini;

namespace {

using Values = std::vector<std::string>;
using Variables = std::map<std::string, std::string>;

Values values(const std::string& text) { return sweep::parse_vary("a.b=" + text).values; }

sweep::Share share(const std::string& text, const Variables& variables = {}) {
  return sweep::parse_share(text, [&](const char* name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional<std::string>(found->second);
  });
}

}  // namespace

TEST_SUITE_BEGIN("unit/study/sweep/sweep");

TEST_CASE("sweep: a range includes its stop and reads as if written by hand") {
  CHECK(values("0:0.3:0.1") == Values{"0", "0.1", "0.2", "0.3"});
  const Values friction = values("0:1.3:0.1");
  CHECK(friction.size() == 14);
  CHECK(friction[3] == "0.3");
  CHECK(friction.back() == "1.3");
  CHECK(values("0:1:0.3") == Values{"0", "0.3", "0.6", "0.9"});
  CHECK(values("1:0:-0.5") == Values{"1", "0.5", "0"});
  CHECK(values("-0.1:0.1:0.1") == Values{"-0.1", "0", "0.1"});
  CHECK(values("2:8:2") == Values{"2", "4", "6", "8"});
  CHECK(values("1e-3:3e-3:1e-3") == Values{"0.001", "0.002", "0.003"});
  CHECK(values("1e6:3e6:1e6") == Values{"1e+06", "2e+06", "3e+06"});
  CHECK(values("5:5:1") == Values{"5"});
  CHECK(values("0:1000:0.1").size() == 10001);
  CHECK(values("0:1000:0.1").back() == "1000");
}

TEST_CASE("sweep: a list keeps its values as they are") {
  CHECK(values("ida,exact") == Values{"ida", "exact"});
  CHECK(values("1e-6, 1e-8") == Values{"1e-6", "1e-8"});
  CHECK(values("[0.0, 1.0],[1.0, 0.0]") == Values{"[0.0, 1.0]", "[1.0, 0.0]"});
  CHECK(values("{static=0.4,kinetic=0.3},0.2") == Values{"{static=0.4,kinetic=0.3}", "0.2"});
  CHECK(values("'a,b',\"c:d\"") == Values{"'a,b'", "\"c:d\""});
  CHECK(values("0.3") == Values{"0.3"});
}

TEST_CASE("sweep: what is no range is refused") {
  for (const char* text :
       {"", "0:1", "0:1:2:3", "0:1:0", "0:1:-0.1", "0:x:1", "1,,2", "0:1:1e-9", "0:inf:1"}) {
    CAPTURE(text);
    CHECK_THROWS_AS((void)values(text), UsageError);
  }
  CHECK_THROWS_AS((void)sweep::parse_vary("=1:2:1"), UsageError);
  CHECK_THROWS_AS((void)sweep::points({sweep::parse_vary("a=1,2"), sweep::parse_vary("a=3")}), UsageError);
}

TEST_CASE("sweep: several ranges make a product, the last runs fastest") {
  const auto list = sweep::points({sweep::parse_vary("a=1,2"), sweep::parse_vary("b=x,y,z")});
  REQUIRE(list.size() == 6);
  CHECK(list[1][0].value == "1");
  CHECK(list[1][1].value == "y");
  CHECK(list[3][0].value == "2");
  CHECK(list[3][1].path == "b");
}

TEST_CASE("sweep: shares part the rows") {
  for (std::size_t row = 0; row < 40; ++row) {
    int holders = 0;
    for (const char* text : {"1/3", "2/3", "3/3"}) holders += share(text).holds(row) ? 1 : 0;
    CHECK(holders == 1);
  }
  for (const char* text : {"0/3", "4/3", "3", "a/b", "1/0", "-1/3", ""})
    CHECK_THROWS_AS((void)share(text), UsageError);
}

TEST_CASE("sweep: shares from the environment") {
  CHECK(share("auto", {{"OMPI_COMM_WORLD_RANK", "2"}, {"OMPI_COMM_WORLD_SIZE", "4"}}) == sweep::Share{3, 4});
  CHECK(share("auto", {{"PMI_RANK", "0"}, {"PMI_SIZE", "2"}}) == sweep::Share{1, 2});
  Variables array = {{"SLURM_ARRAY_TASK_ID", "7"},
                     {"SLURM_ARRAY_TASK_COUNT", "4"},
                     {"SLURM_ARRAY_TASK_MIN", "1"},
                     {"SLURM_ARRAY_TASK_MAX", "10"}};
  CHECK(share("auto", array) == sweep::Share{3, 4});  // 1, 4, 7, 10
  array["PMI_RANK"] = "1";
  array["PMI_SIZE"] = "8";
  CHECK(share("auto", array) == sweep::Share{18, 32});
  array["SLURM_ARRAY_TASK_ID"] = "5";  // of no even array
  CHECK_THROWS_AS((void)share("auto", array), UsageError);
  CHECK_THROWS_AS((void)share("auto", {}), UsageError);
  CHECK_THROWS_AS((void)share("auto", {{"PMI_RANK", "2"}, {"PMI_SIZE", "2"}}), UsageError);
  CHECK_THROWS_AS((void)share("auto", {{"PMI_RANK", "x"}, {"PMI_SIZE", "2"}}), UsageError);
}

TEST_SUITE_END();
