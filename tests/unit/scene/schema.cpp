// The schema against every scene there is, by a validator of its own: the parts of draft 7 that the schema
// uses, and no others. (scripts/deep.sh schema does the same with Debian's jsonschema.)
#include "scene/schema.hpp"

#include <doctest/doctest.h>
#include <toml++/toml.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "base/json.hpp"
#include "scene/keys.hpp"
#include "scene/toml_node.hpp"

using namespace signorini;

namespace {

/// Says where and why a value is no instance of a schema; empty where it is.
class Validator {
 public:
  explicit Validator(const base::Json& root) : root_(root) {}

  [[nodiscard]] std::string why_not(const base::Json& value, const base::Json& schema,
                                    const std::string& path) const {
    static const std::set<std::string> words = {"$ref",        "$schema", "title",
                                                "description", "default", "definitions"};
    for (const auto& [word, rule] : schema.items()) {
      if (word == "$ref") return why_not(value, definition(rule.get<std::string>()), path);
      if (words.contains(word)) continue;
      if (const std::string why = breaks(word, rule, value, schema, path); !why.empty()) return why;
    }
    return {};
  }

 private:
  const base::Json& root_;

  [[nodiscard]] const base::Json& definition(const std::string& address) const {
    const std::string start = "#/definitions/";
    REQUIRE(address.starts_with(start));
    REQUIRE(root_["definitions"].contains(address.substr(start.size())));
    return root_["definitions"][address.substr(start.size())];
  }

  [[nodiscard]] static bool is(const base::Json& value, const std::string& type) {
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "array") return value.is_array();
    if (type == "object") return value.is_object();
    throw std::runtime_error("unknown type " + type);
  }

  [[nodiscard]] std::string members(const base::Json& value, const base::Json& schema,
                                    const std::string& path) const {
    for (const auto& [name, member] : value.items()) {
      const std::string below = path + "." + name;
      const base::Json& others = schema["additionalProperties"];
      const bool known = schema.contains("properties") && schema["properties"].contains(name);
      if (!known && others == false) return below + ": unknown";
      if (const std::string why = why_not(member, known ? schema["properties"][name] : others, below);
          !why.empty())
        return why;
    }
    return {};
  }

  [[nodiscard]] std::string any_or_all(const std::string& word, const base::Json& rule,
                                       const base::Json& value, const std::string& path) const {
    std::string last;
    for (const base::Json& each : rule) {
      last = why_not(value, each, path);
      if (last.empty() == (word == "anyOf")) return last;
    }
    return last;
  }

  [[nodiscard]] std::string breaks(const std::string& word, const base::Json& rule, const base::Json& value,
                                   const base::Json& schema, const std::string& path) const {
    const auto unless = [&](bool kept) {
      return kept ? std::string() : path + ": " + word + " " + rule.dump();
    };
    const auto size = [&] { return static_cast<int>(value.size()); };
    if (word == "type") return unless(is(value, rule));
    if (word == "const") return unless(value == rule);
    if (word == "enum") return unless(std::find(rule.begin(), rule.end(), value) != rule.end());
    if (word == "minimum") return unless(value.get<double>() >= rule.get<double>());
    if (word == "maximum") return unless(value.get<double>() <= rule.get<double>());
    if (word == "exclusiveMinimum") return unless(value.get<double>() > rule.get<double>());
    if (word == "exclusiveMaximum") return unless(value.get<double>() < rule.get<double>());
    if (word == "minItems") return unless(size() >= rule.get<int>());
    if (word == "maxItems") return unless(size() <= rule.get<int>());
    if (word == "anyOf" || word == "allOf") return any_or_all(word, rule, value, path);
    if (word == "additionalProperties") return members(value, schema, path);
    if (word == "properties") return {};  // beside additionalProperties, always
    if (word == "required") {
      for (const base::Json& name : rule)
        if (!value.contains(name.get<std::string>())) return path + ": misses " + name.get<std::string>();
      return {};
    }
    if (word == "items") {
      for (const base::Json& item : value)
        if (const std::string why = why_not(item, rule, path + "[]"); !why.empty()) return why;
      return {};
    }
    throw std::runtime_error("unknown word " + word);
  }
};

std::string against_schema(const toml::table& scene) {
  static const base::Json schema = base::parse_json(scene::scene_schema());
  return Validator(schema).why_not(scene::json_of(scene), schema, "scene");
}

std::string text_against_schema(std::string_view text) { return against_schema(toml::parse(text)); }

constexpr std::string_view small_scene = R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = 1.0
[nodes]
A = [0.0, 0.0]
)";

}  // namespace

