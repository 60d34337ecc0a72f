// table.hpp: typed reads of one TOML table: check, fill in defaults, record, and report errors.
//
//   Table contact(node, "contacts[]", "contacts.first", place);
//   spec.gap = contact.number("gap");      // type, range and default from the key table
//   contact.finish();                      // refuses keys that were not read
//
// Unknown keys are refused immediately, with a suggestion. A known key that was not read has no meaning in its context
// (normal_stiffness of a slider); finish() reports it.
#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scene/keys.hpp"
#include "scene/resolved_scene.hpp"
#include "scene/toml_node.hpp"

namespace signorini::scene {

class Table {
 public:
  /// `kind` is the table's name in the key table, `path` its name in messages. A null `node` is read as an empty table.
  Table(const toml::table* node, std::string kind, std::string path, SourcePlace place);

  [[nodiscard]] bool has(std::string_view key) const { return node_->contains(key); }
  /// The value as parsed, or null if absent. Marks the key as read.
  [[nodiscard]] const toml::node* raw(std::string_view key);

  // For keys that are required or have a default in the key table:
  [[nodiscard]] double number(std::string_view key);
  [[nodiscard]] int integer(std::string_view key);
  [[nodiscard]] bool flag(std::string_view key);
  [[nodiscard]] std::string text(std::string_view key);
  [[nodiscard]] std::string choice(std::string_view key);
  [[nodiscard]] std::array<double, 2> vector(std::string_view key);
  [[nodiscard]] std::vector<std::string> texts(std::string_view key);
  // For keys without a default; nullopt if the key is absent:
  [[nodiscard]] std::optional<double> optional_number(std::string_view key);
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key);
  [[nodiscard]] std::optional<std::string> optional_text(std::string_view key);
  /// The table that is the value of `key`, of kind "KIND.KEY"; empty if absent. The caller must record its values with
  /// record().
  [[nodiscard]] Table child(std::string_view key);

  /// Throws an error if the key is absent: "missing WHY, expected ...".
  void require(std::string_view key, const std::string& why);
  /// Throws the error "found X, expected Y", where X is the value of the key, or "missing, expected Y".
  [[noreturn]] void wrong(std::string_view key, const std::string& expected) const;
  /// Throws an error with this message at the place of the key, or of the table if the key is absent.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

  /// Refuses keys that were given but not read. `why` ends the message.
  void finish(const std::string& why = "has no meaning here") const;

  /// True if `kind` is the table's name in the key table.
  [[nodiscard]] bool is(std::string_view kind) const { return kind_ == kind; }
  [[nodiscard]] SourcePlace place() const { return place_; }
  /// Place of the key's value, or of the table if the key is absent.
  [[nodiscard]] SourcePlace place(std::string_view key) const;
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Path of a key of this table, for messages.
  [[nodiscard]] std::string path(std::string_view key) const;
  [[nodiscard]] const toml::table& node() const { return *node_; }

  /// Records a value that the caller has read with raw() or child(), as TOML.
  void record(std::string_view key, std::string value) { record_.set(key, std::move(value)); }
  /// All values read so far: keys in the order of the file, then defaults.
  [[nodiscard]] ResolvedTable record() const;

 private:
  const Key& key(std::string_view name) const;
  /// The value in the file, or the default; null if the key has neither.
  const toml::node* value(const Key& key, std::string_view name);

  const toml::table* node_;
  std::string kind_, path_;
  SourcePlace place_;
  std::vector<const toml::node*> read_;
  ResolvedTable record_;
};

/// The tables under [[key]] of the top level. Their paths in messages have the name or the number: "contacts.first",
/// "loads.1".
[[nodiscard]] std::vector<Table> tables_of(Table& top, std::string_view key);

/// The node as a finite number. Errors: SceneError whose message ends with `expected`.
[[nodiscard]] double finite_number(const toml::node& node, const std::string& path,
                                   const std::string& expected);

/// Reads an array of finite numbers.
[[nodiscard]] std::vector<double> number_array(const toml::node& node, const std::string& path,
                                               const std::string& expected);

/// Refuses names that cannot be a column of a CSV file or part of a --set path.
void check_name(const std::string& name, const SourcePlace& place, const std::string& path);
/// Refuses text that cannot be a reference, which is a name as in check_name(), or BODY.NUMBER for a node of a mesh.
void check_reference(const std::string& name, const SourcePlace& place, const std::string& path);

/// Names in the order of the file, with fast search.
class Names {
 public:
  Names() = default;
  Names(std::initializer_list<std::string> names) {
    for (const std::string& name : names) add(name);
  }
  /// Returns false if the name already exists.
  bool add(const std::string& name);
  [[nodiscard]] std::optional<std::size_t> index(const std::string& name) const;
  [[nodiscard]] const std::vector<std::string>& list() const { return list_; }
  [[nodiscard]] std::size_t size() const { return list_.size(); }

 private:
  std::vector<std::string> list_;
  std::unordered_map<std::string, std::size_t> index_;
};

/// Index of the name among the known names. Errors: SceneError "unknown WHAT NAME" with a suggestion; what: "node".
std::size_t check_known(const std::string& name, const Names& known, const std::string& what,
                        const SourcePlace& place, const std::string& path);

}  // namespace signorini::scene
