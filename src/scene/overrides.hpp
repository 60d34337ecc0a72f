// overrides.hpp: `--set path=value`, applied to the parsed file before it is read.
//
//   run.rtol=1e-10   contacts.first.friction=0.5   contacts.*.friction.static=0.4   loads.1.amplitude=3
//
// Tables of an array are chosen by name, by number from 1, or all by *. Values are TOML; an unquoted word
// is a string. What is wrong with a path is a UsageError here; what is wrong with the value is found by
// the reader, which sees that the value stands in no file.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

void apply_overrides(toml::table& root, const std::vector<Override>& overrides);

/// "--set run.rtol=1e-10"
[[nodiscard]] std::string text_of(const Override& change);

}  // namespace signorini
