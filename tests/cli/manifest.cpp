// The manifest of a run: every reader of a run's directory refuses files that are not as the run wrote them.
#include <doctest/doctest.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

using namespace signorini::cli_test;
using nlohmann::json;
namespace fs = std::filesystem;

TEST_SUITE_BEGIN("cli/manifest");

namespace {

/// FNV-1a of 64 bits, as docs/output.md describes it, with its published test value.
std::string checksum_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const unsigned char byte : text) {
    hash ^= byte;
    hash *= 0x100000001b3;
  }
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

json manifest_of(const Shell& shell, const std::string& run) {
  return json::parse(shell.read(run + "/manifest.json"));
}

std::vector<std::string> files_of(const json& manifest) {
  std::vector<std::string> files;
  for (const json& entry : manifest["files"]) files.push_back(entry["file"]);
  return files;
}

bool lists(const json& manifest, const std::string& file) {
  const std::vector<std::string> files = files_of(manifest);
  return std::find(files.begin(), files.end(), file) != files.end();
}

/// Each file of the manifest has its size and checksum, and none was written after it.
void check_manifest(const Shell& shell, const std::string& run, const std::string& outcome) {
  CAPTURE(run);
  const json manifest = manifest_of(shell, run);
  CHECK(manifest["outcome"] == outcome);
  CHECK(manifest["signorini"] == json::parse(shell.read(run + "/summary.json"))["versions"]["signorini"]);
  CHECK(manifest["files"].size() >= 6);
  const auto written = fs::last_write_time(shell / (run + "/manifest.json"));
  for (const json& entry : manifest["files"]) {
    const std::string name = entry["file"], text = shell.read(run + "/" + name);
    CAPTURE(name);
    CHECK(entry["size"] == text.size());
    CHECK(entry["checksum"] == checksum_of(text));
    CHECK(fs::last_write_time(shell / (run + "/" + name)) <= written);
  }
}

/// belt-run: states at three times.
void make_run(const Shell& shell, const std::vector<std::string>& more = {}) {
  shell.write("belt.toml", belt(5));
  std::vector<std::string> line = {"run", "belt.toml", "--quiet", "--set", "run.frames=[1.0,2.5]"};
  line.insert(line.end(), more.begin(), more.end());
  REQUIRE(shell.run(line).code == 0);
}

/// next.toml continues from the run in `run`.
void write_next(const Shell& shell, const std::string& run) {
  std::string text = belt(5);
  const std::string initial = "{ block = { ux = 0.0, vx = 0.0 } }";
  text.replace(text.find(initial), initial.size(), "{ run = \"" + run + "\" }");
  shell.write("next.toml", text);
}

std::string flipped(std::string text, std::size_t at) {
  text[at] = static_cast<char>(text[at] ^ 1);
  return text;
}

/// The end of the last but one line.
std::size_t last_row(const std::string& text) { return text.rfind('\n', text.size() - 2) + 1; }

using Command = std::vector<std::string>;

/// Ends with 6 and names the file and what was found; within 20 s.
void refuses(const Shell& shell, const Command& command, const std::string& what) {
  std::string text = "timeout 20 \"$SIGNORINI\"";
  for (const std::string& word : command) text += " '" + word + "'";
  CAPTURE(text);
  CHECK(line(shell, text + " >.out 2>.err") == 6);
  const std::string err = shell.read(".err");
  CAPTURE(err);
  CHECK(has(err, what));
}

void damage(const Shell& shell, const std::string& file, const std::string& text, const Command& command,
            const std::string& what) {
  const std::string whole = shell.read(file);
  REQUIRE(whole != text);
  shell.write(file, text);
  refuses(shell, command, what);
  shell.write(file, whole);
}

std::string bytes(std::size_t found, std::size_t expected) {
  return "found " + std::to_string(found) + " bytes, expected " + std::to_string(expected) +
         " as in manifest.json";
}

}  // namespace

