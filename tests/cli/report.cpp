#include <doctest/doctest.h>

#include "program.hpp"

using namespace signorini::cli_test;

TEST_SUITE_BEGIN("cli/report");

TEST_CASE("cli report: one page a run, with its scene, check, events and data; it needs no other file") {
  const Shell shell;
  shell.write("belt.toml", belt(10.0));
  CHECK(shell.run({"run", "belt.toml", "-o", "out", "--no-plots"}).code == 0);
  const Ending ending = shell.run({"report", "out"});
  CHECK(ending.code == 0);
  CHECK(ending.out == "out/report.html\n");
  const std::string page = shell.read("out/report.html");
  for (const char* part :
       {"<title>Block on a moving belt</title>", "<h2>Audit</h2>", "<h2>Output of check</h2>",
        "contacts at t = 0", "<td>slip</td>", "surface_velocity = ", "\"contacts\":[{\"name\":\"belt\"",
        "signorini plot out draws them"}) {
    CAPTURE(part);
    CHECK(has(page, part));
  }
  for (const char* address : {"src=\"http", "href=\"http", "url(", "import "})
    CHECK_FALSE(has(page, address));
  // A page is one of the run's own files: the next run replaces it.
  CHECK(shell.run({"run", "belt.toml", "-o", "out", "--no-plots", "--force"}).code == 0);
  CHECK_FALSE(exists(shell, "out/report.html"));
}

TEST_CASE("cli report: -o, an interrupted run's tables, and what not a directory of results") {
  const Shell shell;
  shell.write("belt.toml", belt(3.0));
  CHECK(shell.run({"run", "belt.toml", "-o", "out", "--no-plots"}).code == 0);
  for (const char* name : {"out/motion.csv", "out/curves.csv", "out/loads.csv"})
    std::filesystem::remove(shell / name);
  CHECK(shell.run({"report", "out", "-o", "page.html"}).code == 0);
  CHECK(exists(shell, "page.html"));
  CHECK_FALSE(exists(shell, "out/report.html"));
  const Ending none = shell.run({"report", "."});
  CHECK(none.code == 6);
  CHECK(has(none.err, "contains no run"));
  CHECK(shell.run({"report", "nowhere"}).code == 6);
  CHECK(shell.run({"report", "out", "-o", "no/such/page.html"}).code == 6);
}

TEST_CASE("cli report: a page opens with support loads; several runs stand side by side, as page and CSV") {
  const Shell shell;
  shell.write("belt.toml", belt(10.0));
  CHECK(shell.run({"run", "belt.toml", "-o", "one", "--no-plots"}).code == 0);
  CHECK(shell.run({"run", "belt.toml", "-o", "two", "--no-plots", "--set", "contacts.belt.friction=0.2"})
            .code == 0);
  CHECK(shell.run({"report", "one"}).code == 0);
  const std::string page = shell.read("one/report.html");
  const std::size_t loads = page.find("<h2>Support loads</h2>"), events = page.find("<h2>Events</h2>");
  REQUIRE(loads != std::string::npos);
  CHECK(loads < page.find("<h2>Summary</h2>"));
  CHECK(page.find("<h2>Charts</h2>") < events);
  CHECK_FALSE(has(page, "<th>guard_rate"));
  const Ending ending = shell.run({"report", "one", "two", "-o", "both.html"});
  CHECK(ending.code == 0);
  CHECK(ending.out == "both.html\nboth.csv\n");
  CHECK(has(shell.read("both.html"), "<title>Load cases: one, two</title>"));
  CHECK(has(shell.read("both.csv"), "item,quantity,unit,one,one t,two,two t,governing\n"));
  CHECK(has(shell.read("both.csv"), "\nbelt,N min,N,-"));
  CHECK(shell.run({"report", "one", "two", "-o", "both.csv"}).code == 2);
  CHECK(shell.run({"report", "one", "three"}).code == 6);
}

TEST_CASE("cli report: a comparison and a sweep have their tables") {
  const Shell shell;
  shell.write("belt.toml", belt(3.0));
  CHECK(shell.run({"compare", "belt.toml", "--engines", "exact,ida", "-o", "both", "--no-plots"}).code == 0);
  CHECK(shell.run({"report", "both"}).code == 0);
  CHECK(has(shell.read("both/report.html"), "<h2>differences.csv</h2>"));
  CHECK(shell.run({"compare", "belt.toml", "--engines", "exact,ida", "-o", "both", "--no-plots", "--force"})
            .code == 0);
  CHECK_FALSE(exists(shell, "both/report.html"));
  CHECK(shell
            .run({"sweep", "belt.toml", "--vary", "contacts.belt.friction.static=1.2,1.4", "-o", "many",
                  "--no-plots"})
            .code == 0);
  CHECK(shell.run({"report", "many"}).code == 0);
  CHECK(has(shell.read("many/report.html"), "<h2>sweep.csv</h2>"));
}

TEST_SUITE_END();
