#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "program.hpp"
#include "scene/keys.hpp"

using signorini::cli_test::Ending;
using signorini::cli_test::Shell;

TEST_SUITE_BEGIN("cli/keys");

TEST_CASE("cli keys: every key is listed with its meaning") {
  const Shell shell;
  const Ending ending = shell.run({"keys"});
  CHECK(ending.code == 0);
  CHECK(ending.err.empty());
  for (const signorini::scene::Key& key : signorini::scene::all_keys()) {
    const std::string path =
        key.table.empty() ? std::string(key.name) : std::string(key.table) + "." + std::string(key.name);
    CAPTURE(path);
    CHECK(ending.out.find("\n  " + path + " ") != std::string::npos);
    CHECK(ending.out.find(key.meaning) != std::string::npos);
  }
}

// When this fails: signorini keys --markdown > docs/scene.md
TEST_CASE("cli keys: docs/scene.md is what --markdown prints") {
  const Shell shell;
  const Ending ending = shell.run({"keys", "--markdown"});
  CHECK(ending.code == 0);
  std::ifstream file(SIGNORINI_MODELS "/../docs/scene.md", std::ios::binary);
  const std::string written{std::istreambuf_iterator<char>(file), {}};
  const bool stale = written != ending.out;
  CHECK_FALSE(stale);
}

TEST_SUITE_END();
