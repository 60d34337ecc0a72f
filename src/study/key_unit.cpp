#include "study/key_unit.hpp"

#include "result/unit_words.hpp"
#include "scene/keys.hpp"

namespace signorini {

std::string key_unit(const std::string& path, const Units& units) {
  const std::size_t first = path.find('.'), last = path.rfind('.');
  if (first == std::string::npos) return "";
  const std::string table = path.substr(0, first), name = path.substr(last + 1);
  // [run], [sections.NAME], [[contacts]]: a table's own key, that of a named one, of one among several.
  for (const std::string& kind : {table, table + ".*", table + "[]"})
    if (const Key* key = find_key(kind, name); key != nullptr && key->name == name)
      return unit_in_words(key->unit, units);
  // A table within a named one: sections.NAME.pipe.wall.
  if (const std::size_t second = path.find('.', first + 1); second < last)
    for (const char* named : {".*", "[]"})
      if (const Key* key = find_key(table + named + path.substr(second, last - second), name);
          key != nullptr && key->name == name)
        return unit_in_words(key->unit, units);
  return "";
}

std::string key_with_unit(const std::string& path, const Units& units) {
  const std::string unit = key_unit(path, units);
  return unit.empty() ? path : path + " [" + unit + "]";
}

}  // namespace signorini
