#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cstdlib>
#include <filesystem>
#include <regex>

#include "program.hpp"

using signorini::cli_test::belt;
using signorini::cli_test::Ending;
using signorini::cli_test::Shell;

TEST_SUITE_BEGIN("cli/plot");

TEST_CASE("cli plot: draws again what was removed") {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) return;
  const Shell shell;
  shell.write("belt.toml", belt(20));
  REQUIRE(shell.run({"run", "belt.toml"}).code == 0);
  std::filesystem::remove_all(shell / "belt-run/plots");
  const Ending ending = shell.run({"plot", "belt-run"});
  CHECK(ending.code == 0);
  CHECK(ending.err.empty());
  for (const char* name : {"displacement", "contact-belt", "states", "energy"}) {
    for (const char* type : {".png", ".svg"}) {
      const std::string picture = std::string("belt-run/plots/") + name + type;
      CAPTURE(picture);
      CHECK(ending.out.find(picture + "\n") != std::string::npos);
      CHECK(shell.read(picture).size() > 2000);
    }
  }
}

namespace {

/// Twenty masses that slide by themselves, and so run apart.
std::string many_sliders() {
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "3.0\ninitial = {}\n[nodes]\n";
  for (int i = 0; i < 20; ++i) text += fmt::format("b{0} = [{0}.0, 0.0]\n", i);
  for (int i = 0; i < 20; ++i)
    text += fmt::format(
        "[[masses]]\nnode = \"b{0}\"\nmass = {1}\n[[supports]]\nnode = \"b{0}\"\nfix = "
        "[\"uy\"]\n[[springs]]\nnode = "
        "\"b{0}\"\ndirection = [1.0, 0.0]\nstiffness = 40.0\n[[contacts]]\nname = \"s{0}\"\nnode = "
        "\"b{0}\"\nlaw = "
        "\"slider\"\ntangent = [1.0, 0.0]\nnormal_force = 1.0\nfriction = 0.4\n[[loads]]\nnode = "
        "\"b{0}\"\ndirection = "
        "[1.0, 0.0]\namplitude = 3.0\nhistory = {{ type = \"harmonic\", omega = {2} }}\n",
        i, 1.0 + 0.07 * i, 3.0 + 0.3 * i);
  return text;
}

}  // namespace

TEST_CASE("cli plot, report: what --no-plots left out is computed again, to the last bit") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  shell.write("many.toml", many_sliders());
  for (const std::vector<std::string>& scene :
       std::vector<std::vector<std::string>>{{"belt"}, {"many"}, {"many", "--instants"}}) {
    std::vector<std::string> with{"run", scene[0] + ".toml", "-o", "with", "--force"}, without = with;
    without[3] = "without";
    without.emplace_back("--no-plots");
    for (std::vector<std::string>* run : {&with, &without}) {
      run->insert(run->end(), scene.begin() + 1, scene.end());
      REQUIRE(shell.run(*run).code == 0);
    }
    for (const char* table : {"events.csv", "contacts.csv", "history.csv", "energy.csv"})
      CHECK(shell.read(std::string("with/") + table) == shell.read(std::string("without/") + table));
    CHECK_FALSE(signorini::cli_test::exists(shell, "without/motion.csv"));
    CHECK_FALSE(signorini::cli_test::exists(shell, "without/curves.csv"));
    Ending ending = shell.run({"report", "without"});
    CHECK(ending.code == 0);
    CHECK(ending.err.find(
              "note: without: pictures need a new computation, because the run used --no-plots\n") !=
          std::string::npos);
    for (const char* table : {"motion.csv", "curves.csv"})
      CHECK(shell.read(std::string("with/") + table) == shell.read(std::string("without/") + table));
    ending = shell.run({"report", "without"});
    CHECK(ending.err.empty());
  }
}

TEST_CASE("cli plot: a run whose events are others by now gets no pictures of them") {
  const Shell shell;
  shell.write("belt.toml", belt(20));
  REQUIRE(shell.run({"run", "belt.toml", "--no-plots"}).code == 0);
  std::filesystem::remove(shell / "belt-run/manifest.json");
  shell.write("belt-run/events.csv", shell.read("belt-run/events.csv") + "1,2,3\n");
  const Ending ending = shell.run({"plot", "belt-run"});
  CHECK(ending.code == 6);
  CHECK(ending.err.find("events.csv") != std::string::npos);
  CHECK(ending.err.find("its events differ") != std::string::npos);
  CHECK_FALSE(signorini::cli_test::exists(shell, "belt-run/motion.csv"));
  CHECK_FALSE(signorini::cli_test::exists(shell, "belt-run/plots"));
}

