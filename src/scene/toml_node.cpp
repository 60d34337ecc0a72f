#include "scene/toml_node.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "base/number.hpp"
#include "scene/record.hpp"

namespace signorini {

namespace {

bool is_override(const toml::source_region& region) {
  return region.path && region.path->starts_with(override_mark);
}

/// Sort key by position in the file; entries of overrides, which have no lines, are last.
std::tuple<bool, toml::source_index, toml::source_index> position(const Entry& entry) {
  const toml::source_region& region = entry.key->source();
  return is_override(region) ? std::tuple(true, toml::source_index{}, toml::source_index{})
                             : std::tuple(false, region.begin.line, region.begin.column);
}

/// Escapes control characters, so that a message stays on one line.
std::string on_one_line(std::string text) {
  for (char& c : text) {
    if (is_control(c)) c = '?';
  }
  return text;
}

/// The text in quotes, shortened for a message.
std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  return '"' + std::string(text.substr(0, longest)) + (text.size() > longest ? "...\"" : "\"");
}

}  // namespace

SourcePlace place_of(const toml::source_region& region) {
  if (is_override(region)) return {region.path->substr(1), SourcePlace::command_line, 0};
  SourcePlace place;
  if (region.path) place.file = *region.path;
  place.line = static_cast<int>(region.begin.line);
  place.column = static_cast<int>(region.begin.column);
  return place;
}

SourcePlace place_of(const toml::node& node) { return place_of(node.source()); }

std::string describe(const toml::node& node) {
  if (const auto* value = node.as_string()) return "the string " + in_quotes(value->get());
  if (const auto* value = node.as_integer()) return fmt::format("the number {}", value->get());
  if (const auto* value = node.as_floating_point()) return "the number " + toml_number(value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "the boolean true" : "the boolean false";
  if (const auto* array = node.as_array()) {
    return "an array of " + count_of(array->size(), "value");
  }
  if (node.is_table()) return "a table";
  return "a date or time";
}

void refuse(const SourcePlace& place, const std::string& key, const std::string& message) {
  if (place.line == SourcePlace::command_line)
    throw UsageError(on_one_line(place.file + ": " + key + ": " + message));
  throw SceneError(place, on_one_line(key), on_one_line(message));
}

std::vector<Entry> entries_of(const toml::table& table) {
  std::vector<Entry> entries;
  entries.reserve(table.size());
  for (const auto& [key, node] : table) entries.push_back({std::string(key.str()), &node, &key});
  const auto before = [](const Entry& a, const Entry& b) { return position(a) < position(b); };
  if (!std::is_sorted(entries.begin(), entries.end(), before))
    std::stable_sort(entries.begin(), entries.end(), before);
  return entries;
}

}  // namespace signorini
