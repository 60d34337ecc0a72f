// Scenes that must be read, and scenes with one mistake each: a comment under the wrong line holds a part of the
// message. For mistakes in a matrix file or a table of time and value the comment stands in that file.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "signorini/model.hpp"
#include "unit/scene/equal.hpp"

using namespace signorini;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> scenes_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string content(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

struct Expectation {
  int line = 0;  ///< above the comment
  std::string message;
};

Expectation expectation(const fs::path& file) {
  std::istringstream in(content(file));
  Expectation result;
  for (std::string line; std::getline(in, line); ++result.line) {
    const std::size_t mark = line.find("   ^ ");
    if (mark != 1) continue;
    result.message = line.substr(mark + 5);
    return result;
  }
  return {};
}

/// Read, write, read: nothing changes, wherever the second reading happens.
void check_round_trip(const Scene& scene) {
  const Scene again = parse_scene(scene.resolved, "/nowhere/run.toml");
  CHECK(testing::dump(again) == testing::dump(scene));
  CHECK(again.resolved == scene.resolved);
}

}  // namespace

TEST_SUITE_BEGIN("unit/scene/corpus");

TEST_CASE("good scenes are read, and run.toml is the same scene") {
  for (const char* folder : {SIGNORINI_TEST_DATA "/scenes/good", SIGNORINI_MODELS}) {
    for (const fs::path& file : scenes_in(folder)) {
      INFO(file.string());
      Scene scene;
      REQUIRE_NOTHROW(scene = read_scene(file.string()));
      check_round_trip(scene);
    }
  }
}

TEST_CASE("reference cases are read") {
  for (const fs::path& file : scenes_in(SIGNORINI_TEST_DATA "/cases")) {
    INFO(file.string());
    check_round_trip(read_scene(file.string()));
  }
}

TEST_CASE("bad scenes are refused at the right line with the right message") {
  for (const fs::path& file : scenes_in(SIGNORINI_TEST_DATA "/scenes/bad")) {
    INFO(file.string());
    fs::path marked = file;
    if (expectation(file).line == 0) marked.replace_extension(".mtx");
    for (const char* other : {".csv", ".at2"})
      if (!fs::exists(marked)) marked.replace_extension(other);
    const Expectation expected = expectation(marked);
    REQUIRE(expected.line > 0);
    std::string message = "no error";
    try {
      (void)build_model(read_scene(file.string()));
    } catch (const SceneError& error) {
      message = error.what();
    }
    const std::string place = fmt::format("{}:{}:", marked.string(), expected.line);
    CHECK_MESSAGE(message.starts_with(place), "message: ", message, "\nexpected at: ", place);
    CHECK_MESSAGE(message.find(expected.message) != std::string::npos, "message: ", message,
                  "\nexpected: ", expected.message);
  }
}

TEST_SUITE_END();