TEST_CASE("cli plot: size, format and title for a paper") {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) return;
  const Shell shell;
  shell.write("belt.toml", belt(20));
  REQUIRE(shell.run({"run", "belt.toml"}).code == 0);
  const Ending ending =
      shell.run({"plot", "belt-run", "--size", "160x90", "--no-title", "--format", "pdf,svg"});
  CHECK(ending.code == 0);
  CHECK(ending.err.empty());
  const std::string svg = shell.read("belt-run/plots/energy.svg");
  CHECK(svg.find("width=\"605\" height=\"340\"") != std::string::npos);  // 160 and 90 mm of 96 pixels an inch
  CHECK(svg.find("Block on a moving belt") == std::string::npos);
  CHECK(svg.find("time t [s]") != std::string::npos);
  CHECK(shell.read("belt-run/plots/energy.pdf").starts_with("%PDF"));
  CHECK(shell.read("belt-run/plots/cone.svg").find("width=\"605\"") != std::string::npos);
  CHECK_FALSE(signorini::cli_test::exists(shell, "belt-run/plots/energy.png"));
  // A later run takes them away with the rest.
  REQUIRE(shell.run({"run", "belt.toml", "--force", "--no-plots"}).code == 0);
  CHECK_FALSE(signorini::cli_test::exists(shell, "belt-run/plots"));
  for (const auto& wrong : std::vector<std::vector<std::string>>{{"--size", "160x"},
                                                                 {"--size", "10x90"},
                                                                 {"--size", "10"},
                                                                 {"--size", "160x9000"},
                                                                 {"--format", "gif"},
                                                                 {"--language", "latin"}}) {
    const Ending refused = shell.run({"plot", "belt-run", wrong[0], wrong[1]});
    CHECK(refused.code == 2);
    CHECK(refused.err.find(wrong[0] + ": ") != std::string::npos);
  }
}

// A line of text reaches a quarter of its letters below its place.
TEST_CASE("cli plot: no text ends outside its picture, on a screen or in a column") {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) return;
  const Shell shell;
  shell.write("belt.toml", belt(20));
  REQUIRE(shell.run({"run", "belt.toml", "--no-plots"}).code == 0);
  for (const std::vector<std::string>& size : std::vector<std::vector<std::string>>{{}, {"--size", "85"}}) {
    std::vector<std::string> line{"plot", "belt-run", "--format", "svg"};
    line.insert(line.end(), size.begin(), size.end());
    REQUIRE(shell.run(line).code == 0);
    for (const char* name : {"displacement", "contact-belt", "states", "energy", "raster", "cone"}) {
      CAPTURE(name);
      const std::string svg = shell.read(std::string("belt-run/plots/") + name + ".svg");
      const std::size_t box = svg.find("viewBox=\"0 0 ");
      REQUIRE(box != std::string::npos);
      const double height = std::stod(svg.substr(svg.find(' ', box + 13) + 1));
      static const std::regex text("translate\\([-0-9.]+,([-0-9.]+)\\)\"[^>]*font-size=\"([0-9.]+)\"");
      std::size_t found = 0;
      for (std::sregex_iterator i(svg.begin(), svg.end(), text), end; i != end; ++i, ++found) {
        CHECK(std::stod((*i)[1]) + 0.25 * std::stod((*i)[2]) < height);
        CHECK(std::stod((*i)[2]) >= (size.empty() ? 10.0 : 6.0));  // pixels: 4.5 points in legends of cones
      }
      CHECK(found > 3);
    }
  }
}

TEST_CASE("cli plot: labels in another language, names as they are") {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) return;
  const Shell shell;
  shell.write("belt.toml", belt(20));
  REQUIRE(shell.run({"run", "belt.toml", "--no-plots"}).code == 0);
  const auto labels_in = [&](const std::string& language) {
    REQUIRE(shell.run({"plot", "belt-run", "--format", "svg", "--language", language}).code == 0);
    return shell.read("belt-run/plots/contact-belt.svg") + shell.read("belt-run/plots/energy.svg");
  };
  const std::string german = labels_in("de"), russian = labels_in("ru");
  for (const char* words : {"Zeit t [s]", "Haften", "Reibungsverlust", "Kontakt ", "Gleitweg p"}) {
    CAPTURE(words);
    CHECK(german.find(words) != std::string::npos);
  }
  for (const char* words : {"время t [s]", "сцепление", "потери: трение", "belt"}) {
    CAPTURE(words);
    CHECK(russian.find(words) != std::string::npos);
  }
  for (const std::string& text : {german, russian})
    for (const char* english : {"time t", "stick", "lost by", "slip", "balance"}) {
      CAPTURE(english);
      CHECK(text.find(english) == std::string::npos);
    }
}