TEST_CASE("cli manifest: a run lists all its results with size and checksum, and writes the list last") {
  CHECK(checksum_of("foobar") == "85944171f73967e8");
  const Shell shell;
  make_run(shell);
  check_manifest(shell, "belt-run", "done");
  std::vector<std::string> there;
  for (const auto& entry : fs::directory_iterator(shell / "belt-run"))
    if (entry.is_regular_file() && entry.path().filename() != "manifest.json")
      there.push_back(entry.path().filename().string());
  std::vector<std::string> listed = files_of(manifest_of(shell, "belt-run"));
  CHECK(listed.front() == "events.csv");
  CHECK(listed.back() == "run.toml");
  std::sort(there.begin(), there.end());
  std::sort(listed.begin(), listed.end());
  CHECK(there == listed);
}

TEST_CASE("cli manifest: a run is not continued from a torn or altered file") {
  const Shell shell;
  make_run(shell);
  write_next(shell, "belt-run");
  const Command next = {"run", "next.toml", "--no-plots"};
  const std::string states = shell.read("belt-run/states.csv"),
                    place = "next.toml:6:", file = "run.initial.run: belt-run/states.csv: ";
  const auto refused = [&](const std::string& text, const std::string& what) {
    damage(shell, "belt-run/states.csv", text, next, what);
    CHECK(has(shell.read(".err"), place));
    CHECK(has(shell.read(".err"), file));
    CHECK(has(shell.read(".err"), "delete belt-run/manifest.json if the change was intended"));
    CHECK_FALSE(exists(shell, "next-run"));
  };
  const std::size_t row = last_row(states), middle = (row + states.size()) / 2;
  refused(states.substr(0, middle), bytes(middle, states.size()));
  refused(states.substr(0, row), bytes(row, states.size()));
  refused(flipped(states, middle), "found checksum ");
  fs::rename(shell / "belt-run/states.csv", shell / "states.csv");
  refuses(shell, next, file + "not found, expected " + std::to_string(states.size()) + " bytes");
  fs::rename(shell / "states.csv", shell / "belt-run/states.csv");
  for (const std::string other : {"contacts.csv", "summary.json", "run.toml"}) {
    const std::string name = "belt-run/" + other, text = shell.read(name);
    damage(shell, name, flipped(text, text.size() / 2), next, name + ": found checksum ");
    damage(shell, name, text.substr(0, text.size() - 1), next, bytes(text.size() - 1, text.size()));
  }
  refuses(shell, {"check", "nowhere.toml"}, "nowhere.toml");
  CHECK(shell.run({"check", "next.toml"}).err == "");
  CHECK(shell.run(next).code == 0);
  CHECK(shell.run({"plot", "next-run"}).code == 0);
}

TEST_CASE("cli manifest: without one a run is continued, and a warning says what is left out") {
  const Shell shell;
  make_run(shell);
  write_next(shell, "belt-run");
  fs::remove(shell / "belt-run/manifest.json");
  const Ending whole = shell.run({"run", "next.toml", "--no-plots"});
  CHECK(whole.code == 0);
  CHECK(
      has(whole.err,
          "belt-run: manifest.json is missing: the run may not have finished, or is of an earlier version"));
  CHECK_FALSE(has(whole.err, "no line end"));
  const std::string states = shell.read("belt-run/states.csv");
  shell.write("belt-run/states.csv", states.substr(0, states.size() - 3));
  const Ending cut = shell.run({"check", "next.toml"});
  CHECK(cut.code == 0);
  CHECK(has(cut.out + cut.err, "The last line of states.csv has no line end, so its state is ignored"));
  shell.write("belt-run/summary.json", "{\"model\"");
  refuses(shell, {"check", "next.toml"}, "belt-run/summary.json: is not the summary of a run");
}

