// resolved_scene.hpp: the scene as the reader understood it, in TOML: values from the file and filled-in defaults.
//
// Reading a recorded scene again gives the same scene: numbers are written as in the file (a direction before
// normalisation), in the shortest digits that read back exactly.
#pragma once

#include <toml++/toml.h>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini::scene {

/// TOML text of a value. Numbers always read back as floating-point numbers.
[[nodiscard]] std::string toml_number(double value);
[[nodiscard]] std::string toml_string(std::string_view text);
[[nodiscard]] std::string toml_key(std::string_view key);
[[nodiscard]] std::string toml_array(const std::vector<std::string>& items);
[[nodiscard]] std::string toml_numbers(std::span<const double> values);
[[nodiscard]] std::string toml_strings(const std::vector<std::string>& texts);

/// Keys and TOML values in the order of reading.
class ResolvedTable {
 public:
  void set(std::string_view key, std::string value) { items_.emplace_back(key, std::move(value)); }
  /// A copy that begins with the keys in `order`, in that order.
  [[nodiscard]] ResolvedTable arranged(const std::vector<std::string>& order) const;
  [[nodiscard]] std::string inline_table() const;  ///< { a = 1.0, b = 2.0 }
  [[nodiscard]] std::string lines() const;         ///< a = 1.0 \n b = 2.0 \n

 private:
  std::vector<std::pair<std::string, std::string>> items_;
};

/// The sections of a scene file; sections of one top-level table stay together.
class ResolvedScene {
 public:
  ResolvedTable top;  ///< schema, title, units, gravity

  /// `table` is the top-level key, `header` the whole line: "[sections.pipe]".
  void add(std::string_view table, std::string header, const ResolvedTable& record);
  /// Text of the scene: tables in `order` (top-level keys as in the file), then all other tables.
  [[nodiscard]] std::string text(const std::vector<std::string>& order) const;

 private:
  struct Section {
    std::string table, text;
  };
  std::vector<Section> sections_;
};

// A scene as a flat list of keys and values, for comparisons of two scenes.
//
//   "contacts.stop.gap" -> "0.3",   "springs.2.stiffness" -> "2.1",   "nodes.A" -> "[0.0,0.0]"
//
// Entries of a list are addressed by name, or by number from 1. All defaults are filled in. A key that names a file has
// the file's content as its value: a changed file is a different value, a moved file is the same.

using ResolvedKeys = std::map<std::string, std::string>;

/// All keys of the scene except the title. Errors: FileError for a file that can no longer be read.
[[nodiscard]] ResolvedKeys resolved_keys(const Scene& scene);

/// Keys with different values, by name: "contacts.stop.gap (0.3, here 0.2)".
[[nodiscard]] std::vector<std::string> differing_keys(const ResolvedKeys& kept, const ResolvedKeys& here);

// Compares the structures of two scenes with all defaults filled in, table by table:
//
//   nodes, lines, sections, members, bodies, surfaces, seams, masses, rigid, springs, damping, supports, contacts,
//   stops, pendulums, reduction, matrices, gravity, run.geometric
//
// Excitation is ignored, because it may differ in a continued run: motions of supports and surfaces, normal forces
// of sliders, temperatures and initial strains of members, and the initial shear of friction.

[[nodiscard]] bool same_units(const toml::table& a, const toml::table& b);
/// Names of the units for messages: "kN, t, m, s".
[[nodiscard]] std::string units_of(const toml::table& scene);
/// The tables of the structure with different content, in the order above.
[[nodiscard]] std::vector<std::string> differing_structure(const toml::table& a, const toml::table& b);

}  // namespace signorini::scene
