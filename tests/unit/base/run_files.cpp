// The manifest of a directory of files: what is noticed, and what is not its concern.
#include "base/run_files.hpp"

#include <doctest/doctest.h>

#include <fstream>

#include "own_folder.hpp"
#include "signorini/error.hpp"

using namespace signorini;
namespace fs = std::filesystem;

TEST_SUITE_BEGIN("unit/base/run_files");

namespace {

struct Directory {
  tests::OwnFolder own;
  fs::path path = own.path();

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
  }
  void seal() const { write(base::manifest_file, base::manifest_of(path, "done").text()); }
  /// The message without the directory's name.
  [[nodiscard]] std::string refusal() const {
    try {
      base::check_run_files(path);
      return "";
    } catch (const FileError& error) {
      return std::string(error.what()).substr(path.string().size() + 1);
    }
  }
  [[nodiscard]] bool refuses(const std::string& begin) const { return refusal().starts_with(begin); }
};

}  // namespace

TEST_CASE("run files: every byte of a listed file counts, and its length") {
  const Directory run;
  const std::string text = "t,contact\n0.5,foot\n";
  run.write("events.csv", text);
  run.write("summary.json", "");
  run.seal();
  CHECK(run.refusal().empty());
  for (std::size_t i = 0; i < text.size(); ++i)
    for (const int bit : {1, 128}) {
      std::string flipped = text;
      flipped[i] = static_cast<char>(flipped[i] ^ bit);
      run.write("events.csv", flipped);
      CHECK(run.refuses("events.csv: found checksum "));
    }
  for (std::size_t size = 0; size < text.size(); ++size) {
    run.write("events.csv", text.substr(0, size));
    CHECK(
        run.refuses("events.csv: found " + std::to_string(size) + " bytes, expected 19 as in manifest.json"));
  }
  run.write("events.csv", text + "\n");
  CHECK(run.refuses("events.csv: found 20 bytes, expected 19 as in manifest.json"));
  run.write("events.csv", text);
  CHECK(run.refusal().empty());
  CHECK_NOTHROW(base::check_run_files(run.path, {"history.csv", "summary.json"}));
}

TEST_CASE("run files: a manifest lists results only, in their order, and can take and drop them") {
  const Directory run;
  for (const char* name : {"run.toml", "summary.json", "events.csv", "report.html", "mine.csv"})
    run.write(name, name);
  base::Manifest manifest = base::manifest_of(run.path, "stopped");
  REQUIRE(manifest.files.size() == 3);
  CHECK(manifest.files[0].file == "events.csv");
  CHECK(manifest.files[2].file == "run.toml");
  run.write("motion.csv", "t\n");
  manifest.add(run.path, "motion.csv");
  REQUIRE(manifest.files.size() == 4);
  CHECK(manifest.files[1].file == "motion.csv");
  CHECK(manifest.files[1].size == 2);
  run.write(base::manifest_file, manifest.text());
  const std::optional<base::Manifest> again = base::read_manifest(run.path);
  REQUIRE(again);
  CHECK(again->outcome == "stopped");
  CHECK(again->text() == manifest.text());
  CHECK(run.refusal().empty());
  manifest.remove("motion.csv");
  run.write(base::manifest_file, manifest.text());
  CHECK(run.refuses("motion.csv: found a file that manifest.json does not list"));
  fs::remove(run.path / "motion.csv");
  CHECK(run.refusal().empty());
  fs::remove(run.path / "run.toml");
  CHECK(run.refuses("run.toml: not found, expected 8 bytes as in manifest.json"));
  base::remove_manifest(run.path);
  base::remove_manifest(run.path);
  CHECK(run.refusal().empty());
  CHECK(base::unchecked_reason(run.path).starts_with(run.path.string() +
                                                     " has no manifest.json: the run may not have finished"));
}

TEST_CASE("run files: what is no manifest is refused") {
  const Directory run;
  run.write("events.csv", "t\n");
  for (const char* text :
       {"", "[]", "{}", "{\"signorini\": 1, \"outcome\": \"done\", \"files\": []}",
        R"({"signorini": "1", "outcome": "done", "files": [{"file": "events.csv", "size": 2}]})",
        R"({"signorini": "1", "outcome": "done", "files": [{"file": "../a", "size": 2, "checksum": ""}]})",
        R"({"signorini": "1", "outcome": "done", "files": [)"}) {
    CAPTURE(text);
    run.write(base::manifest_file, text);
    CHECK(run.refuses("manifest.json: is not a manifest of a run: "));
    CHECK(base::unchecked_reason(run.path).empty());
  }
}

TEST_SUITE_END();