TEST_CASE("cli plot: a window beside the run is refused, and the pictures stay") {
  const Shell shell;
  shell.write("belt.toml", belt(2));
  REQUIRE(shell.run({"run", "belt.toml"}).code == 0);
  const std::string before = shell.read("belt-run/plots/displacement.gp");
  const std::vector<std::vector<std::string>> windows = {
      {"--from", "5", "--to", "6"}, {"--from", "2"}, {"--to", "0"}, {"--from", "nan"}, {"--to", "inf"}};
  for (const auto& window : windows) {
    std::vector<std::string> line = {"plot", "belt-run"};
    line.insert(line.end(), window.begin(), window.end());
    const Ending ending = shell.run(line);
    CHECK(ending.code == 2);
    CHECK(ending.err ==
          "error: " + window[0] + " " + window[1] + ": nothing to draw, because the run covers t = 0 to 2\n");
    CHECK(shell.read("belt-run/plots/displacement.gp") == before);
  }
  const Ending between = shell.run({"plot", "belt-run", "--from", "1.01", "--to", "1.02"});
  CHECK(between.code == 2);
  CHECK(between.err ==
        "error: --from 1.01 --to 1.02: nothing to draw, because no output time lies between these times\n");
  CHECK(shell.read("belt-run/plots/displacement.gp") == before);
}

TEST_CASE("cli plot: a window about one output time is drawn from what the run recorded between") {
  const Shell shell;
  shell.write("swing.toml", R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 2.0
output_dt = 1.0
initial = { u = [0.3] }
[matrices]
mass = [[1.0]]
stiffness = [[400.0]]
damping = [[1.0]]
dofs = ["x"]
)");
  REQUIRE(shell.run({"run", "swing.toml"}).code == 0);
  const Ending ending = shell.run({"plot", "swing-run", "--from", "0.9", "--to", "1.1"});
  CAPTURE(ending.err);
  CHECK(ending.code == 0);
}

TEST_CASE("cli plot: a window in which nothing happens is drawn") {
  const Shell shell;
  shell.write("belt.toml", belt(2));
  REQUIRE(shell.run({"run", "belt.toml", "--set", "run.output_dt=1e-3"}).code == 0);
  const Ending ending = shell.run({"plot", "belt-run", "--from", "0.0", "--to", "0.2"});
  CAPTURE(ending.err);
  CHECK(ending.code == 0);
  CHECK(shell.read("belt-run/plots/marks.csv") == "row,t,event,N,T\n");
  CHECK(shell.read("belt-run/plots/raster.gp").find("plot NaN with lines notitle, ") != std::string::npos);
}

TEST_CASE("cli plot: a folder that holds no run is refused") {
  const Shell shell;
  std::filesystem::create_directory(shell / "empty");
  shell.write("summary.json", "{ not json");
  CHECK(shell.run({"plot", "empty"}).code == 6);
  const Ending ending = shell.run({"plot", "."});
  CHECK(ending.code == 6);
  CHECK(ending.err.find("is not the summary of a run") != std::string::npos);
}

TEST_CASE("cli plot: small gaps have ticks that differ, and loads have a picture") {
  const Shell shell;
  const std::string pump = SIGNORINI_TEST_DATA "/scenes/robust/pump.toml";
  REQUIRE(shell.run({"run", pump, "-o", "out", "--set", "run.t_end=0.5", "--set", "run.engine=exact"}).code ==
          0);
  const std::string svg = shell.read("out/plots/contact-left.svg");
  if (!svg.empty()) {
    CHECK(svg.find("-0.00002<") == std::string::npos);
    CHECK(svg.find("e-05") != std::string::npos);
    CHECK(shell.read("out/plots/loads.svg").find("load 1") != std::string::npos);
  }
  CHECK(shell.read("out/plots/contact-left.gp").find("motion.csv") != std::string::npos);
  for (const char* script : {"out/plots/displacement.gp", "out/plots/energy.gp"}) {
    CHECK(shell.read(script).find("curves.csv") != std::string::npos);
    CHECK(shell.read(script).find("history.csv") == std::string::npos);
    CHECK(shell.read(script).find("energy.csv") == std::string::npos);
  }
  CHECK(shell.read("out/loads.csv").find("\n0.1,0\n") != std::string::npos);
}

TEST_CASE("cli plot: two apostrophes side by side in a title are drawn") {
  if (!on_path("gnuplot")) return;
  const Shell shell;
  shell.write("belt.toml", belt(5));
  const Ending ending = shell.run({"run", "belt.toml", "--set", "title=\"Pipe 6'' on a belt\""});
  CHECK(ending.code == 0);
  CHECK_FALSE(has(ending.err, "gnuplot failed"));
  for (const char* name : {"displacement", "contact-belt", "states", "energy"})
    CHECK(exists(shell, std::string("belt-run/plots/") + name + ".png"));
  CHECK(has(shell.read("belt-run/plots/energy.svg"), "6'' on a belt"));
}

TEST_SUITE_END();
