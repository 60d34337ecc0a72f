// What must not be lost or mistaken, whatever surrounds the program: closed streams, foreign files, altered
// rows.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/text.hpp"
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

void run_sweep(const Shell& shell, const std::vector<std::string>& more = {}) {
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

TEST_CASE("cli: closed standard streams are no files of a run, and a lost output is exit code 6") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  CHECK(line(shell, "$SIGNORINI run belt.toml --force --no-plots <&- 2>&- > out") == 0);
  CHECK(line(shell, "$SIGNORINI run belt.toml --force --no-plots --quiet >&-") == 0);  // prints nothing
  CHECK(line(shell, "$SIGNORINI check belt.toml >&- 2> err") == 6);
  CHECK(has(shell.read("err"), "standard output: cannot be written"));
  for (const std::string closed : {">&-", "<&- >&-", "<&- >&- 2>&-"}) {
    CAPTURE(closed);
    CHECK(line(shell, "$SIGNORINI run belt.toml --force --no-plots " + closed) == 6);
    CHECK(shell.read("belt-run/events.csv").rfind("t,contact,event,", 0) == 0);
    for (const char* name : {"events.csv", "history.csv", "contacts.csv", "energy.csv"})
      CHECK_FALSE(has(shell.read(std::string("belt-run/") + name), "Block on a moving belt"));
  }
}

TEST_CASE("cli: control characters of titles, names and paths do not reach the terminal") {
  const Shell shell;
  std::string text = belt(5);
  const std::string commands = "\\u001b]0;owned\\u0007 \\u007f \\u009b31m \\u0085";
  const std::size_t title = text.find("title = \"");
  REQUIRE(title != std::string::npos);
  text.insert(title + 9, commands);
  shell.write("belt.toml", text);
  const auto obeyed = [](const std::string& shown) {
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const auto c = static_cast<unsigned char>(shown[i]);
      const bool is_c1 = c == 0xc2 && i + 1 < shown.size() && static_cast<unsigned char>(shown[i + 1]) < 0xa0;
      if ((c < 0x20 && c != '\n' && c != '\t') || c == 0x7f || is_c1) return true;
    }
    return false;
  };
  for (const char* command : {"run", "check"})
    for (const char* format : {"", "--json"}) {
      CAPTURE(command);
      CAPTURE(format);
      std::vector<std::string> words{command, "belt.toml"};
      if (*format != '\0') words.emplace_back(format);
      if (std::string(command) == "run") words.insert(words.end(), {"--no-plots", "--force"});
      const Ending ending = shell.run(words);
      CHECK(ending.code == 0);
      CHECK_FALSE(obeyed(ending.out + ending.err));
      CHECK(has(ending.out, "\\u009b31m"));
      if (*format != '\0') CHECK(json::parse(ending.out).is_object());
    }
  const Ending missing = shell.run({"run", "no\x1b[31m\x7f\xc2\x9bscene.toml"});
  CHECK(missing.code == 6);
  CHECK_FALSE(obeyed(missing.err));
  CHECK(has(missing.err, "no\\u001b[31m\\u007f\\u009bscene.toml"));
}

TEST_CASE("cli: a name of a file with NUL opens no other file") {
  const Shell shell;
  shell.write("a.csv", "t,f\n0,0\n1,1\n");
  fs::create_directory(shell / "old-run");
  const std::string load =
      "[[loads]]\nnode = \"block\"\ndirection = [1.0, 0.0]\namplitude = 1.0\nhistory = { type = \"table\", "
      "file = "
      "\"a.csv\\u0000.gone\" }\n";
  shell.write("file.toml", belt(5) + load);
  const Ending ending = shell.run({"check", "file.toml"});
  CHECK(ending.code == 3);
  CHECK(has(ending.err, "loads.1.history.file"));
  CHECK(has(ending.err, "NUL"));
  const Ending run = shell.run({"check", "file.toml", "--set", "run.initial={ run = \"old-run\\u0000x\" }"});
  CHECK(run.code == 3);
}

