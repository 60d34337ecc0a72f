// What must not be lost or mistaken, whatever surrounds the program: closed streams, foreign files, altered
// rows.
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
using signorini::cli_test::line;
using signorini::cli_test::Shell;

namespace {

namespace fs = std::filesystem;

std::string last_cell(const std::string& table) {
  const std::size_t end = table.rfind('\n'), begin = table.rfind('\n', end - 1) + 1;
  return table.substr(begin, table.find(',', begin) - begin);
}

const std::string three_rows = "contacts.belt.friction.static=1:2:0.5";  // three rows

void sweep(const Shell& shell, const std::vector<std::string>& more = {}) {
  shell.write("belt.toml", belt(5));
  std::vector<std::string> arguments = {"sweep", "belt.toml", "--vary", three_rows, "--no-plots", "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  REQUIRE(shell.run(arguments).code == 0);
}

/// A program called gnuplot that runs the line.
void fake_gnuplot(const Shell& shell, const std::string& text) {
  fs::create_directory(shell / "bin");
  shell.write("bin/gnuplot", "#!/bin/sh\n" + text + "\n");
  fs::permissions(shell / "bin/gnuplot", fs::perms::owner_all);
}

}  // namespace

TEST_SUITE_BEGIN("cli/robust");

TEST_CASE("cli: closed standard streams are no files of a run") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  for (const std::string closed : {">&-", "<&- >&-", "<&- >&- 2>&-"}) {
    CAPTURE(closed);
    CHECK(line(shell, "$SIGNORINI run belt.toml --force --no-plots " + closed) == 0);
    CHECK(shell.read("belt-run/events.csv").rfind("t,contact,event,", 0) == 0);
    for (const char* name : {"events.csv", "history.csv", "contacts.csv", "energy.csv"})
      CHECK_FALSE(has(shell.read(std::string("belt-run/") + name), "Block on a moving belt"));
  }
}

TEST_CASE("cli run: a file error in the first block of rows says how far they go") {
  const Shell shell;
  shell.write("belt.toml", belt(400));
  const pid_t child =
      shell.start({"run", "belt.toml", "--no-plots", "--set", "run.output_dt=1e-4"}, ".out", 8000);
  const Ending ending = shell.wait(child);
  CHECK(ending.code == 6);
  const double t = json::parse(shell.read("belt-run/summary.json"))["outcome"]["t"];
  CHECK(t > 0.0);
  CHECK(t == std::stod(last_cell(shell.read("belt-run/energy.csv"))));
  CHECK_FALSE(has(ending.err, "stopped at t = 0 "));
}