TEST_CASE("cli manifest: all that read a run refuse a damaged file") {
  const Shell shell;
  make_run(shell, {"--instants"});
  fs::copy(shell / "belt-run", shell / "good", fs::copy_options::recursive);
  const auto half = [&](const std::string& name) {
    const std::string text = shell.read("belt-run/" + name);
    return flipped(text, text.size() / 2);
  };
  const Command report = {"report", "belt-run"}, cases = {"report", "good", "belt-run"},
                compare = {"compare", "good", "belt-run"}, plot = {"plot", "belt-run"},
                witness = {"witness", "belt-run"}, paraview = {"paraview", "belt-run"};
  for (const Command& command : {report, compare, plot, witness, paraview})
    for (const std::string name : {"history.csv", "events.csv", "contacts.csv", "motion.csv", "summary.json"})
      damage(shell, "belt-run/" + name, half(name), command, "belt-run/" + name + ": found checksum ");
  damage(shell, "belt-run/summary.json", half("summary.json"), cases,
         "belt-run/summary.json: found checksum ");
  CHECK_FALSE(exists(shell, "belt-run/report.html"));
  CHECK_FALSE(exists(shell, "cases.html"));
  CHECK_FALSE(exists(shell, "good-compare"));
  CHECK_FALSE(exists(shell, "belt-run/paraview"));
  fs::remove(shell / "belt-run/motion.csv");
  refuses(shell, plot, "belt-run/motion.csv: not found, expected ");
  shell.write("belt-run/motion.csv", shell.read("good/motion.csv"));
  // Files that nobody wrote for this run, and what is drawn from it, are nobody's concern.
  shell.write("belt-run/notes.txt", "mine");
  shell.write("belt-run/mine.csv", "t\n");
  for (const Command& command : {plot, report, witness, cases, compare, paraview, plot}) {
    const Ending ending = shell.run(command);
    CAPTURE(command.front());
    CAPTURE(ending.err);
    CHECK(ending.code == 0);
    CHECK_FALSE(has(ending.err, "manifest"));
  }
  // A table of results that the run did not write is taken for one of its own.
  shell.write("belt-run/geometric.csv", "what,from,to,N_from,N_to,stiffness\n");
  refuses(shell, plot, "belt-run/geometric.csv: found a file that manifest.json does not list");
  fs::remove(shell / "belt-run/geometric.csv");
  damage(shell, "belt-run/manifest.json", "{\"files\"", plot,
         "belt-run/manifest.json: is not a manifest of a run");
  fs::remove(shell / "belt-run/manifest.json");
  for (const Command& command : {plot, report, witness, cases, paraview}) {
    const Ending ending = shell.run(command);
    CAPTURE(command.front());
    CHECK(ending.code == 0);
    CHECK(has(ending.err,
              "note: belt-run: manifest.json is missing: the run may not have finished, or is of an earlier "
              "version"));
  }
  const Ending compared = shell.run({"compare", "good", "belt-run", "--force"});
  CHECK(compared.code == 0);
  CHECK(has(compared.err, "note: belt-run: manifest.json is missing"));
  CHECK_FALSE(has(compared.err, "good: manifest.json is missing"));
}

