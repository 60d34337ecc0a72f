// toml_node.hpp: kind and place of a TOML node, for messages.
//
//   refuse(place_of(node), "run.rtol", "found " + describe(node) + ", expected a number");
#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "signorini/error.hpp"

namespace signorini::scene {

/// First character of the source path of values from an Override; the text of the override follows. No file
/// name begins with it.
inline constexpr char override_mark = '\x1a';

[[nodiscard]] SourcePlace place_of(const toml::source_region& region);
[[nodiscard]] SourcePlace place_of(const toml::node& node);

/// True for control characters of ASCII.
[[nodiscard]] inline bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// Text for messages: "the number -0.3", "the number 4.0" for a float, "the string \"abc\"", "an array of 3 values".
[[nodiscard]] std::string describe(const toml::node& node);

/// Throws a SceneError, or a UsageError if the place is an Override.
[[noreturn]] void refuse(const SourcePlace& place, const std::string& key, const std::string& message);

/// A key of a TOML table with its value.
struct Entry {
  std::string name;
  const toml::node* node = nullptr;
  const toml::key* key = nullptr;
  [[nodiscard]] SourcePlace place() const { return place_of(key->source()); }
};

/// The entries in the order of the file (toml++ sorts by name), then those of overrides.
[[nodiscard]] std::vector<Entry> entries_of(const toml::table& table);

/// The text of a scene file, for parse_scene(). Errors: FileError; SceneError if it is larger than 64 MB.
[[nodiscard]] std::string scene_text(const std::string& path);

/// A TOML value as a JSON value of the same shape. Dates and times, which no scene has, become empty objects.
[[nodiscard]] base::Json json_of(const toml::node& node);

}  // namespace signorini::scene