TEST_CASE("cli run: of three --force at once into one directory one is kept whole, the others are refused") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  REQUIRE(shell.run({"run", "belt.toml", "--no-plots"}).code == 0);
  shell.write("belt.toml", belt(5e6));
  const auto start = [&] {
    return shell.start({"run", "belt.toml", "--force", "--no-plots", "-o", "belt-run"});
  };
  const pid_t first = start();
  const auto runs = [&] {
    const json summary = json::parse(shell.read("belt-run/summary.json"), nullptr, false);
    return summary.is_object() && summary["outcome"]["kind"] == "running";
  };
  for (int i = 0; i < 1000 && !runs(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  REQUIRE(runs());
  const pid_t second = start(), third = start();
  CHECK(shell.wait(second).code == 6);
  CHECK(shell.wait(third).code == 6);
  CHECK(runs());
  kill(first, SIGINT);
  CHECK(shell.wait(first).code == 130);
  CHECK(json::parse(shell.read("belt-run/summary.json"))["outcome"]["kind"] == "interrupted");
}

TEST_CASE("cli sweep: --force removes no file that is not its own") {
  const Shell shell;
  sweep(shell);
  for (const std::string foreign : {"2023.xlsx", "000002.txt", "12.json", "notes"}) {
    CAPTURE(foreign);
    shell.write("belt-sweep/rows/" + foreign, "mine");
    const Ending ending =
        shell.run({"sweep", "belt.toml", "--vary", three_rows, "--no-plots", "--quiet", "--force"});
    CHECK(ending.code == 6);
    CHECK(has(ending.err, foreign));
    CHECK(shell.read("belt-sweep/rows/" + foreign) == "mine");
    CHECK(exists(shell, "belt-sweep/rows/000001.json"));
    fs::remove(shell / ("belt-sweep/rows/" + foreign));
  }
  sweep(shell, {"--force"});
}

TEST_CASE("cli sweep: --force follows no link") {
  const Shell shell;
  sweep(shell, {"--keep"});
  for (const std::string folder : {"rows", "runs"}) {
    CAPTURE(folder);
    fs::rename(shell / ("belt-sweep/" + folder), shell / "elsewhere");
    fs::create_directory_symlink(shell / "elsewhere", shell / ("belt-sweep/" + folder));
    const Ending ending =
        shell.run({"sweep", "belt.toml", "--vary", three_rows, "--no-plots", "--quiet", "--force"});
    CHECK(ending.code == 6);
    CHECK(has(ending.err, "belt-sweep/" + folder));
    CHECK(std::distance(fs::directory_iterator(shell / "elsewhere"), {}) == 3);
    fs::remove(shell / ("belt-sweep/" + folder));
    fs::rename(shell / "elsewhere", shell / ("belt-sweep/" + folder));
  }
  // A run that is a link is somebody else's: it stays, with what it leads to.
  fs::rename(shell / "belt-sweep/runs/000002", shell / "kept");
  fs::create_directory_symlink(shell / "kept", shell / "belt-sweep/runs/000002");
  sweep(shell, {"--force"});
  CHECK(exists(shell, "kept/events.csv"));
}

TEST_CASE("cli sweep: rows that are no files, or were altered or misnumbered, are 6") {
  const Shell shell;
  sweep(shell);
  const std::string row = "belt-sweep/rows/000002.json", good = shell.read(row);
  const auto refused = [&](const std::string& message) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"sweep", "belt.toml", "--vary", three_rows, "--no-plots"},
          std::vector<std::string>{"sweep", "--merge", "belt-sweep", "-o", "joined", "--no-plots"}}) {
      const Ending ending = shell.run(arguments);
      CHECK(ending.code == 6);
      CHECK(has(ending.err, message));
    }
    fs::remove_all(shell / "joined");
  };
  std::string altered = good;
  const std::size_t at = altered.find("\"steps\": ") + 9;
  altered[at] = altered[at] == '1' ? '2' : '1';
  shell.write(row, altered);
  refused("has been altered");
  shell.write(row, shell.read("belt-sweep/rows/000001.json"));
  refused("is not the row of this sweep with that number");
  fs::remove(shell / row);
  fs::create_directory(shell / row);
  refused("is a directory");
  fs::remove(shell / row);
  REQUIRE(mkfifo((shell / row).c_str(), 0600) == 0);
  refused("is a pipe");
  fs::remove(shell / row);
  shell.write(row, good);
  CHECK(shell.run({"sweep", "--merge", "belt-sweep", "-o", "joined", "--no-plots"}).code == 0);
}

TEST_CASE("cli sweep: shares that contradict each other are not merged") {
  const Shell shell;
  sweep(shell, {"-o", "one"});
  sweep(shell, {"-o", "two"});
  const auto merge = [&] {
    return shell.run({"sweep", "--merge", "one", "two", "-o", "joined", "--force", "--no-plots"});
  };
  CHECK(merge().code == 0);  // alike but for their times
  // The same sweep of a scene that ends earlier, passed off as a share.
  shell.write("belt.toml", belt(4));
  REQUIRE(shell.run({"sweep", "belt.toml", "--vary", three_rows, "--no-plots", "-o", "short"}).code == 0);
  fs::copy_file(shell / "short/rows/000003.json", shell / "two/rows/000003.json",
                fs::copy_options::overwrite_existing);
  const Ending ending = merge();
  CHECK(ending.code == 6);
  CHECK(has(ending.err, "two/rows/000003.json: contradicts"));
}

TEST_CASE("cli: a gnuplot that floods is ended, and the run is there") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  fake_gnuplot(shell, "exec yes 'warning: all is well' >&2");
  CHECK(line(shell, "PATH=\"$PWD/bin:$PATH\" $SIGNORINI run belt.toml >.out 2>.err") == 0);
  CHECK(has(shell.read(".err"), "it said more than 64 kB and was ended"));
  CHECK(shell.read(".err").size() < 1000);
  CHECK(json::parse(shell.read("belt-run/summary.json"))["outcome"]["kind"] == "done");
}

