#include <doctest/doctest.h>

#include <fstream>
#include <string>
#include <thread>

#include "program.hpp"

using signorini::cli_test::belt;
using signorini::cli_test::Ending;
using signorini::cli_test::Shell;

namespace {

/// Waits until the program runs in the process and has a handler for the signal: before that, as the loader works, it
/// would just end.
bool has_handler(pid_t process, int signal) {
  for (int i = 0; i < 3000; ++i) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    bool is_program = false;  // no longer the test that has forked
    for (std::string line; std::getline(status, line);) {
      is_program = is_program || line == "Name:\tsignorini";
      if (is_program && line.starts_with("SigCgt:") &&
          ((std::stoull(line.substr(7), nullptr, 16) >> static_cast<unsigned>(signal - 1)) & 1U) != 0)
        return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace

TEST_SUITE_BEGIN("cli/command_line");

TEST_CASE("cli: --help and --version are data") {
  const Shell shell;
  const Ending help = shell.run({"--help"});
  CHECK(help.code == 0);
  CHECK(help.out.find("run") != std::string::npos);
  CHECK(help.err.empty());
  const Ending version = shell.run({"--version"});
  CHECK(version.code == 0);
  CHECK(version.out.rfind("signorini ", 0) == 0);
  CHECK(version.err.empty());
  CHECK(shell.run({"run", "--help"}).code == 0);
}

TEST_CASE("cli: a wrong command line is 2, said on stderr, and leaves nothing") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"walk"},
      {"run"},
      {"run", "belt.toml", "--fast"},
      {"run", "belt.toml", "extra"},
      {"run", "belt.toml", "--set", "run.rtol"},
      {"run", "belt.toml", "--set", "=3"},
      {"run", "belt.toml", "--set", "run.rtoll=3"},
      {"run", "belt.toml", "--set", "contacts.nobody.friction=0.1"},
      {"run", "belt.toml", "-o", ""},
      {"plot"},
  };
  for (const auto& arguments : wrong) {
    std::string line;
    for (const auto& a : arguments) line += a + " ";
    CAPTURE(line);
    const Ending ending = shell.run(arguments);
    CHECK(ending.code == 2);
    CHECK(ending.out.empty());
    CHECK(ending.err.rfind("error: ", 0) == 0);
    CHECK(shell.list() == std::vector<std::string>{"belt.toml"});
  }
}

TEST_CASE("cli: what a command does not take is named, with what was meant") {
  const Shell shell;
  const auto told = [&](const std::vector<std::string>& arguments) {
    const Ending ending = shell.run(arguments);
    CHECK(ending.code == 2);
    return ending.err;
  };
  CHECK(told({"run", "a.toml", "--sett", "run.rtol=1"}) ==
        "error: run: no option --sett; did you mean \"--set\"?\nsee signorini run --help\n");
  CHECK(told({"plot", "a-run", "--lang", "de"}) ==
        "error: plot: no option --lang; did you mean \"--language\"?\nsee signorini plot --help\n");
  CHECK(told({"sensitivity", "a.toml", "--engine", "exact", "--parameter", "b"}) ==
        "error: sensitivity: no option --engine; use --set run.engine=NAME\nsee signorini sensitivity "
        "--help\n");
  CHECK(told({"run", "a.toml", "extra"}) ==
        "error: run: unexpected argument \"extra\"\nsee signorini run --help\n");
}

TEST_CASE("cli: --quiet says nothing but errors, and what happens is kept") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  const std::string rough = "contacts.belt.friction.static=2.5";  // above 2: a warning
  CHECK(shell.run({"run", "belt.toml", "--set", rough, "--no-plots"}).err.find("warning: ") !=
        std::string::npos);
  CHECK(shell.run({"run", "belt.toml", "--set", rough, "--no-plots", "--force", "--quiet"}).err.empty());
  CHECK(shell.read("belt-run/summary.json").find("\"warnings\": []") == std::string::npos);
  CHECK(shell.run({"compare", "belt.toml", "--engines", "exact,ida", "--set", rough, "--no-plots", "--quiet"})
            .err.empty());
}

TEST_CASE("cli: wrong measurements are wrong data, as a wrong load table is") {
  const Shell shell;
  shell.write("belt.toml", belt(5));
  shell.write("d.csv", "t,block.ux\nabc,1\n");
  shell.write("e.csv", "t,nobody.ux\n1.0,1\n");
  const auto fit = [&](const std::string& data) {
    return shell.run({"fit", "belt.toml", data, "--parameter", "contacts.1.friction.static"});
  };
  const Ending number = fit("d.csv"), column = fit("e.csv"), missing = fit("nope.csv");
  CHECK(number.code == 3);
  CHECK(number.err == "error: d.csv:2:1: t: found \"abc\", expected a finite number\n");
  CHECK(column.code == 3);
  CHECK(column.err == "error: e.csv:1: the run has no column \"nobody.ux\"\n");
  CHECK(missing.code == 6);
  CHECK(missing.err == "error: nope.csv: cannot be read: No such file or directory\n");
  CHECK(shell.run({"run", "belt.toml", "--trace", "nodir/t"}).err ==
        "error: nodir/t: cannot be created: No such file or directory\n");
  CHECK(shell.run({"plot", "nodir"}).err == "error: nodir: not a directory\n");
}