TEST_CASE("cli manifest: a killed run has none, an interrupted one says that it was") {
  const Shell shell;
  make_run(shell);  // is replaced: its manifest must not vouch for what the next run has written
  shell.write("belt.toml", belt(5e6));
  const auto runs = [&] {
    // Tables are written out at different times: a killed run may have left one without rows.
    for (const char* table : {"history.csv", "contacts.csv", "energy.csv"})
      if (lines(shell.read(std::string("belt-run/") + table)) < 2) return false;
    return has(shell.read("belt-run/summary.json"), "\"running\"") &&
           lines(shell.read("belt-run/events.csv")) > 5;
  };
  const auto ended_by = [&](int signal) {
    const pid_t child =
        shell.start({"run", "belt.toml", "--no-plots", "--force", "--set", "run.frames=[1.0,2.5]"});
    for (int i = 0; i < 6000 && !runs(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    REQUIRE(runs());
    CHECK_FALSE(exists(shell, "belt-run/manifest.json"));
    kill(child, signal);
    return shell.wait(child).code;
  };
  write_next(shell, "belt-run");
  CHECK(ended_by(SIGINT) == 130);
  check_manifest(shell, "belt-run", "interrupted");
  CHECK(shell.run({"check", "next.toml"}).err == "");
  CHECK(ended_by(SIGKILL) == 128 + SIGKILL);
  const Ending plot = shell.run({"plot", "belt-run"});
  CAPTURE(plot.err);
  CHECK(plot.code == 0);
  CHECK(has(plot.err, "belt-run: manifest.json is missing: the run may not have finished"));
  const Ending next = shell.run({"run", "next.toml", "--no-plots"});
  CHECK(next.code == 0);
  CHECK(has(next.err, "manifest.json is missing"));
  check_manifest(shell, "next-run", "done");
}

TEST_CASE("cli manifest: runs that stop early have one") {
  const Shell shell;
  shell.write("none.toml",
              "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
              "[run]\nt_end = 1.0\ninitial = { u = [0.0, 0.0], v = [1.0, 0.0] }\n[matrices]\n"
              "mass = [[0.34847735667203295, 0.2532986927066816], [0.2532986927066816, 0.9015226433279672]]\n"
              "stiffness = [[0.0, 0.0], [0.0, 0.0]]\n[[contacts]]\nname = \"tip\"\nlaw = \"rigid\"\n"
              "normal = { d1 = -1.0 }\ntangent = { d0 = 1.0 }\nfriction = 4.0\n[[loads]]\n"
              "direction = { d0 = 0.2532986927066816, d1 = 0.9015226433279672 }\namplitude = 10.0\n");
  CHECK(shell.run({"run", "none.toml", "--no-plots"}).code == 4);
  check_manifest(shell, "none-run", "stopped");
  shell.write("belt.toml", belt(400));
  CHECK(shell.wait(shell.start({"run", "belt.toml", "--no-plots"}, ".out", 40000)).code == 6);
  check_manifest(shell, "belt-run", "stopped");
  CHECK(shell.run({"plot", "belt-run"}).err == "");
}

TEST_CASE("cli manifest: tables that plot computes later are added to it") {
  const Shell shell;
  make_run(shell, {"-o", "whole"});
  make_run(shell, {"-o", "thin", "--no-plots"});
  CHECK_FALSE(lists(manifest_of(shell, "thin"), "motion.csv"));
  // A kill has left half of a table.
  const std::string motion = shell.read("whole/motion.csv");
  shell.write("thin/motion.csv", motion.substr(0, motion.size() / 2));
  refuses(shell, {"compare", "whole", "thin"},
          "thin/motion.csv: found a file that manifest.json does not list");
  const std::string events = shell.read("thin/events.csv");
  damage(shell, "thin/events.csv", flipped(events, events.size() / 2), {"plot", "thin"},
         "thin/events.csv: found checksum");
  CHECK(shell.run({"plot", "thin"}).code == 0);
  CHECK(shell.read("thin/motion.csv") == motion);
  CHECK(shell.read("thin/curves.csv") == shell.read("whole/curves.csv"));
  check_manifest(shell, "thin", "done");
  CHECK(files_of(manifest_of(shell, "thin")) == files_of(manifest_of(shell, "whole")));
  CHECK(shell.run({"report", "thin"}).err == "");
  damage(shell, "thin/motion.csv", flipped(motion, 100), {"report", "thin"},
         "thin/motion.csv: found checksum");
}

TEST_CASE("cli manifest: orbits, comparisons, sweeps and studies keep runs with one") {
  const Shell shell;
  shell.write("belt.toml", belt(40));
  const std::string vary = "contacts.belt.normal_force=1:1.1:0.1";
  REQUIRE(shell.run({"sweep", "belt.toml", "--vary", vary, "--keep", "--jobs", "1"}).code == 0);
  check_manifest(shell, "belt-sweep/runs/000001", "done");
  REQUIRE(shell.run({"compare", "belt.toml", "--engines", "exact,ida", "--no-plots"}).code == 0);
  check_manifest(shell, "belt-compare/exact", "done");
  check_manifest(shell, "belt-compare/ida", "done");
  const std::string ida = shell.read("belt-compare/ida/events.csv");
  damage(shell, "belt-compare/ida/events.csv", flipped(ida, ida.size() / 2), {"plot", "belt-compare"},
         "belt-compare/ida/events.csv: found checksum");
  REQUIRE(shell.run({"orbit", "belt.toml", "--period", "7", "--no-plots"}).code == 0);
  check_manifest(shell, "belt-orbit", "done");
  CHECK(lists(manifest_of(shell, "belt-orbit"), "orbit.json"));
  CHECK(files_of(manifest_of(shell, "belt-orbit/start")) ==
        std::vector<std::string>{"states.csv", "summary.json", "run.toml"});
  CHECK(shell.run({"report", "belt-orbit"}).err.find("manifest") == std::string::npos);
  const std::string states = shell.read("belt-orbit/start/states.csv");
  damage(shell, "belt-orbit/start/states.csv", flipped(states, states.size() - 5), {"report", "belt-orbit"},
         "belt-orbit/start/states.csv: found checksum");
}

TEST_CASE("cli manifest: pipes and folders in the place of files end with 6") {
  const Shell shell;
  make_run(shell, {"--instants"});
  write_next(shell, "belt-run");
  const std::vector<Command> readers = {{"plot", "belt-run"},        {"report", "belt-run"},
                                        {"paraview", "belt-run"},    {"witness", "belt-run"},
                                        {"report", "belt-run", "b"}, {"compare", "belt-run", "b"},
                                        {"check", "next.toml"}};
  fs::copy(shell / "belt-run", shell / "b");
  const auto replaced = [&](const std::string& name, const char* what) {
    const std::string file = "belt-run/" + name, whole = shell.read(file);
    fs::remove(shell / file);
    REQUIRE(line(shell, std::string(what) + " " + file) == 0);
    for (const Command& command : readers) {
      const bool cases = command.front() == "report" && command.size() == 3;
      const bool stays = cases && name != "summary.json" && name != "manifest.json";
      if (!stays)
        refuses(shell, command, file + (std::string(what) == "mkfifo" ? ": is a pipe" : ": is a directory"));
    }
    fs::remove(shell / file);
    shell.write(file, whole);
  };
  for (const char* what : {"mkfifo", "mkdir"}) {
    replaced("manifest.json", what);
    replaced("contacts.csv", what);
  }
  fs::remove(shell / "belt-run/manifest.json");
  for (const char* what : {"mkfifo", "mkdir"})
    for (const char* name : {"contacts.csv", "states.csv", "run.toml", "summary.json"}) replaced(name, what);
}

TEST_CASE("cli manifest: report -o and --trace replace no file but their own") {
  const Shell shell;
  make_run(shell, {"--trace", "rounds.jsonl"});
  const std::string scene = shell.read("belt.toml");
  const Command report = {"report", "belt-run", "-o", "belt.toml"},
                trace = {"run", "belt.toml", "-o", "again", "--trace", "belt.toml"},
                cases = {"report", "belt-run", "b", "-o", "cases.html"};
  refuses(shell, report, "belt.toml: file exists and is not a page of Signorini, so it is not replaced");
  refuses(shell, trace, "belt.toml: file exists and is not a trace, so it is not replaced");
  CHECK(shell.read("belt.toml") == scene);
  CHECK_FALSE(exists(shell, "again"));
  fs::copy(shell / "belt-run", shell / "b", fs::copy_options::recursive);
  shell.write("cases.csv", "mine\n");
  refuses(shell, cases, "cases.csv: file exists and is not a table of load cases");
  CHECK_FALSE(exists(shell, "cases.html"));
  fs::remove(shell / "cases.csv");
  for (int times = 0; times < 2; ++times) {
    CHECK(shell.run(cases).code == 0);
    CHECK(shell.run({"report", "belt-run", "-o", "page.html"}).code == 0);
    CHECK(shell.run({"report", "belt-run"}).code == 0);
    CHECK(shell.run({"run", "belt.toml", "-o", "again", "--force", "--no-plots", "--trace", "rounds.jsonl"})
              .code == 0);
  }
  shell.write("belt-run/report.html", "<p>mine</p>\n");
  refuses(shell, {"report", "belt-run"}, "belt-run/report.html: file exists and is not a page");
}

TEST_SUITE_END();