TEST_CASE("cli: a deleted current directory is a file error, not a bug") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  fs::create_directory(shell / "gone");
  const std::string scene = (shell / "belt.toml").string();
  const int code =
      line(shell, "cd gone && rmdir ../gone && $SIGNORINI run " + scene + " --no-plots 2> ../err");
  CHECK(code == 6);
  CHECK_FALSE(has(shell.read("err"), "a bug in Signorini"));
}

TEST_CASE("cli report, run --trace: pipes and devices are neither replaced nor waited for") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  REQUIRE(shell.run({"run", "belt.toml", "--no-plots"}).code == 0);
  REQUIRE(mkfifo((shell / "pipe").c_str(), 0600) == 0);
  const Ending report = shell.run({"report", "belt-run", "-o", "pipe"});
  CHECK(report.code == 6);
  CHECK(has(report.err, "pipe: is a pipe"));
  CHECK(fs::is_fifo(shell / "pipe"));
  const Ending trace = shell.run({"run", "belt.toml", "--force", "--no-plots", "--trace", "pipe"});
  CHECK(trace.code == 6);
  CHECK(has(trace.err, "pipe: is a pipe that no program reads"));
  // A pipe with a reader, and a device, take the trace.
  CHECK(line(shell,
             "cat pipe > read & $SIGNORINI run belt.toml --force --no-plots --trace pipe > out; wait") == 0);
  CHECK(has(shell.read("read"), "\"round\":1"));
  CHECK(shell.run({"run", "belt.toml", "--force", "--no-plots", "--trace", "/dev/null"}).code == 0);
}

TEST_CASE("cli sweep: one whose sweep.json states other units, title or columns is not continued") {
  const Shell shell;
  run_sweep(shell, {"-o", "sweep"});
  const std::string right = shell.read("sweep/sweep.json");
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"\"N\"", "\"kN\""}, {"\"kg\"", "\"t\""}}) {
    CAPTURE(from);
    std::string wrong = right;
    REQUIRE(wrong.find(from) != std::string::npos);
    wrong.replace(wrong.find(from), from.size(), to);
    shell.write("sweep/sweep.json", wrong);
    const Ending ending =
        shell.run({"sweep", "belt.toml", "--vary", three_rows, "--no-plots", "--quiet", "-o", "sweep"});
    CHECK(ending.code == 6);
    CHECK(has(ending.err, "units in sweep.json"));
  }
  shell.write("sweep/sweep.json", right);
  CHECK(
      shell.run({"sweep", "belt.toml", "--vary", three_rows, "--no-plots", "--quiet", "-o", "sweep"}).code ==
      0);
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
  run_sweep(shell, {"--keep"});
  const std::vector<std::string> foreign = {"rows/000001.json", "notes", "rows.txt", "runs/000002.txt",
                                            "runs/12/mine"};
  for (const char* folder : {"rows", "runs/12"}) fs::create_directories(shell / "belt-sweep" / folder);
  for (const std::string& file : foreign) shell.write("belt-sweep/" + file, "mine");
  const std::string before = shell.read("belt-sweep/rows.jsonl");
  run_sweep(shell, {"--force"});
  for (const std::string& file : foreign) {
    CAPTURE(file);
    CHECK(shell.read("belt-sweep/" + file) == "mine");
  }
  CHECK(shell.read("belt-sweep/rows.jsonl") != before);  // computed again
  CHECK_FALSE(exists(shell, "belt-sweep/runs/000001"));
}

