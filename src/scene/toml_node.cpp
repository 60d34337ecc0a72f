#include "scene/toml_node.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <tuple>

#include "base/files.hpp"
#include "base/text.hpp"
#include "scene/resolved_scene.hpp"
#include "signorini/error.hpp"

namespace signorini::scene {
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

/// Replaces control characters by ?, so that a message stays on one line.
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

/// A short array of numbers as text, such as "[0.0, 5.0]"; empty for any other array.
std::string short_numbers(const toml::array& array) {
  constexpr std::size_t most = 4;
  if (array.empty() || array.size() > most) return {};
  std::vector<std::string> numbers;
  for (const toml::node& item : array) {
    if (const auto* integer = item.as_integer())
      numbers.push_back(std::to_string(integer->get()));
    else if (const auto* number = item.as_floating_point())
      numbers.push_back(toml_number(number->get()));
    else
      return {};
  }
  return toml_array(numbers);
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
    const std::string numbers = short_numbers(*array);
    return numbers.empty() ? "an array of " + base::count_text(array->size(), "value")
                           : "the array " + numbers;
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

std::string scene_text(const std::string& path) {
  constexpr std::size_t longest_file = 64u << 20;
  if (const std::string why = base::input_file_error(path); !why.empty())
    throw FileError(path, why + ", expected a scene file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(path, std::strerror(errno ? errno : EIO));
  std::string text;
  std::array<char, 8192> block;
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > longest_file)
      throw SceneError({path, 0, 0}, "", "larger than 64 MB, expected a scene file");
  }
  if (in.bad()) throw FileError(path, "cannot be read");
  return text;
}

base::Json json_of(const toml::node& node) {
  if (const auto* value = node.as_boolean()) return value->get();
  if (const auto* value = node.as_integer()) return value->get();
  if (const auto* value = node.as_floating_point()) return value->get();
  if (const auto* value = node.as_string()) return value->get();
  base::Json json = node.is_array() ? base::Json::array() : base::Json::object();
  if (const toml::array* array = node.as_array())
    for (const toml::node& item : *array) json.push_back(json_of(item));
  if (const toml::table* table = node.as_table())
    for (const auto& [name, item] : *table) json[std::string(name.str())] = json_of(item);
  return json;
}

}  // namespace signorini::scene