TEST_CASE("cli: a picture that fails stops no other, and it is said") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  fake_gnuplot(shell,
               "case \"$2\" in displacement*|raster*) echo unhappy >&2; exit 1;; esac; touch \"$2.drawn\"");
  CHECK(line(shell, "PATH=\"$PWD/bin:$PATH\" $SIGNORINI run belt.toml >.out 2>.err") == 0);
  CHECK(exists(shell, "belt-run/plots/energy.gp.drawn"));
  CHECK(exists(shell, "belt-run/plots/states.gp.drawn"));
  CHECK_FALSE(exists(shell, "belt-run/plots/displacement.gp.drawn"));
  const std::string said = shell.read(".err");
  CHECK(has(said, "displacement.gp: unhappy"));
  CHECK(has(said, "2 of "));
  CHECK(line(shell, "PATH=\"$PWD/bin:$PATH\" $SIGNORINI plot belt-run >.out 2>.err") == 6);
}

TEST_CASE("cli: of many contacts the first 24 are drawn, and it is said") {
  const Shell shell;
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\n"
      "t_end = 1.0\n[nodes]\n";
  for (int i = 0; i < 30; ++i) text += "b" + std::to_string(i) + " = [0.0, 0.0]\n";
  for (int i = 0; i < 30; ++i) {
    const std::string node = "node = \"b" + std::to_string(i) + "\"\n";
    text += "[[masses]]\n" + node + "mass = 1.0\n[[contacts]]\nname = \"c" + std::to_string(i) + "\"\n" +
            node + "law = \"slider\"\ntangent = [1.0, 0.0]\nnormal_force = 1.0\nfriction = 0.3\n";
  }
  shell.write("many.toml", text);
  fake_gnuplot(shell, "touch \"$2.drawn\"");
  CHECK(line(shell, "PATH=\"$PWD/bin:$PATH\" $SIGNORINI run many.toml >.out 2>.err") == 0);
  CHECK(has(shell.read(".out"), "of the first 24 contacts"));
  int drawn = 0, scripts = 0;
  for (const auto& entry : fs::directory_iterator(shell / "many-run/plots")) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("contact-")) continue;
    drawn += name.ends_with(".drawn");
    scripts += name.ends_with(".gp");
  }
  CHECK(scripts == 30);
  CHECK(drawn == 24);
  CHECK(exists(shell, "many-run/plots/states.gp.drawn"));
}

TEST_CASE("cli: --vary with bytes that are no text is a wrong command line") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  for (const std::string value : {"title=\xff,b", "title=\x1b[31m,b"}) {
    const Ending ending = shell.run({"sweep", "belt.toml", "--vary", value});
    CHECK(ending.code == 2);
    CHECK(has(ending.err, "no plain UTF-8 text"));
    CHECK(ending.err.find('\x1b') == std::string::npos);
  }
  CHECK(shell.run({"run", "belt.toml", "--set", "title=\xc0\xaf"}).code == 2);
}

TEST_CASE("cli: what a message shows of a wrong matrix file is short and can be printed") {
  const Shell shell;
  shell.write("m.toml",
              "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" "
              "}\n[run]\nt_end = 1.0\n"
              "[matrices]\nmass = [[1.0]]\nstiffness = \"k.mtx\"\n");
  shell.write("k.mtx", "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 \x1b]0;owned\x07" +
                           std::string(150, 'x') + "\n");
  const Ending ending = shell.run({"check", "m.toml"});
  CHECK(ending.code == 3);
  CHECK(ending.err.find('\x1b') == std::string::npos);
  CHECK(ending.err.size() < 300);
  // Holes without a line end: read as a stream, not as a line of so many bytes.
  shell.write("k.mtx", "%%MatrixMarket matrix coordinate real general ");
  fs::resize_file(shell / "k.mtx", 1ULL << 31U);
  // The shadow of AddressSanitizer alone is larger.
  const std::string limit = signorini::tests::with_address_sanitizer ? "" : "ulimit -v 1000000; ";
  CHECK(line(shell, limit + "$SIGNORINI check m.toml >.out 2>.err") == 3);
  CHECK(has(shell.read(".err"), "binary data"));
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("deep/cli/robust");  // it waits for a minute

TEST_CASE("cli: a gnuplot that hangs is ended after a minute, and the run is there") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  fake_gnuplot(shell, "exec sleep 1000");
  CHECK(line(shell, "PATH=\"$PWD/bin:$PATH\" timeout 100 $SIGNORINI run belt.toml >.out 2>.err") == 0);
  CHECK(has(shell.read(".err"), "not done after 60 s"));
}

TEST_SUITE_END();
