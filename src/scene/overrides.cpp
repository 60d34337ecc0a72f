#include "scene/overrides.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <span>

#include "base/excerpt.hpp"
#include "base/number.hpp"
#include "base/suggest.hpp"
#include "scene/keys.hpp"
#include "scene/toml_node.hpp"

namespace signorini {

namespace {

constexpr std::size_t deepest = 16;  // no key of a scene lies nearly as deep

class Change {
 public:
  explicit Change(const Override& change) : change_(change) {
    if (const std::string text = text_of(change_); !is_plain_text(text))
      throw UsageError(excerpt(text) + ": found bytes that are no plain UTF-8 text");
    std::string segment;
    for (const char c : change.path + ".") {
      if (c != '.') {
        segment += c;
        continue;
      }
      if (segment.empty()) fail("expected path=value, the path being names with a dot between");
      if (segments_.size() == deepest) fail("found a path of more than 16 parts");
      segments_.push_back(segment);
      segment.clear();
    }
  }

  void apply(toml::table& root) {
    // A misspelt first name would otherwise make a new table.
    if (!find_key("", segments_[0])) fail("unknown key" + suggestion(segments_[0], key_names("")));
    into_table(root, segments_);
  }

 private:
  using Segments = std::span<const std::string>;

  [[noreturn]] void fail(const std::string& message) const {
    throw UsageError(text_of(change_) + ": " + message);
  }

  /// `value = VALUE`, each time anew: a copied node forgets its place.
  toml::table parsed() const {
    const std::string file = text_of(change_);
    const auto parse = [&](const std::string& value) {
      return toml::parse("value = " + value, std::string_view(file));
    };
    const std::string& value = change_.value;
    const bool one_line = value.find_first_of("\r\n") == std::string::npos;
    try {
      if (one_line) return parse(value);
    } catch (const toml::parse_error&) {
      const bool letters = std::any_of(value.begin(), value.end(), [](char c) {
        return std::isalpha(static_cast<unsigned char>(c)) || c == '/';
      });
      const bool word = letters && value.find_first_of("\"'[]{}=#\\") == std::string::npos;
      if (word) return parse('"' + value + '"');
    }
    fail("the value is not TOML, expected a number, a word, \"text\", [...] or { ... }");
  }

  void into_table(toml::table& table, Segments rest) {
    toml::table source = parsed();
    const toml::key key(rest[0], source.begin()->first.source());
    if (rest.size() == 1) {
      // The other of two ways to say the same would contradict.
      constexpr std::pair<const char*, const char*> alternatives[] = {
          {"output_dt", "output_times"}, {"alpha", "alpha_over_omega1"},
          {"omega", "frequency"},        {"cutoff_omega", "cutoff_frequency"},
          {"tolerance", "cutoff_omega"}, {"tolerance", "cutoff_frequency"}};
      for (const auto& [a, b] : alternatives) {
        if (rest[0] == a) table.erase(b);
        if (rest[0] == b) table.erase(a);
      }
      table.insert_or_assign(key, std::move(*source.get("value")));
      return;
    }
    if (!table.contains(rest[0])) {
      toml::table nested = toml::parse(
          "value = {}", source.source().path ? std::string_view(*source.source().path) : std::string_view());
      table.insert_or_assign(key, std::move(*nested.get("value")));
    }
    toml::node* next = table.get(rest[0]);
    if (rest[0] == "friction" && next->is_number()) next = &split_friction(table);
    into(*next, rest);
  }

  /// friction = 0.3 is short for { static = 0.3, kinetic = 0.3 }.
  static toml::node& split_friction(toml::table& table) {
    const double value = *table.get("friction")->value<double>();
    const SourcePlace place = place_of(*table.get("friction"));
    toml::table both = toml::parse(fmt::format("value = {{ static = {0}, kinetic = {0} }}", shortest(value)),
                                   std::string_view(place.file));
    return table.insert_or_assign("friction", std::move(*both.get("value"))).first->second;
  }

  /// node is what rest[0] names; rest[1] and the following lie inside of it.
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
    std::vector<std::size_t> chosen;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < array.size(); ++i) {
      const toml::table* table = array[i].as_table();
      if (const auto name = table ? (*table)["name"].value<std::string>() : std::nullopt) {
        names.push_back(*name);
        if (*name == which) chosen.push_back(i);
      }
      if (which == "*") chosen.push_back(i);
    }
    const auto number = parse_integer(which);
    const bool in_range = number && *number >= 1 && static_cast<std::size_t>(*number) <= array.size();
    if (chosen.empty() && in_range) chosen.push_back(static_cast<std::size_t>(*number - 1));
    if (chosen.empty()) {
      fail(fmt::format("there is no \"{}\" among the {} of {}{}", which, array.size(), done,
                       suggestion(which, names)));
    }
    for (const std::size_t i : chosen) {
      if (rest.size() == 1) {
        toml::table source = parsed();
        array.replace(array.begin() + static_cast<std::ptrdiff_t>(i), std::move(*source.get("value")));
      } else {
        into(array[i], rest);
      }
    }
  }

  const Override& change_;
  std::vector<std::string> segments_;
};

}  // namespace

std::string text_of(const Override& change) {
  return std::string(override_prefix) + change.path + "=" + change.value;
}

void apply_overrides(toml::table& root, const std::vector<Override>& overrides) {
  for (const Override& change : overrides) Change(change).apply(root);
}

}  // namespace signorini
