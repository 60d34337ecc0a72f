#include "scene/toml_json.hpp"

namespace signorini {

Json json_of(const toml::node& node) {
  if (const auto* value = node.as_boolean()) return value->get();
  if (const auto* value = node.as_integer()) return value->get();
  if (const auto* value = node.as_floating_point()) return value->get();
  if (const auto* value = node.as_string()) return value->get();
  Json json = node.is_array() ? Json::array() : Json::object();
  if (const toml::array* array = node.as_array())
    for (const toml::node& item : *array) json.push_back(json_of(item));
  if (const toml::table* table = node.as_table())
    for (const auto& [name, item] : *table) json[std::string(name.str())] = json_of(item);
  return json;
}

}  // namespace signorini
