#include "scene/overrides.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "base/text.hpp"
#include "scene/keys.hpp"
#include "scene/toml_node.hpp"

namespace signorini::scene {
namespace {

// Limit of the number of parts of a path; keys of scenes have far fewer.
constexpr std::size_t most_parts = 16;

/// Pairs of keys that exclude each other and give the same quantity: places_of() always writes the first one.
constexpr std::pair<const char*, const char*> alternatives[] = {{"output_dt", "output_times"},
                                                                {"alpha", "alpha_over_omega1"},
                                                                {"omega", "frequency"},
                                                                {"gap", "gaps"},
                                                                {"cutoff_omega", "cutoff_frequency"}};
/// Pairs of keys that exclude each other and give different quantities.
constexpr std::pair<const char*, const char*> instead[] = {{"tolerance", "cutoff_omega"},
                                                           {"tolerance", "cutoff_frequency"}};

/// Indices of the tables in `array` that `which`, one part of a path, selects by name, by number or by *. Adds the
/// names of all named tables to `names`.
std::vector<std::size_t> chosen_by(const std::string& which, const toml::array& array,
                                   std::vector<std::string>& names) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const toml::table* table = array[i].as_table();
    if (const auto name = table ? (*table)["name"].value<std::string>() : std::nullopt) {
      names.push_back(*name);
      if (*name == which) chosen.push_back(i);
    }
    if (which == "*") chosen.push_back(i);
  }
  const auto number = base::parse_integer(which);
  const bool in_range = number && *number >= 1 && static_cast<std::size_t>(*number) <= array.size();
  if (chosen.empty() && in_range) chosen.push_back(static_cast<std::size_t>(*number - 1));
  return chosen;
}

const std::string all_contacts = "contacts.*.";

/// True if this stop can have `key`, a key of contacts. A stop is no slider, has its own direction and no
/// keys of [matrices]; it can have friction if it has a tangential stiffness or is rigid.
bool can_have(const toml::table& root, const toml::table& stop, const std::string& key) {
  const std::string name = key.substr(0, key.find('.'));
  if (find_key("stops[]", name) == nullptr || name == "normal_force") return false;
  if (name != "friction") return true;
  if (root.contains("matrices")) return false;
  return stop.contains("tangential_stiffness") || stop.contains("seam") ||
         stop["law"].value<std::string>() == "rigid";
}

std::size_t tables_in(const toml::table& root, const std::string& kind) {
  const toml::array* array = root[kind].as_array();
  return array ? array->size() : 0;
}

class Change {
 public:
  Change(const Override& change, const Override& given) : change_(change), given_(given) {
    if (const std::string text = override_text(given_); !base::is_plain_text(text))
      throw UsageError(base::excerpt(text) + ": found bytes that are not plain UTF-8 text");
    std::string segment;
    for (const char c : change.path + ".") {
      if (c != '.') {
        segment += c;
        continue;
      }
      if (segment.empty())
        fail("found an empty name in the path, expected path=value with names separated by dots");
      if (segments_.size() == most_parts) fail("found a path of more than 16 parts");
      segments_.push_back(segment);
      segment.clear();
    }
  }

  void apply(toml::table& root) {
    // A misspelt first name would otherwise make a new table.
    if (!find_key("", segments_[0])) fail("unknown key" + base::suggestion(segments_[0], key_names("")));
    ready_ = parsed();
    place_ = ready_->begin()->first.source();
    into_table(root, segments_);
  }

 private:
  using Segments = std::span<const std::string>;

  [[noreturn]] void fail(const std::string& message) const {
    throw UsageError(override_text(given_) + ": " + message);
  }

  /// Parses the value anew on each call and passes it to `put`, because a copied toml++ node loses its source place.
  template <typename Put>
  void give(const Put& put) {
    toml::table source = ready_ ? *std::exchange(ready_, std::nullopt) : parsed();
    put(std::move(*source.get("value")));
  }

  /// True for words that TOML accepts without quotes.
  static bool is_toml_word(std::string_view value) {
    constexpr std::string_view words[] = {"true", "false", "inf", "nan"};
    return std::find(std::begin(words), std::end(words), value) != std::end(words);
  }

