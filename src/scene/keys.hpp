// keys.hpp: the one table of all keys of a scene file.
//
// The reader takes types and defaults from it; `signorini keys` and the scene reference print it.
// A table is identified by its path: "" (top level), "run", "sections.*" (any name), "contacts[]" (each of
// [[contacts]]), "history" (any place that accepts a history). The key "*" stands for a user-chosen name.
//
//   const Key* key = find_key("contacts[]", "gap");   // key->unit == "length"
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace signorini::scene {

/// Type of a value. Numbers are finite; integers count as numbers.
enum class KeyType {
  number,
  positive,
  non_negative,
  fraction,
  relative_tolerance,
  count,
  integer,
  text,
  name,
  choice,
  vector,
  numbers,
  numbers_or_file,
  texts,
  table,
  tables,
  tolerance_order,
  automatic_flag,
  flag,
  elements,
  initial,
  friction,
  against,
  place,
  direction,
  one_or_many,
  history,
  number_or_history,
  term,
  matrix
};

struct Key {
  std::string_view table, name;
  KeyType type;
  std::string_view unit;           ///< in units of force, mass, length, time; "" for none
  std::string_view default_value;  ///< TOML text of the default; "required"; "" for none
  std::string_view choices;        ///< allowed words, separated by blanks; choices_of()
  std::string_view meaning;        ///< one sentence
};

[[nodiscard]] std::span<const Key> all_keys();

/// The row of the key, or of "*" in the same table; null: there is none. A stop has the keys of a contact in
/// addition to its own.
[[nodiscard]] const Key* find_key(std::string_view table, std::string_view name);

/// Names of the keys of a table, in the order of the table.
[[nodiscard]] std::vector<std::string> key_names(std::string_view table);

/// "a number > 0", "one of \"ida\", \"newmark\"".
[[nodiscard]] std::string describe_type(const Key& key);

/// The allowed words of a choice.
[[nodiscard]] std::vector<std::string> choices_of(const Key& key);

}  // namespace signorini::scene
