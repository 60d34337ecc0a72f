#include "scene/keys.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "signorini/output.hpp"
#include "signorini/scene.hpp"

using namespace signorini;

namespace {

std::string reference() {
  std::ifstream file(SIGNORINI_MODELS "/../docs/scene.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_SUITE("unit/scene/keys") {
  TEST_CASE("keys: no key stands twice in its table, every one has a type and a meaning") {
    std::set<std::pair<std::string, std::string>> seen;
    for (const scene::Key& key : scene::all_keys()) {
      CAPTURE(key.table);
      CAPTURE(key.name);
      CHECK(seen.emplace(key.table, key.name).second);
      CHECK(key.meaning.ends_with("."));
      CHECK_FALSE(scene::describe_type(key).empty());
      CHECK(scene::find_key(key.table, key.name) == &key);
      CHECK((key.type == scene::KeyType::choice) == !key.choices.empty());
    }
  }

  TEST_CASE("keys: every constant of friction has one, with its unit") {
    for (const FrictionConstant& constant : friction_constants) {
      CAPTURE(constant.key);
      const scene::Key* key = scene::find_key("contacts[].friction", constant.key);
      REQUIRE(key);
      CHECK(key->unit == unit_text(constant.unit, {"force", "mass", "length", "time"}));
    }
  }

  TEST_CASE("keys: the whole scenes in docs/scene.md can be read") {
    const std::string text = reference();
    REQUIRE_FALSE(text.empty());
    const std::string begin = "```toml\nschema = 1";
    int scenes = 0;
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
      const std::size_t from = at + 8, to = text.find("```", from);
      REQUIRE(to != std::string::npos);
      const std::string scene = text.substr(from, to - from);
      CAPTURE(scene);
      CHECK_NOTHROW((void)parse_scene(scene, "docs/scene.md"));
      ++scenes;
    }
    CHECK(scenes >= 2);
  }
}
