// overrides.hpp: `--set path=value`, applied to the parsed file before it is read.
//
//   run.rtol=1e-10   contacts.first.friction=0.5   contacts.*.friction.static=0.4   loads.1.amplitude=3
//
// Tables of an array are chosen by name, by number from 1, or all by *. A stop is two contacts, so contacts.*.KEY is
// stops.*.KEY, too, where a stop can have KEY. Values are TOML; an unquoted word is a string. What is wrong with a path is a UsageError here; what is wrong with the value is found by
// the reader, which sees that the value stands in no file.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

void apply_overrides(toml::table& root, const std::vector<Override>& overrides);

/// The keys that the path means in these tables, with numbers for names and one name for two ways to say the same:
/// "contacts.1.friction.static", "contacts.2.friction.static". What is not there yet stands as it was written.
[[nodiscard]] std::vector<std::string> places_of(const toml::table& root, const std::string& path);
/// The same in a scene file. Errors: as of read_scene, of what TOML says already.
[[nodiscard]] std::vector<std::string> places_in(const std::string& scene, const std::string& path);

/// What the path stands for: contacts.*.KEY for itself and stops.NAME.KEY of all that can have it.
[[nodiscard]] std::vector<std::string> paths_meant(const toml::table& root, const std::string& path);
/// How many tables a path with * chooses: "3 of [[contacts]], 6 of [[stops]]"; empty for a path
/// without *.
[[nodiscard]] std::string tables_met(const toml::table& root, const std::string& path);
/// The same in a scene file that was changed before. Errors: as of read_scene, of what TOML says already.
[[nodiscard]] std::string tables_met_in(const std::string& scene, const std::vector<Override>& before,
                                        const std::string& path);
/// Whether what stands at a stands inside of what stands at b, or is it.
[[nodiscard]] bool lies_in(const std::string& a, const std::string& b);

/// "--set run.rtol=1e-10", or as it was told.
[[nodiscard]] std::string text_of(const Override& change);

}  // namespace signorini