  /// Parses the value as TOML; returns the table { value = VALUE }.
  toml::table parsed() const {
    const std::string file = override_mark + override_text(given_);
    const auto parse = [&](const std::string& value) {
      return toml::parse("value = " + value, std::string_view(file));
    };
    const std::string& value = change_.value;
    const bool one_line = value.find_first_of("\r\n") == std::string::npos;
    const bool bare = value.find_first_of("\"'[]{}=#\\") == std::string::npos;
    const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '/'; };
    const bool begins_with_letter = !value.empty() && letter(value.front());
    try {
      if (one_line && bare && begins_with_letter && !is_toml_word(value)) return parse('"' + value + '"');
      if (one_line) return parse(value);
    } catch (const toml::parse_error&) {
      if (bare && std::any_of(value.begin(), value.end(), letter)) return parse('"' + value + '"');
    }
    fail("the value is not TOML, expected a number, a word, \"text\", [...] or { ... }");
  }

  /// TOML text of a table or list on the path that the file lacks: the key's default if it is a list, else an empty table.
  std::string left_out(Segments rest) const {
    const Key* key = rest.size() == segments_.size() ? find_key("", rest[0]) : nullptr;
    const bool numbers = key != nullptr && key->default_value.starts_with('[');
    return numbers ? std::string(key->default_value) : "{}";
  }

  void into_table(toml::table& table, Segments rest) {
    const toml::key key(rest[0], place_);
    if (rest.size() == 1) {
      // The other key of a pair is erased, because the scene must not contain both.
      const auto erase_conflicting_key = [&](const auto& pairs) {
        for (const auto& [a, b] : pairs) {
          if (rest[0] == a) table.erase(b);
          if (rest[0] == b) table.erase(a);
        }
      };
      erase_conflicting_key(alternatives);
      erase_conflicting_key(instead);
      give([&](toml::node&& value) { table.insert_or_assign(key, std::move(value)); });
      return;
    }
    if (!table.contains(rest[0])) {
      toml::table nested = toml::parse("value = " + left_out(rest), override_mark + override_text(given_));
      table.insert_or_assign(key, std::move(*nested.get("value")));
    }
    toml::node* next = table.get(rest[0]);
    if (rest[0] == "friction" && next->is_number()) next = &split_friction(table);
    into(*next, rest);
  }

  /// Replaces friction = 0.3 by the table { static = 0.3, kinetic = 0.3 }, which means the same.
  static toml::node& split_friction(toml::table& table) {
    const double value = *table.get("friction")->value<double>();
    const toml::source_path_ptr& file = table.get("friction")->source().path;
    toml::table both =
        toml::parse(fmt::format("value = {{ static = {0}, kinetic = {0} }}", base::format_number(value)),
                    file ? std::string_view(*file) : std::string_view());
    return table.insert_or_assign("friction", std::move(*both.get("value"))).first->second;
  }

  /// Puts the value into `node`, which rest[0] names; rest[1] and later parts are keys inside `node`.
  void into(toml::node& node, Segments rest) {
    const std::string done = change_.path.substr(0, offset_of(rest.subspan(1)) - 1);
    if (auto* table = node.as_table()) {
      into_table(*table, rest.subspan(1));
    } else if (auto* array = node.as_array()) {
      into_array(*array, rest.subspan(1), done);
    } else {
      fail(fmt::format("{} is {}, not a table", done, describe(node)));
    }
  }

  std::size_t offset_of(Segments rest) const {
    std::size_t offset = 0;
    for (std::size_t i = 0; i + rest.size() < segments_.size(); ++i) offset += segments_[i].size() + 1;
    return offset;
  }

  void into_array(toml::array& array, Segments rest, const std::string& done) {
    const std::string& which = rest[0];
    std::vector<std::string> names;
    const std::vector<std::size_t> chosen = chosen_by(which, array, names);
    if (chosen.empty()) {
      const std::string hint = base::suggestion(which, names);
      if (array.empty()) fail(fmt::format("{} has no entries, so no \"{}\"", done, which));
      fail(fmt::format(
          "{} has {}, but no \"{}\"{}", done,
          array.size() == 1 ? "1 entry" : std::to_string(array.size()) + " entries", which,
          hint.empty() ? fmt::format("; expected a name, a number from 1 to {}, or * for all", array.size())
                       : hint));
    }
    for (const std::size_t i : chosen) {
      if (rest.size() == 1) {
        give([&](toml::node&& value) {
          array.replace(array.begin() + static_cast<std::ptrdiff_t>(i), std::move(value));
        });
      } else {
        into(array[i], rest);
      }
    }
  }

  const Override& change_;
  const Override& given_;  // the override as the user gave it, for messages
  std::vector<std::string> segments_;
  std::optional<toml::table> ready_;
  toml::source_region place_;
};