TEST_CASE("cli sweep: --force follows no link") {
  const Shell shell;
  run_sweep(shell, {"--keep"});
  fs::rename(shell / "belt-sweep/runs", shell / "elsewhere");
  fs::create_directory_symlink(shell / "elsewhere", shell / "belt-sweep/runs");
  const Ending ending =
      shell.run({"sweep", "belt.toml", "--vary", three_rows, "--no-plots", "--quiet", "--force"});
  CHECK(ending.code == 6);
  CHECK(has(ending.err, "belt-sweep/runs"));
  CHECK(std::distance(fs::directory_iterator(shell / "elsewhere"), {}) == 3);
  fs::remove(shell / "belt-sweep/runs");
  fs::rename(shell / "elsewhere", shell / "belt-sweep/runs");
  // A run that is a link is somebody else's: it stays, with what it leads to.
  fs::rename(shell / "belt-sweep/runs/000002", shell / "kept");
  fs::create_directory_symlink(shell / "kept", shell / "belt-sweep/runs/000002");
  run_sweep(shell, {"--force"});
  CHECK(exists(shell, "kept/events.csv"));
  // So are rows: a link is not followed, and --force removes the link alone.
  fs::rename(shell / "belt-sweep/rows.jsonl", shell / "mine");
  fs::create_symlink(shell / "mine", shell / "belt-sweep/rows.jsonl");
  const std::string mine = shell.read("mine");
  const Ending linked = shell.run({"sweep", "belt.toml", "--vary", three_rows, "--no-plots", "--quiet"});
  CHECK(linked.code == 6);
  CHECK(has(linked.err, "rows.jsonl: is a symbolic link, expected a file with the rows of a sweep"));
  run_sweep(shell, {"--force"});
  CHECK(shell.read("mine") == mine);
}

TEST_CASE("cli sweep: rows that are no files, or were altered or misnumbered, are 6") {
  const Shell shell;
  run_sweep(shell);
  const std::string file = "belt-sweep/rows.jsonl", good = shell.read(file);
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < good.size(); begin = good.find('\n', begin) + 1)
    lines.push_back(good.substr(begin, good.find('\n', begin) + 1 - begin));
  REQUIRE(lines.size() == 3);
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
  std::string altered = lines[1];
  const std::size_t at = altered.find("\"steps\":") + 8;
  altered[at] = altered[at] == '1' ? '2' : '1';
  shell.write(file, lines[0] + altered + lines[2]);
  refused("rows.jsonl: line 2 has been altered since it was written");
  shell.write(file, lines[0] + "\n" + lines[1]);
  refused("rows.jsonl: line 2 has been altered since it was written");
  // A line without its checksum, and one whose checksum is right but which is no row.
  shell.write(file, lines[0].substr(0, lines[0].find(",\"checksum\"")) + "}\n");
  refused("rows.jsonl: line 1 has been altered since it was written");
  shell.write(file, R"({"row":1,"checksum":")" + signorini::base::fingerprint_of(R"({"row":1})") + "\"}\n");
  refused("rows.jsonl: line 1 is not a row of a sweep: ");
  fs::remove(shell / file);
  fs::create_directory(shell / file);
  refused("is a directory, expected a file with the rows of a sweep");
  fs::remove(shell / file);
  REQUIRE(mkfifo((shell / file).c_str(), 0600) == 0);
  refused("is a pipe, expected a file with the rows of a sweep");
  fs::remove(shell / file);
  shell.write(file, good);
  CHECK(shell.run({"sweep", "--merge", "belt-sweep", "-o", "joined", "--no-plots"}).code == 0);
  // An earlier version of the directory.
  std::string spec = shell.read("belt-sweep/sweep.json");
  spec.replace(spec.find("\"sweep\": 2"), 10, "\"sweep\": 1");
  shell.write("belt-sweep/sweep.json", spec);
  refused("sweep.json: was written by an earlier version of Signorini");
}

