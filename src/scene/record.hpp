// record.hpp: the scene as the reader understood it, in TOML: values from the file and filled-in defaults.
//
// Reading a recorded scene again gives the same scene: numbers are written as in the file (a direction before
// normalisation), in the shortest digits that read back exactly.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace signorini {

/// TOML text of a value. Numbers always read back as floating-point numbers.
[[nodiscard]] std::string toml_number(double value);
[[nodiscard]] std::string toml_string(std::string_view text);
[[nodiscard]] std::string toml_key(std::string_view key);
[[nodiscard]] std::string toml_array(const std::vector<std::string>& items);
[[nodiscard]] std::string toml_numbers(std::span<const double> values);
[[nodiscard]] std::string toml_strings(const std::vector<std::string>& texts);

/// Keys and TOML values in the order of reading.
class Record {
 public:
  void set(std::string_view key, std::string value) { items_.emplace_back(key, std::move(value)); }
  /// A copy with these keys first, in this order.
  [[nodiscard]] Record arranged(const std::vector<std::string>& order) const;
  [[nodiscard]] std::string inline_table() const;  ///< { a = 1.0, b = 2.0 }
  [[nodiscard]] std::string lines() const;         ///< a = 1.0 \n b = 2.0 \n

 private:
  std::vector<std::pair<std::string, std::string>> items_;
};

/// The sections of a scene file; sections of one top-level table stay together.
class RecordedScene {
 public:
  Record top;  ///< schema, title, units, gravity

  /// `table` is the top-level key, `header` the whole line: "[sections.pipe]".
  void add(std::string_view table, std::string header, const Record& record);
  /// Tables in `order` (top-level keys as in the file), then all others.
  [[nodiscard]] std::string text(const std::vector<std::string>& order) const;

 private:
  struct Section {
    std::string table, text;
  };
  std::vector<Section> sections_;
};

}  // namespace signorini