std::vector<std::string> places_of_one(const toml::table& root, const std::string& path) {
  struct Place {
    const toml::node* node;
    std::string text;
  };
  std::vector<Place> places{{&root, ""}};
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    std::string segment = path.substr(begin, end - begin);
    begin = end + 1;
    for (const auto& [a, b] : alternatives)
      if (segment == b) segment = a;
    std::vector<Place> next;
    for (const Place& place : places) {
      const std::string before = place.text.empty() ? "" : place.text + ".";
      const toml::array* array = place.node ? place.node->as_array() : nullptr;
      const toml::table* table = place.node ? place.node->as_table() : nullptr;
      std::vector<std::string> names;
      const std::vector<std::size_t> chosen =
          array ? chosen_by(segment, *array, names) : std::vector<std::size_t>{};
      for (const std::size_t i : chosen) next.push_back({array->get(i), before + std::to_string(i + 1)});
      if (chosen.empty()) next.push_back({table ? table->get(segment) : nullptr, before + segment});
    }
    places = std::move(next);
  }
  std::vector<std::string> texts;
  for (Place& place : places) texts.push_back(std::move(place.text));
  return texts;
}

}  // namespace

std::string override_text(const Override& change) {
  return change.shown_as.empty() ? "--set " + change.path + "=" + change.value : change.shown_as;
}

std::vector<std::string> matching_paths(const toml::table& root, const std::string& path) {
  const toml::array* stops = root["stops"].as_array();
  if (!path.starts_with(all_contacts) || !stops) return {path};
  const std::string key = path.substr(all_contacts.size());
  std::vector<std::string> meant;
  if (tables_in(root, "contacts") > 0) meant.push_back(path);
  for (std::size_t i = 0; i < stops->size(); ++i) {
    const toml::table* stop = (*stops)[i].as_table();
    if (!stop || !can_have(root, *stop, key)) continue;
    const auto name = (*stop)["name"].value<std::string>();
    meant.push_back(fmt::format("stops.{}.{}", name ? *name : std::to_string(i + 1), key));
  }
  return meant.empty() ? std::vector<std::string>{path} : meant;
}

std::vector<std::string> places_of(const toml::table& root, const std::string& path) {
  std::vector<std::string> places;
  for (const std::string& meant : matching_paths(root, path)) {
    std::vector<std::string> more = places_of_one(root, meant);
    places.insert(places.end(), more.begin(), more.end());
  }
  return places;
}

std::string count_matching_tables(const toml::table& root, const std::string& path) {
  if (("." + path + ".").find(".*.") == std::string::npos) return {};
  std::size_t met = 0, stops = 0;
  const std::string kind = path.substr(0, path.find('.'));
  for (const std::string& place : places_of(root, path)) ++(place.starts_with(kind + ".") ? met : stops);
  std::string text = fmt::format("matches {} of [[{}]]", tables_in(root, kind) > 0 ? met : 0, kind);
  if (!path.starts_with(all_contacts) || tables_in(root, "stops") == 0) return text;
  text += fmt::format(", {} of [[stops]]", stops);
  if (const std::size_t others = tables_in(root, "stops") - stops; others > 0)
    text += fmt::format(" ({} cannot have this key with {} present settings)", others,
                        others == 1 ? "its" : "their");
  return text;
}

bool is_within_path(const std::string& a, const std::string& b) {
  return a.starts_with(b) && (a.size() == b.size() || a[b.size()] == '.');
}

void apply_overrides(toml::table& root, const std::vector<Override>& overrides) {
  for (const Override& change : overrides)
    for (const std::string& path : matching_paths(root, change.path)) {
      const Override one{path, change.value};
      Change(one, change).apply(root);
    }
}

const Key* key_of(const std::string& path) {
  const std::size_t first = path.find('.'), last = path.rfind('.');
  if (first == std::string::npos) return nullptr;
  const std::string table = path.substr(0, first), name = path.substr(last + 1);
  // [run], [sections.NAME], [[contacts]]: the table itself, a named table, or one of several.
  for (const std::string& kind : {table, table + ".*", table + "[]"})
    if (const Key* key = find_key(kind, name); key != nullptr && key->name == name) return key;
  // A table within a named table: sections.NAME.pipe.wall.
  if (const std::size_t second = path.find('.', first + 1); second < last)
    for (const char* named : {".*", "[]"})
      if (const Key* key = find_key(table + named + path.substr(second, last - second), name);
          key != nullptr && key->name == name)
        return key;
  return nullptr;
}

KeyRange range_of(const Key& key) {
  switch (key.type) {
    case KeyType::positive:
      return {.min = 0.0, .excludes_min = true};
    case KeyType::non_negative:
    case KeyType::friction:
      return {.min = 0.0};
    case KeyType::fraction:
      return {.min = 0.0, .max = 1.0};
    default:
      return {};
  }
}

}  // namespace signorini::scene