TEST_SUITE("unit/scene/schema") {
  TEST_CASE("schema: every scene of models and of the reference cases is an instance") {
    int scenes = 0;
    for (const std::string folder :
         {SIGNORINI_MODELS, SIGNORINI_TEST_DATA "/cases", SIGNORINI_MODELS "/../src/cli/scenes"})
      for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".toml") continue;
        CAPTURE(entry.path().string());
        CHECK(against_schema(toml::parse_file(entry.path().string())) == "");
        ++scenes;
      }
    CHECK(scenes >= 30);
  }

  TEST_CASE("schema: what the reader takes in several forms") {
    const std::string scene(small_scene);
    CHECK(text_against_schema(scene) == "");
    for (const std::string more :
         {"[base_motion]\ndirection = [1.0, 0.0]\nacceleration = 1\n",
          "[[base_motion]]\ndirection = { d0 = 1 }\nacceleration = { type = \"step\" }\n",
          "[matrices]\nmass = \"M.mtx\"\nstiffness = [[1, 0], [0, 1]]\n",
          "[[members]]\nnodes = [\"A\", \"B\"]\nsection = \"s\"\nelements = [1, 2]\n",
          "[[contacts]]\nlaw = \"rigid\"\nagainst = [\"A\", \"B\"]\nfriction = { static = 0.4, kinetic = 0.3 "
          "}\n",
          "[[contacts]]\nlaw = \"rigid\"\nfriction = { slow = 0.04, fast = 0.1, velocity = 0.02 }\n",
          "[[contacts]]\nlaw = \"rigid\"\nfriction = { light = 0.12, heavy = 0.05, force = 600 }\n",
          "[[stops]]\ndirection = [1, 0]\nlaw = \"rigid\"\nfriction = { static = 0.4 }\ngaps = [1, 2]\n"}) {
      CAPTURE(more);
      CHECK(text_against_schema(scene + more) == "");
    }
    for (const std::string initial : {"\"static\"", "{ A = { ux = 0.1 } }", "{ u = [0.0], v = \"v.mtx\" }",
                                      "{ run = \"DIR\", t = 1.0 }", "{ u = { ux = 0.1 } }"}) {
      std::string with = scene;
      with.insert(with.find("[nodes]"), "initial = " + initial + "\n");
      CAPTURE(initial);
      CHECK(text_against_schema(with) == "");
    }
  }

  TEST_CASE("schema: what the reader refuses by kind and range is no instance, and the place is named") {
    const std::string scene(small_scene);
    const std::string contact = "[[contacts]]\nnode = \"A\"\nlaw = ";
    struct Wrong {
      std::string more, place;
    };
    for (const auto& [more, place] :
         {Wrong{"[damping]\nalhpa = 1.0\n", "scene.damping.alhpa"},
          Wrong{"[damping]\nalpha = -1.0\n", "scene.damping.alpha"},
          Wrong{"[damping]\nalpha = \"1\"\n", "scene.damping.alpha"},
          Wrong{contact + "\"springy\"\n", "scene.contacts[].law"},
          Wrong{contact + "\"rigid\"\nrestitution = 1.5\n", "scene.contacts[].restitution"},
          Wrong{contact + "\"rigid\"\nnormal_stiffness = 0\n", "scene.contacts[].normal_stiffness"},
          Wrong{contact + "\"rigid\"\nfriction = { kinetic = 0.1 }\n", "scene.contacts[].friction"},
          Wrong{contact + "\"rigid\"\nfriction = { slow = 0.1, fast = 0.2 }\n", "scene.contacts[].friction"},
          Wrong{contact + "\"rigid\"\nfriction = { light = 0.1, heavy = 0.05 }\n",
                "scene.contacts[].friction"},
          Wrong{contact + "\"rigid\"\nfriction = { statik = 0.1 }\n", "scene.contacts[].friction"},
          Wrong{"[[contacts]]\nnode = \"A\"\n", "scene.contacts[]: misses law"},
          Wrong{"[[stops]]\nlaw = \"rigid\"\n", "scene.stops[]: misses direction"},
          Wrong{"[[stops]]\nlaw = \"rigid\"\ndirection = [1, 0]\nnormal = [1, 0]\n", "scene.stops[].normal"},
          Wrong{"[[lines]]\nname = \"P\"\nfrom = [0, 0]\nto = [1, 0, 0]\npieces = 2\n", "scene.lines[].to"},
          Wrong{"[[lines]]\nname = \"P\"\nfrom = [0, 0]\nto = [1, 0]\npieces = 0\n", "scene.lines[].pieces"},
          Wrong{"[[loads]]\nhistory = { type = \"sine\" }\n", "scene.loads[].history.type"},
          Wrong{"contacts = 3\n", "scene.nodes.contacts"}}) {
      CAPTURE(more);
      const std::string why = text_against_schema(scene + more);
      CAPTURE(why);
      CHECK(why.starts_with(place));
    }
    for (const std::string run : {"rtol = 1.0", "rtol = 1e-15", "max_order = 6", "engine = \"idea\"",
                                  "certify = 1", "initial = \"dynamic\"", "initial = { A = { uz = 0.1 } }"}) {
      std::string with = scene;
      with.insert(with.find("[nodes]"), run + "\n");
      CAPTURE(run);
      CHECK(text_against_schema(with).starts_with("scene.run." + run.substr(0, run.find(' '))));
    }
  }

  TEST_CASE("schema: every key is described, with its unit and its default") {
    const base::Json schema = base::parse_json(scene::scene_schema());
    const base::Json& contact = schema["definitions"]["contacts"]["properties"];
    CHECK(contact["gap"]["description"] == "Gap of the undeformed state. Unit: length.");
    CHECK(contact["gap"]["default"] == 0.0);
    CHECK_FALSE(contact["law"].contains("default"));
    CHECK(schema["definitions"]["run"]["properties"]["step"]["default"] == "fixed");
    CHECK(schema["definitions"]["loads"]["properties"]["history"]["default"] ==
          base::Json{{"type", "constant"}});
    for (const auto& [name, table] : schema["definitions"].items())
      for (const auto& [key, rules] : table["properties"].items()) {
        CAPTURE(name);
        CAPTURE(key);
        CHECK((rules.contains("description") || rules.contains("anyOf")));
      }
  }
}
