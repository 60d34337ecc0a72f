// key_reference.hpp: the key table as text: for a terminal, and as docs/scene.md.
//
// Keys, types, units, defaults and meanings come from scene/keys.hpp; the words around them stand in
// key_introduction.cpp and key_examples.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace signorini::cli {

/// One line a key: path, type, unit, default, meaning. Only lines that have all of the words, whatever the case.
/// Errors: UsageError where no line has.
[[nodiscard]] std::string key_list(const std::vector<std::string>& words = {});

/// docs/scene.md, whole.
[[nodiscard]] std::string scene_reference();

/// What the reference says about one table besides its keys.
struct TableText {
  std::string_view table;    ///< its path in the key table
  std::string_view heading;  ///< Markdown, with the #s
  std::string_view text;     ///< below the heading
};

/// In the order of the reference.
[[nodiscard]] std::span<const TableText> table_texts();
/// What comes before the first table.
[[nodiscard]] std::string_view reference_introduction();

}  // namespace signorini::cli
