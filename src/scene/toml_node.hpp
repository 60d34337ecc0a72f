// toml_node.hpp: what a TOML node is and where it stands, for messages.
//
//   refuse(place_of(node), "run.rtol", "found " + describe(node) + ", expected a number");
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "signorini/error.hpp"

namespace signorini {

/// Values that come from an Override carry this, which begins no name of a file, and its text as the name of their file.
inline constexpr char override_mark = '\x1a';

[[nodiscard]] SourcePlace place_of(const toml::source_region& region);
[[nodiscard]] SourcePlace place_of(const toml::node& node);

/// The control characters of ASCII.
[[nodiscard]] inline bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// "the number -0.3", "the number 4.0" of a float, "the string \"abc\"", "an array of 3 values".
[[nodiscard]] std::string describe(const toml::node& node);

/// A SceneError, or a UsageError where the place is an Override.
[[noreturn]] void refuse(const SourcePlace& place, const std::string& key, const std::string& message);

/// An entry of a table.
struct Entry {
  std::string name;
  const toml::node* node = nullptr;
  const toml::key* key = nullptr;
  [[nodiscard]] SourcePlace place() const { return place_of(key->source()); }
};

/// The entries in the order of the file (toml++ sorts by name); those of overrides follow.
[[nodiscard]] std::vector<Entry> entries_of(const toml::table& table);

}  // namespace signorini
