#include "report/page.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "report/html.hpp"
#include "report/svg_figures.hpp"
#include "signorini/error.hpp"

using namespace signorini;

namespace fs = std::filesystem;

namespace {

/// A folder with files; gone with its owner.
struct Folder {
  fs::path path;
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "signorini-page-XXXXXX").string();
    path = mkdtemp(pattern.data());
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((path / name).parent_path());
    std::ofstream(path / name, std::ios::binary) << text;
  }
};

}  // namespace

TEST_SUITE("unit/report/page") {
  TEST_CASE("html: text of a scene is never markup") {
    CHECK(report::html_text("<script>&\"'") == "&lt;script&gt;&amp;&quot;&#39;");
    CHECK(report::html_text("a\x01z\n") == "a\xef\xbf\xbdz\n");
    CHECK(report::script_json("\"</script><!--\"") == "\"\\u003c/script>\\u003c!--\"");
    CHECK(report::section("x", "A < B", "body") == "<section id=\"x\">\n<h2>A &lt; B</h2>\nbody</section>\n");
    CHECK(report::section("x", "A", "").empty());
  }

  TEST_CASE("html: what is filled in is not looked through again") {
    CHECK(report::fill_template("a@x@b@y@c@z@", {{"x", "@y@"}, {"y", "2"}}) == "a@y@b2c@z@");
    CHECK(report::fill_template("@media", {{"m", "1"}}) == "@media");
  }

  TEST_CASE("html: tables have short numbers, escaped names, and say what they leave out") {
    const Folder folder;
    folder.write("t.csv", "t,contact,N\n0.12345678901234,<b>,1.23456789\n1,two,-0\n2,three,3\n");
    const std::string table = report::csv_table(folder.path / "t.csv", 2);
    CHECK(table.find("<td class=n>0.12345678901</td><td>&lt;b&gt;</td><td class=n>1.23457</td>") !=
          std::string::npos);
    CHECK(table.find("three") == std::string::npos);
    CHECK(table.find("1 more rows are in t.csv") != std::string::npos);
    CHECK(report::csv_table(folder.path / "t.csv", 9, {"contact"}).find("1.23457") == std::string::npos);
    CHECK(report::csv_table(folder.path / "none.csv", 9).empty());
    // Rounding beside its like is zero; what is small by itself is not.
    folder.write("e.csv", "t,N,T,t_error\n0.5,-20,3.4e-14,2e-10\n0.6,0,-1,1e-16\n");
    const std::string told = report::csv_table(folder.path / "e.csv", 9, {}, {{"N", "kN"}, {"t_error", "s"}});
    CHECK(told.find("e-14") == std::string::npos);
    CHECK(told.find("<td class=n>1e-16</td>") != std::string::npos);
    CHECK(told.find("<th>N [kN]</th><th>T</th><th>t_error [s]</th>") != std::string::npos);
    CHECK(report::short_number("1e-300x") == "1e-300x");
    CHECK(report::short_number("inf") == "inf");
  }

  TEST_CASE("pictures: paths become steps of a tenth, points on the one before are left out") {
    CHECK(report::compress_svg(
              "<path d='M112.00,61.99 L115.21,60.02 L115.22,60.03 L114.00,60.00 M1.00,2.00 L1.50,2.00'/>") ==
          "<path d='M112 62l3.2-2-1.2 0M1 2l.5 0'/>");
    // A path of one point is drawn where its ends are round.
    CHECK(report::compress_svg("<path d='M1.00,1.00 L1.01,1.01'/>") == "<path d='M1 1l0 0'/>");
    // What is not as gnuplot writes it stays.
    for (const std::string other :
         {"<path d='M-1,0 h2 M0,-1 v2'/>", "<path d='M1 1 L2 2'/>", "<path id='gpPt0' d='M0,0"})
      CHECK(report::compress_svg(other) == other);
  }

  TEST_CASE("pictures: steps do not drift away from the points") {
    std::string path = "M0.04,0.04";
    for (int i = 1; i <= 1000; ++i) path += " L" + std::to_string(i) + ".04,0.04";
    const std::string slim = report::compress_svg("<path d='" + path + "'/>");
    CHECK(slim.starts_with("<path d='M0 0l1 0 1 0"));
    std::size_t steps = 0;
    for (std::size_t at = slim.find("1 0"); at != std::string::npos; at = slim.find("1 0", at + 3)) ++steps;
    CHECK(steps == 1000);
  }

  TEST_CASE("pages: every kind of directory is known by its file, others are refused by name") {
    const Folder folder;
    folder.write("c/compare.json", "{\"title\": \"</title>\", \"reference\": \"a\"}");
    folder.write("c/runs.csv", "run,events\na,3\n");
    CHECK(report::kind_of_results(folder.path / "c") == "comparison");
    const std::string page = report::results_page(folder.path / "c");
    CHECK(page.find("<title>&lt;/title&gt;</title>") != std::string::npos);
    CHECK(page.find("<h2>runs.csv</h2>") != std::string::npos);
    CHECK(page.find("id=\"data\">null</script>") != std::string::npos);
    CHECK_THROWS_AS((void)report::kind_of_results(folder.path), FileError);
    struct Known {
      const char *marker, *kind;
    };
    for (const auto& [marker, kind] :
         {Known{"study.json", "study"}, Known{"sweep.json", "sweep"}, Known{"verify.json", "verification"},
          Known{"sensitivity.json", "sensitivity"}, Known{"fit.json", "fit"}, Known{"branch.json", "branch"},
          Known{"summary.json", "run"}}) {
      folder.write(std::string(kind) + "/" + marker, "{}");
      CHECK(report::kind_of_results(folder.path / kind) == kind);
    }
    CHECK_THROWS_AS((void)report::kind_of_results(folder.path / "nowhere"), FileError);
    folder.write("b/study.json", "{ not json");
    CHECK_THROWS_AS((void)report::results_page(folder.path / "b"), FileError);
  }
}