TEST_CASE("cli: a wrong scene is 3, with its place, and leaves nothing") {
  const Shell shell;
  shell.write("wrong.toml", belt(10) + "frction = 0.3\n");
  const Ending ending = shell.run({"run", "wrong.toml"});
  CHECK(ending.code == 3);
  CHECK(ending.out.empty());
  CHECK(ending.err.rfind("error: wrong.toml:", 0) == 0);
  CHECK(ending.err.find("frction") != std::string::npos);
  CHECK(shell.list() == std::vector<std::string>{"wrong.toml"});
}

TEST_CASE("cli: what cannot be read or written is 6") {
  const Shell shell;
  CHECK(shell.run({"run", "missing.toml"}).code == 6);
  CHECK(shell.run({"plot", "missing"}).code == 6);
  CHECK(shell.list().empty());
  shell.write("belt.toml", belt(1));
  shell.write("taken", "a file");
  const Ending ending = shell.run({"run", "belt.toml", "-o", "taken"});
  CHECK(ending.code == 6);
  CHECK(ending.err.find("taken") != std::string::npos);
  CHECK(shell.read("taken") == "a file");
}

TEST_CASE("cli: a pipe is no scene, no matrix and no table, and nobody waits for it") {
  const Shell shell;
  REQUIRE(mkfifo((shell / "pipe").c_str(), 0600) == 0);
  const Ending scene = shell.run({"check", "pipe"});
  CHECK(scene.code == 6);
  CHECK(scene.err.find("pipe: is a pipe, expected a scene file") != std::string::npos);
  shell.write("table.toml", belt(1) + R"([[loads]]
node = "block"
direction = [1.0, 0.0]
amplitude = 1.0
history = { type = "table", file = "pipe" }
)");
  shell.write("matrix.toml", R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1.0
[matrices]
mass = [[1.0]]
stiffness = "pipe"
)");
  for (const std::string name : {"table", "matrix"}) {
    const Ending ending = shell.run({"check", name + ".toml"});
    CHECK(ending.code == 6);
    CHECK(ending.err.rfind("error: " + name + ".toml:", 0) == 0);
    CHECK(ending.err.find("pipe: is a pipe, expected a file") != std::string::npos);
  }
}

TEST_CASE("cli: an unknown command is named, with a suggestion") {
  const Shell shell;
  const Ending ending = shell.run({"rum", "belt.toml"});
  CHECK(ending.code == 2);
  CHECK(ending.err.find("no command \"rum\"; did you mean \"run\"?") != std::string::npos);
}

TEST_CASE("cli: an engine that does not exist is a wrong command line") {
  const Shell shell;
  shell.write("belt.toml", belt(1));
  const Ending ending = shell.run({"run", "belt.toml", "--engine", "idda"});
  CHECK(ending.code == 2);
  CHECK(ending.err.find("did you mean \"ida\"?") != std::string::npos);
  CHECK(shell.list() == std::vector<std::string>{"belt.toml"});
}

TEST_CASE("cli: a full disk behind stdout is 6") {
  if (!std::filesystem::exists("/dev/full")) return;
  const Shell shell;
  shell.write("belt.toml", belt(1));
  const Ending ending = shell.wait(shell.start({"run", "belt.toml", "--no-plots"}, "/dev/full"));
  CHECK(ending.code == 6);
  CHECK(ending.err.find("No space left") != std::string::npos);
}

TEST_CASE("cli: help, asked for as a command") {
  const Shell shell;
  CHECK(shell.run({"help"}).out == shell.run({"--help"}).out);
  CHECK(shell.run({"help"}).code == 0);
  CHECK(shell.run({"help", "run"}).out == shell.run({"run", "--help"}).out);
  CHECK(shell.run({"help", "rum"}).code == 2);
}

TEST_CASE("cli: INT and TERM end a set-up that has nothing to keep, with 130") {
  const Shell shell;
  std::string text = belt(1);
  for (int i = 0; i < 4000; ++i) {  // some seconds of building and checking
    const std::string n = std::to_string(i);
    text += "[[masses]]\nnode = \"n" + n + "\"\nmass = 1.0\n[[contacts]]\nname = \"c" + n + "\"\nnode = \"n" +
            n + "\"\nlaw = \"rigid\"\nnormal = [0.0, 1.0]\nfriction = 0.3\ngap = 1.0\n";
  }
  std::string nodes = "[nodes]\n";
  for (int i = 0; i < 4000; ++i) nodes += "n" + std::to_string(i) + " = [0.0, " + std::to_string(i) + ".0]\n";
  text.replace(text.find("[nodes]\n"), 8, nodes);
  shell.write("many.toml", text);
  for (const int signal : {SIGINT, SIGTERM})
    for (const char* command : {"check", "run"}) {
      CAPTURE(signal);
      CAPTURE(command);
      const pid_t child = shell.start({command, "many.toml"});
      REQUIRE(has_handler(child, signal));
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      kill(child, signal);
      const Ending ending = shell.wait(child);
      CHECK(ending.code == 130);
      CHECK(ending.err == "error: interrupted\n");
      CHECK_FALSE(exists(shell, "many-run"));
    }
}

TEST_SUITE_END();
