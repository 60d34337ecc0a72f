#include "scene/key_path.hpp"

namespace signorini {

const Key* key_of(const std::string& path) {
  const std::size_t first = path.find('.'), last = path.rfind('.');
  if (first == std::string::npos) return nullptr;
  const std::string table = path.substr(0, first), name = path.substr(last + 1);
  // [run], [sections.NAME], [[contacts]]: the table itself, a named table, or one of several.
  for (const std::string& kind : {table, table + ".*", table + "[]"})
    if (const Key* key = find_key(kind, name); key != nullptr && key->name == name) return key;
  // A table within a named one: sections.NAME.pipe.wall.
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
      return {.least = 0.0, .open = true};
    case KeyType::non_negative:
    case KeyType::friction:
      return {.least = 0.0};
    case KeyType::fraction:
      return {.least = 0.0, .greatest = 1.0};
    default:
      return {};
  }
}

}  // namespace signorini
