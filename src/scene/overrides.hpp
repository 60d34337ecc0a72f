// overrides.hpp: `--set path=value`, applied to the parsed file before it is read.
//
//   run.rtol=1e-10   contacts.first.friction=0.5   contacts.*.friction.static=0.4   loads.1.amplitude=3
//
// Tables of an array are selected by name, by number from 1, or all by *. A stop is two contacts, so contacts.*.KEY
// also applies to stops.*.KEY if a stop can have KEY. Values are TOML; an unquoted word is a string. An invalid path is
// a UsageError here. The reader finds invalid values; its message then names the override in place of a file.
#pragma once

#include <toml++/toml.h>
#include <limits>
#include <string>
#include <vector>

#include "scene/keys.hpp"
#include "signorini/scene.hpp"

namespace signorini::scene {

/// Changes the parsed file. Errors: UsageError.
void apply_overrides(toml::table& root, const std::vector<Override>& overrides);

/// Keys that the path refers to in these tables, normalised: numbers instead of names, and one spelling for equivalent
/// keys: "contacts.1.friction.static", "contacts.2.friction.static". Keys that do not exist yet stay as written.
[[nodiscard]] std::vector<std::string> places_of(const toml::table& root, const std::string& path);
/// places_of() for the scene file with the name `scene`. Errors: those of read_scene for invalid TOML.
[[nodiscard]] std::vector<std::string> places_in(const std::string& scene, const std::string& path);

/// The path itself; for contacts.*.KEY also stops.NAME.KEY for each stop that can have the key.
[[nodiscard]] std::vector<std::string> matching_paths(const toml::table& root, const std::string& path);
/// Number of tables that a path with * selects: "3 of [[contacts]], 6 of [[stops]]"; empty for a path
/// without *.
[[nodiscard]] std::string count_matching_tables(const toml::table& root, const std::string& path);
/// count_matching_tables() for the scene file with the name `scene`, after the overrides `before`. Errors: those of read_scene for
/// invalid TOML.
[[nodiscard]] std::string count_matching_tables_in(const std::string& scene,
                                                   const std::vector<Override>& before,
                                                   const std::string& path);
/// True if path a equals path b or continues path b: "run.atol.force" is within "run.atol".
[[nodiscard]] bool is_within_path(const std::string& a, const std::string& b);

/// "--set run.rtol=1e-10", or the override as the user typed it.
[[nodiscard]] std::string override_text(const Override& change);

// The key of a scene that a path refers to, and its allowed values.
//
//   key_of("contacts.left.normal_stiffness") == find_key("contacts[]", "normal_stiffness")
//   range_of(*key_of("rigid.block.inertia")) == [0, infinity)

/// The key that a path refers to; null if the path refers to no key of a scene.
[[nodiscard]] const Key* key_of(const std::string& path);

/// Allowed numbers, from min to max, in the key's unit. excludes_min: min itself is not allowed.
struct KeyRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool excludes_min = false;
  [[nodiscard]] bool contains(double value) const {
    return (excludes_min ? value > min : value >= min) && value <= max;
  }
};

/// Range by the key's type alone; restrictions by other keys are not included.
[[nodiscard]] KeyRange range_of(const Key& key);

}  // namespace signorini::scene
