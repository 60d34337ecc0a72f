// What helps to begin: new, keys WORD, schema, completion, man.
#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "program.hpp"

using namespace signorini::cli_test;

TEST_SUITE_BEGIN("cli/learn");

TEST_CASE("cli new: each scene is written, checked and run, and something happens at its contacts") {
  const Shell shell;
  for (const std::string from : {"block", "portal", "pipe", "matrices"}) {
    CAPTURE(from);
    const Ending ending = shell.run({"new", "my-" + from, "--from", from});
    CHECK(ending.code == 0);
    CHECK(ending.out == "my-" + from + ".toml\n");
    CHECK(has(ending.err, "signorini check my-" + from + ".toml"));
    CHECK(shell.run({"check", "my-" + from + ".toml"}).code == 0);
    CHECK(shell.run({"run", "my-" + from + ".toml", "-o", "out", "--force", "--no-plots"}).code == 0);
    CHECK(has(shell.read("out/events.csv"), ",slip,stick,"));
  }
  // All that they say of keys that one may want is true: without "#?" it is TOML of a scene, but for
  // alternatives.
  const std::string portal = shell.read("my-portal.toml");
  CHECK(has(portal, "\n#? frames = "));
  CHECK(has(shell.read("out/run.toml"), "Matrices of another program"));
}

TEST_CASE(
    "cli new: scenes of earthquakes come with their accelerograms, which `quake` makes again to the byte") {
  const Shell shell;
  for (const std::string from : {"rack", "isolator", "rocking", "building"}) {
    CAPTURE(from);
    const std::string name = "my-" + from;
    const Ending ending = shell.run({"new", name, "--from", from});
    CAPTURE(ending.err);
    REQUIRE(ending.code == 0);
    CHECK(ending.out == name + ".toml\n" + name + ".AT2\n" + name + ".csv\n");
    const std::string text = shell.read(name + ".toml");
    CHECK_FALSE(has(text, "@NAME@"));
    const Ending check = shell.run({"check", name + ".toml"});
    CAPTURE(check.err);
    CHECK(check.code == 0);
    const Ending run = shell.run(
        {"run", name + ".toml", "-o", "out", "--force", "--no-plots", "--quiet", "--set", "run.t_end=3"});
    CAPTURE(run.err);
    CHECK(run.code == 0);
    CHECK(has(shell.read("out/events.csv"), ",slip,stick,"));
    // The command in its comments.
    const std::size_t at = text.find("signorini quake ");
    std::istringstream line(text.substr(at, text.find('\n', at) - at));
    std::vector<std::string> words;
    for (std::string word; line >> word;) words.push_back(word);
    words.erase(words.begin());
    words[1] = "again";
    words.insert(words.end(), {"--force", "--quiet"});
    REQUIRE(shell.run(words).code == 0);
    CHECK(shell.read("again.AT2") == shell.read(name + ".AT2"));
    CHECK(shell.read("again.csv") == shell.read(name + ".csv"));
    // A scene that is there, or an accelerogram, stays.
    std::filesystem::remove(shell / (name + ".toml"));
    CHECK(shell.run({"new", name, "--from", from}).code == 6);
    CHECK_FALSE(exists(shell, name + ".toml"));
  }
}

TEST_CASE("cli quake: what is wrong is told, with exit code 2 or 6, and nothing is written") {
  const Shell shell;
  const std::pair<std::vector<std::string>, const char*> wrong[] = {
      {{"quake", "q", "--pga", "0"}, "--pga: found 0, expected"},
      {{"quake", "q", "--duration", "10.003"}, "expected a multiple of --dt 0.01"},
      {{"quake", "q", "--seed", "-1"}, "--seed: found -1"},
      {{"quake", "q", "--spectrum", "ec8-F"}, "expected ec8-A to ec8-E"},
      {{"quake", "q", "--spectrum", "ec8-A", "--dt", "0.02"}, "at most 0.0125"},
      {{"quake", "folder/"}, "expected a file's name"},
  };
  for (const auto& [words, message] : wrong) {
    CAPTURE(message);
    const Ending ending = shell.run(words);
    CHECK(ending.code == 2);
    CHECK(has(ending.err, message));
  }
  CHECK(shell.run({"quake", "q", "--spectrum", "none.csv"}).code == 6);
  CHECK(shell.list().empty());
  shell.write("target.csv", "T,PSA\n0.1,0.5\n0.5,0.5\n2,0.1\n");
  const Ending own = shell.run({"quake", "q", "--spectrum", "target.csv", "--duration", "12"});
  CHECK(own.code == 0);
  CHECK(has(own.out, "of the target"));
  CHECK(has(shell.read("q.AT2"), "NPTS= 1201, DT= 0.01 SEC"));
  CHECK(has(shell.read("q.csv"), "\n12,"));
}

TEST_CASE("cli new: the keys that its comments offer are keys") {
  const Shell shell;
  const auto offered = [&](const std::string& from, const std::string& commented) {
    CHECK(shell.run({"new", "own.toml", "--from", from, "--force"}).code == 0);
    std::string text = shell.read("own.toml");
    const std::size_t at = text.find("#? " + commented);
    CAPTURE(commented);
    REQUIRE(at != std::string::npos);
    text.erase(at, 3);
    shell.write("own.toml", text);
    const Ending ending = shell.run({"check", "own.toml"});
    CAPTURE(ending.err);
    CHECK(ending.code == 0);
  };
  offered("block", "engine = ");
  offered("block", "initial = ");
  offered("block", "surface_velocity = ");
  offered("portal", "frames = ");
  offered("pipe", "thermal_expansion = ");
  offered("matrices", "initial = ");
}

