#include "study/key_unit.hpp"

#include <array>
#include <cctype>
#include <utility>

#include "scene/keys.hpp"

namespace signorini {

namespace {

/// "force/length" with the scene's words; a unit of the table of keys has letters only in names of quantities.
std::string in_words(std::string_view unit, const Units& units) {
  const std::array<std::pair<std::string_view, const std::string*>, 4> words = {
      {{"force", &units.force}, {"mass", &units.mass}, {"length", &units.length}, {"time", &units.time}}};
  std::string text;
  for (std::size_t at = 0; at < unit.size();) {
    std::size_t end = at;
    while (end < unit.size() && std::isalpha(static_cast<unsigned char>(unit[end])) != 0) ++end;
    if (end == at) {
      text += unit[at] == '*' ? ' ' : unit[at];
      ++at;
      continue;
    }
    const std::string_view word = unit.substr(at, end - at);
    std::string said(word);
    for (const auto& [name, own] : words)
      if (word == name) said = *own;
    text += said;
    at = end;
  }
  return text;
}

}  // namespace

std::string key_unit(const std::string& path, const Units& units) {
  const std::size_t first = path.find('.'), last = path.rfind('.');
  if (first == std::string::npos) return "";
  const std::string table = path.substr(0, first), name = path.substr(last + 1);
  // [run], [sections.NAME], [[contacts]]: a table's own key, that of a named one, of one among several.
  for (const std::string& kind : {table, table + ".*", table + "[]"})
    if (const Key* key = find_key(kind, name); key != nullptr && key->name == name)
      return in_words(key->unit, units);
  return "";
}

std::string key_with_unit(const std::string& path, const Units& units) {
  const std::string unit = key_unit(path, units);
  return unit.empty() ? path : path + " [" + unit + "]";
}

}  // namespace signorini