TEST_CASE("cli sweep: a row of another value, or of another share, is none of this sweep") {
  const Shell shell;
  run_sweep(shell);
  const auto refused = [&](const std::vector<std::string>& more, const std::string& message) {
    std::vector<std::string> arguments = {"sweep", "belt.toml", "--no-plots", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ending ending = shell.run(arguments);
    CHECK(ending.code == 6);
    CHECK_MESSAGE(has(ending.err, message), ending.err);
  };
  REQUIRE(shell
              .run({"sweep", "belt.toml", "--vary", "contacts.belt.friction.static=1:2:0.25", "--no-plots",
                    "--quiet", "-o", "finer"})
              .code == 0);
  fs::copy_file(shell / "finer/rows.jsonl", shell / "belt-sweep/rows.jsonl",
                fs::copy_options::overwrite_existing);
  refused({"--vary", three_rows}, "is not from this sweep: its values of the varied keys differ");
  REQUIRE(shell
              .run({"sweep", "belt.toml", "--vary", three_rows, "--no-plots", "--quiet", "--share", "2/2",
                    "-o", "half"})
              .code == 0);
  CHECK(shell.read("half/rows.jsonl").starts_with("{\"row\":2,"));
  run_sweep(shell, {"--force"});
  fs::copy_file(shell / "belt-sweep/rows.jsonl", shell / "half/rows.jsonl",
                fs::copy_options::overwrite_existing);
  refused({"--vary", three_rows, "--share", "2/2", "-o", "half"}, "is not part of share 2/2");
}

TEST_CASE(
    "cli sweep: where a row cannot be written whole, the others stay, and the sweep goes on from them") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  const std::vector<std::string> command = {"sweep", "belt.toml", "--vary",
                                            "contacts.belt.friction.static=1:2:0.05", "--no-plots"};
  const Ending full = shell.wait(shell.start(command, ".out", 3000));
  CHECK(full.code == 6);
  CHECK_MESSAGE(has(full.err, "belt-sweep/rows.jsonl: cannot be written: File too large"), full.err);
  CHECK(has(full.err, "a file could not be written, so the sweep stopped; "));
  const std::string kept = shell.read("belt-sweep/rows.jsonl");
  CHECK(kept.size() > 1000);
  CHECK(kept.back() == '\n');
  CHECK(signorini::cli_test::lines(shell.read("belt-sweep/sweep.csv")) > 1);
  const Ending again = shell.run(command);
  CHECK(again.code == 0);
  CHECK(has(again.err, std::to_string(signorini::cli_test::lines(kept)) + " rows of 21 already computed"));
  CHECK(shell.read("belt-sweep/rows.jsonl").starts_with(kept));
  CHECK(signorini::cli_test::lines(shell.read("belt-sweep/rows.jsonl")) == 21);
}

TEST_CASE("cli sweep: shares that contradict each other are not merged") {
  const Shell shell;
  run_sweep(shell, {"-o", "one"});
  run_sweep(shell, {"-o", "two"});
  const auto merge = [&] {
    return shell.run({"sweep", "--merge", "one", "two", "-o", "joined", "--force", "--no-plots"});
  };
  CHECK(merge().code == 0);  // alike but for their times
  // The same sweep of a scene that ends earlier, passed off as a share.
  shell.write("belt.toml", belt(4));
  REQUIRE(shell.run({"sweep", "belt.toml", "--vary", three_rows, "--no-plots", "-o", "short"}).code == 0);
  fs::copy_file(shell / "short/rows.jsonl", shell / "two/rows.jsonl", fs::copy_options::overwrite_existing);
  const Ending ending = merge();
  CHECK(ending.code == 6);
  CHECK_MESSAGE(has(ending.err, "two/rows.jsonl: line "), ending.err);
  CHECK(has(ending.err, "differs from row 1 of another share"));
}

TEST_CASE("cli: a gnuplot that floods is ended, and the run is there") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  fake_gnuplot(shell, "exec yes 'warning: all is well' >&2");
  CHECK(line(shell, "PATH=\"$PWD/bin:$PATH\" $SIGNORINI run belt.toml >.out 2>.err") == 0);
  CHECK(has(shell.read(".err"), "gnuplot printed more than 64 kB and was stopped"));
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
    CHECK(has(ending.err, "not plain UTF-8 text"));
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
  CHECK(has(shell.read(".err"), "gnuplot ran longer than 60 s and was stopped"));
}

TEST_SUITE_END();