TEST_CASE("cli new: a file that is there stays, unknown scenes are refused with what there is") {
  const Shell shell;
  shell.write("mine.toml", "precious");
  const Ending there = shell.run({"new", "mine.toml"});
  CHECK(there.code == 6);
  CHECK(has(there.err, "mine.toml"));
  CHECK(shell.read("mine.toml") == "precious");
  const Ending unknown = shell.run({"new", "other", "--from", "portl"});
  CHECK(unknown.code == 2);
  CHECK(has(unknown.err, "\"portal\""));
  CHECK_FALSE(exists(shell, "other.toml"));
  CHECK(shell.run({"new", "folder/"}).code == 2);
  CHECK(shell.run({"new", "no/such/folder"}).code == 6);
}

TEST_CASE("cli keys: words choose lines, whatever their case; none is an error") {
  const Shell shell;
  const Ending friction = shell.run({"keys", "Friction", "STATIC"});
  CHECK(friction.code == 0);
  CHECK(has(friction.out, "  contacts[].friction.static "));
  CHECK_FALSE(has(friction.out, "contacts[].gap"));
  CHECK_FALSE(has(friction.out, "run.relaxation"));  // speaks of friction, not of static
  // What somebody looks for who does not know the scene's words.
  const std::pair<const char*, const char*> synonyms[] = {{"earthquake", "  base_motion.acceleration "},
                                                          {"hanger", "  springs[].preload "},
                                                          {"bearing", "  pendulums[].radius "},
                                                          {"bearings", "  pendulums[].radius "},
                                                          {"Stress", "  output[].sif "},
                                                          {"temperature", "  members[].thermal_expansion "}};
  for (const auto& [word, key] : synonyms) {
    CAPTURE(word);
    const Ending found = shell.run({"keys", word});
    CHECK(found.code == 0);
    CHECK(has(found.out, key));
    CHECK_FALSE(has(found.out, "run.rtol"));
  }
  const Ending none = shell.run({"keys", "frictoin"});
  CHECK(none.code == 2);
  CHECK(has(none.err, "'frictoin'"));
  CHECK(none.out.empty());
  CHECK(shell.run({"keys", "gap", "--markdown"}).code == 2);
}

TEST_CASE("cli schema: JSON with the keys") {
  const Ending ending = Shell().run({"schema"});
  CHECK(ending.code == 0);
  CHECK(ending.out.starts_with("{\n"));
  CHECK(has(ending.out, "\"tangential_stiffness\""));
}

TEST_CASE("cli man: a page a command, with every option of --help, and text that troff leaves alone") {
  const Shell shell;
  const Ending run = shell.run({"man", "run"});
  CHECK(run.code == 0);
  CHECK(run.out.starts_with(".TH SIGNORINI\\-RUN 1"));
  for (const char* part : {"\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fIDIR\\fR", "\\fB\\-\\-no\\-plots\\fR\n",
                           "\\fISCENE\\fR\n", ".SH EXIT STATUS\n0 done"}) {
    CAPTURE(part);
    CHECK(has(run.out, part));
  }
  CHECK(shell.run({"man", "rum"}).code == 2);
  CHECK(has(shell.run({"man"}).out, ".BR signorini\\-sweep (1)"));
  const Ending all = shell.run({"man", "--write", "."});
  CHECK(all.code == 0);
  CHECK(shell.read("signorini-run.1") == run.out);
  CHECK(exists(shell, "signorini.1"));
  CHECK(shell.run({"man", "--write", "nowhere"}).code == 6);
}

namespace {

/// What bash offers for the last of the words.
std::string offers(const Shell& shell, const std::string& words, int last) {
  const std::string command = "cd '" + (shell / "").string() +
                              "' && bash --norc -c 'source ./words; COMP_WORDS=(" + words +
                              "); COMP_CWORD=" + std::to_string(last) +
                              "; _signorini; printf \"%s \" \"${COMPREPLY[@]}\"' 2>/dev/null";
  std::string text;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 256> part{};
  while (pipe && std::fgets(part.data(), part.size(), pipe)) text += part.data();
  if (pipe) pclose(pipe);
  return text;
}

}  // namespace

TEST_CASE("cli completion: bash offers commands, options, engines, settings, scenes and folders") {
  const Shell shell;
  const Ending script = shell.run({"completion", "bash"});
  CHECK(script.code == 0);
  shell.write("words", script.out);
  shell.write("one.toml", "");
  shell.write("two.csv", "");
  CHECK(shell.run({"new", "three.toml"}).code == 0);
  CHECK(offers(shell, "signorini ver", 1) == "verify ");
  CHECK(offers(shell, "signorini run --no", 2) == "--no-plots ");
  CHECK(offers(shell, "signorini run --engine new", 3) == "newmark ");
  CHECK(offers(shell, "signorini run --set run.rt", 3) == "run.rtol= ");
  CHECK(offers(shell, "signorini new a --from po", 4) == "portal ");
  CHECK(offers(shell, "signorini run o", 2) == "one.toml ");
  CHECK(offers(shell, "signorini check tw", 2) == " ");
  CHECK(offers(shell, "signorini completion z", 2) == "zsh ");
  CHECK(shell.run({"completion", "fish"}).code == 2);
}

TEST_CASE("cli completion: zsh has the same, with texts that its _arguments cannot misread") {
  const Ending script = Shell().run({"completion", "zsh"});
  CHECK(script.code == 0);
  CHECK(script.out.starts_with("#compdef signorini\n"));
  CHECK(has(script.out, "'*--engine[time integration, instead of the scene'\\''s run.engine]:NAME:("));
  CHECK(has(script.out, "'sweep:run a scene over ranges of its keys, into one table'"));
}

TEST_SUITE_END();
