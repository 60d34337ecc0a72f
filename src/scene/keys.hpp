// keys.hpp: table of all keys of a scene file.
//
// The reader takes types and defaults from this table; `signorini keys` and the scene reference print the table.
// A table is identified by its path: "" (top level), "run", "sections.*" (any name), "contacts[]" (each of
// [[contacts]]), "history" (any place that accepts a history). The key "*" means a name chosen by the user.
//
//   const Key* key = find_key("contacts[]", "gap");   // key->unit == "length"
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace signorini::scene {

/// Type of a value. Numbers must be finite; an integer is accepted where a number is expected.
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
  std::string_view unit;           ///< product of force, mass, length, time; "" if dimensionless
  std::string_view default_value;  ///< TOML text of the default; "required"; "" without default
  std::string_view choices;        ///< allowed words, separated by blanks; choices_of() splits them
  std::string_view meaning;        ///< description of the key, in sentences
};

[[nodiscard]] std::span<const Key> all_keys();

/// Row of the key `name`, or of "*" in the same table; null if the table has neither. Stops, pendulums and seams
/// share keys with contacts; those rows are in the table "contacts[]".
[[nodiscard]] const Key* find_key(std::string_view table, std::string_view name);

/// Names of the keys of a table, in the order of the table.
[[nodiscard]] std::vector<std::string> key_names(std::string_view table);

/// Text for messages about a wrong value: "a number > 0", "one of \"ida\", \"newmark\"".
[[nodiscard]] std::string describe_type(const Key& key);

/// The allowed words of a choice.
[[nodiscard]] std::vector<std::string> choices_of(const Key& key);

}  // namespace signorini::scene
